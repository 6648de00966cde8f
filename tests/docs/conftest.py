"""The site, built once for all tests that look at it; what Sphinx warns of is an error."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def pytest_collection_modifyitems(items):
    """Keep the tests of the site in one process of several, so that it is built once."""
    for item in items:
        if "site" in getattr(item, "fixturenames", ()):
            item.add_marker(pytest.mark.xdist_group("site"))


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """The folder of the built site. It has to be built within 3 minutes, on a busy machine too."""
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-d", str(folder / "doctrees")]
    subprocess.run([*command, str(ROOT / "docs"), str(folder / "site")], check=True, timeout=180)
    return folder / "site"
