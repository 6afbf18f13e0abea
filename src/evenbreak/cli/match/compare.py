"""`evenbreak compare`: match formats side by side, for the same two players."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

from evenbreak import matches
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.cli.match.odds import players_of
from evenbreak.matches.formats import MatchFormat
from evenbreak.questions.match import Compare

MOST_SCORES = {"race": 10_000, "break": 900, "": 2_500}
"""The most scores of a race where the break matters, of another match where it does, and of
another match where it does not, so that every answer takes seconds."""


@command_of(Compare, "compare")
def command(asked: Compare) -> Answer:
    """Compare match formats for two players."""
    from evenbreak.answers.match.formats import Compared, compare_answer

    players = players_of(asked, 0.0)
    read = _read(asked.formats, players)
    line = _line(players, asked.hold)
    compared = []
    for played in read:
        match = played.match(
            players.rack, breaks=players.break_format, first_breaker=players.first_breaker
        )
        compared.append(
            Compared(played, matches.match_odds(match), matches.even_probability(played, **line))
        )
    pairs = {
        (i, j): matches.crossings(read[i], read[j], **line)
        for i, j in combinations(range(len(read)), 2)
    }
    answer = compare_answer(players, compared, pairs, hold=asked.hold)
    if asked.plot is not None:
        from evenbreak.plots.matches import draw_formats

        figure = draw_formats(
            read,
            line,
            pairs.values(),
            p1=float(players.rack.p1),
            title=answer.heading,
            names=players.names,
        )
        write_plot(figure, asked.plot)
    return answer


def _read(texts: Sequence[str], players: TwoPlayers) -> list[MatchFormat]:
    """Return the formats, or refuse those that cannot be compared here."""
    read = [matches.match_format(text) for text in texts]
    for played in read:
        kinds = [played]
        while kinds[-1].set_ is not None:
            kinds.append(kinds[-1].set_)
        if kinds[-1].breaks is not None and not players.rack.break_matters:
            refuse(
                f"{str(played)!r} says who breaks, which matters only with --p1 and --p2; "
                "leave it out"
            )
        for kind in kinds:
            race = len(kinds) == 1 and not kind.ahead and kind.win_by == 1
            if race and not players.rack.break_matters:
                continue
            most = MOST_SCORES["race" if race else "break" if players.rack.break_matters else ""]
            scores = kind.scores // (kind.set_.scores if kind.set_ else 1)
            if scores > most:
                refuse(
                    f"{str(played)!r} has a part with about {scores:,} scores, and {most:,} are "
                    "the most that can be compared here; use evenbreak odds for such a match"
                )
    return read


def _line(players: TwoPlayers, hold: str | None) -> dict[str, Any]:
    """Return the pairs of players that the formats are compared for, as options of `crossings`."""
    p1, p2 = players.rack.p1, players.rack.p2
    if p2 is None:
        if hold is not None:
            refuse("--hold goes with --p1 and --p2, which are not given; leave it out")
        return {}
    line: dict[str, Any] = {"breaks": players.break_format, "first_breaker": players.first_breaker}
    if hold != "break":
        return line | {"p2": p2}
    if not (0.0 < p1 < 1.0 and 0.0 < p2 < 1.0):
        refuse("--hold break needs --p1 and --p2 above 0 and below 1; use --hold p2")
    return line | {"break_odds": p1 / (1.0 - p1) * p2 / (1.0 - p2)}
