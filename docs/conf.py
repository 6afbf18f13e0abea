"""Sphinx settings: MyST pages, autodoc for the interface, furo."""

import evenbreak

project = "evenbreak"
author = "The evenbreak authors"
project_copyright = author
version = release = evenbreak.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build", "images"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
napoleon_attr_annotations = False
# A docstring's words in single backquotes are code.
default_role = "literal"
nitpicky = False

html_theme = "furo"
html_title = f"evenbreak {release}"
html_static_path: list[str] = []


def prepare(app, what, name, obj, options, lines) -> None:  # noqa: ARG001
    """Rewrite a docstring where napoleon would misread it.

    It takes `a: b` in the first line of an attribute for a type, and examples that follow a
    section for a part of that section.
    """
    if what in {"attribute", "data", "property"}:
        lines[:0] = ["..", ""]
    examples = next((i for i, line in enumerate(lines) if line.startswith(">>>")), None)
    if examples and any(line.startswith("---") for line in lines[:examples]):
        lines[examples:examples] = ["Examples", "--------"]


def setup(app) -> None:
    """Run before napoleon does, whose priority is 500."""
    app.connect("autodoc-process-docstring", prepare, priority=100)
