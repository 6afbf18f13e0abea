"""The groups of commands that are lists alone: charts, chips, physics, sandbagging, the office."""

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup

CHART = {
    "list": Entry("List the charts."),
    "show": Entry("Show a chart: who needs how many games."),
    "audit": Entry("Check how fair a chart is, and which ratings it fits."),
    "design": Entry("Design the fairest chart for given ratings."),
    "team": Entry("Find the points that the weaker of two teams gets."),
}


@click.command("chart", cls=LazyGroup, table=CHART)
def chart() -> None:
    """List, show, audit and design handicap charts.

    A chart gives the race that two players play, based on the difference between their ratings or
    on their skill levels.
    """


CHIPS = {
    "odds": Entry("Find each player's odds in a chip tournament."),
    "audit": Entry("Check who a chip chart favors."),
    "design": Entry("Design a fairer chip chart."),
}


@click.command("chips", cls=LazyGroup, table=CHIPS)
def chips() -> None:
    """Find the odds of chip tournaments; audit and design chip charts.

    In a chip tournament, the loser of a rack gives up a chip and goes to the end of the line, the
    winner stays at the table, and anyone with no chips left is out. A chart gives weaker players
    more chips at the start.
    """


PHYSICS = {
    "speed": Entry("Find how fast a table is from the time of a lag."),
    "throw": Entry("Find how far friction throws the object ball off its line."),
    "aim": Entry("Find where to aim to allow for throw."),
    "deflect": Entry("Find where the cue ball goes after the hit."),
    "strike": Entry("Find the spin and speed from an off-center hit."),
    "breakcue": Entry("Find the cue weight that breaks best."),
    "shot": Entry("Trace a whole shot, and draw it."),
}


@click.command("physics", cls=LazyGroup, table=PHYSICS)
def physics() -> None:
    """Calculate what the ball, cloth and cue do: throw, aim, spin, and the cue ball's path.

    Lengths are in inches, weights in ounces, speeds in inches per second, angles in degrees; with
    --metric in centimeters, grams and meters per second. Spin J is the speed of the ball's rim
    divided by the speed of the ball: a topspin of 1 is natural roll.
    """


SANDBAG = {
    "pay": Entry("Show how much losing matches on purpose pays."),
    "watch": Entry("Check a league's results for sandbagging.", "sandbag:watch"),
}


@click.command("sandbag", cls=LazyGroup, table=SANDBAG)
def sandbag() -> None:
    """Show how much losing on purpose pays, and whether it can be detected.

    A sandbagger loses matches that count for little, so that their rating falls and they get a
    better handicap in the matches that count.
    """


LEAGUE = {
    "init": Entry("Write league.toml based on the files in a league's folder.", "league.init"),
    "tidy": Entry("Combine all result files into one clean list of matches.", "league.tidy:tidy"),
    "table": Entry("Show the table: who is ahead, and why.", "league.tables:table"),
    "fixtures": Entry(
        "List who plays who, when and where, and what is left.", "league.tables:fixtures"
    ),
}


@click.command("league", cls=LazyGroup, table=LEAGUE)
def league() -> None:
    """Run a league: settings, results, standings and fixtures."""
