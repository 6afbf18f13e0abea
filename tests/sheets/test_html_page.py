import base64
import hashlib
import re

import pytest
from jinja2 import UndefinedError

from evenbreak.sheets.html_page import html_page, shown_name

POLICY = re.compile(r'Content-Security-Policy" content="([^"]*)"')


def test_the_policy_allows_the_style_of_the_page_and_nothing_else():
    page = html_page("answer.html", title="x", answer="<p>y</p>").decode()
    style = re.search(r"<style>(.*)</style>", page, re.DOTALL)[1]
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    assert POLICY.search(page)[1].replace("&#39;", "'").split("; ") == [
        "default-src 'none'",
        f"style-src 'sha256-{digest}'",
        "base-uri 'none'",
        "form-action 'none'",
    ]
    assert "url(" not in style
    assert "@import" not in style
    assert "://" not in page


def test_what_a_template_shows_must_be_given_and_is_escaped():
    with pytest.raises(UndefinedError):
        html_page("answer.html", answer="")
    assert "<title>&lt;b&gt;</title>" in html_page("answer.html", title="<b>", answer="").decode()


@pytest.mark.parametrize(
    ("name", "shown"), [("Zoë", "Zoë"), ("a\x01\nb", "a\N{REPLACEMENT CHARACTER}\ufffdb")]
)
def test_control_characters_become_marks(name, shown):
    assert shown_name(name) == shown
