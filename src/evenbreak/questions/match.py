"""Questions about one match of two players."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Annotated, Any

from evenbreak.errors import InputError
from evenbreak.fields.kinds import NUMBER, Choice, File, Flag, Named, Text, Whole, meant
from evenbreak.fields.question import Field, Question, Says
from evenbreak.matches.formats import LONGEST, WHO_BREAKS, match_format
from evenbreak.questions.common import (
    CHANCE,
    RACE,
    SCORE,
    USUAL_RACE,
    ByWay,
    ChartName,
    FormOfDay,
    Lengths,
    LevelResults,
    PlotFile,
    ScaleOf,
    Target,
    has_levels,
)
from evenbreak.tournaments.evening.format import LONGEST_RACE
from evenbreak.words import Parameter

_BY_CHANCE = "Chances instead of ratings"
_MORE = ("via", "exact", "racks", "set_score", "comebacks", "plot")


@dataclass(frozen=True, kw_only=True)
class Players(Question):
    """Who plays: two ratings, two names on a list, a chance in a game, or one for each breaker."""

    ratings: Annotated[
        tuple[str, ...],
        Field(
            Named(str, "[A B]", offers="players", number=True),
            "A's and B's ratings.",
            argument=True,
            many=True,
        ),
    ] = ()
    from_file: Annotated[
        str | None,
        Field(
            File("RATINGS.csv"),
            "Look A and B up by name in this list of ratings, with its scale and errors.",
            option="from",
            more="The file is a [list](../files.md#roster). Everything is averaged over the "
            "errors stated in it, as in [matchups](league.md#evenbreak-matchups); JSON "
            "output also has `player_a` and `player_b`.",
        ),
    ] = None
    scale: ScaleOf = None
    chart: Annotated[
        ChartName,
        Says(
            "The league's chart, by name or in a file; with a chart by skill level, such as "
            "apa_8ball, A and B are levels.",
            more="The chart sets the race if none is given. If A and B are names in a list, the "
            "list needs a `level` column; the chances come from its ratings if there are "
            "any, otherwise from the levels.",
        ),
    ] = None
    results: LevelResults = None
    p: Annotated[float | None, Field(CHANCE, "Chance that A wins a game.", section=_BY_CHANCE)] = (
        None
    )
    p1: Annotated[
        float | None, Field(CHANCE, "Chance that A wins a game that A breaks.", section=_BY_CHANCE)
    ] = None
    p2: Annotated[
        float | None, Field(CHANCE, "Chance that B wins a game that B breaks.", section=_BY_CHANCE)
    ] = None
    breaks: Annotated[
        str | None,
        Field(
            Choice(tuple(WHO_BREAKS)),
            "Who breaks: winner, loser, in turn, or always A or B.",
            section=_BY_CHANCE,
        ),
    ] = None
    first_break: Annotated[
        str | None,
        Field(
            Choice(("a", "b")),
            "Who breaks the next game.",
            usual="a; b with {breaks} b",
            section=_BY_CHANCE,
            rare=True,
        ),
    ] = None

    def check(self) -> None:
        """Refuse players that are missing, or given in two ways."""
        remedy = (
            "give two ratings (612 521), two names with {from_file} ratings.csv, {p} P, or "
            "{p1} P and {p2} P with {breaks}"
        )
        self._check_ratings()
        by_break = self.p1 is not None or self.p2 is not None
        ways = bool(self.ratings) + (self.p is not None) + by_break
        if not ways:
            self.refuse(f"missing players: {remedy}")
        if ways > 1:
            self.refuse(f"the players are given twice. Use only one way: {remedy}")
        if self.from_file is not None and not self.ratings:
            self.refuse(
                "{from_file} looks two players up by name, but you named none. Leave it out."
            )
        self._check_chart()
        if self.scale is not None and not self.ratings:
            self.refuse("{scale} is for ratings, but you gave none. Leave it out.")
        if by_break and None in (self.p1, self.p2, self.breaks):
            self.refuse("give {p1}, {p2} and {breaks} together, or none of them")
        if not by_break and (self.breaks is not None or self.first_break is not None):
            self.refuse(
                "the break matters only with {p1} and {p2}. Leave {breaks} and {first_break} out."
            )
        if self.from_file is not None and len(self.ratings) != 2:
            self.refuse(
                "{from_file} needs two players, but you named {n}. Put a name that has spaces "
                "in quotes.",
                n=len(self.ratings),
            )
        if len(self.ratings) == 1:
            self.refuse("only one rating, {rating}: " + remedy, rating=self.ratings[0])
        if len(self.ratings) > 2:
            self.refuse(
                "{n} ratings, {ratings}: " + remedy,
                n=len(self.ratings),
                ratings=" ".join(self.ratings),
            )

    def _check_chart(self) -> None:
        """Refuse a chart that does not go with the players, and what does not go with it."""
        if self.results is not None and not has_levels(self.chart):
            self.refuse(
                "{results} is for chances based on skill levels. Add a chart of levels, such as "
                "{chart} apa_8ball."
            )
        if self.chart is None:
            return
        if not self.ratings:
            self.refuse("{chart} is for ratings or skill levels, but you gave none. Leave it out.")
        from evenbreak.files.charts import find_chart
        from evenbreak.handicaps.charts.chart import Chart
        from evenbreak.handicaps.charts.level_chart import PointsChart

        found = find_chart(self.chart)
        if isinstance(found, Chart | PointsChart) and not isinstance(self, Played):
            self.refuse("{chart} must be a chart of races by skill level here. Leave it out.")
        if isinstance(found, PointsChart):
            self._refuse_with_points(found.name)
        if not isinstance(found, Chart) and self.from_file is None:
            self._check_levels(found.name, found.levels)

    def _refuse_with_points(self, name: str) -> None:
        """Refuse what is about games where a match is played to points."""
        for part in (*("race", "ahead", "set_", "win_by", "scale", "form"), *_MORE):
            if part in self.given:
                self.refuse(
                    "{part} isn't for a points chart such as {name}. Leave it out.",
                    part=Parameter(part),
                    name=name,
                )

    def _check_levels(self, name: str, levels: Sequence[int]) -> None:
        """Refuse typed numbers that are no levels of a chart, and a scale for those that are."""
        for word in self.ratings:
            if not NUMBER.fullmatch(word) or float(word) not in levels:
                self.refuse(
                    "{word} isn't a skill level in {name}, whose levels are {levels}; for "
                    "ratings leave {chart} out, or give a chart of rating differences",
                    word=word,
                    levels=", ".join(map(str, levels)),
                    name=name,
                )
        if self.scale is not None:
            self.refuse(
                "{scale} is for ratings, and with {chart} A and B are levels. Leave it out."
            )

    def _check_ratings(self) -> None:
        """Refuse words that are no ratings."""
        for word in self.ratings:
            if self.from_file is not None or NUMBER.fullmatch(word):
                continue
            wanted = (
                "Give two ratings (612 521), or use {from_file} FILE to look players up by name."
            )
            values: dict[str, Any] = {}
            with suppress(InputError):
                match = match_format(word)
                if hasattr(self, "race"):
                    wanted += (
                        f" A match goes with {{{'ahead' if match.ahead else 'race'}}} {{m}}:{{n}}"
                    )
                    values = {"m": match.m, "n": match.n}
            wanted += "{hint}"
            hint = meant(word, -math.inf, math.inf)
            self.refuse("{word} isn't a rating. " + wanted, word=repr(word), hint=hint, **values)


@dataclass(frozen=True, kw_only=True)
class Played(Question):
    """The match: a race or n-ahead, perhaps in sets, perhaps from a score on."""

    race: Annotated[
        tuple[int, int] | None, Field(RACE, "A needs M games, and B needs N; 7 means 7:7.")
    ] = None
    ahead: Annotated[
        tuple[int, int] | None, Field(RACE, "A wins with a lead of M games, B with a lead of N.")
    ] = None
    set_: Annotated[
        tuple[int, int] | None,
        Field(RACE, "Play sets, each one an M:N race; {race} then counts sets.", option="set"),
    ] = None
    score: Annotated[
        tuple[int, int] | None,
        Field(
            SCORE,
            "The score so far: A has I, and B has J.",
            more="Use it for games on the wire, or for a match under way; with `--set`, it "
            "counts sets.",
        ),
    ] = None
    win_by: Annotated[
        int | None,
        Field(
            Whole(1, LONGEST),
            "The race goes on until one player leads by K, counted from what each needs.",
            metavar="K",
        ),
    ] = None

    def check(self) -> None:
        """Refuse a match that is missing, or two in one."""
        if self.race is not None and self.ahead is not None:
            self.refuse("{race} and {ahead} can't be used together. Leave one out.")
        if self.win_by is not None and self.ahead:
            self.refuse("{win_by} can't be used with {ahead}. Leave it out.")
        if self.win_by is not None and self.set_:
            self.refuse("{win_by} can't be used with {set_}. Leave it out.")
        if self.race is None and self.ahead is None and getattr(self, "chart", None) is None:
            self.refuse("missing match: give {race} M:N, {ahead} M:N or {chart} NAME")


@dataclass(frozen=True, kw_only=True)
class Odds(Players, Played):
    """Give the odds of a match, and its likely length.

    Describe the players by two ratings A B, by two skill levels with {chart}, by two names with
    {from_file}, by {p}, or by {p1}, {p2} and {breaks}. Describe the match by {race} or {ahead},
    with {set_} if it is played in sets; or let the {chart} set the race.
    """

    examples = """\
  evenbreak odds 612 521 --scale fargo --race 7:5
  evenbreak odds 5 3 --chart apa_8ball
  evenbreak odds "Ann Lee" "Bo Diaz" --from ratings.csv --race 7:5
  evenbreak odds --p1 0.6 --p2 0.5 --breaks winner --race 9:9 --score 4:6
