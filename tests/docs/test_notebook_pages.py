"""What a notebook becomes on its way to its page."""

import importlib.util

from tests.docs.conftest import ROOT

_spec = importlib.util.spec_from_file_location("notebook_pages", ROOT / "docs" / "notebook_pages.py")
pages = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(pages)


def code(source="", outputs=(), tags=()):
    metadata = {"tags": list(tags)}
    return {"cell_type": "code", "id": "a", "metadata": metadata, "source": source, "outputs": list(outputs)}


def prose(source):
    return {"cell_type": "markdown", "id": "b", "metadata": {}, "source": source}


def printed(text):
    return {"output_type": "stream", "name": "stdout", "text": text}


def test_the_first_heading_has_the_number_of_the_file():
    notebook = {"cells": [prose(["# A first solve\n", "\n", "Text"])]}
    pages.number_heading(notebook, "01-first-solve")
    assert notebook["cells"][0]["source"] == "# 01 · A first solve\n\nText"


def test_words_below_a_picture_describe_it():
    notebook = {"cells": [code(), prose("*In words:* one *agent* flies."), code(), prose("Other words")]}
    pages.describe_pictures(notebook)
    assert notebook["cells"][0]["metadata"]["mystnb"] == {"image": {"alt": "one agent flies."}}
    assert "mystnb" not in notebook["cells"][2]["metadata"]


def test_only_solutions_are_folded():
    notebook = {"cells": [code(tags=["solution"]), code(tags=["check"])]}
    pages.fold_solutions(notebook)
    assert ["hide-input" in cell["metadata"]["tags"] for cell in notebook["cells"]] == [True, False]


def test_markdown_that_a_cell_showed_becomes_prose():
    shown = {"output_type": "display_data", "metadata": {}, "data": {"text/markdown": ["[a](b.ipynb)"]}}
    notebook = {"cells": [code(outputs=[shown, printed("x")])]}
    pages.show_markdown(notebook)
    cell, below = notebook["cells"]
    assert cell["outputs"] == [printed("x")] and below["source"] == ["[a](b.ipynb)"]


def test_only_printed_code_is_shown_as_code():
    notebook = {"cells": [code(outputs=[printed("def f():\n    pass\n"), printed("a = 1"), printed("no: code")])]}
    pages.show_printed_code(notebook)
    first, *others = notebook["cells"][0]["outputs"]
    assert first["data"] == {"text/markdown": "```python\ndef f():\n    pass\n```"}
    assert others == [printed("a = 1"), printed("no: code")]


def test_what_vanished_leaves_no_empty_box():
    vanished = {"output_type": "display_data", "metadata": {}, "data": {"text/plain": [""]}}
    picture = {"output_type": "display_data", "metadata": {}, "data": {"image/png": "x", "text/plain": [""]}}
    failed = {"output_type": "error", "ename": "E", "evalue": "", "traceback": []}
    notebook = {"cells": [prose("Text"), code(outputs=[vanished, printed(" \n"), picture, printed("x"), failed])]}
    pages.drop_what_vanished(notebook)
    assert notebook["cells"][1]["outputs"] == [picture, printed("x"), failed]


def test_only_printed_columns_keep_their_lines():
    columns, sentence = printed("a    b    c\n1    2    3\n"), printed("One sentence, and  two blanks in it.")
    frame = {"output_type": "execute_result", "data": {"text/html": "<table>", "text/plain": columns["text"]}}
    notebook = {"cells": [code(outputs=[columns]), code(outputs=[sentence]), code(outputs=[sentence, frame])]}
    pages.mark_columns(notebook)
    assert ["columns" in cell["metadata"]["tags"] for cell in notebook["cells"]] == [True, False, False]


def test_links_to_docs_lead_to_pages_and_those_to_the_glossary_to_a_term():
    text = "[a](../README.md), [b](../docs/references.md#b-2000), [gap](../docs/glossary.md)"
    more = '[cones](../../docs/glossary.md "second-order cone")'
    notebook = {"cells": [prose([text, more]), code("read('../docs/data')")]}
    pages.lead_to_pages(notebook)
    shown, untouched = (cell["source"] for cell in notebook["cells"])
    assert shown == (
        "[a](../index.md), [b](../references.md#b-2000), {term}`gap <gap>`{term}`cones <second-order cone>`"
    )
    assert untouched == "read('../docs/data')"


def test_of_links_to_sources_the_text_stays():
    notebook = {"cells": [prose("See [`mamttsp/a.md`](../mamttsp/a.md), [01](01-a.ipynb).")]}
    pages.lead_to_pages(notebook)
    assert notebook["cells"][0]["source"] == "See `mamttsp/a.md`, [01](01-a.ipynb)."
