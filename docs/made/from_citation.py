"""How to cite, from CITATION.cff, as Markdown."""

from functools import cache
from pathlib import Path

import yaml

CITATION = Path(__file__).parents[2] / "CITATION.cff"


@cache
def citation():
    return yaml.safe_load(CITATION.read_text(encoding="utf-8"))["preferred-citation"]


def how_to_cite():
    """The paper as one line, with its links."""
    paper, names = citation(), []
    for author in citation()["authors"]:
        initials = "".join(f"{name[0]}. " for name in author["given-names"].split())
        names.append(initials + author["family-names"])
    arxiv = paper["identifiers"][0]["value"].removeprefix("arXiv:")
    return (
        f"{', '.join(names)}, *{paper['title']}*, {paper['conference']['name']}, pp. {paper['start']}–{paper['end']}, "
        f"[doi {paper['doi']}](https://doi.org/{paper['doi']}), [arXiv {arxiv}](https://arxiv.org/abs/{arxiv})"
    )


def bibtex():
    """The paper as a BibTeX entry."""
    paper = citation()
    names = " and ".join(f"{a['family-names']}, {a['given-names']}" for a in paper["authors"])
    fields = {"author": names, "title": f"{{{paper['title']}}}", "booktitle": paper["collection-title"]}
    fields |= {"year": paper["year"], "pages": f"{paper['start']}--{paper['end']}", "doi": paper["doi"]}
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items()]
    return "\n".join(["```bibtex", "@inproceedings{Philip2025,", *lines, "}", "```"])
