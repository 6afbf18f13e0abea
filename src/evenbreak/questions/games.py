"""Questions about games shot by shot, about breaks, and about any Markov chain."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, File, Named, Number, Text, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.questions.common import CHANCE, RACE, SHARE, ByWay, OutFolder, PlotFile
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from evenbreak.chains.matrices import Rows
else:  # which loads scipy
    Rows = str

MOST_BALLS = 100_000
"""The most balls that an option can name."""
HIGHEST = 1_000_000
"""The highest stake."""
MOST_SHOTS = 1000
"""The most shots to look ahead."""

_STAKE = Number(0, HIGHEST, f" isn't a stake. Give a number from 0 to {HIGHEST}")

Stake: TypeAlias = Annotated[float, Field(_STAKE)]
Chance: TypeAlias = Annotated[float | None, Field(CHANCE)]
Safety: TypeAlias = Annotated[
    float,
    Field(
        SHARE,
        "The first shot of an inning goes in ALPHA times as often as the others.",
        metavar="ALPHA",
    ),
]
Shots: TypeAlias = tuple[float, ...]


def numbers_in(text: str, least: int, most: int, kind: Number, wanted: str) -> Shots:
    """Return the numbers of a text, with colons between them.

    >>> numbers_in("24:19", 2, 2, Number(0, 100), "isn't A:B")
    (24.0, 19.0)
    """
    numbers = tuple(kind.read(part) for part in text.split(":") if part.strip())
    if not least <= len(numbers) <= most:
        raise InputError(f"{text!r} {wanted}")
    return numbers


def _averages(text: str) -> Shots:
    wanted = f"isn't a pair of averages. Give two from 0 to {MOST_BALLS}, such as 24:19"
    return numbers_in(text, 2, 2, Number(0, MOST_BALLS), wanted)


def _shot(text: str) -> Shots:
    wanted = "isn't a shot. Give two or more numbers from 0 to 1, such as 0.3:0.3"
    return numbers_in(text, 2, MOST_SHOTS, SHARE, wanted)


@dataclass(frozen=True, kw_only=True)
class Breaks(Question):
    """Compare break formats for two players over the long run, listing A's best format first."""

    examples = """\
  evenbreak breaks --p1 0.6 --p2 0.55
  evenbreak breaks --p1 0.9 --p2 0.5 --win 1 --lose 2
  evenbreak breaks --p1 0.9 --p2 0.5 --plot breaks.png
"""
    old_words = ("p1", "p2")
    p1: Annotated[Chance, Says("Chance that A wins a rack that A breaks.")] = None
    p2: Annotated[Chance, Says("Chance that B wins a rack that B breaks.")] = None
    win: Annotated[Stake, Says("What A wins for each rack won.")] = 1.0
    lose: Annotated[Stake, Says("What A pays for each rack lost.", metavar="Y")] = 1.0
    first_break: Annotated[
        str,
        Field(
            Choice(("a", "b")),
            "Who breaks the first rack; this matters only if the break never changes hands.",
        ),
    ] = "a"
    via: ByWay = None
    plot: Annotated[
        PlotFile,
        Says(
            more="The chart shows the two players as a dot on contour lines of A's share of "
            "the racks."
        ),
    ] = None

    def check(self) -> None:
        """Refuse a question without chances."""
        if self.p1 is None or self.p2 is None:
            self.refuse("missing chances: give {p1} P and {p2} P")


@dataclass(frozen=True, kw_only=True)
class Straight(Question):
    """Give the odds of a straight pool match (14.1), and the spot that makes it even.

    Describe the players by their balls per inning ({averages} A:B), or by {p1} and {p2}.
    """

    examples = """\
  evenbreak straight --averages 9:4 --points 100
  evenbreak straight --averages 24:19 --points 150:130 --first b
  evenbreak straight --p1 0.9 --p2 0.85 --points 100 --safety 0.8
"""
    old_words = ("averages",)
    averages: Annotated[
        Shots | None, Field(Named(_averages, "A:B"), "A's and B's average balls per inning.")
    ] = None
    p1: Annotated[Chance, Says("Chance that A makes a shot.")] = None
    p2: Annotated[Chance, Says("Chance that B makes a shot.")] = None
    points: Annotated[
        tuple[int, int], Field(RACE, "Points needed to win: A needs M, and B needs N.")
    ]
    safety: Safety = 1.0
    first: Annotated[str, Field(Choice(("a", "b")), "The player who shoots first.")] = "a"
    plot: Annotated[
        PlotFile,
        Says(more="The chart shows A's chance against the points that the weaker player needs."),
    ] = None

    def check(self) -> None:
        """Refuse players that are missing, or given twice."""
        by_chance = self.p1 is not None or self.p2 is not None
        if self.averages and by_chance:
            self.refuse(
                "the players are given twice. Use {averages} A:B, or {p1} and {p2}, not both."
            )
        if not self.averages and (self.p1 is None or self.p2 is None):
            self.refuse("missing players: give {averages} A:B, or {p1} and {p2}")


LOOK_AHEADS = {"infinite": "infinite", "two": "two shots", "all": "all shots"}


