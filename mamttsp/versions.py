"""The versions that a bug report needs: of this package, its solvers and the machine."""

import os
import platform
from importlib import metadata
from pathlib import Path

#: of this package
VERSION = "0.2.0"
_PACKAGES = ("numpy", "scipy", "numba", "networkx", "pyomo", "cvxpy")
_SOLVERS = ("clarabel", "pyscipopt", "highspy", "gurobipy", "mosek", "xpress", "coptpy")


def versions():
    """Return a table of versions, a line each; what is not installed says so."""
    rows = [("mamttsp", VERSION), ("Python", platform.python_version())]
    rows += [(name, _version(name)) for name in _PACKAGES + _SOLVERS]
    rows += [("SCIP", _scip()), ("system", platform.platform())]
    rows += [("processor", processor()), ("cores", str(os.cpu_count()))]
    return "\n".join(f"{name:<11} {value}" for name, value in rows)


def _version(package):
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return "not installed"


def _scip():
    try:
        from pyscipopt import Model
    except ImportError:
        return "not installed"
    model = Model()
    return f"{model.getMajorVersion()}.{model.getMinorVersion()}.{model.getTechVersion()}"


def processor():
    """Return the processor's name: Linux keeps it in /proc/cpuinfo; elsewhere the platform module knows it."""
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text().splitlines() if cpuinfo.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()
