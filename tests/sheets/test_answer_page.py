import re

from evenbreak.answers.kit.answer import Answer
from evenbreak.sheets.html_page import answer_page


def test_a_page_has_the_answer_and_its_first_line_for_a_title():
    page = answer_page(Answer("Race 7:5\nbetween <A> & B", ["A wins."])).decode()
    assert re.search(r"<title>(.*)</title>", page)[1] == "Race 7:5"
    assert "<p>A wins.</p>" in page
    assert "&lt;A&gt; &amp; B" in page
