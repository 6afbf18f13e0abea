"""Make the pictures of README and docs, the same to the byte every time.

python docs/images/make_images.py
"""

from pathlib import Path

import networkx as nx

from evenbreak.games import Ahead, OneBall, Race, Rack
from evenbreak.reports.draw import draw, image_bytes

HERE = Path(__file__).parent


def drill(levels: int) -> nx.DiGraph:
    """Return the diagram of a drill with symbols for its chances."""
    graph = nx.DiGraph()
    for i in range(1, levels + 1):
        graph.add_edge(i, min(i + 1, levels), label=f"$p_{i}$")
        graph.add_edge(i, max(i - 1, 1), label=f"$q_{i}$")
    return graph


def main() -> None:
    """Write every picture beside this file."""
    ahead = draw(Ahead(3, 2, Rack(2 / 3)), title="Player 1 must lead by 3, player 2 by 2")
    pictures = {
        "one_ball": draw(OneBall(0.4, 0.8)),
        "ahead": ahead,
        "drill": draw(drill(4)),
        "race": draw(Race(3, 2, Rack(0.6)), title="Race 3:2"),
    }
    for name, figure in pictures.items():
        (HERE / f"{name}.svg").write_bytes(image_bytes(figure, "svg"))


if __name__ == "__main__":
    main()
