"""All HTML pages: a shared frame and style, a strict content policy; any answer as a page.

A page says what its answer says, in the same order, in one file that fetches nothing from
elsewhere. A sheet may draw its answer's tables differently, and add drawings; it adds no sentences.
"""

import base64
import hashlib
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any, NamedTuple

from markupsafe import Markup

from evenbreak import __version__
from evenbreak.answers.faces.to_html import body_lines, part_lines
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.remarks import Remarks, fingerprints, warnings_of
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile

if TYPE_CHECKING:
    from jinja2 import Environment


def html_page(
    *, search: bool = False, more_style: str = "", drawings: bool = False, **values: Any
) -> bytes:
    """Return a self-contained HTML page in UTF-8; the same values give the same bytes.

    Its Content-Security-Policy allows its own style and, if there is one, its own script, which the
    player `search` needs. `more_style` follows the shared style; `drawings` may have their own
    styles. All text is escaped.
    """
    style = own_file("sheet.css") + more_style
    script = own_file("search.js") if search else ""
    template = environment("evenbreak.sheets").get_template("answer.html")
    csp = OF_DRAWINGS if drawings else policy(style, script)
    page = template.render(style=style, script=script, csp=csp, version=__version__, **values)
    return page.encode()


OF_DRAWINGS = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
"""The policy for a page whose drawings have their own styles: no script, no other host."""


def policy(style: str, script: str = "", *, images: str = "") -> str:
    """Return a page's policy: its own style, its own script and some images, nothing else."""
    allowed = ["default-src 'none'", f"style-src '{_digest(style)}'"]
    allowed += [f"script-src '{_digest(script)}'"] if script else []
    allowed += [f"img-src {images}"] if images else []
    return "; ".join([*allowed, "base-uri 'none'", "form-action 'none'"])


def drawn(macro: str, *values: Any) -> "Markup":
    """Return a piece of a page: the output of a macro in parts.html for these values."""
    parts = environment("evenbreak.sheets").get_template("parts.html").module
    made: Markup = getattr(parts, macro)(*values)
    return made


def shown_name(name: str) -> str:
    r"""Return a name with a mark for each control character, which HTML can't contain.

    >>> shown_name("Bo\x1b") == "Bo\ufffd"
    True
    """
    return "".join(
        "\N{REPLACEMENT CHARACTER}" if unicodedata.category(letter) == "Cc" else letter
        for letter in name
    )


@cache
def environment(room: str) -> "Environment":
    """Return an environment for the templates of a package."""
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    environment = Environment(
        autoescape=True,
        loader=FunctionLoader(lambda name: own_file(name, room)),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["name"] = shown_name
    return environment


def _digest(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}"


def own_file(name: str, room: str = "evenbreak.sheets") -> str:
    """Return the text of a file in a package's templates."""
    return files(room).joinpath("templates", name).read_text("utf-8")


class Section(NamedTuple):
    """A section of a page: its link target, its heading, and its content."""

    id: str
    title: str
    html: Markup


def answer_page(answer: Answer) -> bytes:
    """Return an answer as a page of HTML in UTF-8.

    >>> from evenbreak.answers.kit.answer import Answer
    >>> b"<p>Ann wins.</p>" in answer_page(Answer("race 7:5", ["Ann wins."]))
    True
    """
    return html_page(
        heading=answer.heading.split("\n"),
        links=[],
        sections=[Section("", "", _markup(body_lines(answer)))],
        below="",
        made_of="",
    )


def drawn_page(
    answer: Answer,
    drawings: Sequence[Sequence[Section]],
    *,
    notes: tuple[str, str, str],
    made_of: str,
    file: ResultsFile | RosterFile,
) -> bytes:
    """Return an answer as a page with custom drawings of its tables.

    Anything in front of a table belongs to its section; anything after the last table comes last,
    with the remarks in the details and the warnings. The other details are at the foot of the page.
    `notes` is the last section: its id, its title, and its text if there is nothing else.
    """
    tables = iter(drawings)
    sections, said = [], Markup()
    for part in answer.parts:
        if isinstance(part, Table):
            for section in next(tables):
                sections.append(section._replace(html=said + section.html))
                said = Markup()
        else:
            said += _parts([part])
    warnings = list(warnings_of(file, answer.warnings))
    remarks: list[Part] = [part for part in answer.details if isinstance(part, Remarks)]
    said += _parts([*remarks, *([Remarks(warnings)] if warnings else [])])
    identity, title, nothing = notes
    sections.append(Section(identity, title, said or _parts([nothing])))
    return html_page(
        search=True,
        heading=answer.heading.split("\n"),
        links=[(section.id, section.title) for section in sections],
        sections=sections,
        below=_parts(part for part in answer.details if not isinstance(part, Remarks)),
        made_of=made_of,
        sha256=fingerprints(file),
    )


def _parts(parts: Iterable[Part]) -> Markup:
    return _markup(line for part in parts for line in part_lines(part))


def _markup(lines: Iterator[str]) -> Markup:
    """Return lines that are already HTML, with all text in them escaped."""
    return Markup("".join(f"{line}\n" for line in lines))  # noqa: S704
