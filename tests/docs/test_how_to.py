"""The Python on the pages runs as it stands there, block after block."""

import re

import pytest

from tests.docs.conftest import ROOT

PAGES = ("index.md", "how-to/own-data.md", "how-to/methods.md", "how-to/citing.md")


@pytest.mark.parametrize("name", PAGES)
def test_python_on_a_page_runs(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs" / name).read_text(encoding="utf-8"), re.M | re.S)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, name, "exec"), names)
