"""Write what a script has measured into its place in benchmarks/README.md."""

from pathlib import Path

README = Path(__file__).with_name("README.md")


def write_section(script, lines):
    """Replace what is between the script's mark and the next `to here`."""
    begin, end = f"<!-- {script} writes from here -->\n", "<!-- to here -->\n"
    before, rest = README.read_text(encoding="utf-8").split(begin)
    _, after = rest.split(end, 1)
    README.write_text("\n".join([f"{before}{begin}", *lines, "", f"{end}{after}"]), encoding="utf-8")
