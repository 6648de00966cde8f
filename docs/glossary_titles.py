"""Links to a term of the glossary carry its definition as their title, which browsers show under a pointer."""

from docutils import nodes

PAGE = "glossary"


def add(app, tree, page):
    """Sphinx's event `doctree-resolved`: give titles to the links of a page that has its links already."""
    links = [link for link in tree.findall(nodes.reference) if f"{PAGE}.html#term-" in link.get("refuri", "")]
    if links:
        says = definitions(app.env.get_doctree(PAGE))
        for link in links:
            link["reftitle"] = says[link["refuri"].partition("#")[2]]


def definitions(glossary):
    """Return {anchor: definition} of the terms in the page's tree."""
    return {
        anchor: " ".join(item.next_node(nodes.definition).astext().split())
        for item in glossary.findall(nodes.definition_list_item)
        for term in item.findall(nodes.term)
        for anchor in term["ids"]
    }
