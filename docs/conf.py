"""Sphinx settings: MyST pages and notebooks, autodoc for the interface, furo."""

import ast
import json
import logging
import os
import re
import tempfile
from pathlib import Path

import evenbreak

project = "evenbreak"
author = "The evenbreak authors"
project_copyright = author
version = release = evenbreak.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
]
exclude_patterns = ["_build", "images"]
myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3

# The notebooks run at each build, in their own folder; an error in one is an error of the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
logging.getLogger("traitlets").setLevel(logging.WARNING)
# They run without the reader's own IPython settings, without history, and quietly.
_ipython = tempfile.TemporaryDirectory()
_profile = Path(_ipython.name, "profile_default")
_profile.mkdir()
(_profile / "ipython_kernel_config.json").write_text(
    json.dumps({"IPKernelApp": {"log_level": 40}, "HistoryManager": {"enabled": False}})
)
os.environ["IPYTHONDIR"] = _ipython.name

autodoc_member_order = "bysource"
# matplotlib writes this method into each of its subclasses.
autodoc_default_options = {"exclude-members": "set"}
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
napoleon_attr_annotations = False
# A docstring's words in single backquotes are code.
default_role = "literal"
toc_object_entries = False
nitpicky = False
# Many classes have a field `games`; a class that names its own means no other.
suppress_warnings = ["ref.python"]

html_theme = "furo"
html_title = f"evenbreak {release}"
html_static_path = ["_static"]
html_css_files = ["notebooks.css"]


ROOM = re.compile(r"^```\{room\} (\w+)\n```$", re.MULTILINE)


def modules_of(room: str) -> str:
    """Return a heading and the documentation for each module of a room that has public names."""
    stub = Path(evenbreak.__file__).parent / room / "__init__.pyi"
    public: dict[str, list[str]] = {}
    for line in ast.parse(stub.read_text("utf-8")).body:
        names = [alias.name for alias in line.names]
        public.setdefault(line.module, []).extend(names)
    return "\n".join(
        f"## {module.replace('_', ' ').replace('.', ', ').capitalize()}\n\n"
        f"```{{eval-rst}}\n"
        f".. automodule:: evenbreak.{room}.{module}\n   :members: {', '.join(names)}\n"
        f"```\n"
        for module, names in public.items()
    )


def write_rooms(app, docname, source) -> None:  # noqa: ARG001
    """Put the modules of a room where a page says `{room} games`, as the room's stub lists them."""
    source[0] = ROOM.sub(lambda found: modules_of(found[1]), source[0])


FIELDS = {"Parameters", "Attributes", "Returns", "Yields", "Raises"}


def prepare(app, what, name, obj, options, lines) -> None:  # noqa: ARG001
    """Rewrite docstrings that napoleon would misread.

    It reads `a: b` in the first line of an attribute as a type, and a paragraph or an example
    after a section of fields as one more field.
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
    """Write the rooms' pages, and run `prepare` before napoleon, whose priority is 500."""
    app.connect("source-read", write_rooms)
    app.connect("autodoc-process-docstring", prepare, priority=100)
