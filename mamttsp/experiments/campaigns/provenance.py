"""Where a row comes from: the code, the machine and the day."""

import datetime
import os
import platform
import subprocess
from pathlib import Path

import psutil

from ...versions import VERSION, processor


def provenance(jobs):
    """Return the columns that all rows of a campaign share; jobs: how many runs share the machine at a time."""
    return {
        "version": VERSION,
        "commit": _commit(),
        "jobs": jobs,
        "cpu": processor(),
        "cores": os.cpu_count(),
        "machine_memory_gb": round(psutil.virtual_memory().total / 2**30, 1),
        "os": f"{platform.system()} {platform.release().partition('-')[0]}",
        "python": platform.python_version(),
    }


def now():
    """Return the date and time in UTC, to the second."""
    return datetime.datetime.now(datetime.UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def _commit():
    """Return the commit of this package's files, "+changed" if they differ from it, None without a repository."""
    commit = _git("rev-parse", "--short=12", "HEAD")
    if commit is None or _git("ls-files", "--error-unmatch", "__init__.py") is None:
        return None
    return commit + ("+changed" if _git("status", "--porcelain", "--", ".") else "")


def _git(*arguments):
    folder = Path(__file__).parents[2]
    try:
        done = subprocess.run(["git", *arguments], cwd=folder, capture_output=True, text=True)
    except OSError:
        return None
    return done.stdout.strip() if done.returncode == 0 else None
