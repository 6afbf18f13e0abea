import base64
import hashlib
import re

import pytest
from jinja2 import UndefinedError

from evenbreak.answers.kit.answer import Answer
from evenbreak.sheets.html_page import answer_page, html_page, shown_name

POLICY = re.compile(r'Content-Security-Policy" content="([^"]*)"')


NOTHING = {"heading": ["x"], "links": [], "sections": [], "below": "", "made_of": ""}


def digest(text):
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


@pytest.mark.parametrize("search", [True, False])
def test_the_policy_allows_the_style_and_the_search_of_the_page_and_nothing_else(search):
    page = html_page(search=search, **NOTHING).decode()
    style = re.search(r"<style>(.*)</style>", page, re.DOTALL)[1]
    script = re.search(r"<script>(.*)</script>", page, re.DOTALL)
    assert bool(script) == search
    assert POLICY.search(page)[1].replace("&#39;", "'").split("; ") == [
        "default-src 'none'",
        f"style-src '{digest(style)}'",
        *([f"script-src '{digest(script[1])}'"] if search else []),
        "base-uri 'none'",
        "form-action 'none'",
    ]
    assert "url(" not in style
    assert "@import" not in style
    assert "://" not in page


def test_what_a_template_shows_must_be_given_and_is_escaped():
    with pytest.raises(UndefinedError):
        html_page(heading=["x"])
    page = html_page(**{**NOTHING, "heading": ["<b>"]}).decode()
    assert "<title>&lt;b&gt;</title>" in page


def test_a_screen_in_the_dark_has_dark_paper_and_print_has_none():
    style = html_page(**NOTHING).decode()
    assert "@media screen and (prefers-color-scheme: dark)" in style
    colors = re.findall(r"#[0-9a-f]{3,6}\b", style.partition("* {")[2].partition("</style>")[0])
    assert not colors, "a color that does not change in the dark"


@pytest.mark.parametrize(
    ("name", "shown"), [("Zoë", "Zoë"), ("a\x01\nb", "a\N{REPLACEMENT CHARACTER}\ufffdb")]
)
def test_control_characters_become_marks(name, shown):
    assert shown_name(name) == shown


def test_a_page_has_the_answer_and_its_first_line_for_a_title():
    page = answer_page(Answer("Race 7:5\nbetween <A> & B", ["A wins."])).decode()
    assert re.search(r"<title>(.*)</title>", page)[1] == "Race 7:5"
    assert "<p>A wins.</p>" in page
    assert "&lt;A&gt; &amp; B" in page
