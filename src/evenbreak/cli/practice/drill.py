"""`evenbreak drill`: where a progressive drill settles, and what to practise."""

from __future__ import annotations

import click

from evenbreak import files, games, practice
from evenbreak.answers.kit.answer import Answer
from evenbreak.chains.ways import Way
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import drill_option, seed_option, via_option
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import CHANCE, Whole, numbers, refuse
from evenbreak.games.drill import EIGHT_BALL_LEVELS

MOST_LEVELS = 100
LEVELS = {"9-ball": 9, "8-ball": EIGHT_BALL_LEVELS}
SEED = 1

MOST_DRAWS = 20_000_000
"""The most attempts simulated for a test, so that a long log takes seconds."""

EXAMPLES = """\b
Examples:
  evenbreak drill --p 0.8
  evenbreak drill --p 0.8 --game 8-ball
  evenbreak drill --success 0.95,0.8,0.6,0.3 --json
  evenbreak drill --log drill_log.csv --plot drill.png
"""


_chances = numbers(
    ",",
    range(1, MOST_LEVELS + 1),
    0.0,
    1.0,
    f"give up to {MOST_LEVELS} numbers from 0 to 1 with commas between them, such as 0.9,0.8,0.5",
)


@click.command("drill", epilog=EXAMPLES)
@click.option(
    "--p",
    metavar="P",
    type=CHANCE,
    help="The chance of making a shot; level i takes i - 1 in a row, or i in 8-ball.",
)
@click.option(
    "--game",
    type=click.Choice(list(LEVELS)),
    help="The drill of --p: i balls at level i, or in 8-ball one group of i balls and the 8-ball.  "
    "[default: 9-ball]",
)
@click.option(
    "--success",
    metavar="P,P,...",
    type=_chances,
    help="Or the chance of success at each level.",
)
@click.option("--log", metavar="LOG.csv", help="Or a log of attempts; - reads standard input.")
@click.option(
    "--levels",
    type=Whole(1, MOST_LEVELS),
    metavar="N",
    help="How many levels there are.  [default: 9 with --p, 7 in 8-ball, the highest in the log "
    "with --log]",
)
@drill_option
@seed_option(f"The seed of the simulations that test a log.  [default: {SEED}]", default=None)
@via_option
@plot_option
@faces()
def command(
    p: float | None,
    game: str | None,
    success: tuple[float, ...] | None,
    log: str | None,
    levels: int | None,
    drill: str | None,
    seed: int | None,
    via: Way | None,
    plot: str | None,
) -> Answer:
    """Find where a progressive drill settles, and which level to practise.

    A success leads one level up, a miss one level down. Describe the drill by --p,
    --success or --log. LOG.csv has the columns level and success, and session or date
    if there are several sessions, and drill if there are several drills.
    """
    if sum(which is not None for which in (p, success, log)) != 1:
        refuse("give exactly one of --p, --success and --log")
    if p is None and game is not None:
        refuse("--game says what --p is about; leave it out")
    if game == "8-ball" and levels is not None and levels > EIGHT_BALL_LEVELS:
        refuse(f"--levels is {levels}; in 8-ball all 15 balls are on the table at level 7")
    if success is not None and levels is not None:
        refuse("--success already says how many levels there are; leave --levels out")
    if log is None and seed is not None:
        refuse("--seed is for the tests of --log; leave it out")
    if log is None and drill is not None:
        refuse("--drill names a drill of --log; leave it out")
    if log is not None and via is not None:
        refuse("--via is for a drill of known chances; leave it out with --log")
    if log is not None:
        return _log(log, levels, drill, SEED if seed is None else seed, plot)
    from evenbreak.answers.practice.drill import drill_answer

    if p is None:
        played = games.Drill(success or ())
        description = "A drill with the given chance of success at each level"
    elif game == "8-ball":
        played = games.Drill.eight_ball(p, LEVELS[game] if levels is None else levels)
        description = (
            "The progressive 8-ball drill: i balls of each group and the 8-ball at level i, which "
            f"takes i good shots, each with chance {p:g}"
        )
    else:
        played = games.Drill.progressive(p, LEVELS["9-ball"] if levels is None else levels)
        description = f"A drill in which level i takes i - 1 good shots, each with chance {p:g}"
    statistics = practice.drill_statistics(played, via=via)
    if plot is not None:
        from evenbreak.plots.practice import draw_drill

        write_plot(draw_drill(statistics), plot)
    return drill_answer(statistics, description, via=via)


def _log(path: str, levels: int | None, drill: str | None, seed: int, plot: str | None) -> Answer:
    import numpy as np

    from evenbreak.answers.practice.drill import drill_log_answer

    file = files.read_drill_log(path, levels=levels, drill=drill)
    replicas = min(1999, max(199, MOST_DRAWS // len(file.log)))
    analysis = practice.analyse_log(file.log, rng=np.random.default_rng(seed), replicas=replicas)
    if plot is not None:
        from evenbreak.plots.practice import draw_log

        write_plot(draw_log(analysis), plot)
    return drill_log_answer(file, analysis, seed=seed, levels_given=levels is not None)