"""
    form: FormOfDay = None
    exact: Annotated[
        bool,
        Field(
            Flag(),
            "Also show the chances of winning as fractions; needs {p}, or {p1} and {p2}.",
            section="Details",
        ),
    ] = False
    via: ByWay = None

    def check(self) -> None:
        """Refuse ways to the answer that do not go with the players."""
        if self.exact and self.ratings:
            self.refuse(
                "{exact} needs the chances themselves. Give {p}, or {p1} and {p2}, not ratings."
            )
        if self.exact and self.via is not None:
            self.refuse("{exact} uses its own method. Leave {via} out.")
        if self.exact and self.form:
            self.refuse("{exact} can't give fractions with {form}. Leave one out.")
        if self.form and self.breaks is not None and any(self.score or ()):
            self.refuse(
                "the games already played show day-to-day form, but only if it's known who "
                "broke them. Leave out {score} or {form}."
            )


MOST_RACES = 300
"""The most races that are listed, so that every answer takes seconds."""

MOST_GRAPHS, MOST_GAMES = 20, 99
"""The most races whose graph is built with `via`, and the most games in them."""


@dataclass(frozen=True, kw_only=True)
class Fair(Players, Lengths):
    """Find the fairest races for two players, with the fairest listed first.

    Describe the players by two ratings A B, by two names with {from_file}, by {p}, or by {p1}, {p2}
    and {breaks}; limit the length by {games} or {race_to}.
    """

    examples = """\
  evenbreak fair 612 521 --scale fargo --race-to 7
  evenbreak fair "Ann Lee" "Bo Diaz" --from ratings.csv --race-to 7
  evenbreak fair 85 40 --games 7..13 --top 3
