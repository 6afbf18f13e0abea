"""Who to put up in a team match, and each choice's value."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import error_of_share, luck_words
from evenbreak.answers.kit.columns import column_of, columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import form_used_words
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.team.strengths import level_words, strengths_words
from evenbreak.handicaps.charts.level_chart import PointsChart
from evenbreak.handicaps.charts.race_of_pair import Fairest
from evenbreak.teams.advice import Advice, Option, Point, advice, best_by_skills
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import NAMED, OURS, THEIRS, mirrored, order_of
from evenbreak.teams.pairs import SetRace
from evenbreak.teams.sealed import SealedLineUp, SealedNight, sealed
from evenbreak.teams.solve import SolvedNight, solved, steps_of
from evenbreak.words import Sentence, joined, listed, say, say_count

MOST_DRAWS, _FEWEST_DRAWS = 400, 20
"""How many times ratings are drawn: fewer if a night takes long to solve."""

_WORK, _WORK_OF_ORDERS = 4e8, 2e7  # steps of `steps_of` that take a second or so


def lineup_answer(
    meeting: Meeting,
    point: Point | None = None,
    *,
    seed: int = 0,
    warnings: Sequence[str] = (),
    solution: SolvedNight | None = None,
) -> Answer:
    """Return who to put up now; `point` is None before the first nomination.

    If the solution is given, the ratings aren't drawn again.

    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.teams import Squad
    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy", "Di"], [560, 540])
    >>> squads = Squad(us.players), Squad(them.players)
    >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "A")
    >>> lineup_answer(meeting).sentences[0]
    'Put up Ann: you win the night 67% of the time if they make their best reply (Cy).'
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
        joined([_in_words(found, named), *([TIE] if tied else [])]),
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
    form = form_used_words(meeting.form, meeting.scale)
    barred = _barred_words(meeting, point, found) if found.ours else None
    rests_on = level_words(meeting.race, meeting.levels)
    parts += filter(None, [barred, form, rests_on, _sure_words(found, sure, draws)])
    return Answer(
        _heading(meeting, found), parts, details=details, data=data, warnings=warnings, csv=table
    )


def _name(option: Option) -> str:
    return names_words(option.names)


TIE = say("A tie counts as half a win.")


def names_words(names: Sequence[str]) -> Sentence:
    """Return a pick: a player, or a doubles pair.

    >>> names_words(["Ann"]), names_words(["Ann", "Bo"])
    ('Ann', 'Ann and Bo')
    """
    return listed(list(names))


def _heading(meeting: Meeting, found: Advice) -> str:
    ours, theirs = len(meeting.ours), len(meeting.theirs)
    return say(
        "Set {n} of {sets}: {ours} players against {theirs}, {races}\n{strengths}",
        n=found.set_number,
        sets=len(meeting.sizes),
        ours=ours,
        theirs=theirs,
        races=race_words(meeting.race),
        strengths=strengths_words(meeting.race, meeting.levels, meeting.scale),
    )


def _barred_words(meeting: Meeting, point: Point | None, found: Advice) -> Sentence | None:
    """Return who could still play, but is ruled out now by the caps on upcoming sets."""
    squad = meeting.squads[0]
    used = Counter(() if point is None else point.used_ours)
    able = {name for option in found.options for name in option.names}
    barred = [name for name in squad.names if name not in able and used[name] < squad.times]
    if not barred or not squad.caps:
        return None
    return say(
        "{players} can't be put up now: the remaining sets could no longer be filled within the "
        "limit.",
        players=listed(barred),
    )


def _in_words(found: Advice, named: Sequence[str]) -> Sentence:
    best, p = found.best, percent(found.worth)
    worths = {option.worth for option in found.options}
    if worths in ({1.0}, {0.0}):
        if found.worth:
            return say("The match is decided: you have won it.")
        return say("The match is decided: you have lost it.")
    if found.blind:
        mixed = [
            say("{pick} {share}", pick=_name(option), share=percent(option.mix))
            for option in sorted(found.options, key=lambda option: -option.mix)
            if option.mix > 5e-4
        ]
        if len(mixed) == 1:
            return say(
                "Put up {pick}: you win the night at least {p} of the time.", pick=_name(best), p=p
            )
        return say(
            "Pick at random ({picks}): you win the night {p} of the time, whatever they do.",
            picks=listed(mixed),
            p=p,
        )
    if found.ours and named:
        return say(
            "Against {theirs}, put up {pick}: you win the night {p} of the time.",
            theirs=names_words(named),
            pick=_name(best),
            p=p,
        )
    if found.ours:
        return say(
            "Put up {pick}: you win the night {p} of the time if they make their best reply "
            "({reply}).",
            pick=_name(best),
            p=p,
            reply=names_words(best.answer),
        )
    if named:
        return say(
            "If you put up {ours}, their best answer is {pick}, and you win the night {p} of "
            "the time.",
            ours=names_words(named),
            pick=_name(best),
            p=p,
        )
    return say(
        "They put up first. Their best pick is {pick}. Answer with {reply}, and you win "
        "the night {p} of the time.",
        pick=_name(best),
        reply=names_words(best.answer),
        p=p,
    )


