"""A name and a rating as they are entered, and what is doubtful about the ratings of tonight."""

from __future__ import annotations

from evenbreak.answers.kit.scales import far_doubts
from evenbreak.files.lists.roster import LARGEST
from evenbreak.files.tables.names import clean_name, is_name
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.forms import Form
from evenbreak.web.refusals import RefusalError


def name_of(form: Form) -> str:
    """Return the name in a form, as it is read from a list; '': the field was left empty."""
    name = clean_name(form.text("name", longest=80))
    if name and not is_name(name):
        raise RefusalError("The name {value!r} can't be printed. Type it again.", value=name)
    return name


def rating_of(form: Form) -> float | None:
    """Return the rating in a form; None: the field was left empty."""
    stated = form.text("rating", longest=12).replace(",", ".")
    if not stated:
        return None
    try:
        rating = float(stated)
    except ValueError:
        raise RefusalError(
            "{value!r} is not a rating. Enter a number, such as 520.", value=stated
        ) from None
    if not abs(rating) <= LARGEST:
        raise RefusalError("{value!r} is not a rating. Enter a number, such as 520.", value=stated)
    return rating


def rating_doubts(state: Evening) -> list[str]:
    """Return whose ratings are far from those of all others."""
    entrants = state.entrants.values()
    ratings = [one.rating for one in entrants]
    return far_doubts(state.scale, ratings, [one.name for one in entrants])
