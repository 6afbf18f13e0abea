"""Handicap systems side by side: accuracy, speed, fairness, and the best step size."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, in_files
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.ladder.ladder import OPPONENTS
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart import chart as printed
from evenbreak.handicaps.ladders.comparison import NEAR, SystemRow, compare_systems, on_front
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import Opponents
from evenbreak.handicaps.ladders.settling import settling
from evenbreak.handicaps.systems.catalog import steps_of
from evenbreak.league.reestimate import Reestimated, reestimate
from evenbreak.words import listed

OTHERS = ("margin 2", "elo 4", "elo 16", "fixed 9")
"""The other systems; those without a printed chart use a chart of their own."""

STEPS = (1, 2, 3, 4, 5, 6, 8, 10)
"""The step sizes compared."""

NEWCOMERS = "npl new"
"""The row name for a player who moves by the league's newcomer steps."""

REFITTED_PLAYERS, REFITTED_LEAGUES, REFITTED_SEED = 40, 8, 1
"""The simulated leagues of equally good players whose ratings are recalculated every week."""


class LadderComparison(NamedTuple):
    """Systems and step sizes side by side.

    `steps` says for each step size whether no other is better in both respects; `refitted` are
    ratings recalculated every week from all results, None if they weren't simulated.
    """

    chart: Chart
    opponents: str
    systems: Sequence[SystemRow]
    steps: Sequence[tuple[SystemRow, bool]]
    refitted: Reestimated | None


def compare_ladders(chart: Chart, opponents: Opponents, name: str) -> LadderComparison:
    """Return systems and step sizes side by side, against a type of opponents in `OPPONENTS`."""
    rows = compare_systems([(f"step {step}", chart) for step in STEPS], opponents=opponents)
    front = on_front([(row.sd, row.settling_mean) for row in rows])
    refitted = _refitted(chart) if name == "equal skill" else None
    steps = list(zip(rows, front, strict=True))
    return LadderComparison(chart, name, _systems(chart, opponents), steps, refitted)


def _systems(chart: Chart, opponents: Opponents) -> list[SystemRow]:
    """Return the National Pool League with all of its charts and with `chart`, and others."""
    npl = steps_of("npl")
    charts = [printed(name) for name in npl.charts]
    if chart not in charts:
        charts.append(chart)
    others = [(name, chart if steps_of(name).charts else None) for name in OTHERS]
    rows = compare_systems([*(("npl", each) for each in charts), *others], opponents=opponents)
    place = charts.index(chart)
    return [*rows[: place + 1], _newcomer(rows[place], chart, opponents), *rows[place + 1 :]]


def _newcomer(row: SystemRow, chart: Chart, opponents: Opponents) -> SystemRow:
    """Return the league's row for this chart if the player starts with its newcomer steps."""
    ladder = Ladder("npl", chart, opponents=opponents)
    points = ladder.system.scale.points_per_doubling
    sooner = settling(ladder, -round(points), round(NEAR * points), newcomer=True)
    nine = int(sooner.matches.quantile(0.9))
    return row._replace(system=NEWCOMERS, settling_mean=sooner.mean, settling_p90=nine)


def _refitted(chart: Chart) -> Reestimated:
    """Return how far off ratings are that are recalculated every week, in simulated leagues."""
    return reestimate(
        [0.0] * REFITTED_PLAYERS,
        chart,
        scale="npl",
        newcomer_weeks=100,
        leagues=REFITTED_LEAGUES,
        seed=REFITTED_SEED,
    )


def ladder_comparison_answer(found: LadderComparison, warnings: Sequence[str] = ()) -> Answer:
    """Return systems and step sizes side by side; in files, one row for each."""
    shown = [*found.systems, *([] if found.refitted is None else [found.refitted.row])]
    beaten = [row.system for row, best in found.steps if not best]
    parts: list[Part] = [
        _advice(found),
        _view(shown),
        _EXPLANATION,
        *_notes(found),
        _view([row for row, _ in found.steps], f"Step sizes on chart {found.chart.name}:"),
        "Longer steps make ratings settle sooner but leave them less accurate, so they pay off "
        f"where there are many newcomers. {_never_worth_it(beaten)}",
    ]
    return Answer(
        f"Handicap systems side by side\n{OPPONENTS[found.opponents]}",
        parts,
        warnings=warnings,
        data={"opponents": found.opponents},
        csv=Table("systems", _COLUMNS, list(_rows(found))),
    )


