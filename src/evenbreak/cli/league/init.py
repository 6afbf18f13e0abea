"""`evenbreak league init`: the file of a league, written from what is in its folder."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.terminal import can_ask, say
from evenbreak.errors import InputError
from evenbreak.fields.kinds import Kind, Text
from evenbreak.fields.question import declaration
from evenbreak.files.league import LEAGUE_TOML, find_league
from evenbreak.questions.start import LeagueInit

if TYPE_CHECKING:
    from evenbreak.files.league.folder import SeenFile
    from evenbreak.files.league.new_file import NewLeague

NO_TABLES = "-"
"""What is typed where the number of tables is left open."""


@command_of(LeagueInit, "init", page=False, always_text=True)
def command(asked: LeagueInit) -> Answer:
    """Write the file of a league."""
    from evenbreak.answers.written import league_answer
    from evenbreak.files.league.folder import seen_files
    from evenbreak.files.league.league_file import league_of
    from evenbreak.files.league.new_file import league_toml, proposed
    from evenbreak.files.store.folder import check_folder, write_files

    folder = Path(asked.folder)
    if not folder.is_dir():
        asked.refuse(
            "folder {folder} doesn't exist. Create it or choose another.", folder=asked.folder
        )
    check_folder(folder)
    asks = not asked.yes and can_ask()
    _keep_old(asked, asks)
    seen = seen_files(folder)
    if asks:
        for one in seen:
            say(f"{one.name}: {said(one.about)}")
    league = _answered(asked, proposed(seen, asked.name or _name_of(folder)), asks)
    path, content = folder / LEAGUE_TOML, league_toml(league).encode()
    league_of(content, path)  # which refuses what cannot be, such as a chart that there is not
    write_files(folder, {LEAGUE_TOML: content})
    return league_answer(
        str(path),
        list(_taken(seen, league)),
        list(_commands(asked.folder, league)),
        [line for one in seen for line in one.warnings],
    )


def _name_of(folder: Path) -> str:
    """Return the name of a league whose folder has this name."""
    words = folder.resolve().name.replace("_", " ").replace("-", " ").split()
    name = " ".join(word if word[:1].isupper() else word.capitalize() for word in words)
    return name or "Our league"


def _keep_old(asked: LeagueInit, asks: bool) -> None:
    """Refuse to write over a file, unless the user agrees."""
    old = find_league(asked.folder)
    if old is None:
        return
    if not asks:
        asked.refuse("{old} already exists. Edit it, or remove it first.", old=str(old))
    click.confirm(f"{old} already exists. Replace it?", abort=True, err=True)


def _answered(asked: LeagueInit, league: NewLeague, asks: bool) -> NewLeague:
    """Return what the file says: what is typed, what is answered, and else what is proposed."""
    values = dict(league.values)
    for name in ("name", "discipline", "scale", "chart", "race_to", "tables"):
        if name in asked.given:
            values[name] = declaration(LeagueInit, name).kind.words(getattr(asked, name))
    if asked.chart is not None:
        values.pop("race_to", None)
    if asked.race_to is not None:
        values.pop("chart", None)
    if not asks:
        return replace(league, values=values)

    def ask(name: str, question: str, usual: str) -> None:
        if name not in asked.given:
            kind = declaration(LeagueInit, name).kind
            values[name] = kind.words(_prompt(question, usual, kind))

    ask("name", "The league's name", values["name"])
    ask("discipline", "Which game", values["discipline"])
    if not league.levels:
        ask(
            "scale",
            "The scale of the ratings (npl, fargo, elo, points)",
            values.get("scale", "npl"),
        )
    if asked.chart is None and asked.race_to is None:
        usual = values.pop("chart", None) or values.pop("race_to", "7")
        races = "Races: a chart (name or file), or the games that the stronger player needs"
        typed = str(_prompt(races, usual, Text()))
        values["race_to" if typed.isdecimal() else "chart"] = typed
    if asked.tables is None:
        kind = _OrNone(declaration(LeagueInit, "tables").kind)
        tables = _prompt(f"How many tables ({NO_TABLES}: left open)", NO_TABLES, kind)
        if tables is not None:
            values["tables"] = str(tables)
    return replace(league, values=values)


class _OrNone(Kind):
    """A kind of values, or a sign for none."""

    def __init__(self, kind: Kind) -> None:
        self.kind = kind

    def read(self, text: str) -> object:
        """Return the value of a text; None of the sign."""
        return None if text.strip() == NO_TABLES else self.kind.read(text)


def _prompt(question: str, usual: str, kind: Kind) -> object:
    """Ask until the answer can be read."""

    def read(text: str) -> object:
        try:
            return kind.read(text)
        except InputError as error:
            raise click.UsageError(said(error.sentence)) from None

    return click.prompt(question, default=usual, value_proc=read, err=True)


def _taken(seen: Sequence[SeenFile], league: NewLeague) -> Iterator[tuple[str, str, str]]:
    """Yield each file, what it is taken as, and what it holds."""
    names = {value: key.rpartition(".")[2] for key, value in league.values.items()}
    names |= {name: "results" for name, _ in league.sources}
    for one in seen:
        taken = "aliases" if one.what == "aliases" else names.get(one.name, "")
        yield one.name, taken, said(one.about)


def _commands(folder: str, league: NewLeague) -> Iterator[tuple[str, str]]:
    """Yield what can be run now, each with what it is for."""
    where = "" if folder == "." else f" --league {shlex.quote(folder)}"
    roster = "files.roster" in league.values
    if roster:
        yield "tonight's races", f"evenbreak matchups{where}"
    if len(league.teams) > 1:
        ours, theirs = map(_quoted, league.teams[:2])
        yield "a lineup", f"evenbreak lineup {ours} {theirs}{where}"
    if league.sources:
        yield "the table", f"evenbreak league table{where}"
        if not league.levels:
            yield "ratings", f"evenbreak rate{where}"
        yield "a website", f"evenbreak publish{where}"
        yield "are the handicaps fair?", f"evenbreak validate{where}"
        if "chart" in league.values:
            yield "is the chart fair?", f"evenbreak chart audit{where}"
    elif "files.team_results" in league.values:
        yield "the table", f"evenbreak league table{where}"
    if roster:
        if league.sources:
            yield "is anyone sandbagging?", f"evenbreak sandbag watch{where}"
        systems = _alternatives(league)
        yield "would another system be fairer?", f'evenbreak simulate --compare "{systems}"{where}'
    elif not league.sources:
        yield "the odds of a match", f"evenbreak odds 612 521{where}"


def _quoted(text: str) -> str:
    """Return a name as it is typed in a command, in double quotes where any shell takes them."""
    return shlex.quote(text) if set(text) & set('"$`\\!') else f'"{text}"'


def _alternatives(league: NewLeague) -> str:
    """Return the league's own system, and two that it could have in its place."""
    own = league.values.get("system", "npl")
    others = ["fargo-like", "none"] if league.levels else ["fargo-like", "npl", "none"]
    return ", ".join([own, *(one for one in others if one != own)][:3])
