"""`evenbreak sandbag watch`: what the results of a league weigh for sandbagging."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import refuse, wants_aliases, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    heading_lines,
    paragraphs,
    print_json,
    say,
    to_terminal,
)
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.scale_doubts import scale_doubts
from evenbreak.cli.sandbag.options import (
    found_chart,
    found_system,
    wants_alpha,
    wants_chart,
    wants_day_sd,
    wants_honest,
    wants_system,
    watched_ladder,
)

if TYPE_CHECKING:
    from evenbreak.answers.watch_files import WatchRow
    from evenbreak.files.results import ResultsFile
    from evenbreak.league.nights import Night
    from evenbreak.league.watch import Watched

SHOWN = 10
"""How many players a terminal shows."""

MATCH_COLUMNS = (
    "date",
    "opponent",
    "rating",
    "opponent_rating",
    "games_won",
    "games_lost",
    "needs",
    "opponent_needs",
    "won",
    "e_value",
    "factor",
)

EXAMPLES = """\b
Examples:
  evenbreak sandbag watch season.csv --roster start.csv
  evenbreak sandbag watch season.csv --roster start.csv --dumps-in "League night"
  evenbreak sandbag watch season.csv --roster start.csv --player "Bo Diaz"
"""


@click.command("watch", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.option(
    "--roster",
    required=True,
    metavar="ROSTER.csv",
    help="The ratings before the first match of the results.",
)
@wants_chart
@wants_system
@wants_alpha
@wants_honest
@click.option(
    "--dumps-in",
    "events",
    multiple=True,
    metavar="EVENT",
    help="An event that counts for little: only its matches may be dumped. May be repeated.",
)
@wants_day_sd
@click.option("--player", metavar="NAME", help="Show what each match of one player weighs.")
@wants_aliases
@plot_option
@wants_json
def command(
    results: str,
    roster: str,
    *,
    chart_name: str | None,
    system_name: str,
    alpha: float,
    honest: str,
    events: tuple[str, ...],
    day_sd: float,
    player: str | None,
    aliases: str | None,
    plot: str | None,
    as_json: bool,
) -> None:
    """Weigh the results of a league for sandbagging.

    RESULTS.csv is the file that `report` reads; - is stdin. The ratings are moved from
    ROSTER.csv on, night by night. The evidence e of a player grows with results that a sandbagger
    has more often than an honest player; at 1 / alpha he is flagged. It is evidence, no verdict.
    """
    from evenbreak.answers.watch_files import events_marked, nights_of_files
    from evenbreak.files.results import read_results
    from evenbreak.files.roster import read_roster
    from evenbreak.league.watch import watch

    if [results, roster, chart_name, aliases].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")
    system = found_system(system_name)
    chart = None if chart_name is None else found_chart(chart_name)
    law = watched_ladder(system, chart, day_sd).law()
    first, season = read_roster(roster), read_results(results, aliases=aliases)
    for warning in (*first.warnings, *season.warnings):
        say(f"Warning: {warning}")
    for doubt in scale_doubts(system.scale, first.roster.rating, "--system says whose they are"):
        say(doubt)
    marked = events_marked(season.results, events) if events else None
    nights = nights_of_files(system, first, season, chart=chart)
    found = watch(nights, system, law, alpha=alpha, honest=honest, marked=marked, day_sd=day_sd)
    if player is not None:
        found = [one for one in found if one.player == player]
        if not found:
            refuse(f"--player is {player!r}, of whom there is no match; write a name of the file")
        _print_player(found[0], nights, season, as_json=as_json)
    else:
        _print(found, season, as_json=as_json)
    if plot is not None:
        from evenbreak.plots.sandbagging import watch_figure

        write_plot(watch_figure(found, alpha=alpha), plot)


def _print(found: list[Watched], season: ResultsFile, *, as_json: bool) -> None:
    from evenbreak.answers.watch_files import WatchRow, watch_rows

    rows = watch_rows(found, season.results)
    if as_json:
        alpha, honest = (found[0].alpha, found[0].honest) if found else (None, None)
        print_json(
            {
                "alpha": alpha,
                "honest": honest,
                "players": [row._asdict() for row in rows],
                "schema_version": SCHEMA_VERSION,
            }
        )
    elif not to_terminal():
        from evenbreak.files.csv_writer import to_csv

        _csv(WatchRow._fields, [list(row) for row in rows], to_csv)
    else:
        _show(_table(rows, found, season))


def _table(rows: list[WatchRow], found: list[Watched], season: ResultsFile) -> str:
    from evenbreak.files.problems import printable

    if not rows:
        return f"{season.source}: no match was played.\n"
    alpha, many = found[0].alpha, len(found)
    matches = sum(row.matches for row in rows) // 2
    flagged = sum(row.flagged for row in rows)
    shown = rows[: max(SHOWN, flagged)]
    cells = [
        [
            printable(row.player),
            str(row.matches),
            str(row.won),
            _e_text(row.e_value),
            _e_text(row.largest_e),
            "-" if row.alarm_match is None else f"{row.alarm_match}",
            row.alarm_date or "",
        ]
        for row in shown
    ]
    heads = ["player", "matches", "won", "e now", "largest e", "alarm at\nmatch", "on"]
    table = aligned([*heading_lines(heads), *cells])
    rest = f"  and {many - len(shown):,} more\n" if many > len(shown) else ""
    is_are = "is" if flagged == 1 else "are"
    told = [
        f"{flagged} of {many} {is_are} flagged.",
        f"{_SAID[found[0].honest]} is ever flagged with a chance of {alpha:g} at most; of {many} "
        f"such, {alpha * many:.2g} on average. That any is flagged at e = {_e_text(many / alpha)} "
        f"has a chance of {alpha:g} at most.",
        "Evidence is no verdict: look at the matches with --player, and ask.",
    ]
    return (
        paragraphs(
            printable(
                f"{season.source}: {matches:,} match{'es' * (matches != 1)}; the alarm is at "
                f"e = {_e_text(1.0 / alpha)}"
            )
        )
        + f"\n\n{table}{rest}\n"
        + paragraphs("\n".join(told))
        + "\n"
    )


_SAID = {
    "any": "An honest player, of whatever skill and a form as steady as --day-sd says,",
    "established": "An honest player, rated as rightly as ratings are and of a form as steady as "
    "--day-sd says,",
}


def _print_player(one: Watched, nights: list[Night], season: ResultsFile, *, as_json: bool) -> None:
    from evenbreak.answers.watch_files import match_rows
    from evenbreak.files.problems import printable

    dates = season.results.date
    rows = [
        [None if dates is None else str(dates[row[0]]), *row[1:]] for row in match_rows(one, nights)
    ]
    if as_json:
        print_json(
            {
                "player": one.player,
                "alpha": one.alpha,
                "honest": one.honest,
                "alarm_match": None if one.alarm is None else one.alarm + 1,
                "matches": [dict(zip(MATCH_COLUMNS, row, strict=True)) for row in rows],
                "schema_version": SCHEMA_VERSION,
            }
        )
        return
    if not to_terminal():
        from evenbreak.files.csv_writer import to_csv

        _csv(MATCH_COLUMNS, rows, to_csv)
        return
    cells = [
        [
            row[0] or "",
            printable(row[1]),
            f"{row[2]:g}-{row[3]:g}",
            "" if row[6] is None else f"{row[6]}:{row[7]}",
            ("won" if row[8] else "lost") if row[4] is None else f"{row[4]}-{row[5]}",
            f"{row[10]:.2f}",
            _e_text(row[9]),
        ]
        for row in rows
    ]
    alarm = "no alarm" if one.alarm is None else f"alarm after match {one.alarm + 1}"
    text = aligned(
        [["date", "opponent", "ratings", "race", "score", "factor", "e"], *cells], left=2
    )
    _show(f"{printable(one.player)}: {len(rows)} matches, {alarm}\n\n{text}")


def _csv(columns: tuple[str, ...], rows: list[list[Any]], to_csv: Any) -> None:
    import pandas as pd

    plain = [[{True: "yes", False: ""}[v] if isinstance(v, bool) else v for v in r] for r in rows]
    frame = pd.DataFrame(plain, columns=list(columns), dtype=object)
    click.echo(to_csv(frame), nl=False)


def _show(text: str) -> None:
    # Names may have letters that the terminal's encoding lacks.
    click.echo(text.encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)


def _e_text(e: float) -> str:
    """Return a value of e for a person to read.

    >>> _e_text(0.0123), _e_text(34.5), _e_text(1.23e9)
    ('0.012', '34.5', '1.2e+09')
    """
    if e >= 1e6 or 0.0 < e < 1e-3:
        return f"{e:.1e}"
    return f"{e:,.0f}" if e >= 100 else f"{e:.3g}" if e >= 1 else f"{e:.2g}"
