"""The comeback table: a player's chance at every score that can still come."""

from collections.abc import Iterator, Mapping

from evenbreak.answers.parts import Column, Part, Table
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match
from evenbreak.matches.live import LiveOdds

Score = tuple[int, int]
Cells = Mapping[Score, float]


def comeback_tables(match: Match, odds: LiveOdds, names: tuple[str, str]) -> Iterator[Part]:
    """Yield the comeback table as people read it: a matrix of scores, or a list of leads.

    In a match of sets, the scores of the set under way come first, then those at which a set
    begins. A star marks the chance at the score now.
    """
    moments = odds.comebacks()
    if not moments:
        yield "The match is over: there are no scores to come."
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
            title = f"by the score of the set under way{breaks}"
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
    star = " (* marks the score now)" if now in cells else ""
    title = f"{a}'s chance of winning the match in %, {title}{star}"
    shown = {at: f"{'*' if at == now else ''}{100 * cells[at]:.1f}" for at in cells}
    if leads:
        by_lead = {i - j: text for (i, j), text in shown.items()}
        rows = [(_lead(lead, names), by_lead[lead]) for lead in sorted(by_lead)]
        return Table("", [Column("lead", "", left=True), Column("p_win_a", "")], rows, title)
    down = sorted({i for i, _ in cells})
    across = sorted({j for _, j in cells})
    columns = [Column("score_a", "", left=True)]
    columns += [Column(f"score_b_{j}", f"{b} {j}") for j in across]
    matrix = [(f"{a} {i}", *(shown.get((i, j)) for j in across)) for i in down]
    return Table("", columns, matrix, title)


def _lead(lead: int, names: tuple[str, str]) -> str:
    return "level" if lead == 0 else f"{names[lead < 0]} leads by {abs(lead)}"
