"""A table of long texts as lines that open: what a reader compares stands in the line, the rest behind it."""

from html import escape


class Folded:
    """A DataFrame for a notebook: each row is a line of its `head` columns, and opens to show the others.

    As text, where nothing opens, only the lines are there. Values are shown as `str` has them, empty ones not at all.

    >>> import pandas as pd
    >>> from mamttsp.study.folded import Folded
    >>> Folded(pd.DataFrame({"claim": ["twice as fast"], "rule": ["mean over mean"]}), ["claim"])
    twice as fast
    """

    def __init__(self, table, head):
        self.table, self.head = table.astype(str), list(head)

    def __repr__(self):
        return "\n".join(map(" · ".join, self.table[self.head].to_numpy()))

    def _repr_html_(self):
        rows = (self._row(row) for _, row in self.table.iterrows())
        return '<div style="text-align: left">\n' + "\n".join(rows) + "\n</div>"

    def _row(self, row):
        line = escape(" · ".join(row[self.head]))
        rest = "".join(
            f"<li><i>{escape(name)}</i>: {escape(value)}</li>" for name, value in row.drop(self.head).items() if value
        )
        return f"<details><summary>{line}</summary><ul>{rest}</ul></details>"
