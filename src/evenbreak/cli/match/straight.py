"""`evenbreak straight`: a match of 14.1 straight pool, and its handicap."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import click

from evenbreak.cli.kit.callbacks import PlainCommand, chance, number, pair, refuse, wants_json
from evenbreak.cli.kit.output import chance_text, print_quantities, to_terminal
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import MOST_BALLS

if TYPE_CHECKING:
    from evenbreak.matches.straight_pool import StraightPool

WORDS = {
    "p_win_a": "A wins the match",
    "p_win_b": "B wins the match",
    "p_never_ends": "the match never ends",
    "mean_innings": "the winner's innings, mean",
    "sd_innings": "the winner's innings, standard deviation",
    "innings_p50": "the winner's innings, half of the matches within",
    "innings_p90": "the winner's innings, 9 of 10 matches within",
    "even_points_a": "nearest to even: A needs",
    "even_points_b": "nearest to even: B needs",
    "p_win_a_even": "nearest to even: A wins the match",
}
"""What each quantity is called on a terminal."""

MEND = "give two averages A B, or --p1 and --p2"

EXAMPLES = """\b
Examples:
  evenbreak straight 9 4 --points 100
  evenbreak straight 24 19 --points 150:130 --first b
  evenbreak straight --p1 0.9 --p2 0.85 --points 100 --safety 0.8
  evenbreak straight 24 19 --points 150 --plot spot.png
"""


class Shots(NamedTuple):
    """The two players: the chance of a shot, and of a first shot over it."""

    p_a: Fraction | float
    p_b: Fraction | float
    safety: float

    @property
    def a_is_stronger(self) -> bool:
        """Whether A makes as many balls an inning as B, or more."""
        return self.p_a >= self.p_b

    @classmethod
    def of(
        cls, averages: tuple[str, ...], p1: float | None, p2: float | None, safety: float
    ) -> Shots:
        """Return the players that the options describe, or refuse what contradicts itself."""
        from evenbreak.stats.runs import shot_chance

        if averages and (p1 is not None or p2 is not None):
            refuse(f"who plays is said twice; {MEND}")
        if not averages:
            if p1 is None or p2 is None:
                refuse(f"who plays is missing; {MEND}")
            return cls(p1, p2, safety)
        if len(averages) != 2:
            refuse(f"{len(averages)} average(s) given, {', '.join(averages)}; {MEND}")
        wanted = f" is no average; give balls an inning from 0 to {MOST_BALLS}"
        p_a, p_b = (shot_chance(number(word, 0, MOST_BALLS, wanted), safety) for word in averages)
        return cls(p_a, p_b, safety)


@click.command("straight", cls=PlainCommand, epilog=EXAMPLES)
@click.argument("averages", nargs=-1, metavar="[A B]")
@click.option("--p1", metavar="P", callback=chance, help="Chance that A makes a shot.")
@click.option("--p2", metavar="P", callback=chance, help="Chance that B makes a shot.")
@click.option(
    "--points",
    metavar="N|M:N",
    callback=pair,
    required=True,
    help="The points that each needs; A needs M, B needs N.",
)
@click.option(
    "--safety",
    metavar="ALPHA",
    callback=chance,
    default="1",
    show_default=True,
    help="The first shot of an inning is made with ALPHA times the chance of the others.",
)
@click.option(
    "--first",
    type=click.Choice(["a", "b"]),
    default="a",
    show_default=True,
    help="Who has the first inning.",
)
@plot_option
@wants_json
def command(
    averages: tuple[str, ...],
    p1: float | None,
    p2: float | None,
    points: tuple[int, int],
    safety: float,
    first: str,
    plot: str | None,
    as_json: bool,
) -> None:
    """Answer who wins a match of 14.1 straight pool, and what handicap makes it even.

    Who plays: what each runs on average, A B, in balls an inning; or --p1 and --p2.
    """
    from evenbreak.matches.straight_pool import straight_pool_odds

    players = Shots.of(averages, p1, p2, safety)
    odds = straight_pool_odds(_match(players, points, first))
    if plot is not None and odds.p_never_ends:
        refuse("nobody ever makes a ball, so there is nothing to draw; leave --plot out")
    even, p_win_a_even = _even(players, points, first)
    print_quantities(
        {
            "p_make_a": float(players.p_a),
            "p_make_b": float(players.p_b),
            "safety": safety,
            "points_a": points[0],
            "points_b": points[1],
            "p_win_a": odds.p_win_1,
            "p_win_b": odds.p_win_2,
            "p_never_ends": odds.p_never_ends,
            "mean_innings": odds.mean_innings,
            "sd_innings": odds.sd_innings,
            "innings_p50": odds.innings_p50,
            "innings_p90": odds.innings_p90,
            "even_points_a": even and even[0],
            "even_points_b": even and even[1],
            "p_win_a_even": p_win_a_even,
        },
        words={
            key: name for key, name in WORDS.items() if key != "p_never_ends" or odds.p_never_ends
        },
        heading=_heading(averages, players, points, first),
        text=_text,
        as_json=as_json,
    )
    if even is None and not odds.p_never_ends and to_terminal():
        click.echo("\nNo spot makes this match even.")
    if plot is not None:
        from evenbreak.plots.runs import plot_spot

        weaker = 2 if players.a_is_stronger else 1
        figure = plot_spot(
            _match(players, points, first),
            weaker=weaker,
            even=even and even[weaker - 1],
            title=_who(averages, players),
        )
        write_plot(figure, plot)


def _match(players: Shots, points: tuple[int, int], first: str) -> StraightPool:
    from evenbreak.matches.straight_pool import StraightPool

    p_a, p_b, safety = players
    return StraightPool(
        *points, p_a, p_b, safety_1=safety, safety_2=safety, first=1 if first == "a" else 2
    )


def _even(
    players: Shots, points: tuple[int, int], first: str
) -> tuple[tuple[int, int] | None, float | None]:
    """Return what A and B need for an even match, the stronger what he needs now, and A's chance.

    None where no spot makes it even.
    """
    from evenbreak.matches.straight_pool import even_points

    p_a, p_b, safety = players
    if players.a_is_stronger:
        strong, weak, needs, starts = p_a, p_b, points[0], first == "a"
    else:
        strong, weak, needs, starts = p_b, p_a, points[1], first == "b"
    spot = even_points(
        needs,
        strong,
        weak,
        safety_1=safety,
        safety_2=safety,
        first=1 if starts else 2,
        most=needs,
    )
    if not spot.is_even:
        return None, None
    if players.a_is_stronger:
        return (needs, spot.points_2), spot.p_win_1
    return (spot.points_2, needs), 1.0 - spot.p_win_1


def _who(averages: tuple[str, ...], players: Shots) -> str:
    if averages:
        return f"A runs {float(averages[0]):g} balls an inning, B {float(averages[1]):g}"
    return f"A makes a shot with {players.p_a:g}, B with {players.p_b:g}"


def _heading(averages: tuple[str, ...], players: Shots, points: tuple[int, int], first: str) -> str:
    told = f"{_who(averages, players)}; {first.upper()} shoots first\n"
    if players.safety != 1:
        told += f"the first shot of an inning: {players.safety:g} of the chance of the others\n"
    return f"{told}A needs {points[0]} points, B {points[1]}"


def _text(key: str, value: float) -> str:
    if key.startswith("p_"):
        return chance_text(value)
    return f"{value:.2f}" if isinstance(value, float) else str(value)
