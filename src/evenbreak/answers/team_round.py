"""A round between two teams: who wins it, and the head start that makes it even."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Part, Quantities, Quantity, Table
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.wording import chance, count_of, decimals, percent
from evenbreak.handicaps.systems.team_handicap import team_handicap
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.teams.round_law import Outcome, RoundLaw, known_starts


def team_round_answer(
    teams: tuple[Roster, Roster],
    law: RoundLaw,
    *,
    played: str,
    scale: Scale,
    games: int | None = None,
    everybody: bool = False,
    names: tuple[str, str] = ("team 1", "team 2"),
    warnings: Sequence[str] = (),
) -> Answer:
    """Return who wins a round, and the head start that makes it even.

    Parameters
    ----------
    teams
        both teams.
    law
        of the lead of the first.
    played
        what is played, in words.
    scale
        of the ratings.
    games
        the games of each match, if it is single games; then CSI's way is compared.
    everybody
        whether everybody meets everybody.
    names
        what the teams are called.
    warnings
        about the question.

    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.teams import round_law
    >>> us, them = Roster(["Ann"], [500]), Roster(["Bo"], [600])
    >>> law = round_law(us, them, games=2)
    >>> asked = {"played": "2 games", "scale": SCALES["fargo"], "games": 2}
    >>> print(team_round_answer((us, them), law, **asked).sentences[0])
    Without a head start team 1 wins the round 11% of the time, loses it 44% and ties it 44%.
    With 1 game for team 1 it is nearest to even: they win it 56% of the time and lose it 44%; \
there are no ties.
    """
    fair, plain = law.fair_start, law.with_start(0)
    words = [f"Without a head start {names[0]} {_in_words(plain, 'wins', 'loses', 'ties')}."]
    if fair:
        ahead = law.with_start(fair)
        seen = ahead if fair > 0 else Outcome(ahead.lose, ahead.tie, ahead.win)
        words.append(
            f"With {count_of(abs(fair), 'game')} for {names[fair < 0]} it is nearest to even: they "
            f"{_in_words(seen, 'win', 'lose', 'tie').replace(' the round', ' it', 1)}."
        )
    else:
        words.append("No head start of whole games brings it nearer to even.")
    parts: list[Part] = ["\n".join(words)]
    csi: int | None = None
    if games is not None:
        csi, said = _csi(teams, law, games, everybody, scale, names)
        parts.append(said)
    rows = [
        (start, *law.with_start(start))
        for start in known_starts(law, *([] if csi is None else [csi]))
    ]
    columns = [
        Column("start_1", "head start", lambda start: _start_words(start, names), left=True),
        Column("p_win_1", f"{names[0]}\nwins", chance),
        Column("p_tie", "tie", chance),
        Column("p_lose_1", f"{names[1]}\nwins", chance),
    ]
    data = [
        Quantity("mean_lead_1", law.mean, f"lead of {names[0]} on average", decimals(2)),
        Quantity("fair_start_1", fair),
        Quantity("csi_start_1", csi),
    ]
    return Answer(
        f"{count_of(len(teams[0]), 'player')} against {len(teams[1])}, {played}\n"
        f"Ratings {scale_words(scale)}",
        [*parts, Quantities(data), Table("starts", columns, rows, title="What a head start does")],
        warnings=warnings,
    )


def _start_words(start: int, names: tuple[str, str]) -> str:
    return f"{abs(start)} for {names[start < 0]}" if start else "none"


def _in_words(seen: Outcome, win: str, lose: str, tie: str) -> str:
    won = f"{win} the round {percent(seen.win)} of the time"
    if not seen.tie:
        return f"{won} and {lose} it {percent(seen.lose)}; there are no ties"
    return f"{won}, {lose} it {percent(seen.lose)} and {tie} it {percent(seen.tie)}"


def _csi(
    teams: tuple[Roster, Roster],
    law: RoundLaw,
    games: int,
    everybody: bool,
    scale: Scale,
    names: tuple[str, str],
) -> tuple[int, str]:
    """Return the start in games that CSI's way of rounding gives, and what it gives away."""
    one, other = (float(roster.rating.mean()) for roster in teams)
    pairs = len(teams[0]) * (len(teams[1]) if everybody else 1)
    found = team_handicap(
        one, other, match_ups=pairs, games=games, points_won=1.0, points_lost=0.0, scale=scale
    )
    start = found.points if found.to_team == 1 else -found.points
    weaker, times = names[law.mean > 0], f", then times {games}" if games > 1 else ""
    text = (
        f"CSI's way (from the two averages, one game of each match, rounded down{times}) gives "
        f"{count_of(found.points, 'game')}"
    )
    if found.points:
        text += f" to {names[(found.to_team or 1) - 1]}"
    if found.given_away > 0.005:
        text += (
            f"; {found.even_points:.2f} would even out the averages, so the rounding keeps "
            f"{percent(found.given_away)} of them from {weaker}"
        )
    seen = law.with_start(start)
    return start, f"{text}. Then {names[0]} {_in_words(seen, 'wins', 'loses', 'ties')}."
