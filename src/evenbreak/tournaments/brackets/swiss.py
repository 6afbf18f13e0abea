"""Swiss tournaments: no one is knocked out; each round pairs players with equal scores.

A round can be paired only when the previous one is over, so a Swiss isn't a bracket. Pairings come
from caissify-pairings, an extra: `pip install 'evenbreak[swiss]'`.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Literal, NamedTuple, TypeAlias

from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Match, Place, Slot, Source
from evenbreak.tournaments.brackets.drafts import checked_players
from evenbreak.words import Parameter

System: TypeAlias = Literal["dutch", "casual"]


class Pairing(NamedTuple):
    """Two paired players; `second` is None for a bye, `winner` is None until it is played."""

    first: str
    second: str | None = None
    winner: str | None = None


class SwissRank(NamedTuple):
    """A player's place in the standings.

    Parameters
    ----------
    score
        matches won; a bye counts as one.
    buchholz
        the sum of the opponents' scores, the usual tie-break.
    """

    player: str
    score: int
    buchholz: int
    lost: int


@dataclass(frozen=True)
class Swiss:
    """A Swiss tournament.

    Parameters
    ----------
    players
        the names in seed order.
    system
        the pairing system: 'dutch' follows the rules of chess (FIDE C.04.3); 'casual' is simpler
        and a hundred times as fast, but may pair two players twice.
    """

    players: tuple[str, ...]
    rounds: int
    system: System = "dutch"

    def __post_init__(self) -> None:
        object.__setattr__(self, "players", checked_players(self.players))
        object.__setattr__(self, "rounds", whole(self.rounds, "rounds", at_least=1))
        one_of(self.system, "system", ("dutch", "casual"))
        most = len(self.players) - 1 + len(self.players) % 2
        if self.rounds > most:
            raise InputError(
                "{name} must be at most {most} for {players} players, so that no one has "
                "to play the same opponent twice; it is {value}",
                name=Parameter("rounds"),
                most=most,
                players=len(self.players),
                value=self.rounds,
            )


def swiss(players: Sequence[str] | int, rounds: int, *, system: System = "dutch") -> Swiss:
    """Return a Swiss tournament.

    Parameters
    ----------
    players
        names in seed order, or their number.

    >>> swiss(["Ann", "Bo", "Cy", "Di"], 3).rounds
    3
    """
    return Swiss(checked_players(players), rounds, system)


def swiss_round(
    event: Swiss,
    played: Sequence[Sequence[Pairing]] = (),
    *,
    without: Collection[str] = (),
) -> list[Pairing]:
    """Return the next round's pairings.

    Parameters
    ----------
    played
        the rounds so far, complete with winners.
    without
        players who have gone home and are no longer paired; everyone is paired in the first round.

    Raises
    ------
    InputError
        if a round is incomplete, fewer than two players are left, all rounds are over, or the extra
        isn't installed.
    """
    check_rounds(event, played)
    if len(played) == event.rounds:
        raise InputError("all {rounds} rounds have been played", rounds=event.rounds)
    rows = _histories(event, played)
    if played:
        rows = [row for row in rows if row["name"] not in without]
    if len(rows) < 2:
        raise InputError("fewer than two players are left, so no round can be paired")
    try:
        engine: Any = import_module("caissify_pairings")
    except ImportError:
        raise InputError(
            "pairing a Swiss needs caissify-pairings: pip install 'evenbreak[swiss]'"
        ) from None
    met = {
        (event.players.index(p.first) + 1, event.players.index(p.second) + 1)
        for pairings in played
        for p in pairings
        if p.second is not None
    }
    found = engine.generate_pairings(event.system, rows, met, len(played) + 1, event.rounds)
    name = dict(enumerate(event.players, 1))
    return [Pairing(name[row["white_id"]], name.get(row["black_id"])) for row in found]


def swiss_standings(event: Swiss, played: Sequence[Sequence[Pairing]]) -> list[SwissRank]:
    """Return the standings: by score, then by the sum of the opponents' scores, then by seed.

    >>> event = swiss(["Ann", "Bo", "Cy"], 2)
    >>> first = [Pairing("Ann", "Bo", "Bo"), Pairing("Cy", None)]
    >>> swiss_standings(event, [first])[0]
    SwissRank(player='Bo', score=1, buchholz=0, lost=0)
    """
    check_rounds(event, played)
    score, lost = dict.fromkeys(event.players, 0), dict.fromkeys(event.players, 0)
    met: dict[str, list[str]] = {player: [] for player in event.players}
    for pairings in played:
        for first, second, winner in pairings:
            score[winner or first] += 1
            if second is not None:
                lost[first if winner == second else second] += 1
                met[first].append(second)
                met[second].append(first)
    rows = [
        SwissRank(player, score[player], sum(score[other] for other in met[player]), lost[player])
        for player in event.players
    ]
    return sorted(rows, key=lambda row: (-row.score, -row.buchholz))


def swiss_bracket(
    event: Swiss, drawn: Sequence[Sequence[Pairing]] = (), *, to_come: bool = True
) -> Bracket:
    """Return a Swiss tournament's matches, in rounds already drawn and in upcoming rounds.

    Pairings in an upcoming round aren't known. Instead, the previous round's winners play each
    other, and so do its losers; that is good enough for estimating how long it takes.

    Parameters
    ----------
    drawn
        the pairings of the first rounds.
    to_come
        whether to add the other rounds.

    >>> bracket = swiss_bracket(swiss(5, 2), [[Pairing("1", "3"), Pairing("4", "2"), Pairing("5")]])
    >>> [(match.name, match.slots) for match in bracket.matches][1:3]
    [('R1.2', (3, 1)), ('R2.1', (4, Source(match='R1.1', outcome='winner', via=None)))]
    """
    seat = {player: k for k, player in enumerate(event.players)}
    order: list[Slot] = list(range(len(seat)))
    matches: list[Match] = []
    for number in range(1, (event.rounds if to_come else len(drawn)) + 1):
        if number <= len(drawn):
            pairs: list[tuple[Slot, Slot]] = [
                (seat[p.first], seat[p.second]) for p in drawn[number - 1] if p.second is not None
            ]
            resting: list[Slot] = [seat[p.first] for p in drawn[number - 1] if p.second is None]
        else:
            half = len(order) // 2
            ends = (
                (order[:half], order[half : 2 * half]) if number == 1 else (order[::2], order[1::2])
            )
            pairs, resting = list(zip(*ends, strict=False)), order[2 * half :]
        names = [f"R{number}.{i}" for i in range(1, len(pairs) + 1)]
        matches += [
            Match(name, "Swiss", number, pair) for name, pair in zip(names, pairs, strict=True)
        ]
        order = [*resting, *(Source(name, end) for end in ("winner", "loser") for name in names)]
    members = tuple(range(len(seat)))
    ranks = Group("Swiss", members, (), (), tuple(Place(k + 1, k + 1) for k in members))
    return Bracket(
        f"Swiss, {event.rounds} round{'s' * (event.rounds > 1)}",
        event.players,
        tuple(matches),
        (ranks,),
    )


def check_rounds(event: Swiss, played: Sequence[Sequence[Pairing]]) -> None:
    """Raise an error if a round repeats a player, lacks one who plays later, or lacks a winner."""
    if len(played) > event.rounds:
        raise InputError(
            "{played} rounds have been played, but the event has only {rounds}",
            played=len(played),
            rounds=event.rounds,
        )
    before = set(event.players)
    for number, pairings in enumerate(played, 1):
        seats = [player for p in pairings for player in (p.first, p.second) if player is not None]
        if number == 1 and sorted(seats) != sorted(event.players):
            raise InputError("round 1 must have every player exactly once")
        if len(set(seats)) < len(seats) or not set(seats) <= before:
            raise InputError("round {n} has a player twice, or one who had withdrawn", n=number)
        before = set(seats)
        for first, second, winner in pairings:
            if second is not None and winner not in (first, second):
                raise InputError(
                    "round {n}: {first} against {second} was won by {winner!r}. Name one "
                    "of the two.",
                    n=number,
                    first=first,
                    second=second,
                    winner=winner,
                )


def _histories(event: Swiss, played: Sequence[Sequence[Pairing]]) -> list[dict[str, Any]]:
    """Return each player's history in the pairing engine's format; the first player is white."""
    rows: dict[str, dict[str, Any]] = {
        player: {
            "id": number,
            "name": player,
            "score": 0.0,
            "rating": len(event.players) - number,
            "starting_number": number,
            "color_hist": [],
            "float_history": [],
            "bye_count": 0,
        }
        for number, player in enumerate(event.players, 1)
    }
    for pairings in played:
        before = {player: row["score"] for player, row in rows.items()}
        for first, second, winner in pairings:
            rows[winner or first]["score"] += 1.0
            if second is None:
                rows[first]["bye_count"] += 1
                rows[first]["color_hist"].append("none")
                rows[first]["float_history"].append("down")
                continue
            for player, other, seat in ((first, second, "white"), (second, first, "black")):
                floated = (before[player] > before[other]) - (before[player] < before[other])
                rows[player]["color_hist"].append(seat)
                rows[player]["float_history"].append(("none", "down", "up")[floated])
    return list(rows.values())
