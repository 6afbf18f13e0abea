"""Sphinx settings: MyST pages and notebooks, autodoc for the interface, furo."""

import ast
import json
import logging
import os
import re
import sys
import tempfile
from pathlib import Path

import click
from docutils.nodes import SkipNode, math_block
from latex2mathml.converter import convert as mathml
from sphinx.util.inspect import TypeAliasForwardRef

import evenbreak
from evenbreak.cli.program import program

sys.path.insert(0, str(Path(__file__).parent))
import addresses
import answer_tables
import column_tables
import league_keys
import option_tables
from narrow_blocks import narrow

project = "evenbreak"
author = "The evenbreak authors"
project_copyright = author
version = release = evenbreak.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
]
exclude_patterns = ["_build", "images"]
myst_enable_extensions = ["deflist", "dollarmath", "html_image"]
myst_heading_anchors = 4

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
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 80
# These names say more than what they stand for.
autodoc_type_aliases = {
    name: name
    for name in ("ArrayLike", "Floats", "Ints", "Bools", "Players", "Scale", "Win", "Wins", "Way")
}
# In a union Sphinx writes the repr of such a name.
TypeAliasForwardRef.__repr__ = lambda self: self.name
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True
napoleon_attr_annotations = False
# A docstring's words in single backquotes are code.
default_role = "literal"
add_module_names = False
toc_object_entries = False
nitpicky = False
# Many classes have a field `games`; a class that names its own means no other.
suppress_warnings = ["ref.python"]

html_math_renderer = "mathml"

html_theme = "furo"
html_title = f"evenbreak {release}"
html_static_path = ["_static"]
html_css_files = ["cards.css", "equations.css", "notebooks.css"]


API = Path(__file__).parent / "reference" / "api"
ROOM = re.compile(r"^```\{room\} (\w+)\n```$", re.MULTILINE)


def modules_of(room: str) -> dict[str, list[str]]:
    """Return the public names of a room by module, as its stub lists them."""
    stub = Path(evenbreak.__file__).parent / room / "__init__.pyi"
    public: dict[str, list[str]] = {}
    for line in ast.parse(stub.read_text("utf-8")).body:
        public.setdefault(line.module, []).extend(alias.name for alias in line.names)
    return public


def title_of(module: str) -> str:
    """Return a heading for a module."""
    return module.replace("_", " ").replace(".", ", ").capitalize()


def first_line(module: str) -> str:
    """Return what a module says of itself in one line."""
    path = Path(evenbreak.__file__).parent.joinpath(*module.split("."))
    source = path.with_suffix(".py") if path.with_suffix(".py").exists() else path / "__init__.py"
    said = ast.get_docstring(ast.parse(source.read_text("utf-8"))) or ""
    return " ".join(said.partition("\n\n")[0].split())


def write_modules(app) -> None:  # noqa: ARG001
    """Write a page for each module with public names, and remove those of modules that are gone."""
    pages = {}
    for stub in Path(evenbreak.__file__).parent.glob("*/__init__.pyi"):
        room = stub.parent.name
        for module, names in modules_of(room).items():
            pages[API / "modules" / f"{room}.{module}.md"] = (
                # Kept out of the sidebar, which every page would have to draw anew.
                f"---\norphan: true\n---\n\n# {title_of(module)}\n\n"
                f"`evenbreak.{room}.{module}`, in [{room}](../{room}.md)\n\n```{{eval-rst}}\n"
                f".. automodule:: evenbreak.{room}.{module}\n   :members: {', '.join(names)}\n```\n"
            )
    (API / "modules").mkdir(exist_ok=True)
    for gone in set((API / "modules").glob("*.md")) - pages.keys():
        gone.unlink()
    for page, text in pages.items():
        if not page.exists() or page.read_text("utf-8") != text:
            page.write_text(text, "utf-8")


def listed(room: str) -> str:
    """Return a list of a room's modules: what each is for, and its names."""
    rows = []
    for module, names in modules_of(room).items():
        links = [f"{{py:obj}}`{name} <evenbreak.{room}.{module}.{name}>`" for name in names]
        rows += [
            f"[{title_of(module)}](modules/{room}.{module}.md)",
            f": {first_line(f'{room}.{module}')}\n  {', '.join(links)}\n",
        ]
    return "\n".join(rows)


def write_rooms(app, docname, source) -> None:  # noqa: ARG001
    """List the modules of a room where a page says `{room} games`."""
    source[0] = ROOM.sub(lambda found: listed(found[1]), source[0])


UNSEEN = re.compile(r"^(?:[^\n]+\n)*?<!--\n(```\{.*?^```)\n-->$", re.MULTILINE | re.DOTALL)
LISTED = re.compile(r"^(?:- |\*\*)\[[^]]+\]\(((?!\.\.)[^)#]+)\.md\)(?=[:, ]|\*\*$)", re.MULTILINE)
NOTEBOOK = """\
---
file_format: mystnb
kernelspec:
  name: python3
  display_name: Python 3
---
"""


def write_unseen(app, docname, source) -> None:  # noqa: ARG001
    """Take directives out of the comments that hide them on a Git host.

    The lines directly above such a comment stand in for it there, and are left out here.
    """
    source[0] = UNSEEN.sub(r"\1", source[0])


