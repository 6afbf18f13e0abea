"""`evenbreak graph` and `evenbreak chain`: from a graph to its limit.

The graph is that of a game, or of any chain from a file.
"""

from __future__ import annotations

import re
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from evenbreak import files
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import write_folder
from evenbreak.errors import DataError, InputError
from evenbreak.questions.games import Chain, Graph

if TYPE_CHECKING:
    import networkx as nx

    from evenbreak.answers.match.chain import Road
    from evenbreak.files.arcs import ArcsFile
    from evenbreak.game import Game
    from evenbreak.matches.formats import MatchFormat


MOST_STATES = 5_000
"""The most states, so that every file is written in seconds."""

MOST_ARCS = 100_000
"""The most arcs, for the same reason."""

FORMS = (".csv", ".graphml", ".json", ".mtx", ".ods", ".tsv", ".txt", ".xlsx", ".xml")
"""How the names of files end; what ends so is not a game."""

MOST_WITH_VECTORS = 200
"""The most states whose eigenvectors are written."""

FILES = (
    "graph.graphml",
    "graph.json",
    "arcs.csv",
    "matrix.mtx",
    "states.csv",
    "classes.csv",
    "eigenvalues.csv",
    "eigenvectors.csv",
    "limit.csv",
    "graph.svg",
    "graph.png",
)


@command_of(Graph, "graph", page=False, always_text=True)
def command(asked: Graph) -> Answer:
    """Write a game as graph, matrix, eigenvalues and limit."""
    from evenbreak.answers.match.chain import road_of
    from evenbreak.answers.match.graph import graph_answer
    from evenbreak.files.store.folder import check_folder

    chances, name, out = asked.chances, " ".join(asked.game), asked.out
    check_folder(out)
    if _is_file(name):
        if chances:
            asked.refuse("a chain in a file has its own chances. Leave {p}, {p1} and {p2} out.")
        file = files.read_chain(name, states=asked.states, rows=asked.rows)
        _check_size(file)
        title = f"The chain in {file.source if name == '-' else Path(name).name}"
        chain = file.chain(asked.start_state)
        road = road_of(file.graph(asked.start_state), start=str(chain.start))
        written, doubts = _files(road.graph, road, title)
        doubts = [*file.warnings, *doubts]
    else:
        asked.refuse_file_options()
        title, played = _game(name, chances)
        road = road_of(played)
        written, doubts = _files(played, road, title)
    doubts += [
        f"{Path(out, name)} is from an earlier run for another game. Remove it."
        for name in FILES
        if name not in written and Path(out, name).exists()
    ]
    write_folder(out, written)
    return graph_answer(title, road, warnings=doubts)


def _is_file(name: str) -> bool:
    """Return whether a name is that of a file with a chain, and not with a chart."""
    from evenbreak.files.chain_files import OTHER_FORMS
    from evenbreak.files.charts import is_chart

    form = Path(name).suffix.lower()
    if name == "-" or form in (".graphml", ".json", ".mtx", ".xml", *OTHER_FORMS):
        return True
    return (form in FORMS or Path(name).is_file()) and not is_chart(name)


def _check_size(file: ArcsFile) -> None:
    for what, count, most in (
        ("states", len(file.states), MOST_STATES),
        ("arcs", len(file.sources), MOST_ARCS),
    ):
        if count > most:
            raise DataError(
                [
                    f"{file.source}: has {count:,} {what}, but evenbreak graph writes at most "
                    f"{most:,}. Use evenbreak chain to find the limit."
                ]
            )


def _game(name: str, chances: tuple[float, ...]) -> tuple[str, Game]:
    """Return what a game is called, with its chances, and the game itself."""
    from evenbreak.games.catalog import CATALOG, game_of_catalog
    from evenbreak.handicaps.charts.chart import CHARTS
    from evenbreak.handicaps.charts.chart_of import catalog_name

    found = _format(name)
    ours = found or name.strip().lower() in CATALOG
    if catalog_name(name) in CHARTS or Path(name).is_file() or (not ours and _adds_chart(name)):
        if chances:
            refuse("a chart's ladder has no chances of its own. Leave --p, --p1 and --p2 out.")
        return _ladder(name)
    if found and (chances or name not in CATALOG):
        return _match(found, chances)
    try:
        title, played = game_of_catalog(name, *chances)
    except InputError as error:
        if meant := _meant(name):
            refuse(f"{name!r} isn't a game; did you mean {meant!r}?")
        charts = "" if chances else f"; or a chart: {', '.join(CHARTS)}"
        refuse(f"{error}; or a match, such as 7:5 or race to 7{charts}")
    shown = chances or (_example_chances(played) if title in CATALOG else ())
    return f"{title[0].upper()}{title[1:]}{_with(shown)}", played


def _adds_chart(name: str) -> bool:
    """Return whether an installed package adds a chart of this name, and none a game of it."""
    from evenbreak.plugins import added, plain

    return plain(name) in {*map(plain, added("chart"))} - {*map(plain, added("game"))}


