"""Make the pictures of README and docs, the same to the byte every time.

python docs/images/make_images.py
"""

from pathlib import Path

import networkx as nx
import numpy as np
from matplotlib.figure import Figure

from evenbreak.answers import OfferedRaces, Sheet, most_active
from evenbreak.files.results import read_results
from evenbreak.games import Ahead, OneBall, Race, Rack
from evenbreak.handicaps import EQUAL_SKILL, Ladder, chart, settling
from evenbreak.physics import PoolTable, aimed_shot, pockets, strike_for_speed
from evenbreak.physics.units import INCH
from evenbreak.plots.diagram import draw
from evenbreak.plots.ladders import ladder_figure
from evenbreak.plots.picture import image_bytes, in_our_look
from evenbreak.plots.style import LINES, new_axes
from evenbreak.plots.traced_shot import shot_on_table
from evenbreak.ratings import fit
from evenbreak.sheets import sheet_pages
from evenbreak.tournaments import double_elimination, single_elimination, title_odds

HERE = Path(__file__).resolve().parent
RESULTS = HERE.parents[1] / "data" / "demo_league.csv"


def drill(levels: int) -> nx.DiGraph:
    """Return the diagram of a drill with symbols for its chances."""
    graph = nx.DiGraph()
    for i in range(1, levels + 1):
        graph.add_edge(i, min(i + 1, levels), label=f"$p_{i}$")
        graph.add_edge(i, max(i - 1, 1), label=f"$q_{i}$")
    return graph


def sheet() -> Figure:
    """Draw the page that `evenbreak report` writes for the demo league."""
    file = read_results(RESULTS)
    ratings = fit(file.results)
    sheet = Sheet.of(file, ratings, OfferedRaces(race_to=7), most_active(ratings, 10))
    (page,) = sheet_pages(sheet)
    return page


def cut_shot() -> Figure:
    """Draw a draw shot into the far corner, allowing for throw."""
    corner = pockets(PoolTable())[2]
    hit = strike_for_speed(80.0 * INCH, -0.4)
    places = ((30.0, 15.0), (50.0, 15.0), (corner.x / INCH, corner.y / INCH))
    return shot_on_table(aimed_shot(hit, *((x * INCH, y * INCH) for x, y in places)))


def ladder() -> Figure:
    """Draw what `evenbreak ladder` draws of chart 10: the law, and how newcomers settle."""
    model = Ladder("npl", chart("npl_10"), opponents=EQUAL_SKILL)
    natural = Ladder("npl", chart("npl_10")).law()
    curve = settling(model, -30, newcomer=True)
    return ladder_figure(
        model.law(), natural=natural, curve=curve, title="chart npl_10, system npl"
    )


@in_our_look
def second_chance() -> Figure:
    """Draw a favourite's chance of the title in single and in double elimination."""
    chances = np.linspace(0.5, 1.0, 26)
    figure, axes = new_axes(
        "chance to win a match", "chance to win the tournament", size=(6.4, 4.0)
    )
    for players, line in ((8, LINES[0]), (16, LINES[1])):
        win = np.full((players, players), 0.5)
        for make, dashes in ((double_elimination, "-"), (single_elimination, "--")):
            title = []
            for p in chances:
                win[0, 1:], win[1:, 0] = p, 1.0 - p
                title.append(title_odds(make(players), win).title[0])
            name = f"{make.__name__.replace('_', ' ')} of {players}"
            axes.plot(chances, title, dashes, color=line.color, label=name)
    axes.legend(fontsize=9)
    return figure


def main() -> None:
    """Write every picture beside this file."""
    diagrams = {
        "one_ball": draw(OneBall(0.4, 0.8)),
        "ahead": draw(Ahead(3, 2, Rack(2 / 3)), title="Player 1 must lead by 3, player 2 by 2"),
        "drill": draw(drill(4)),
        "race": draw(Race(3, 2, Rack(0.6)), title="Race 3:2"),
        "shot": cut_shot(),
        "ladder": ladder(),
        "second_chance": second_chance(),
    }
    for name, figure in diagrams.items():
        (HERE / f"{name}.svg").write_bytes(image_bytes(figure, "svg"))
    (HERE / "sheet.png").write_bytes(image_bytes(sheet(), "png"))


if __name__ == "__main__":
    main()