def write_tree(app, docname, source) -> None:  # noqa: ARG001
    """Make the links in a list of pages, which a Git host shows as well, a table of contents."""
    if docname.endswith("index") or docname in {"reference/api", "reference/commands"}:
        pages = "\n".join(dict.fromkeys(LISTED.findall(source[0])))
        source[0] += f"\n```{{toctree}}\n:hidden:\n\n{pages}\n```\n"
    if docname == "explanation/decisions/index":
        # Contributors come to them by CONTRIBUTING.md; readers need no list of them.
        source[0] = f"---\norphan: true\n---\n\n{source[0]}"


def write_cells(app, docname, source) -> None:  # noqa: ARG001
    """Run the Python of a notebook in cells, and offer it for Jupyter below its title."""
    folder, _, name = docname.rpartition("/")
    if folder == "notebooks" and name != "index":
        title, _, rest = source[0].replace("```python\n", "```{code-cell}\n").partition("\n")
        offer = f"Download this page as a notebook: {{nb-download}}`{name}.ipynb`."
        source[0] = f"{NOTEBOOK}\n{title}\n\n{offer}\n{rest}"


COMMAND = re.compile(r"^## evenbreak (\w+)\n", re.MULTILINE)


def helps(command: click.Command, parent: click.Context | None, name: str) -> list[str]:
    """Return what `--help` prints for a command, and for each command within it."""
    ctx = click.Context(command, info_name=name, parent=parent, max_content_width=88)
    inner = command.list_commands(ctx) if isinstance(command, click.Group) else ()
    return [
        command.get_help(ctx),
        *(text for each in inner for text in helps(command.get_command(ctx, each), ctx, each)),
    ]


def write_help(app, docname, source) -> None:  # noqa: ARG001
    """Fold what `--help` prints into the section of each command."""
    if not docname.startswith("reference/commands/"):
        return
    ctx = click.Context(program, info_name="evenbreak")

    def with_help(found: re.Match[str]) -> str:
        texts = "\n\n\n".join(helps(program.get_command(ctx, found[1]), ctx, found[1]))
        return (
            f"{found[0]}\n<details><summary><code>evenbreak {found[1]} --help</code></summary>\n\n"
            f"````text\n{texts}\n````\n\n</details>\n"
        )

    source[0] = COMMAND.sub(with_help, source[0])


def write_tables(app, docname, source) -> None:  # noqa: ARG001
    """Write the tables that `--help` and the program's own descriptions hold where a page asks."""
    if docname.startswith("reference/"):
        for made in (option_tables, answer_tables, league_keys, addresses):
            source[0] = made.with_tables(source[0])
        source[0] = column_tables.with_tables(source[0], full=True)


OUTSIDE = re.compile(r"\[([^]]+)\]\(((?:\.\./)+(?:reports|benchmarks)/[^)#]+\.md)(?:#[^)]*)?\)")


def write_outside(app, docname, source) -> None:  # noqa: ARG001
    """Offer Markdown files of the repository that are no pages here for download."""
    source[0] = OUTSIDE.sub(r"{download}`\1 <\2>`", source[0])


FIELDS = {"Parameters", "Attributes", "Returns", "Yields", "Raises"}


def prepare(app, what, name, obj, options, lines) -> None:  # noqa: ARG001
    """Rewrite docstrings that napoleon would misread.

    It reads `a: b` in the first line of an attribute as a type, and a paragraph or an example
    after a section of fields as one more field.
    """
    if lines and lines[0].startswith("Alias for field number"):
        lines.clear()
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


ARRAY = re.compile(r"ndarray\[tuple\[[^]]*\], ?[\w.~]*dtype\[~?(?:\w+\.)*(\w+?)_?\]\]")
LIKE = re.compile(r"[\w.~]*Buffer \| .*?_NestedSequence\[[^]]*complex \| bytes \| str\]")


def shorten(app, what, name, obj, options, signature, returned):  # noqa: ARG001
    """Write arrays as the source does: `NDArray[int64]`, `ArrayLike`."""
    return tuple(
        LIKE.sub("ArrayLike", ARRAY.sub(r"NDArray[\1]", text)) if text else text
        for text in (signature, returned)
    )


def number_equations(app, doctree, docname) -> None:  # noqa: ARG001
    """Give each displayed equation of a page its number."""
    for number, node in enumerate(doctree.findall(math_block), 1):
        node["number"] = number


def inline_math(translator, node) -> None:
    """Write an equation in a line as MathML, which browsers show without a script."""
    translator.body.append(mathml(node.astext()))
    raise SkipNode


def displayed_math(translator, node) -> None:
    """Write an equation on a line of its own, with its number."""
    translator.body.append(translator.starttag(node, "div", CLASS="math notranslate"))
    translator.body.append(f"<div>{mathml(node.astext(), display='block')}</div>")
    translator.body.append(f'<span class="eqno">({node["number"]})</span></div>\n')
    raise SkipNode


def setup(app) -> None:
    """Write the modules' pages, and run `prepare` before napoleon, whose priority is 500."""
    app.add_html_math_renderer("mathml", (inline_math, None), (displayed_math, None))
    app.connect("builder-inited", write_modules)
    app.connect("doctree-resolved", number_equations)
    for write in (write_unseen, write_rooms, write_tree, write_cells):
        app.connect("source-read", write)
    app.connect("source-read", write_help)
    app.connect("source-read", write_tables)
    app.connect("html-page-context", narrow)
    app.connect("source-read", write_outside)
    app.connect("autodoc-process-signature", shorten)
    app.connect("autodoc-process-docstring", prepare, priority=100)
