"""What all HTML pages share: one frame, one style, and a policy that allows nothing else."""

import base64
import hashlib
import unicodedata
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from evenbreak import __version__

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup


def html_page(*, search: bool = False, **values: Any) -> bytes:
    """Return a page that asks no other host for anything.

    Its Content-Security-Policy allows its own style and, if there is one, its own script.

    Parameters
    ----------
    search
        whether players can be searched for, which takes a script; without it, the box is hidden.
    values
        what the page shows; every text in it is escaped.

    Returns
    -------
    bytes
        UTF-8; the same values give the same bytes.
    """
    style, script = _template("sheet.css"), _template("search.js") if search else ""
    policy = ["default-src 'none'", f"style-src '{_digest(style)}'"]
    policy += [f"script-src '{_digest(script)}'"] if script else []
    policy += ["base-uri 'none'", "form-action 'none'"]
    template = _environment().get_template("answer.html")
    page = template.render(
        style=style, script=script, csp="; ".join(policy), version=__version__, **values
    )
    return page.encode()


def drawn(macro: str, *values: Any) -> "Markup":
    """Return a piece of a page: what a macro of parts.html makes of these values."""
    made: Markup = getattr(_environment().get_template("parts.html").module, macro)(*values)
    return made


def shown_name(name: str) -> str:
    r"""Return a name with a mark for each control character, which HTML cannot hold.

    >>> shown_name("Bo\x1b") == "Bo\ufffd"
    True
    """
    return "".join(
        "\N{REPLACEMENT CHARACTER}" if unicodedata.category(letter) == "Cc" else letter
        for letter in name
    )


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    environment = Environment(
        autoescape=True,
        loader=FunctionLoader(_template),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["name"] = shown_name
    return environment


def _digest(text: str) -> str:
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}"


def _template(name: str) -> str:
    return files("evenbreak.sheets").joinpath("templates", name).read_text("utf-8")
