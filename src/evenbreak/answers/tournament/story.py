"""A night's story: the upset, the climb, the closest match, in words and as a table."""

from __future__ import annotations

from datetime import datetime
from typing import Any, NamedTuple

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import share_at_a_glance
from evenbreak.answers.tournament.time import minute_of_day, time_of_day
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.story import Step, Story
from evenbreak.words import Sentence, joined, say, tally


class Remark(NamedTuple):
    """Something that stood out: its name, what happened, what to say about it."""

    kind: Sentence
    what: Sentence | str
    why: Sentence


def clock_words(at: str) -> str:
    """Return the time of day from a timestamp such as 2025-03-01T19:30:00.

    >>> print(clock_words("2025-03-01T19:30:00"))
    19:30
    """
    return time_of_day(minute_of_day(datetime.fromisoformat(at)))


def won_words(result: Result) -> Sentence:
    """Return who won and how, the winner first.

    >>> print(won_words(Result("F", ("Ann", "Bo"), (3, 5), "Bo")))
    Bo 5-3 Ann
    """
    loser = next(name for name in result.players if name != result.winner)
    if result.forfeit:
        return say("{winner} beat {loser} by forfeit", winner=result.winner, loser=loser)
    games = result.games
    score = tally((games[result.winner], games[loser]))
    return say("{winner} {score} {loser}", winner=result.winner, score=score, loser=loser)


def chance_words(step: Step) -> Sentence:
    """Return what a match's winner had been given, or that it went to the last game."""
    if step.chance is not None and step.chance < 0.5:
        return say("given a {p} chance before the match", p=share_at_a_glance(step.chance))
    if step.hill:
        return say("from hill-hill")
    return say("moved the odds most")


def remarks(story: Story) -> list[Remark]:
    """Return what has stood out on a night so far, at most three things."""
    said = []
    if upset := story.upset:
        assert upset.result is not None  # noqa: S101 - it is a match
        said.append(Remark(say("Upset of the night"), won_words(upset.result), chance_words(upset)))
    if climb := story.climb:
        name, start, now = climb
        words = say(
            "from {start} to {now} since {at}",
            start=share_at_a_glance(start),
            now=share_at_a_glance(now),
            at=clock_words(story.steps[0].at),
        )
        said.append(Remark(say("Biggest climb"), name, words))
    if (close := story.closest) and close.result:
        words = say("hill-hill")
        if close.minutes:
            words = say("hill-hill, {minutes:.0f} minutes", minutes=close.minutes)
        said.append(Remark(say("Closest match"), won_words(close.result), words))
    return said


def story_answer(state: Evening, story: Story) -> Answer:
    """Return a night's story: what stood out, and the title odds after each match."""
    rows: list[list[Any]] = []
    odds: list[list[Any]] = []
    for k, step in enumerate(story.steps):
        result = step.result
        what = say("the draw") if result is None else won_words(result)
        number = None if result is None else state.number_of(result.match)
        moved = story.moved(k) if k else None
        rows.append([clock_words(step.at), number, what, step.chance, moved])
        odds += [[step.at, number, name, p] for name, p in step.title.items()]
    columns = columns_of("happened_at match happened p_winner title_moved")
    said = [
        say("{kind}: {what}, {why}.", kind=one.kind, what=one.what, why=one.why)
        for one in remarks(story)
    ]
    heading = say("The story of the night: the title odds after each match")
    table = Table("story", columns, rows)
    data = {"odds": [{"at": one.at, "title": one.title} for one in story.steps]}
    every = Table("odds", columns_of("happened_at match name p_title"), odds)
    return Answer(heading, [joined(said, "\n"), table], csv=every, data=data)
