"""Sphinx settings: MyST pages, autodoc for the interface, furo."""

import evenbreak

project = "evenbreak"
author = "The evenbreak authors"
project_copyright = author
version = release = evenbreak.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build", "images"]
myst_enable_extensions = ["colon_fence", "deflist"]
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
# Many classes have a field `games`: where one is named, no other is meant.
suppress_warnings = ["ref.python"]

html_theme = "furo"
html_title = f"evenbreak {release}"
html_static_path: list[str] = []


FIELDS = {"Parameters", "Attributes", "Returns", "Yields", "Raises"}


def prepare(app, what, name, obj, options, lines) -> None:  # noqa: ARG001
    """Rewrite a docstring where napoleon would misread it.

    It takes `a: b` in the first line of an attribute for a type, and a paragraph or examples that
    follow a section of fields for one more field.
    """
    if what in {"attribute", "data", "property"}:
        lines[:0] = ["..", ""]
    section, result = "", []
    for before, line, after in zip(["", *lines], lines, [*lines[1:], ""], strict=False):
        if after.startswith("---"):
            section = line
        elif section in FIELDS and line[:1].strip() and not before and not after.startswith(" "):
            section = "Examples" if line.startswith(">>>") else "Notes"
            result += [section, "-" * len(section)]
        elif section in {"Notes", *FIELDS} and line.startswith(">>>") and not before:
            section = "Examples"
            result += [section, "-" * len(section)]
        result.append(line)
    lines[:] = result


def setup(app) -> None:
    """Run before napoleon does, whose priority is 500."""
    app.connect("autodoc-process-docstring", prepare, priority=100)
