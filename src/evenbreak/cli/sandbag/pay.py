"""`evenbreak sandbag pay`: what losing on purpose pays."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from evenbreak.cli.kit.callbacks import Whole, refuse, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    paragraphs,
    print_json,
    print_table,
    say,
    to_terminal,
)
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.sandbag.options import (
    DOUBLINGS,
    between,
    found_chart,
    found_system,
    wants_chart,
    wants_system,
    wide_ladder,
)

if TYPE_CHECKING:
    from evenbreak.handicaps.ladders.ladder import Ladder
    from evenbreak.league.dump_cycle import DumpCycle
    from evenbreak.league.sandbag import DumpRow, Sandbagging

COLUMNS = {
    "dumped": "matches\ndumped",
    "given_away": "given\naway",
    "p_first": "wins\nthe next",
    "p_in_a_row": "wins {}\nin a row",
    "extra_wins": "extra\nwins in {}",
    "for_the_last": "by the\nlast",
    "break_even": "pays\nfrom",
    "profit": "profit",
}
"""The columns with their headings on a terminal; the CSV has `rating` too."""

EXAMPLES = """\b
Examples:
  evenbreak sandbag pay
  evenbreak sandbag pay --chart npl_12 --stake 100 --dumped-stake 5 --plot pay.png
  evenbreak sandbag pay --in-a-row 4 --prize 500 --stake 0
  evenbreak sandbag pay --compare
