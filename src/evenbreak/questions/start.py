"""What the commands ask that write a demo, open the page and write the source text."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, ClassVar

from evenbreak.errors import InputError
from evenbreak.fields.kinds import File, Flag, Named, Whole
from evenbreak.fields.question import Field, Question, Says
from evenbreak.files.league.values import COLOR, LINE
from evenbreak.questions.common import ChartName, HandicappedRace, OutFolder, ScaleOf, folder
from evenbreak.tournaments.evening.format import Discipline, Tables

_ORIGIN = re.compile(r"(https?)://([a-z0-9._-]+|\[[0-9a-f:.]+\])(?::([0-9]{1,5}))?")


def _host(text: str) -> str:
    """Return the name or address of a computer, perhaps with a port, or refuse it."""
    name = text.strip().lower()
    if not re.fullmatch(r"[a-z0-9]([a-z0-9.-]*[a-z0-9])?(:\d{1,5})?", name):
        raise InputError(
            "host must be a name or an address, such as 192.168.1.20 or pool.example:80; "
            "you gave {value!r}",
            value=text,
        )
    return name


@dataclass(frozen=True, kw_only=True)
class Demo(Question):
    """Write made-up files to FOLDER, and show three commands to try on them.

    The files are a league's results, a tournament's players, two teams and a player's practice.
    FOLDER defaults to evenbreak-demo. A file there that isn't part of the demo is left alone.
    """

    examples = """\
  evenbreak demo
  evenbreak demo data
"""
    folder: Annotated[str, Field(Named(folder, "[FOLDER]"), argument=True)] = "evenbreak-demo"


@dataclass(frozen=True, kw_only=True)
class LeagueInit(Question):
    """Write a league's file, league.toml, based on the files in its folder.

    FOLDER defaults to the current one. The command reads the files there: results, lists of
    players, fixtures, a chart. If anything is missing, it asks you and suggests an answer; in a
    script, or with {yes}, it accepts the suggestions. After that, every command run in the folder
    takes its defaults from league.toml.
    """

    examples = """\
  evenbreak league init
  evenbreak league init tuesday --yes
  evenbreak league init --name "Tuesday 8-Ball" --chart apa_8ball --tables 6
"""
    folder: Annotated[str, Field(Named(folder, "[FOLDER]"), argument=True)] = "."
    yes: Annotated[bool, Field(Flag(), "Accept all suggestions without asking.")] = False
    name: Annotated[
        str | None, Field(LINE, "The league's name.", usual="the folder's", metavar="TEXT")
    ] = None
    discipline: Annotated[Discipline | None, Says("The game.", usual="8-ball")] = None
    scale: Annotated[ScaleOf, Says(more="")] = None
    chart: Annotated[
        ChartName,
        Says(
            "The race chart: a name, or a file in the folder.", usual="based on the list of players"
        ),
    ] = None
    race_to: Annotated[
        int | None, HandicappedRace, Says("Instead of a chart: the stronger player needs N games.")
    ] = None
    tables: Annotated[Tables | None, Says(usual="left open")] = None

    def check(self) -> None:
        """Refuse two kinds of races."""
        if self.chart is not None and self.race_to is not None:
            self.refuse("{chart} and {race_to} can't be used together. Leave one out.")


def origin(text: str) -> str:
    """Return where a page is, as browsers write it.

    >>> origin("https://League.example"), origin("http://10.0.0.7:3000"), origin("http://a:80")
    ('https://league.example', 'http://10.0.0.7:3000', 'http://a')
    """
    found = _ORIGIN.fullmatch(text.strip().lower())
    if found is None or not 1 <= int(found[3] or 1) <= 65535:
        raise InputError(
            "{value!r} isn't a web address. Give its scheme, host and port, such as "
            "https://league.example or http://192.168.1.20:3000.",
            value=text,
        )
    usual = {"http": "80", "https": "443"}[found[1]]
    port = f":{int(found[3])}" if found[3] and found[3] != usual else ""
    return f"{found[1]}://{found[2]}{port}"


@dataclass(frozen=True, kw_only=True)
class Serve(Question):
    """Open tonight's tournament or team night as a page, for phones and the screen on the wall.

    FILE.db is a tournament file, as written by evenbreak tournament new, or a team-night file;
    default: tonight.db. If it doesn't exist, the page starts one. You can use the evenbreak
    tournament commands on it at the same time.
    """

    of_league: ClassVar[bool] = True
    """Forms start with what the league's file says."""
    examples = """\
  evenbreak serve
  evenbreak serve --open
  evenbreak serve saturday.db --lan
  evenbreak serve --demo --color "#7a1f5c"
"""
    file: Annotated[str | None, Field(File("FILE.db"), metavar="[FILE.db]", argument=True)] = None
    demo: Annotated[
        bool,
        Field(
            Flag(),
            "Open a sample tournament, half played.",
            more="The tournament has 16 players, some results, matches on tables and one match "
            "to call. Its file name is printed; the file is in a temporary folder of its own.",
        ),
    ] = False
    open: Annotated[
        bool,
        Field(
            Flag(),
            "Open the page in the browser, as the director.",
            more="Without FILE.db the tournament is kept in the evenbreak folder in your "
            "documents, with one file for each day. If the page is already running, "
            "starting it again opens the browser on it. If the port is taken, the next "
            "free one is used.",
        ),
    ] = False
    lan: Annotated[
        bool,
        Field(
            Flag(),
            "Let phones connect; prints the address and a QR code.",
            more="Without it, the director can let them in on the page.",
        ),
    ] = False
    host: Annotated[
        str | None,
        Field(
            Named(_host, "NAME[:PORT]"),
            "This computer's address for phones.",
            usual="its own address",
            more="This is for `--lan` in a container, which doesn't see the address that phones "
            "use. Requests under other names are refused.",
        ),
    ] = None
    allow_origin: Annotated[
        tuple[str, ...],
        Field(
            Named(origin, "ORIGIN"),
            "A page on another site that may use the JSON interface, such as "
            "https://league.example.",
            many=True,
            more="It reads what everyone in the room sees; to enter something, it also needs a "
            "token. Without this option, no page on another site can use the interface. "
            "`*` and `null` are refused: they would let in every page, and every file.",
        ),
    ] = ()
    port: Annotated[int, Field(Whole(1024, 65535), "Port to listen on.")] = 8000
    color: Annotated[
        str | None,
        Field(
            COLOR,
            "Your house color for buttons and chances, such as #7a1f5c.",
            usual="blue",
            more="Where text in this color would be hard to read, the color is darkened by day "
            "and lightened by night.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a file for the demo, which makes its own."""
        if self.demo and self.file is not None:
            self.refuse("{demo} makes its own file. Leave out {name} or {demo}.", name=self.file)
        if self.host is not None and not self.lan:
            self.refuse("{host} is for phones. Give {lan} too.")


@dataclass(frozen=True, kw_only=True)
class Reproduce(Question):
    """Recompute and write every table, figure and number in the source text.

    Start with DIR/index.md for section 5 (statistics), DIR/physics.md for sections 1 to 4 (the
    physics of the table), or DIR/graph_to_limit.md for each game's graph, matrix, eigenvalues and
    limit. These pages show and explain every number, point out errors in the text and link to the
    CSV files. The files are identical, byte for byte, every time. If a number isn't as expected,
    the command says so and ends with exit code 1.
    """

    examples = """\
  evenbreak reproduce --out text
"""
    out: OutFolder
