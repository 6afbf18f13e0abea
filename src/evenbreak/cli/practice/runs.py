"""`evenbreak runs`: what a player runs in an inning, or scores in several."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.callbacks import LONGEST, Whole, chance, number, refuse, wants_json
from evenbreak.cli.kit.output import chance_text, print_quantities
from evenbreak.cli.kit.plot import plot_option, write_plot

if TYPE_CHECKING:
    from evenbreak.stats.innings import InningsScore
    from evenbreak.stats.runs import RunLength

MOST_BALLS = 100_000
"""The most balls that an option can name here."""

WORDS = {
    "p_make": "chance to make a shot",
    "mean": "mean, fair line if every ball is paid",
    "median": "median, at least half are this or less",
    "mode": "mode, the likeliest number",
    "sd": "standard deviation",
    "relative_sd": "standard deviation / mean",
    "median_estimate": "median, by the rule of thumb",
}
"""What each quantity that is always answered is called on a terminal."""

EXAMPLES = """\b
Examples:
  evenbreak runs --mean 24 --at-least 100
  evenbreak runs --mean 24 --over 20
  evenbreak runs --p 0.96 --innings 5 --between 100..150
  evenbreak runs --p 0.96 --safety 0.8 --plot runs.png
"""


def _average(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return a mean number of balls."""
    if value is None:
        return None
    wanted = f"; give a number of balls an inning from 0 to {MOST_BALLS}"
    return number(value, 0, MOST_BALLS, wanted, ctx=ctx, param=param)


def _line(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return the line of a wager, such as 20 or 20.5."""
    if value is None:
        return None
    wanted = f"; give a number of balls from 0 to {MOST_BALLS}, such as 20 or 20.5"
    return number(value, 0, MOST_BALLS, wanted, ctx=ctx, param=param)


def _balls(ctx: click.Context, param: click.Parameter, value: str | None) -> tuple[int, int] | None:
    """Return the two ends of a span of scores, such as 50..75."""
    if value is None:
        return None
    match = re.fullmatch(r"\s*(\d{1,9})\.\.(\d{1,9})\s*", value, re.ASCII)
    if match and int(match[1]) <= int(match[2]) <= MOST_BALLS:
        return int(match[1]), int(match[2])
    raise click.BadParameter(
        f"{value!r}; give the fewest and the most balls, from 0 to {MOST_BALLS}, "
        "with two dots between them, such as 50..75",
        ctx=ctx,
        param=param,
    )


@click.command("runs", epilog=EXAMPLES)
@click.option(
    "--mean", metavar="BALLS", callback=_average, help="What the player runs on average an inning."
)
@click.option("--p", metavar="P", callback=chance, help="Chance that the player makes a shot.")
@click.option(
    "--safety",
    metavar="ALPHA",
    callback=chance,
    default="1",
    show_default=True,
    help="The first shot of an inning is made with ALPHA times the chance of the others.",
)
@click.option(
    "--innings",
    type=Whole(1, LONGEST),
    metavar="M",
    default=1,
    show_default=True,
    help="How many innings are played.",
)
@click.option("--at-least", type=Whole(0, MOST_BALLS), metavar="N", help="The chance of N or more.")
@click.option("--between", metavar="LO..HI", callback=_balls, help="The chance of LO to HI.")
@click.option("--over", metavar="N", callback=_line, help="The wager on more than N; 20.5 is fine.")
@plot_option
@wants_json
def command(
    mean: float | None,
    p: float | None,
    safety: float,
    innings: int,
    at_least: int | None,
    between: tuple[int, int] | None,
    over: float | None,
    plot: str | None,
    as_json: bool,
) -> None:
    """Answer how long the runs of a player are, and what the innings of a match bring.

    Who plays: --mean, or --p.
    """
    if (mean is None) == (p is None):
        refuse("give one of --mean and --p, and not both")
    law = _law(mean, p, safety, innings)
    most = None if over is None else math.floor(over)  # what loses the wager on more
    answer = {
        "p_make": float(law.p),
        "safety": safety,
        "innings": innings,
        "mean": law.mean,
        "median": law.median,
        "mode": law.mode,
        "sd": law.sd,
        "relative_sd": law.relative_sd,
        # With safety play the blank innings stand apart, and the rule for several is no use.
        "median_estimate": law.median_estimate if innings == 1 or safety == 1 else None,
        "p_at_least": None if at_least is None else float(law.at_least(at_least)),
        "p_between": None if between is None else float(law.between(*between)),
        "p_over": None if most is None else float(law.at_least(most + 1)),
        "p_not_over": None if most is None else float(law.cumulative(most)),
    }
    asked = _asked(at_least, between, over)
    print_quantities(
        answer,
        words={
            **WORDS,
            **{key: name for key, (name, _, _) in asked.items()},
            "p_not_over": "" if over is None else f"not over {over:.12g}: {most} or less",
        },
        heading=_heading(law, safety, innings),
        text=_text,
        as_json=as_json,
    )
    if plot is not None:
        from evenbreak.plots.runs import plot_score

        write_plot(plot_score(law, innings, asked=list(asked.values())), plot)


def _asked(
    at_least: int | None, between: tuple[int, int] | None, over: float | None
) -> dict[str, tuple[str, int, int | None]]:
    """Return the spans of scores that were asked for: a name, the fewest and the most."""
    asked: dict[str, tuple[str, int, int | None]] = {}
    if at_least is not None:
        asked["p_at_least"] = (f"{at_least} or more", at_least, None)
    if between is not None:
        asked["p_between"] = (f"{between[0]} to {between[1]}", *between)
    if over is not None:
        fewest = math.floor(over) + 1
        asked["p_over"] = (f"over {over:.12g}: {fewest} or more", fewest, None)
    return asked


def _law(
    mean: float | None, p: float | None, safety: float, innings: int
) -> RunLength | InningsScore:
    from evenbreak.stats.innings import InningsScore
    from evenbreak.stats.runs import RunLength, shot_chance

    chance = shot_chance(mean, safety) if p is None else p
    return RunLength(chance, safety) if innings == 1 else InningsScore(chance, innings, safety)


def _heading(law: RunLength | InningsScore, safety: float, innings: int) -> str:
    first = "" if safety == 1 else f", but the first of an inning with {float(law.p) * safety:.4g}"
    played = "the run of an inning" if innings == 1 else f"the score of {innings} innings"
    return f"each shot is made with {float(law.p):.4g}{first}\n{played}"


def _text(key: str, value: float) -> str:
    if key.startswith("p_"):
        return chance_text(value)
    if key == "relative_sd":
        return f"{value:.3f}"
    return f"{value:.2f}" if isinstance(value, float) else str(value)
