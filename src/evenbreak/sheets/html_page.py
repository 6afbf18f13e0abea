"""What all HTML pages share: one frame, one style, and a policy that allows nothing else."""

from __future__ import annotations

import base64
import hashlib
import unicodedata
from importlib.resources import files
from typing import Any

from evenbreak import __version__


def html_page(template: str, **values: Any) -> bytes:
    """Return a page that has no script and asks no other host for anything.

    Its Content-Security-Policy allows its own style and nothing else.

    Parameters
    ----------
    template
        the name of the page's template.
    values
        what the template shows; every text in it is escaped.

    Returns
    -------
    bytes
        UTF-8; the same values give the same bytes.
    """
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
    style = _template("sheet.css")
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    page = environment.get_template(template).render(
        style=style,
        csp=f"default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'",
        version=__version__,
        **values,
    )
    return page.encode()


def shown_name(name: str) -> str:
    r"""Return a name with a mark for each control character, which HTML cannot hold.

    >>> shown_name("Bo\x1b") == "Bo\ufffd"
    True
    """
    return "".join(
        "\N{REPLACEMENT CHARACTER}" if unicodedata.category(letter) == "Cc" else letter
        for letter in name
    )


def _template(name: str) -> str:
    return files("evenbreak.sheets").joinpath("templates", name).read_text("utf-8")
