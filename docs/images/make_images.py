"""Make the pictures of README and docs, the same to the byte every time.

python docs/images/make_images.py
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import networkx as nx
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from evenbreak.games import Ahead, OneBall, Race, Rack
from evenbreak.reports.draw import draw, image_bytes

HERE = Path(__file__).resolve().parent
RESULTS = HERE.parents[1] / "data" / "demo_league.csv"
PAIRED = 8
"""Players in the table of races: more would be too small to read."""


def drill(levels: int) -> nx.DiGraph:
    """Return the diagram of a drill with symbols for its chances."""
    graph = nx.DiGraph()
    for i in range(1, levels + 1):
        graph.add_edge(i, min(i + 1, levels), label=f"$p_{i}$")
        graph.add_edge(i, max(i - 1, 1), label=f"$q_{i}$")
    return graph


def report_rows() -> tuple[list[dict[str, str]], list[dict[str, str]]]:
    """Run `evenbreak report` on the demo league; return the rows of ratings and matchups."""
    with tempfile.TemporaryDirectory() as folder:
        program = [sys.executable, "-m", "evenbreak", "report", str(RESULTS), "--out", folder]
        subprocess.run([*program, "--top", str(PAIRED)], check=True, capture_output=True)  # noqa: S603
        ratings, matchups = (
            list(csv.DictReader((Path(folder) / name).read_text(encoding="utf-8").splitlines()))
            for name in ("ratings.csv", "matchups.csv")
        )
    return ratings, matchups


def draw_ratings(axes: Axes, ratings: list[dict[str, str]]) -> None:
    """Draw each rating as a dot with a line of two standard errors either way."""
    for place, row in enumerate(ratings):
        # Rounded, so that the last bits of a sum cannot move a pixel.
        rating, error = (round(float(row[name]), 1) for name in ("rating", "standard_error"))
        axes.plot([rating - 2 * error, rating + 2 * error], [place, place], color="0.7", lw=3)
        axes.plot([rating], [place], "o", color="black", ms=5)
    axes.set_yticks(range(len(ratings)), [row["player"] for row in ratings])
    axes.set_ylim(len(ratings) - 0.4, -0.6)
    axes.set_xlabel("rating, with two standard errors either way")
    axes.grid(axis="x", color="0.9")
    axes.set_axisbelow(True)
    axes.spines[["top", "right", "left"]].set_visible(False)
    axes.tick_params(length=0)


def draw_races(axes: Axes, matchups: list[dict[str, str]], players: list[str]) -> None:
    """Write the fairest race of each pair in a table: the row's player needs the first number."""
    races = {}
    for row in matchups:
        races[row["player_a"], row["player_b"]] = row["race_a"], row["race_b"]
        races[row["player_b"], row["player_a"]] = row["race_b"], row["race_a"]
    for y, row_player in enumerate(players):
        for x, column_player in enumerate(players):
            race = races.get((row_player, column_player))
            axes.add_patch(
                Rectangle((x - 0.5, y - 0.5), 1, 1, fc="white" if race else "0.93", ec="0.8")
            )
            axes.text(x, y, " : ".join(race) if race else "", ha="center", va="center")
    axes.set(xlim=(-0.5, len(players) - 0.5), ylim=(len(players) - 0.5, -0.5), aspect="equal")
    axes.set_xticks(range(len(players)), players, rotation=40, ha="left", rotation_mode="anchor")
    axes.set_yticks(range(len(players)), players)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)


def sheet() -> Figure:
    """Draw what `evenbreak report` found in the demo league."""
    ratings, matchups = report_rows()
    paired = {name for row in matchups for name in (row["player_a"], row["player_b"])}
    figure = Figure(figsize=(13, 6.2), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=[1, 1.15])
    draw_ratings(left, ratings)
    draw_races(right, matchups, [row["player"] for row in ratings if row["player"] in paired])
    right.set_xlabel("the fairest race: games that the player on the left needs : the one above")
    return figure


def main() -> None:
    """Write every picture beside this file."""
    diagrams = {
        "one_ball": draw(OneBall(0.4, 0.8)),
        "ahead": draw(Ahead(3, 2, Rack(2 / 3)), title="Player 1 must lead by 3, player 2 by 2"),
        "drill": draw(drill(4)),
        "race": draw(Race(3, 2, Rack(0.6)), title="Race 3:2"),
    }
    for name, figure in diagrams.items():
        (HERE / f"{name}.svg").write_bytes(image_bytes(figure, "svg"))
    (HERE / "sheet.png").write_bytes(image_bytes(sheet(), "png"))


if __name__ == "__main__":
    main()