def _table(found: Advice, sure: dict[tuple[str, ...], float], draws: int) -> Table:
    sign = 1.0 if found.ours else -1.0
    whose = say("player") if found.ours else say("their pick")
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
    """Return the night's value if we name first or answer first, and the words for it."""
    order = solution.night.order
    if order[0] not in (OURS, THEIRS):
        return None, ""
    other = solved(meeting.night(mirrored(order))).value
    first, second = (solution.value, other) if order[0] == OURS else (other, solution.value)
    toss = {"name_first": first, "answer_first": second, "worth": abs(first - second)}
    if str(percent(first)) == str(percent(second)):
        return toss, say("The toss makes no difference.")
    return toss, say(
        "If you win the toss, {choice}: you win the night {better} of the time, compared with "
        "{worse} the other way around.",
        choice=say("answer") if second > first else say("put up first"),
        better=percent(max(first, second)),
        worse=percent(min(first, second)),
    )


def _orders(meeting: Meeting, solution: SolvedNight) -> Table:
    """Return the night's value in each order of nomination."""
    sets = len(meeting.sizes)
    rows: list[list[Any]] = []
    for name in NAMED:
        order = order_of(name, sets)
        for each in dict.fromkeys((order, mirrored(order))):
            known = each == solution.night.order
            value = solution.value if known else solved(meeting.night(each)).value
            rows.append([each, _order_words(name, each), value])
    columns = columns_of("order names_first p_win_night")
    return Table("orders", columns, rows, title="What each nomination order is worth")


def _order_words(name: str, order: str) -> str:
    who = say("you") if order[0] == OURS else say("them")
    return {
        "alternate": say("in turn, {who} in set 1", who=who),
        "home": say("always {who}", who=who),
        "blind": say("both at once, blind"),
        "winner": say("the winner of the last set, {who} in set 1", who=who),
        "loser": say("the loser of the last set, {who} in set 1", who=who),
    }[name]


def _sure_words(found: Advice, sure: dict[tuple[str, ...], float], draws: int) -> str:
    """Return how much the best pick depends on the ratings."""
    if not sure:
        return ""
    best, share = _name(found.best), sure.get(found.best.names, 0.0)
    others = [names for names in sure if names != found.best.names]
    if share > 0.95 or not others:
        return say(
            "{pick} is the best pick even if the ratings are as far off as their errors allow.",
            pick=best,
        )
    return say(
        "Because ratings are uncertain, {draws} sets of ratings were drawn: {pick} is the best "
        "pick in {p} of them and {other} in {q} ({luck}). On average, {pick} comes out ahead.",
        pick=best,
        p=percent(share),
        other=names_words(others[0]),
        q=percent(sure[others[0]]),
        draws=draws,
        luck=luck_words([error_of_share(each, draws) for each in sure.values()]),
    )


_LISTED = 10


def sealed_answer(
    meeting: Meeting, warnings: Sequence[str], solution: SealedNight | None = None
) -> Answer:
    """Return what to write on a lineup that the other team doesn't see.

    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.teams import Squad
    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy"], [560])
    >>> squads = Squad(us.players), Squad(them.players)
    >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "sealed")
    >>> print(sealed_answer(meeting, ()).sentences[0])
    Play Ann in a random order: you win the night 67% of the time, whatever they do.
    """
    found = solution or sealed(meeting.night())
    played = [one for one in found.ours if one.mix > 5e-4]
    if len(played) == 1:
        line_up = listed(list(played[0].names))
        words = say(
            "Play {players} in a random order: you win the night {p} of the time, whatever they "
            "do.",
            players=line_up,
            p=percent(found.worth),
        )
    else:
        words = say(
            "Pick one of the lineups below at random, using the shares as weights, then put it "
            "in a random order: you win the night {p} of the time, whatever they do.",
            p=percent(found.worth),
        )
    columns = columns_of("-name sits_out p_win_night cost mix")
    listing = found.ours[:_LISTED]
    rows = [
        [
            ", ".join(one.names),
            ", ".join(name for name in meeting.ours.players if name not in one.names)
            or say("no one"),
            one.worth,
            max(0.0, found.worth - one.worth),
            one.mix,
        ]
        for one in listing
    ]
    left = len(found.ours) - len(listing)
    notes = [say("Against a random order, all their orders are worth the same.")]
    if left:
        notes.append(
            say_count("{n} more lineup is not listed.", "{n} more lineups are not listed.", left)
        )
    table = Table("options", columns, rows)
    return Answer(
        say(
            "Sealed lineups of {sets}: {ours} players against {theirs}, {races}\n{strengths}",
            sets=say_count("{n} set", "{n} sets", len(meeting.sizes)),
            ours=len(meeting.ours),
            theirs=len(meeting.theirs),
            races=race_words(meeting.race),
            strengths=strengths_words(meeting.race, meeting.levels, meeting.scale),
        ),
        [
            words,
            Quantities(quantities_of({"-p_win_night": found.worth, "best": _best(found.ours)})),
            table,
            joined(notes),
            *filter(None, [level_words(meeting.race, meeting.levels)]),
        ],
        data={"toss": None, "blind": True, "ours": True, "set": 1},
        warnings=warnings,
        csv=table,
    )


def _best(line_ups: Sequence[SealedLineUp]) -> str:
    return ", ".join(line_ups[0].names)


def race_words(race: SetRace) -> Sentence:
    """Return what is played in a set.

    >>> race_words(5), race_words(Fairest(7))
    ('races to 5', 'the fairest races to 7')
    """
    if isinstance(race, Fairest):
        return say("the fairest races to {n}", n=race.race_to)
    if isinstance(race, int):
        return say("races to {n}", n=race)
    if isinstance(race, PointsChart):
        return say("points from {chart}", chart=race.name)
    return say("races from {chart}", chart=race.name)
