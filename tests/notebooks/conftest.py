"""The website of the notebooks, built once for all tests that look at it."""

import subprocess
import sys

import pytest
from notebooks.running import ROOT


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """The folder of the built site."""
    folder = tmp_path_factory.mktemp("website") / "site"
    builder = ROOT / "notebooks" / "website" / "build.py"
    subprocess.run([sys.executable, str(builder), str(folder)], check=True, timeout=200)
    return folder
