"""What the pages show and code makes: each name stands on a page as {{ name }}."""

from . import from_citation, from_code, from_rows


def everything():
    """Return {name: Markdown} for all pages."""
    return {
        "certified": from_rows.certified(),
        "time_for_20": from_rows.time_for_20(),
        "certification": from_rows.certification_tables(),
        "reach": from_rows.reach(),
        "reach_in_words": from_rows.reach_in_words(),
        "solvers": from_code.solvers(),
        "equations": from_code.equations(),
        "beyond": from_code.beyond(),
        "variables": from_code.variables(),
        "how_to_cite": from_citation.how_to_cite(),
        "bibtex": from_citation.bibtex(),
    }
