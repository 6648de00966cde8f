"""Print the lowest versions that pyproject.toml allows, one pin a line: of the package and of each extra named."""

import re
import sys
import tomllib
from pathlib import Path

project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]
wanted = project["dependencies"] + [one for name in sys.argv[1:] for one in project["optional-dependencies"][name]]
for requirement in wanted:
    print(re.sub(r">=([\d.]+).*", r"==\1", requirement))