"""
    target: Target = 0.5
    top: Annotated[int, Field(Whole(1, MOST_RACES), "Number of races to list.", metavar="K")] = 5
    form: FormOfDay = None
    via: ByWay = None

    def check(self) -> None:
        """Refuse more graphs than can be built in seconds."""
        games, race_to = self.lengths.values()
        longest = games[1] if games is not None else 2 * race_to - 1
        if self.via is not None and (longest > MOST_GAMES or self.top > MOST_GRAPHS):
            self.refuse(
                "{via} builds the graph of each race listed. Ask for at most {graphs} "
                "races of at most {most} games.",
                graphs=MOST_GRAPHS,
                most=MOST_GAMES,
            )


@dataclass(frozen=True, kw_only=True)
class FairTonight(Fair):
    """The same on a page that anyone may open.

    Its races are as long as those of a tournament: one to 1,000 takes seconds to work out.
    """

    race_to: Annotated[int, Field(Whole(1, LONGEST_RACE))] = USUAL_RACE
    top: Annotated[int, Field(Whole(1, MOST_RACES), "Number of races to list.")] = 3


def winners(text: str) -> list[int]:
    """Return the winner of each game, 1 or 2.

    >>> winners("ab, b")
    [1, 2, 2]
    """
    letters = "".join(text.lower().replace(",", " ").split())
    for letter in letters:
        if letter not in "ab":
            raise InputError(f"{letter!r} isn't a or b. Write one letter per rack, such as abbab.")
    return ["ab".index(letter) + 1 for letter in letters]


@dataclass(frozen=True, kw_only=True)
class Live(Players, Played):
    """Follow a match under way: the odds now, what the next game is worth, and the turning point.

    Describe the players and the match as for `odds`. Give the score with {racks}, with {score}, or
    with both; if both, {racks} starts from that score.
    """

    examples = """\
  evenbreak live 612 521 --scale fargo --race 7:5 --racks abbab
  evenbreak live --p 0.6 --race 9:7 --score 4:6
  evenbreak live --p 0.6 --race 3:3 --set 4:3 --score 1:0 --set-score 2:2
