"""The notebooks as a course: what each one is about, read from its own cells so that the map cannot go stale."""

import ast
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

WORDS_PER_MINUTE, CELLS_PER_MINUTE = 100, 2


@dataclass(frozen=True)
class Chapter:
    """A notebook: its heading, and what its cells name.

    file: its name. sections: of the paper. modules: of this package, whose names its code uses or whose code it shows.
    figures: that it saves, without suffix. rows: files in paper_results. exercises: their file, or None; tasks: how
    many there are. minutes: to read it at 100 words and 2 code cells a minute, rounded up to the next 5.
    """

    file: str
    title: str
    sections: tuple
    modules: tuple
    figures: tuple
    rows: tuple
    exercises: str | None
    tasks: int
    minutes: int

    @property
    def files(self):
        """The files that it names, relative to its own folder."""
        figures = [f"../figures/{name}{suffix}" for name in self.figures for suffix in (".pdf", ".png")]
        return [*figures, *(f"../paper_results/{name}" for name in self.rows)]


def notebooks(folder):
    """Return the paths of the numbered notebooks in a folder, in order, without copies such as 01-x.nbconvert.ipynb."""
    return sorted(path for path in Path(folder).glob("[0-9][0-9]-*.ipynb") if "." not in path.stem)


def read_course(folder):
    """Return a Chapter for each notebook in a folder after the overview, number 00, in their order."""
    return [_chapter(path) for path in notebooks(folder) if not path.name.startswith("00")]


def read_questions(path):
    """Return {number: text} of the questions under "Exercises" at the end of a notebook; {} if it has none."""
    cells = json.loads(Path(path).read_text(encoding="utf-8"))["cells"]
    prose = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    _, _, listed = prose.partition("\n## Exercises\n")
    found = re.findall(r"^(\d+)\. (.+(?:\n+(?: {2,}\S.*))*)", listed.partition("\n## ")[0], re.MULTILINE)
    return {int(number): text for number, text in found}


def count_minutes(cells):
    """Return the minutes that cells take: 100 words and 2 code cells a minute."""
    prose = ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]
    words, codes = sum(len(text.split()) for text in prose), len(cells) - len(prose)
    return words / WORDS_PER_MINUTE + codes / CELLS_PER_MINUTE


def read_sections(path):
    """Return {heading: minutes} for the sections of a notebook, by their headings of the second level."""
    found, heading = {}, ""
    for cell in json.loads(Path(path).read_text(encoding="utf-8"))["cells"]:
        source = "".join(cell["source"])
        prose = cell["cell_type"] == "markdown"
        for part in re.split(r"^(?=## )", source, flags=re.MULTILINE) if prose else [source]:
            if prose and part.startswith("## "):
                heading = part.splitlines()[0].removeprefix("## ")
            found[heading] = found.get(heading, 0.0) + count_minutes([cell | {"source": part}])
    found.pop("", None)  # what stands before the first section
    return found


def table(chapters):
    """Return the map of the course in Markdown: a row for each notebook, each module where it first occurs."""
    heads = ("paper, Section", "notebook", "modules, where first used", "figures", "rows", "tasks", "minutes")
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    seen = set()
    for chapter in chapters:
        cells = (
            ", ".join(chapter.sections) or "beyond it",
            f"[{chapter.file[:2]} {chapter.title}]({chapter.file})",
            ", ".join(f"`{name.removeprefix('mamttsp.')}`" for name in chapter.modules if name not in seen),
            ", ".join(f"[{name}](../figures/{name}.png)" for name in chapter.figures),
            ", ".join(f"[{name}](../paper_results/{name})" for name in chapter.rows),
            f"[{chapter.tasks}]({chapter.exercises})" if chapter.exercises else "",
            str(chapter.minutes),
        )
        seen.update(chapter.modules)
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _chapter(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    prose, codes = (["".join(c["source"]) for c in cells if c["cell_type"] == kind] for kind in ("markdown", "code"))
    text, code = "\n".join(prose), "\n".join(codes)
    minutes = count_minutes(cells)
    sheets = notebooks(path.parent / "exercises")
    exercises = next((sheet for sheet in sheets if sheet.name[:2] == path.name[:2]), None)
    return Chapter(
        file=path.name,
        title=text.splitlines()[0].lstrip("# "),
        sections=_named(r"Section ([IVX]+(?:-[A-Z])?)", text),
        modules=_modules(code),
        figures=_named(r"\.\./figures/([\w-]+)", code),
        rows=_named(r"((?:instances/)?[\w-]+\.csv)", text + code),
        exercises=exercises and f"exercises/{exercises.name}",
        tasks=exercises.read_text(encoding="utf-8").count('"## Task ') if exercises else 0,
        minutes=5 * -int(-minutes // 5),
    )


def _named(pattern, text):
    return tuple(sorted(set(re.findall(pattern, text))))


def _modules(code):
    """The modules of this package that code imports, takes a name from, or shows with `source`."""
    names = {f"mamttsp.formulations.pyomo.{method}" for method in re.findall(r'\bsource\("(\w+)"', code)}
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.ImportFrom) and node.module.partition(".")[0] == "mamttsp":
            taken = [f"{node.module}.{alias.name}" for alias in node.names]
            names.update(name if _is_module(name) else node.module for name in taken)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "mamttsp":
            names.add(getattr(sys.modules["mamttsp"], node.attr).__module__)
    return tuple(sorted(names))


def _is_module(name):
    path = Path(__file__).parents[2].joinpath(*name.split("."))
    return path.is_dir() or path.with_suffix(".py").is_file()
