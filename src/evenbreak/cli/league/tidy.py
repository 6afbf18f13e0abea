"""`evenbreak league tidy`: one clean list of matches out of all files of results."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import click

from evenbreak import files
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.progress import erase
from evenbreak.cli.kit.terminal import can_ask, write_file
from evenbreak.files.league import is_league
from evenbreak.files.league.league_file import LeagueFile, Source, read_league
from evenbreak.files.league.sources import LeagueResults, NameDoubt, league_results
from evenbreak.questions.of_league import text_of
from evenbreak.questions.tables import LeagueTidy


@command_of(LeagueTidy, "tidy")
def tidy(asked: LeagueTidy) -> Answer:
    """Make one clean list of matches of all results."""
    from evenbreak.answers.league.tidy import results_frame, tidy_answer

    league = _league(asked)
    reading = asked.reading
    if asked.aliases is not None and not is_league(asked.aliases):
        league = replace(league, aliases=files.read_aliases(asked.aliases).means)
    how = {name: reading[name] for name in ("columns", "dates")}
    how["chart"] = text_of(league, "chart")  # which says who won by the levels of a score sheet
    found = league_results(league, **how)
    answers: dict[str, str] = {}
    if can_ask() and found.name_doubts:
        answers = dict(_answered(found))
        found = league_results(replace(league, aliases={**league.aliases, **answers}), **how)
    write_file(asked.out, files.to_csv(results_frame(found.results)))
    listed = league.files.roster
    roster = files.read_roster(league.place(listed)).roster.players if listed else ()
    return tidy_answer(found, answers=answers, roster=roster)


def _league(asked: LeagueTidy) -> LeagueFile:
    """Return the league whose file is named, or one of the files that are."""
    if len(asked.results) == 1 and is_league(asked.results[0]):
        return read_league(asked.results[0])
    return LeagueFile(folder=Path(), results=tuple(Source(file=one) for one in asked.results))


def _answered(found: LeagueResults) -> Iterator[tuple[str, str]]:
    """Ask about each pair of names, and yield what each means: the other, or itself."""
    erase()
    for doubt in found.name_doubts:
        for k, name in enumerate(doubt.names[1:], 1):
            yield name, doubt.names[0] if _one_player(doubt, k) else name


def _one_player(doubt: NameDoubt, k: int) -> bool:
    names = [f"{doubt.names[j]} ({doubt.matches[j]:,})" for j in (0, k)]
    return click.confirm(f"Are {names[0]} and {names[1]} one player?", default=False, err=True)
