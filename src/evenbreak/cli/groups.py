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

    A chart gives the race that two players play, by the difference of their ratings or
    by their skill levels.
    """


CHIPS = {
    "odds": Entry("Find each player's odds in a chip tournament."),
    "audit": Entry("Check who a chip chart favors."),
    "design": Entry("Design a fairer chip chart."),
}


@click.command("chips", cls=LazyGroup, table=CHIPS)
def chips() -> None:
    """Find the odds of chip tournaments; audit and design chip charts.

    In a chip tournament the loser of a rack pays a chip and goes to the end of the line, the
    winner stays at the table, and whoever has no chips left is out. Weaker players start with
    more chips, by a chart.
    """


PHYSICS = {
    "speed": Entry("Find how fast a table is, from the time of a lag."),
    "throw": Entry("Find how far friction throws the object ball off its line."),
    "aim": Entry("Find where to aim to allow for throw."),
    "deflect": Entry("Find where the cue ball goes after the hit."),
    "strike": Entry("Find the spin and speed that a hit off center gives."),
    "breakcue": Entry("Find the weight of the cue that breaks best."),
    "shot": Entry("Trace a whole shot, and draw it."),
}


@click.command("physics", cls=LazyGroup, table=PHYSICS)
def physics() -> None:
    """Calculate what ball, cloth and cue do: throw, aim, spin, the cue ball's path.

    Lengths are in inches, weights in ounces, speeds in inches per second, angles in degrees;
    with --metric in centimeters, grams and meters per second. Spin J is the speed of the
    ball's rim over the speed of the ball: a topspin of 1 is natural roll.
    """


SANDBAG = {
    "pay": Entry("Show what it pays to lose matches on purpose."),
    "watch": Entry("Check the results of a league for sandbagging.", "sandbag:watch"),
}


@click.command("sandbag", cls=LazyGroup, table=SANDBAG)
def sandbag() -> None:
    """Show what losing on purpose pays, and whether it can be seen.

    A sandbagger loses matches that count for little, so that their rating falls and they
    are given games in the matches that count.
    """


LEAGUE = {
    "init": Entry("Write league.toml from what is in a league's folder.", "league.init"),
    "tidy": Entry(
        "Combine all files of results into one clean list of matches.", "league.tidy:tidy"
    ),
    "table": Entry("The table: who is ahead, and why.", "league.tables:table"),
    "fixtures": Entry("Who plays who, when and where; what is left.", "league.tables:fixtures"),
}


@click.command("league", cls=LazyGroup, table=LEAGUE)
def league() -> None:
    """Run the office of a league."""
