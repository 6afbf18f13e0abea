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
# A docstring's words in single backquotes are code.
default_role = "literal"
nitpicky = False

html_theme = "furo"
html_title = f"evenbreak {release}"
html_static_path: list[str] = []