"""
    set_score: Annotated[
        tuple[int, int] | None,
        Field(SCORE, "The score of the set under way, before the games in {racks}."),
    ] = None
    racks: Annotated[
        list[int] | tuple[int, ...],
        Field(Named(winners, "abbab..."), "Who won each game since {score}."),
    ] = ()
    comebacks: Annotated[
        bool,
        Field(Flag(), "Add the comeback table: the odds at every possible score.", old=("table",)),
    ] = False
    form: FormOfDay = None
    plot: Annotated[
        PlotFile, Says(more="The chart shows the match so far; it needs `--racks`.")
    ] = None

    def check(self) -> None:
        """Refuse what needs something else."""
        if self.set_score is not None and self.set_ is None:
            self.refuse("{set_score} is the score of a set, but there's no {set_}. Leave it out.")
        if self.plot is not None and not self.racks:
            self.refuse("{plot} draws the match as it went. Give {racks}, such as abbab.")


MOST_FORMATS = 7
"""As many formats as a picture has lines for."""


@dataclass(frozen=True, kw_only=True)
class Compare(Players):
    """Compare match formats for two players: who each one favors.

    A FORMAT is 9:5 (A needs 9 games, B needs 5), "7:7 win by 2", "ahead 5:3" or "3:1 of 3:3"
    (sets), and may end in a break format, such as "winner breaks". Describe the players by two
    ratings A B, by two names with {from_file}, by {p}, or by {p1}, {p2} and {breaks}.
    """

    examples = """\
  evenbreak compare --p 0.6667 9:5 "3:1 of 3:3" "ahead 5:3"
  evenbreak compare 612 521 --scale fargo 7:5 "7:7 win by 2" --plot formats.png
  evenbreak compare --p1 0.6 --p2 0.55 --breaks winner 9:7 "9:7 alternate breaks"
"""
    formats: Annotated[
        tuple[str, ...],
        Field(
            Text(),
            "Formats, such as 9:7 or 3:1 of 3:3.",
            metavar="FORMAT...",
            argument=True,
            many=True,
        ),
    ] = ()
    hold: Annotated[
        str | None,
        Field(
            Choice(("p2", "break")),
            "What stays fixed as P1 varies: P2, or the advantage of the break.",
            usual="p2",
            section="Details",
        ),
    ] = None
    plot: Annotated[
        PlotFile,
        Says(more="The chart shows A's chance in each format against the chance in a game."),
    ] = None

    @classmethod
    def split(cls, typed: dict[str, Any]) -> dict[str, Any]:
        """Separate what is typed into ratings, which are numbers, and formats, which are not."""
        words = typed.get("ratings", ())
        if "from_file" in typed:
            return typed | {"ratings": words[:2], "formats": words[2:]}
        ratings = tuple(word for word in words if NUMBER.fullmatch(word))
        said = not typed.keys().isdisjoint({"p", "p1", "p2"})
        if ratings and (said or len(ratings) > 2):
            word = ratings[0 if said else 2]
            race = word if word.isdecimal() else "7"
            cls.refuse(
                "{word} was read as a rating. For a race to {race}, write {race}:{race}.",
                word=word,
                race=race,
            )
        formats = tuple(word for word in words if not NUMBER.fullmatch(word))
        return typed | {"ratings": ratings, "formats": formats}

    def check(self) -> None:
        """Refuse too few or too many formats."""
        if not self.formats:
            self.refuse('missing formats: give some, such as 9:5 "3:1 of 3:3" "ahead 5:3"')
        if len(self.formats) > MOST_FORMATS:
            self.refuse(
                "compare at most {most} formats; you gave {n}",
                n=len(self.formats),
                most=MOST_FORMATS,
            )