_EXPLANATION = (
    "'Error': how far ratings are typically off in the long run (standard deviation), in points "
    "and as a percentage of a doubling (the points that double the odds of winning a game). "
    "'Settles in': how many matches it takes for a rating that starts one doubling too low to "
    "come within a sixth of a doubling, on average and for 9 out of 10 players. 'Favorite': how "
    "often the player favored by the errors wins, and in how many of 100 matches their chance "
    "is 60% or more. 'Games': the average length of a match."
)


_COLUMNS = [
    *columns_of(
        "system chart error_points sd_doublings settling_mean settling_p90 p_favorite_mean "
        "favorite_over_60 match_games inflation on_front"
    ),
    *in_files(("sd_se", "settling_mean_se")),
]


def _rows(found: LadderComparison) -> Iterator[tuple[Any, ...]]:
    yield from ((*row, None, None, None) for row in found.systems)
    if found.refitted is not None:
        refitted = found.refitted
        yield (*refitted.row, None, refitted.sd_error, refitted.settling_error)
    yield from ((*row, best, None, None) for row, best in found.steps)


def _view(rows: Sequence[SystemRow], title: str = "") -> Table:
    return Table("", _COLUMNS, [(*row, None, None, None) for row in rows], title)


def _advice(found: LadderComparison) -> str:
    """Return the change that would help most, compared with the league's own rule on this chart."""
    systems, steps = found.systems, [row for row, _ in found.steps]
    own = next(row for row in systems if (row.system, row.chart) == ("npl", found.chart.name))
    new = next(row for row in systems if row.system == NEWCOMERS)
    others = [row for row in (*systems, *steps) if row is not new]
    accurate = min(others, key=lambda row: row.sd_doublings)
    fastest = min(others, key=lambda row: row.settling_mean)
    no_slower = [row for row in others if row.settling_mean <= own.settling_mean]
    best = min(no_slower, key=lambda row: row.sd_doublings)
    better = (
        "no other system is both as fast and more accurate"
        if best.sd_doublings >= own.sd_doublings
        else f"{_called(best)} is the most accurate of the systems that are no slower"
    )
    return (
        f"Ratings are most accurate with {_called(accurate)}. Wrong ratings are corrected "
        f"fastest with {_called(fastest)}, in {fastest.settling_mean:.1f} matches on average. "
        f"With {_called(own)} it takes {own.settling_mean:.1f} matches; {better}. Longer steps for "
        f"newcomers only ({new.system}) take {new.settling_mean:.1f} matches and leave the other "
        "ratings as accurate as they are."
    )


def _called(row: SystemRow) -> str:
    return f"{row.system} on {row.chart}"


def _notes(found: LadderComparison) -> Iterator[str]:
    if found.refitted is not None:
        refitted = found.refitted
        yield (
            f"{refitted.row.system}: all ratings are refitted to all results every week, as "
            f"in Fargo. Its figures come from {REFITTED_LEAGUES} simulated leagues of "
            f"{REFITTED_PLAYERS} players over a year, so they are uncertain: the error may be off "
            f"by about {refitted.sd_error:.2f} points, and the settling time by about "
            f"{refitted.settling_error:.1f} matches."
        )
    rising = [f"{row.system} by {row.inflation:+.2f}" for row in found.systems if row.inflation]
    if rising:
        yield f"Ratings inflate (in points a match): {', '.join(rising)}."


def _never_worth_it(steps: Sequence[str]) -> str:
    """Return the steps for which some other step is better.

    >>> _never_worth_it(["step 6"])
    'Step 6 is never worth it: another step is both more accurate and faster.'
    """
    if not steps:
        return "Each of these steps can be worth it: none is beaten in both accuracy and speed."
    verb = "is" if len(steps) == 1 else "are"
    return (
        f"{listed(steps).capitalize()} {verb} never worth it: another step is both more accurate "
        "and faster."
    )
