"""A match in progress: the score, the value of the next game, the story so far."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, in_files, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.match.odds import TwoPlayers, match_words
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match
from evenbreak.matches.live import LiveOdds, Standing
from evenbreak.words import tally

_PLACE = ("score_a", "score_b", "set_a", "set_b", "next_break")


LARGE_SWING = 0.15
"""How much a game must change a player's chance to be called the turning point."""


def live_answer(
    players: TwoPlayers, match: Match, odds: LiveOdds, *, comebacks: bool = False
) -> Answer:
    """Return a match's state and odds.

    With `comebacks`, files have the chances at every score that is still possible.
    """
    now, course = odds.now, _course(odds)
    to_come = Table(
        "comebacks",
        in_files((*_PLACE, "p_win_a", "leverage")),
        [(*_place(moment), moment.p_win_1, moment.leverage) for moment in odds.comebacks()],
    )
    parts: list[Part] = [_in_words(now, players)]
    if now.leverage is not None:
        parts.append(_now(now, players))
    if odds.winners:
        parts += [_as_it_went(odds, players), _turning_point(odds, players)]
    if comebacks:
        parts += comeback_tables(match, odds, players.names)
    *_, last = course.records()
    return Answer(
        f"{players.description}\n{_standing_words(match, now, players)}",
        [part for part in [*parts, players.taken_as_right, _by_form(players)] if part],
        warnings=players.doubts,
        data={
            "now": dict(zip(course.names, last, strict=True)),
            course.name: course.to_dicts(),
            to_come.name: to_come.to_dicts(),
            **players.named,
        },
        csv=to_come if comebacks else course,
    )


def _by_form(players: TwoPlayers) -> str:
    learns = " Each game played shows how well both are playing today." if players.form else ""
    return players.by_form + learns


def _place(moment: Standing) -> tuple[Any, ...]:
    inside = moment.scores[1] if len(moment.scores) > 1 else (None, None)
    return (*moment.scores[0], *inside, _letter(moment.breaker))


def _letter(player: int | None) -> str | None:
    return None if player is None else " ab"[player]


def _in_words(now: Standing, players: TwoPlayers) -> str:
    a, b = players.names
    if now.leverage is None:
        return f"{a if now.p_win_1 else b} has won the match."
    p, left = now.p_win_1, now.p_win_2
    after, other = now.p_win_1_after or (p, p)
    won = left if p == 1.0 else 0.0  # otherwise a chance of 1 means that the match ends
    name, p, least = (a, p, left) if p >= left else (b, left, p)
    return (
        f"From here {name} wins {percent(p, least)} of the time.\nIf {a} wins the next game, {a}'s "
        f"chance is {percent(after, won)}; if {b} wins it, {percent(other, left)}."
    )


def _now(now: Standing, players: TwoPlayers) -> Quantities:
    a, b = players.names
    after, other = now.p_win_1_after or (None, None)
    return Quantities(
        quantities_of(
            {
                "p_win_a": now.p_win_1,
                "p_win_b": now.p_win_2,
                "p_win_a_if_a": after,
                "p_win_a_if_b": other,
                "next_game": now.leverage,
                "mean_racks_left": now.mean_racks,
                "racks_left_p90": now.racks_p90,
            },
            a=a,
            b=b,
        ),
        in_json=False,
    )


def _course(odds: LiveOdds) -> Table:
    """Return the match so far, one row per moment, starting before the first game."""
    moments = zip(odds.course, (None, *odds.winners), (None, *odds.swings), strict=True)
    rows = [
        (
            *(number, _letter(winner), *_place(moment), moment.p_win_1, moment.p_win_2, swing),
            *(moment.p_win_1_after or (None, None)),
            *(moment.leverage, moment.mean_racks, moment.racks_p90),
        )
        for number, (moment, winner, swing) in enumerate(moments)
    ]
    names = [
        *("rack", "won_by", *_PLACE, "p_win_a", "p_win_b", "swing_a"),
        *("p_win_a_if_a", "p_win_a_if_b", "leverage", "mean_racks_left", "racks_left_p90"),
    ]
    return Table("course", in_files(names), rows)


