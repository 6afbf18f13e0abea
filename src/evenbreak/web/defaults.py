"""Initial form values from the league's file in the folder where the page runs."""

from __future__ import annotations

from collections.abc import Collection

from evenbreak.fields.question import declared
from evenbreak.files.league.league_file import LeagueFile
from evenbreak.questions.of_league import key_of, text_of
from evenbreak.web.forms import EVEN, FAIR, name_of


def of_league(
    question: type,
    league: LeagueFile | None,
    *,
    charts: Collection[str],
    orders: Collection[str] = (),
) -> dict[str, str]:
    """Return the initial values of a form's fields by name, based on the league's rules.

    The league's chart or order must be among `charts` or `orders`; any other order is a pattern,
    and any other chart is left out.
    """
    if league is None:
        return {}
    texts: dict[str, str] = {}
    for one in declared(question):
        key = key_of(question, one.name)
        is_file = key.startswith(("files.", "results", "aliases"))
        if key and not is_file and (text := text_of(league, key)) is not None:
            texts[name_of(one)] = text
    if (chart := texts.pop("chart", None)) in charts:
        texts["races"] = str(chart)
    elif "race" in texts:
        texts["races"] = EVEN
    elif (length := texts.pop("race_to", None)) is not None:
        texts |= {"races": FAIR, "race": length}
    if "order" in texts and texts["order"] not in orders:
        texts["pattern"] = texts.pop("order")
    return texts
