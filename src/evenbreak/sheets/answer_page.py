"""Any answer as a page: one file, no script, nothing fetched from elsewhere."""

from evenbreak.answers.answer import Answer
from evenbreak.answers.faces.to_html import to_html
from evenbreak.sheets.html_page import html_page


def answer_page(answer: Answer) -> bytes:
    """Return an answer as a page of HTML in UTF-8.

    >>> from evenbreak.answers.answer import Answer
    >>> b"<p>Ann wins.</p>" in answer_page(Answer("race 7:5", ["Ann wins."]))
    True
    """
    title = answer.heading.partition("\n")[0]
    return html_page("answer.html", title=title, answer=to_html(answer))
