"""Whom to put up in a team match, and what each choice is worth."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import error_of_share, luck_words
from evenbreak.answers.kit.columns import column_of, columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, listed, percent
from evenbreak.handicaps.charts.race_of_pair import Fairest, Race
from evenbreak.teams.advice import Advice, Option, Point, advice, best_by_skills
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import NAMED, OURS, THEIRS, mirrored, order_of
from evenbreak.teams.sealed import SealedLineUp, SealedNight, sealed
from evenbreak.teams.solve import SolvedNight, solved, steps_of

MOST_DRAWS, _FEWEST_DRAWS = 400, 20
"""Draws of the ratings: fewer where a night takes long to solve."""

_WORK, _WORK_OF_ORDERS = 4e8, 2e7  # steps of `steps_of` that take a second or so


def lineup_answer(
    meeting: Meeting,
    point: Point | None = None,
    *,
    seed: int = 0,
    warnings: Sequence[str] = (),
    solution: SolvedNight | None = None,
) -> Answer:
    """Return whom to put up now.

    Parameters
    ----------
    meeting
        who meets whom, and what is played.
    point
        the point in the night; None: before the first nomination.
    seed
        of the ratings that are drawn, where they have standard errors.
    warnings
        about the question.
    solution
        of the night, if it is known; then the ratings are not drawn again.

    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.teams import Squad
    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy", "Di"], [560, 540])
    >>> squads = Squad(us.players), Squad(them.players)
    >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "A")
    >>> lineup_answer(meeting).sentences[0].partition(",")[0]
    'Put up Ann: you then win the night 67% of the time'
    """
    if meeting.order == SEALED:
        return sealed_answer(meeting, warnings)
    night = meeting.night() if solution is None else solution.night
    redrawn = solution is None and meeting.uncertain
    solution = solution or solved(night)
    found = advice(solution, point)
    sure: dict[tuple[str, ...], float] = {}
    draws = int(min(MOST_DRAWS, _WORK / steps_of(night)))
    if redrawn and not found.blind and draws >= _FEWEST_DRAWS:
        sure = best_by_skills(
            night,
            meeting.laws,
            meeting.ours,
            meeting.theirs,
            point,
            draws=draws,
            rng=np.random.default_rng(seed),
        )
    named = point.named if point is not None else ()
    table = _table(found, sure, draws)
    tied = night.payoff(0) > 0.0 and 0 in night.leads_after(night.sets)
    parts: list[Part] = [
        _in_words(found, named) + (" A tie counts as half a win." if tied else ""),
        Quantities(quantities_of({"-p_win_night": found.worth, "best": _name(found.best)})),
        table,
    ]
    data: dict[str, Any] = {"set": found.set_number, "ours": found.ours, "blind": found.blind}
    if point is None:
        data["toss"], words = _toss(meeting, solution)
        parts += filter(None, [words])
        details: list[Part] = []
        if steps_of(night) < _WORK_OF_ORDERS:
            details.append(_orders(meeting, solution))
    else:
        details = []
    parts += filter(None, [_sure_words(found, sure, draws)])
    return Answer(
        _heading(meeting, found),
        parts,
        details=details,
        data=data,
        warnings=warnings,
        csv=table,
    )


def _name(option: Option) -> str:
    return names_words(option.names)


def names_words(names: Sequence[str]) -> str:
    """Return a pick: a player, or the pair of a doubles set.

    >>> names_words(["Ann"]), names_words(["Ann", "Bo"])
    ('Ann', 'Ann and Bo')
    """
    return listed(list(names))


def _heading(meeting: Meeting, found: Advice) -> str:
    ours, theirs = len(meeting.ours), len(meeting.theirs)
    return (
        f"Set {found.set_number} of {len(meeting.sizes)}: {ours} players against {theirs}, "
        f"{race_words(meeting.race)}\nRatings "
        f"{scale_words(meeting.scale)}"
    )


def _in_words(found: Advice, named: Sequence[str]) -> str:
    best, p = found.best, percent(found.worth)
    worths = {option.worth for option in found.options}
    if worths in ({1.0}, {0.0}):
        return f"The match is decided: you have {'won' if found.worth else 'lost'} it."
    if found.blind:
        mixed = [
            f"{_name(option)} {percent(option.mix)}"
            for option in sorted(found.options, key=lambda option: -option.mix)
            if option.mix > 5e-4
        ]
        if len(mixed) == 1:
            return f"Put up {_name(best)}: you win the night {p} of the time at least."
        return (
            f"Pick at random, {listed(mixed)}: you then win the night {p} of the time, "
            "whatever they do."
        )
    if found.ours and named:
        return (
            f"Answer {names_words(named)} with {_name(best)}: you then win the night {p} of the "
            "time."
        )
    if found.ours:
        return (
            f"Put up {_name(best)}: you then win the night {p} of the time, if they answer as well "
            f"as they can (with {names_words(best.answer)})."
        )
    if named:
        return (
            f"Their best answer to {names_words(named)} is {_name(best)}: you then win the night "
            f"{p} of the time."
        )
    return (
        f"They name first. Their best pick is {_name(best)}; answer with "
        f"{names_words(best.answer)}, and you win the night {p} of the time."
    )


def _table(found: Advice, sure: dict[tuple[str, ...], float], draws: int) -> Table:
    sign = 1.0 if found.ours else -1.0
    whose = "player" if found.ours else "their pick"
    columns = columns_of("pick p_win_night cost", whose=whose)
    answers = any(option.answer for option in found.options) and not found.blind
    if answers:
        columns.append(column_of("answer"))
    if found.blind:
        columns.append(column_of("pick_mix"))
    if sure:
        columns.append(column_of("p_best"))
        columns.append(column_of("p_best_error"))
    top = found.worth if found.blind else found.best.worth
    rows = []
    for option in found.options:
        row: list[Any] = [_name(option), option.worth, max(0.0, sign * (top - option.worth))]
        if answers:
            row.append(names_words(option.answer))
        if found.blind:
            row.append(option.mix)
        if sure:
            often = sure.get(option.names, 0.0)
            row += [often, error_of_share(often, draws)]
        rows.append(row)
    return Table("options", columns, rows)


def _toss(meeting: Meeting, solution: SolvedNight) -> tuple[dict[str, float] | None, str]:
    """Return what the night is worth if we name first or answer first, and the words for it."""
    order = solution.night.order
    if order[0] not in (OURS, THEIRS):
        return None, ""
    other = solved(meeting.night(mirrored(order))).value
    first, second = (solution.value, other) if order[0] == OURS else (other, solution.value)
    gap = abs(first - second)
    toss = {"name_first": first, "answer_first": second, "worth": gap}
    if gap < 5e-4:
        return toss, "Who names first makes no difference."
    better = "answer" if second > first else "name first"
    return toss, (
        f"If you win the toss, {better}: you win {percent(max(first, second))} of such nights, "
        f"against {percent(min(first, second))} the other way round."
    )


def _orders(meeting: Meeting, solution: SolvedNight) -> Table:
    """Return what the night is worth in each order of nomination."""
    sets = len(meeting.sizes)
    rows: list[list[Any]] = []
    for name in NAMED:
        order = order_of(name, sets)
        for each in dict.fromkeys((order, mirrored(order))):
            known = each == solution.night.order
            value = solution.value if known else solved(meeting.night(each)).value
            rows.append([each, _order_words(name, each), value])
    columns = columns_of("order names_first p_win_night")
    return Table("orders", columns, rows, title="What each order of nomination is worth")


def _order_words(name: str, order: str) -> str:
    who = "you" if order[0] == OURS else "they"
    return {
        "alternate": f"in turn, {who} in set 1",
        "home": f"always {who}",
        "blind": "both at once, unseen",
        "winner": f"the winner of the last set, {who} in set 1",
        "loser": f"the loser of the last set, {who} in set 1",
    }[name]


def _sure_words(found: Advice, sure: dict[tuple[str, ...], float], draws: int) -> str:
    """Return how far the best pick depends on the ratings."""
    if not sure:
        return ""
    best, share = _name(found.best), sure.get(found.best.names, 0.0)
    others = [names for names in sure if names != found.best.names]
    if share > 0.95 or not others:
        return f"{best} is the best pick even if the ratings are off by what their errors allow."
    return (
        f"With ratings that are off by what their errors allow, {best} is the best pick "
        f"{percent(share)} of the time and {names_words(others[0])} {percent(sure[others[0]])}, in "
        f"{draws} draws ({luck_words([error_of_share(each, draws) for each in sure.values()])}); "
        f"on average it is {best}."
    )


_LISTED = 10


def sealed_answer(
    meeting: Meeting, warnings: Sequence[str], solution: SealedNight | None = None
) -> Answer:
    """Return whom to write on a line-up that the other team does not see.

    Parameters
    ----------
    meeting
        who meets whom, and what is played.
    warnings
        about the question.
    solution
        of the night, if it is known.

    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.teams import Squad
    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy"], [560])
    >>> squads = Squad(us.players), Squad(them.players)
    >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "sealed")
    >>> print(sealed_answer(meeting, ()).sentences[0])
    Play Ann, in an order drawn at random: you win the night 67% of the time, whatever they do.
    """
    found = solution or sealed(meeting.night())
    played = [one for one in found.ours if one.mix > 5e-4]
    if len(played) == 1:
        words = f"Play {listed(list(played[0].names))}, in an order drawn at random"
    else:
        words = "Draw one of the line-ups below by its share, and its order at random"
    columns = columns_of("-name sits_out p_win_night cost mix")
    listing = found.ours[:_LISTED]
    rows = [
        [
            ", ".join(one.names),
            ", ".join(name for name in meeting.ours.players if name not in one.names) or "nobody",
            one.worth,
            max(0.0, found.worth - one.worth),
            one.mix,
        ]
        for one in listing
    ]
    left = len(found.ours) - len(listing)
    more = f" {count_of(left, 'more line-up')} not listed." if left else ""
    table = Table("options", columns, rows)
    return Answer(
        f"Sealed line-ups of {count_of(len(meeting.sizes), 'set')}: {len(meeting.ours)} players "
        f"against {len(meeting.theirs)}, {race_words(meeting.race)}\nRatings "
        f"{scale_words(meeting.scale)}",
        [
            f"{words}: you win the night {percent(found.worth)} of the time, whatever they do.",
            Quantities(quantities_of({"-p_win_night": found.worth, "best": _best(found.ours)})),
            table,
            f"Against a random order, every order of theirs is worth the same.{more}",
        ],
        data={"toss": None, "blind": True, "ours": True, "set": 1},
        warnings=warnings,
        csv=table,
    )


def _best(line_ups: Sequence[SealedLineUp]) -> str:
    return ", ".join(line_ups[0].names)


def race_words(race: Race) -> str:
    """Return what is played in a set.

    >>> race_words(5), race_words(Fairest(7))
    ('races to 5', 'the fairest races to 7')
    """
    if isinstance(race, Fairest):
        return f"the fairest races to {race.race_to}"
    return f"races to {race}" if isinstance(race, int) else f"races by {race.name}"