def _as_it_went(odds: LiveOdds, players: TwoPlayers) -> Table:
    """Return the games played so far, each with what was at stake and what it changed."""
    a = players.names[0]
    rows = [
        (number, players.names[winner - 1], _score_words(after), after.p_win_1, swing, leverage)
        for number, (winner, after, swing, leverage) in enumerate(
            zip(
                odds.winners,
                odds.course[1:],
                odds.swings,
                [moment.leverage for moment in odds.course[:-1]],
                strict=True,
            ),
            1,
        )
    ]
    columns = columns_of("rack won_by score wins_a swing_a leverage", a=a)
    return Table("", columns, rows)


def _turning_point(odds: LiveOdds, players: TwoPlayers) -> str:
    most = max(range(len(odds.swings)), key=lambda i: abs(odds.swings[i]))
    swing = odds.swings[most]
    if not swing:
        return ""
    winner = odds.winners[most]
    before, after = (
        moment.p_win_1 if winner == 1 else moment.p_win_2 for moment in odds.course[most : most + 2]
    )
    turned = "was the turning point" if after - before >= LARGE_SWING else "changed the odds most"
    return (
        f"Game {most + 1} {turned}: it took {players.names[winner - 1]}'s chance from "
        f"{percent(before)} to {percent(after)}."
    )


def _standing_words(match: Match, now: Standing, players: TwoPlayers) -> str:
    """Return what is played and the score."""
    text = f"{match_words(replace(match, score=(0, 0)))}, score {_score_words(now)}"
    if now.leverage is None:
        return text
    return text + (f", {players.names[now.breaker - 1]} breaks" if now.breaker else "")


def _score_words(moment: Standing) -> str:
    """Return a score, including the current set's: 1-0 (2-2)."""
    games, *inside = moment.scores
    return tally(games) + "".join(f" ({tally(of_set)})" for of_set in inside)


Score = tuple[int, int]
Cells = Mapping[Score, float]


def comeback_tables(match: Match, odds: LiveOdds, names: tuple[str, str]) -> Iterator[Part]:
    """Yield the comeback table for display: a matrix of scores, or a list of leads.

    In a match of sets, scores in the current set come first, then scores at which a set starts. A
    star marks the chance at the current score.
    """
    moments = odds.comebacks()
    if not moments:
        yield "The match is over."
    for breaker in sorted({moment.breaker or 0 for moment in moments}):
        score, *inner = odds.now.scores if (odds.now.breaker or 0) == breaker else ((-1, -1),)
        here = [moment for moment in moments if (moment.breaker or 0) == breaker]
        breaks = f", {names[breaker - 1]} to break" if breaker else ""
        if not isinstance(match.rack, Match):
            cells = {moment.scores[0]: moment.p_win_1 for moment in here}
            yield _matrix(f"by score{breaks}", cells, isinstance(match, Ahead), score, names)
            continue
        now, begin = match.fold(*odds.now.scores[0]), match.rack.fold(*match.rack.score)
        inside = {m.scores[1]: m.p_win_1 for m in here if m.scores[0] == now}
        if inside:
            title = f"by the score in the current set{breaks}"
            at = inner[0] if inner else None
            yield _matrix(title, inside, isinstance(match.rack, Ahead), at, names)
        between = {m.scores[0]: m.p_win_1 for m in here if m.scores[1] == begin}
        if between:
            title = f"by the score in sets, at the start of a set{breaks}"
            at = score if inner == [begin] else None
            yield _matrix(title, between, isinstance(match, Ahead), at, names)


def _matrix(
    title: str, cells: Cells, leads: bool, now: Score | None, names: tuple[str, str]
) -> Table:
    a, b = names
    star = " (* marks the current score)" if now in cells else ""
    title = f"{a}'s chance of winning the match in %, {title}{star}"
    shown = {at: f"{'*' if at == now else ''}{100 * cells[at]:.1f}" for at in cells}
    if leads:
        by_lead = {i - j: text for (i, j), text in shown.items()}
        rows = [(_lead(lead, names), by_lead[lead]) for lead in sorted(by_lead)]
        return Table("", columns_of("lead p_win_a_by_lead"), rows, title)
    down = sorted({i for i, _ in cells})
    across = sorted({j for _, j in cells})
    columns = columns_of("score_a")
    columns += [column_of("score_b", b=b, score=j) for j in across]
    matrix = [(f"{a} {i}", *(shown.get((i, j)) for j in across)) for i in down]
    return Table("", columns, matrix, title)


def _lead(lead: int, names: tuple[str, str]) -> str:
    return "level" if lead == 0 else f"{names[lead < 0]} leads by {abs(lead)}"
