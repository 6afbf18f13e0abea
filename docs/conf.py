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


def keep_colons(app, what, name, obj, options, lines) -> None:  # noqa: ARG001
    """Begin docstrings of attributes with a comment: napoleon would take `a: b` for a type."""
    if what in {"attribute", "data", "property"}:
        lines[:0] = ["..", ""]


def setup(app) -> None:
    """Run before napoleon does, whose priority is 500."""
    app.connect("autodoc-process-docstring", keep_colons, priority=100)