"""


class _Question(NamedTuple):
    """How many matches are dumped and played, from where, and for what."""

    dumped: int
    earnest: int
    start: int
    stake: float
    dumped_stake: float
    in_a_row: int
    prize: float


class _Answer(NamedTuple):
    """What was found for one chart: by matches dumped, for ever, and for who enters low.

    `pays` is what is shown; `all_pays` goes as far as the ladder does.
    """

    ladder: Ladder
    pays: Sandbagging
    all_pays: Sandbagging
    cycle: DumpCycle | None
    enters: dict[str, float]


@click.command("pay", epilog=EXAMPLES)
@wants_chart
@wants_system
@click.option(
    "--dumped",
    type=Whole(1, 100),
    default=12,
    show_default=True,
    metavar="D",
    help="The most matches that are lost on purpose.",
)
@click.option(
    "--earnest",
    type=Whole(1, 500),
    default=20,
    show_default=True,
    metavar="E",
    help="The matches that are then played in earnest.",
)
@click.option(
    "--stake",
    default="10",
    show_default=True,
    metavar="X",
    callback=between(0.0, 1e9),
    help="What a match won in earnest is worth more than one lost.",
)
@click.option(
    "--dumped-stake",
    default="1",
    show_default=True,
    metavar="X",
    callback=between(0.0, 1e9),
    help="The same of the matches that are dumped.",
)
@click.option(
    "--in-a-row",
    type=Whole(1, 50),
    default=3,
    show_default=True,
    metavar="K",
    help="A tournament is won by so many matches in a row.",
)
@click.option(
    "--prize",
    default="0",
    show_default=True,
    metavar="X",
    callback=between(0.0, 1e9),
    help="What the tournament pays.",
)
@click.option(
    "--from",
    "start",
    type=Whole(-100, 100),
    default=0,
    show_default=True,
    metavar="ERROR",
    help="The rating less the skill before, in points.",
)
@click.option("--compare", is_flag=True, help="Compare the charts of the system.")
@plot_option
@wants_json
def command(
    chart_name: str | None,
    system_name: str,
    *,
    compare: bool,
    plot: str | None,
    as_json: bool,
    **asked: Any,
) -> None:
    """Tell what it pays to lose matches on purpose.

    Opponents are as good as the player and rated rightly. He loses D matches on purpose, then
    plays E in earnest while his rating climbs back. All of it is exact.
    """
    question = _Question(**asked)
    system = found_system(system_name)
    if compare:
        if chart_name is not None or plot is not None:
            refuse("--compare takes all charts of the system; leave --chart and --plot out")
        found = [
            _answer(wide_ladder(system, one), question, for_ever=False)
            for one in system.known_charts()
        ]
        _print_comparison(found, question, as_json=as_json)
        return
    chart = None if chart_name is None else found_chart(chart_name)
    one = _answer(wide_ladder(system, chart), question)
    if as_json:
        print_json({**_as_json(one), "schema_version": SCHEMA_VERSION})
    else:
        _print(one, question)
    if plot is not None:
        from evenbreak.plots.sandbagging import pay_figure

        write_plot(pay_figure(one.pays), plot)


def _answer(ladder: Ladder, question: _Question, *, for_ever: bool = True) -> _Answer:
    from evenbreak.league.dump_cycle import best_cycle
    from evenbreak.league.sandbag import entering_low, most_dumped, sandbagging

    stakes = {"stake": question.stake, "dumped_stake": question.dumped_stake}
    asked = question._asdict()
    # The best may lie beyond the table; as far as the ladder goes.
    most = most_dumped(ladder, question.start)
    if not most:
        refuse(
            f"--system {ladder.system.name}: a match lost takes the rating to where the odds of "
            f"a game are {2**DOUBLINGS} to 1 or more; give smaller steps, or --from a higher rating"
        )
    if question.dumped > most:
        say(
            f"{ladder.chart.name}: so far off that the odds of a game are {2**DOUBLINGS} to 1, "
            f"nobody falls further; dumped is {most} at most"
        )
    pays = sandbagging(ladder, **{**asked, "dumped": min(question.dumped, most)})
    all_pays = sandbagging(ladder, **{**asked, "dumped": most})
    doubling = round(ladder.system.scale.points_per_doubling)
    low = {"established": entering_low(ladder, doubling, question.earnest)[-1]}
    if ladder.system.newcomer_steps:
        low["newcomer"] = entering_low(ladder, doubling, question.earnest, newcomer=True)[-1]
    # It takes a while, and a comparison does not tell it.
    cycle = best_cycle(ladder, [10], lowest=-float(doubling), **stakes) if for_ever else None
    return _Answer(ladder, pays, all_pays, cycle, {name: float(wins) for name, wins in low.items()})


def _print(found: _Answer, question: _Question) -> None:
    rows = found.pays.rows
    if not to_terminal():
        print_table(
            rows[0]._fields,
            [_plain(row) for row in rows],
            headings=(),
            heading="",
            text=lambda _, value: str(value),
        )
        return
    asked = {"p_in_a_row": question.in_a_row, "extra_wins": question.earnest}
    print_table(
        list(COLUMNS),
        [[_blank(row, name) for name in COLUMNS] for row in rows],
        headings=[text.format(asked.get(name, "")) for name, text in COLUMNS.items()],
        heading=paragraphs(_heading(found, question)),
        text=_text,
    )
    click.echo("\n" + paragraphs("\n".join(_sentences(found, question))))


def _heading(found: _Answer, question: _Question) -> str:
    chart, system = found.ladder.chart.name, found.ladder.system
    start = f", from a rating {question.start:+d} off" if question.start else ""
    prize = f"; the tournament pays {question.prize:g}" if question.prize else ""
    return (
        f"{chart}, {system.in_words}; opponents as good as the player and rated rightly{start}\n"
        f"A match won is worth {question.stake:g} more than one lost in earnest, "
        f"{question.dumped_stake:g} where it is dumped{prize}"
    )


def _sentences(found: _Answer, question: _Question) -> list[str]:
    best, cycle = found.all_pays.best, found.cycle
    doubling = round(found.ladder.system.scale.points_per_doubling)
    told = [
        f"Most profit: {best.dumped} dumped, for {best.profit:.2f}."
        if best.dumped
        else "At these stakes none pays.",
    ]
    least = found.all_pays.cheapest
    if math.isfinite(least.break_even):
        told.append(
            f"The {question.earnest} matches bring a profit only if one is worth at least "
            f"{least.break_even:.2f} times as much in earnest as where it is dumped; that is with "
            f"{least.dumped} dumped."
        )
    if cycle is not None and cycle.dumped and cycle.profit > 0.0:
        told.append(
            f"For ever, dumping {cycle.dumped} of each {cycle.dumped + cycle.earnest}: rated "
            f"{-cycle.rating_error:.1f} points too low as he begins in earnest, he wins "
            f"{cycle.p_win:.4f} of those matches, a profit of {cycle.profit:.2f} a match. Of "
            f"cycles of {cycle.dumped + cycle.earnest} it is the best for who dares to be "
            f"{doubling} points off."
        )
    steps = (
        f", {found.enters['newcomer']:.2f} with newcomer steps"
        if "newcomer" in found.enters
        else ""
    )
    told.append(
        f"Who enters {doubling} points too low wins {found.enters['established']:.2f} more of his "
        f"first {question.earnest} matches{steps}."
    )
    return told


def _print_comparison(found: list[_Answer], question: _Question, *, as_json: bool) -> None:
    rows = [
        {
            "chart": one.ladder.chart.name,
            "dumped": one.all_pays.best.dumped,
            "p_first": one.all_pays.best.p_first,
            "p_in_a_row": one.all_pays.best.p_in_a_row,
            "extra_wins": one.all_pays.best.extra_wins,
            "break_even": _finite(one.all_pays.cheapest.break_even),
            "profit": one.all_pays.best.profit,
            "enters_low": one.enters["established"],
        }
        for one in found
    ]
    if as_json:
        print_json({"charts": rows, "schema_version": SCHEMA_VERSION})
        return
    print_table(
        list(rows[0]),
        [list(row.values()) for row in rows],
        headings=[
            "chart",
            "best\ndumped",
            "wins\nthe next",
            f"wins {question.in_a_row}\nin a row",
            f"extra\nwins in {question.earnest}",
            "pays\nfrom",
            "profit",
            "enters\nlow",
        ],
        heading=paragraphs(
            f"What sandbagging pays by chart, with the number dumped that pays most; a match "
            f"won is worth {question.stake:g} more than one lost in earnest, "
            f"{question.dumped_stake:g} where it is dumped"
        ),
        text=_text,
        left=1,
    )
    if to_terminal():
        least = min(found, key=lambda one: one.all_pays.best.profit)
        click.echo(f"\nLeast worth gaming at these stakes: {least.ladder.chart.name}.")


def _plain(row: DumpRow) -> list[Any]:
    return [_finite(value) for value in row]


def _finite(value: float) -> float | None:
    return None if math.isinf(value) else value


def _blank(row: DumpRow, name: str) -> Any:
    """Return a value, None where nothing is dumped and so nothing can be said of it."""
    return None if not row.dumped and name in _OF_DUMPS else _finite(getattr(row, name))


_OF_DUMPS = ("given_away", "extra_wins", "for_the_last", "profit")


def _text(name: str, value: Any) -> str:
    if isinstance(value, int | str):
        return str(value)
    return f"{value:.4f}" if name.startswith("p_") else f"{value:.2f}"


def _as_json(found: _Answer) -> dict[str, Any]:
    best = found.all_pays.best
    return {
        "chart": found.ladder.chart.name,
        "system": found.ladder.system.name,
        "rows": [dict(zip(row._fields, _plain(row), strict=True)) for row in found.pays.rows],
        "best": dict(zip(best._fields, _plain(best), strict=True)),
        "p_win": found.pays.p_win.tolist(),
        "p_honest": found.pays.p_honest.tolist(),
        "cycle": None if found.cycle is None else found.cycle._asdict(),
        "enters_low": found.enters,
    }