def _meant(name: str) -> str | None:
    """Return the game, match or chart whose words are spelled nearly so, if there is one.

    >>> _meant("rcae to 7"), _meant("drlil 9-ball"), _meant("nlp_10"), _meant("chess"), _meant("7")
    ('race to 7', 'drill 9-ball', 'npl_10', None, 'race to 7')
    """
    from difflib import get_close_matches

    from evenbreak.games.catalog import CATALOG, game_of_catalog
    from evenbreak.handicaps.charts.chart import CHARTS
    from evenbreak.matches.formats import WORDS

    if re.fullmatch(r"[1-9]\d*", name):
        return f"race to {name}"
    words = {*WORDS, *re.findall(r"[a-z]+", " ".join(CATALOG))}
    near = re.sub(
        r"[^\W\d_]{3,}",
        lambda word: next(iter(get_close_matches(word[0], words, 1, 0.7)), word[0]),
        name.lower(),
    )
    if near != name.lower():
        if _format(near):
            return near
        with suppress(InputError):
            return game_of_catalog(near) and near
    return next(iter(get_close_matches(name.lower(), CHARTS, 1, 0.7)), None)


def _example_chances(game: Any) -> tuple[float, ...]:
    """Return the chances with which the catalog has a game.

    >>> from evenbreak.games import Race, Rack
    >>> _example_chances(Race(3, 1, Race(3, 3, Rack(0.6))))
    (0.6,)
    """
    if hasattr(game, "rack"):
        return _example_chances(game.rack)
    if hasattr(game, "p1"):
        return (game.p1,) if game.p2 is None else (game.p1, game.p2)
    if hasattr(game, "shots"):
        return tuple(game.shots)
    # The first chance of a drill, except for the level that never fails.
    return next(((chance,) for chance in getattr(game, "success", ()) if chance < 1.0), ())


def _ladder(name: str) -> tuple[str, Game]:
    """Return the ladder that a chart makes, by the rule of the National Pool League."""
    from evenbreak.answers.kit.systems import chart_by_difference
    from evenbreak.handicaps import Ladder

    chart = chart_by_difference(name, "game")
    return f"The ladder of rating errors on the chart {chart.name}", Ladder(chart)


def _format(name: str) -> MatchFormat | None:
    from evenbreak.matches.formats import NotAFormatError, match_format

    try:
        return match_format(name)
    except NotAFormatError:
        return None


def _match(played: MatchFormat, chances: tuple[float, ...]) -> tuple[str, Game]:
    from evenbreak.games.rack import Rack

    if not chances:
        refuse(f"the chances for {played} are missing. Give --p, or --p1 and --p2.")
    if played.scores > MOST_STATES:
        refuse(
            f"{played} has about {played.scores:,} scores. Give a match of up to {MOST_STATES:,}."
        )
    kind = "" if played.ahead or played.set_ else "Race "
    if len(chances) == 2 and not played.breaks:
        refuse(
            f"with --p1 and --p2, it matters who breaks in {played}. Add winner breaks, loser "
            "breaks or alternate breaks, or give --p alone."
        )
    return f"{kind}{played}{_with(chances)}".capitalize(), played.match(Rack(*chances))


def _with(chances: tuple[float, ...]) -> str:
    """Return the chances in words.

    >>> _with((0.6,)), _with((0.6, 0.55)), _with(())
    (' with p = 0.6', ' with p1 = 0.6 and p2 = 0.55', '')
    """
    if len(chances) == 2:
        return f" with p1 = {chances[0]:g} and p2 = {chances[1]:g}"
    return f" with p = {chances[0]:g}" if chances else ""


def _files(
    played: Game | nx.DiGraph[Any], road: Road, title: str
) -> tuple[dict[str, bytes], list[str]]:
    """Return the content of each file by its name, and what is not written, with the reason."""
    from evenbreak.answers.faces.to_csv import table_lines
    from evenbreak.answers.match import graph as tables
    from evenbreak.plots.diagram import draw
    from evenbreak.plots.picture import image_bytes

    written = {
        "graph.graphml": files.graphml_bytes(road.graph),
        "graph.json": files.node_link_bytes(road.graph),
        "matrix.mtx": files.matrix_market_bytes(road.chain),
    }
    doubts = []
    made = [
        tables.arcs_table,
        tables.states_table,
        tables.classes_table,
        tables.eigenvalue_table,
        tables.limit_table,
    ]
    if len(road.chain) <= MOST_WITH_VECTORS:
        made.append(tables.eigenvector_table)
    else:
        doubts.append(
            f"eigenvectors.csv is not written: there are more than {MOST_WITH_VECTORS} states"
        )
    for table in (make(road) for make in made):
        written[f"{table.name}.csv"] = "".join(table_lines(table)).encode()
    try:
        picture = draw(played, title=title)
        written["graph.svg"] = image_bytes(picture, "svg")
        written["graph.png"] = image_bytes(picture, "png")
    except InputError as error:
        doubts.append(f"no picture is written: {error}")
    return {name: written[name] for name in FILES if name in written}, doubts


@command_of(Chain, "chain")
def chain(asked: Chain) -> Answer:
    """Find where a Markov chain ends."""
    from evenbreak.answers.match.chain import chain_answer

    file = files.read_chain(asked.path, states=asked.states, rows=asked.rows)
    chain = file.chain(asked.start_state)
    return chain_answer(chain, steps=asked.steps, warnings=file.warnings, via=asked.via)
