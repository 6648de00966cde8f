"""Rows that open: the line, what is behind it, and nothing that a page would take for its own."""

from xml.etree import ElementTree

import pandas as pd

from mamttsp.study.folded import Folded

TABLE = pd.DataFrame(
    {"section": ["I", "V-B"], "claim": ["a < b & c", "two"], "rule": ["at most 3", ""], "rows": [20, 5]}
)


def test_each_row_is_a_line_that_opens():
    page = ElementTree.fromstring(Folded(TABLE, ["section", "claim"])._repr_html_())
    first, second = page.findall("details")
    assert [row.find("summary").text for row in (first, second)] == ["I · a < b & c", "V-B · two"]
    assert ["".join(item.itertext()) for item in first.iter("li")] == ["rule: at most 3", "rows: 20"]
    assert ["".join(item.itertext()) for item in second.iter("li")] == ["rows: 5"]  # an empty value is left out


def test_as_text_only_the_lines_are_there():
    assert repr(Folded(TABLE, ["claim", "rows"])) == "a < b & c · 20\ntwo · 5"