@dataclass(frozen=True, kw_only=True)
class OneBall(Question):
    """Choose the best shot in the one-ball game, and give your odds of winning it.

    In each {shots}, P1 is your chance of making the shot, and P2 is the opponent's chance of making
    what your miss leaves. If you know more, give the chances for later shots too: P3 is for your
    next shot, P4 is for the opponent's, and so on.
    """

    examples = """\
  evenbreak oneball --shot 0.4:0.8
  evenbreak oneball --shot 0.4:0.8 --shot 0.3:0.3 --shot 0.5:0.9
  evenbreak oneball --shot 0.4:0.8:0.5:0.2 --shot 0.3:0.3:0.2:0.4
"""
    old_words = ("shots",)
    shots: Annotated[
        tuple[Shots, ...],
        Field(
            Named(_shot, "P1:P2[:P3...]"),
            "A shot you could take.",
            many=True,
            option="shot",
            old=("or",),
        ),
    ] = ()
    look_ahead: Annotated[
        str | None,
        Field(
            Choice(LOOK_AHEADS),
            "How to rank shots: by the first two, repeated until one is made (infinite); or by "
            "the first two (two) or all of them (all), assuming that the game is even after that.",
            usual="all if there is a P3, otherwise infinite",
        ),
    ] = None
    via: ByWay = None
    plot: Annotated[
        PlotFile,
        Says(
            more="The chart shows the shots on contour lines of the chance of winning; on the "
            "thick line, the game is even."
        ),
    ] = None

    def check(self) -> None:
        """Refuse a question without a shot, and a picture that would need more dimensions."""
        if not self.shots:
            self.refuse("missing shots: give some, such as {shots} 0.4:0.8")
        if self.plot is not None and self.ahead == "all shots":
            self.refuse("{plot} draws two chances per shot. Add {look_ahead} infinite or two.")

    @property
    def ahead(self) -> str:
        """How far to look ahead."""
        return self.look_ahead or (
            "all shots" if any(len(shot) > 2 for shot in self.shots) else "infinite"
        )


@dataclass(frozen=True, kw_only=True)
class ChainFile(Question):
    """How a file of a chain is read."""

    start_state: Annotated[
        str | None,
        Field(
            Text("STATE"),
            "The state the chain starts in.",
            usual="the start that the file names, otherwise the first state",
            old=("start",),
        ),
    ] = None
    states: Annotated[
        str | None,
        Field(
            File("STATES.csv"),
            "The names of a matrix's states, in matrix order.",
            usual="1, 2, ...",
        ),
    ] = None
    rows: Annotated[
        Rows | None,
        Field(
            Choice(("from", "to")),
            "What each row of a matrix holds: the probabilities of leaving its state, or of "
            "entering it.",
            usual="to, so that columns sum to 1",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Chain(ChainFile):
    """Find where a Markov chain in a file ends, or its long-run average.

    FILE is a CSV file of arcs with the columns source, target and probability (- reads one from
    standard input), a graph in GraphML (.graphml) or node-link JSON (.json), or a transition matrix
    in Matrix Market form (.mtx). The probabilities of the arcs out of each state sum to 1; the
    chain ends in a state that appears only as a target.
    """

    examples = """\
  evenbreak chain arcs.csv
  evenbreak chain arcs.csv --start-state S2 --json
  evenbreak chain arcs.csv --steps 10
  evenbreak chain matrix.mtx --states states.csv
"""
    path: Annotated[str, Field(File(), argument=True)]
    steps: Annotated[
        int | None,
        Field(
            Whole(0, 10**40),
            "Also show the probabilities after N steps; CSV output then has only these.",
        ),
    ] = None
    via: ByWay = None


@dataclass(frozen=True, kw_only=True)
class Graph(ChainFile):
    """Write the graph, matrix, eigenvalues and limit of a game, or of your own graph, to files.

    GAME is one-ball; series, with winner, loser or alternate breaks; drill 9-ball or drill 8-ball;
    a match, such as 9:5, "7:7 win by 2", race to 7 or n-ahead 3; another game in the catalog; or a
    chart, such as npl_10, for the ladder of rating errors it leads to. Without {p}, or {p1} and
    {p2}, a game in the catalog uses example chances; any other match needs them. FILE is any chain
    that evenbreak chain reads: a CSV file of arcs, GraphML (.graphml), node-link JSON (.json) or a
    matrix in Matrix Market form (.mtx). The command writes all of these formats, which can be read
    again, as well as tables and a picture.
    """

    examples = """\
  evenbreak graph one-ball --p1 0.4 --p2 0.8 --out one_ball
  evenbreak graph series winner breaks --p1 0.6 --p2 0.55 --out breaks
  evenbreak graph 7:5 alternate breaks --p1 0.6 --p2 0.5 --out race
  evenbreak graph npl_10 --out ladder
  evenbreak graph matrix.mtx --states states.csv --out mine
"""
    game: Annotated[tuple[str, ...], Field(File("GAME|FILE"), argument=True, many=True)]
    p: Annotated[Chance, Says("Chance that A wins a game or, in a drill, that a shot is made.")] = (
        None
    )
    p1: Annotated[
        Chance, Says("Chance that A wins a game that A breaks, or makes the one ball.")
    ] = None
    p2: Annotated[
        Chance, Says("Chance that B wins a game that B breaks, or makes the one ball.")
    ] = None
    out: OutFolder

    def check(self) -> None:
        """Refuse chances that contradict each other."""
        if self.p is not None and (self.p1 is not None or self.p2 is not None):
            self.refuse("{p} can't be used with {p1} and {p2}. Leave it out.")
        if (self.p1 is None) != (self.p2 is None):
            self.refuse("give both {p1} and {p2}, or neither")

    @property
    def chances(self) -> tuple[float, ...]:
        """The chances that are given."""
        return tuple(chance for chance in (self.p, self.p1, self.p2) if chance is not None)

    def refuse_file_options(self) -> None:
        """Refuse for a game what says how a file is read."""
        for name in ("start_state", "states", "rows"):
            if getattr(self, name) is not None:
                self.refuse("{part} is for a chain in a file. Leave it out.", part=Parameter(name))
