"""Two players and a match between them: its odds, its length, and the most nearly even races."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import DEFECTIVE, by_way
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import decimals_of, scale_words, two_ratings_doubts
from evenbreak.answers.kit.wording import chance, decimals, games, percent
from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.odds import MatchOdds, match_odds
from evenbreak.ratings.scale import Scale
from evenbreak.words import joined, say, tally

if TYPE_CHECKING:
    from fractions import Fraction

    from evenbreak.chains.ways import Way
    from evenbreak.handicaps.charts.fair import FairRace
    from evenbreak.handicaps.charts.gap import Gap
    from evenbreak.handicaps.charts.level_skills import LevelSkills
    from evenbreak.questions.match import Fair


FORMATS = {
    "winner": BREAK_FORMATS["winner"],
    "loser": BREAK_FORMATS["loser"],
    "alternate": BREAK_FORMATS["alternate"],
    "a": BREAK_FORMATS["player 1"],
    "b": BREAK_FORMATS["player 2"],
}
"""Break formats as people call them; A is player 1."""

_AVERAGED = say("All of this allows for how far off that may be.")


@dataclass(frozen=True)
class TwoPlayers:
    """Two players, A and B, and how a game between them goes.

    `breaks` names a format of `FORMATS`. `errors` are standard errors of the ratings, `form` is the
    standard deviation of a game's log-odds from match to match. With `skills`, the strengths of
    levels, the ratings are relative points, and the second is 0. `assumed` says what is assumed
    about the errors, if anything.
    """

    rack: Rack[float]
    breaks: str | None = None
    first_breaker: int = 1
    ratings: tuple[float, float] | None = None
    scale: Scale | None = None
    names: tuple[str, str] = ("A", "B")
    errors: tuple[float, float] | None = None
    form: float = 0.0
    levels: tuple[int, int] | None = None
    skills: LevelSkills | None = None
    assumed: str = ""

    @classmethod
    def of_levels(
        cls, levels: tuple[int, int], skills: LevelSkills, names: tuple[str, str] = ("A", "B")
    ) -> TwoPlayers:
        """Return two players whose skill levels are known."""
        off = float(skills.error(*levels)) / math.sqrt(2.0)
        apart = float(skills.difference(*levels))
        players = cls.rated(apart, 0.0, skills.scale, names, (off, off) if off else None)
        return replace(players, levels=levels, skills=skills)

    @classmethod
    def rated(
        cls,
        rating_a: float,
        rating_b: float,
        scale: Scale,
        names: tuple[str, str] = ("A", "B"),
        errors: tuple[float, float] | None = None,
    ) -> TwoPlayers:
        """Return two players whose ratings are known."""
        rack = scale.rack(rating_a - rating_b)
        return cls(rack, ratings=(rating_a, rating_b), scale=scale, names=names, errors=errors)

    @property
    def break_format(self) -> BreakFormat | None:
        """Who breaks the next game; None if it doesn't matter."""
        return None if self.breaks is None else FORMATS[self.breaks]

    @property
    def p_game_a(self) -> float | None:
        """P(A wins a game); None if it depends on who breaks."""
        return None if self.rack.break_matters else float(self.rack.p1)

    @property
    def difference(self) -> float:
        """A's rating minus B's; 0 if there are no ratings."""
        first, second = self.ratings or (0.0, 0.0)
        return first - second

    @property
    def error(self) -> float:
        """The standard error of the rating difference; 0 if ratings are treated as exact."""
        return math.hypot(*self.errors) if self.errors else 0.0

    @property
    def gap(self) -> Gap:
        """How much higher A is rated than B; without ratings, a game's log-odds."""
        from evenbreak.handicaps.charts.gap import Gap

        if self.scale is not None:
            return Gap(self.difference, self.error, self.scale, self.form)
        p = self.rack.p1
        return Gap(math.log(p) - math.log1p(-p), 0.0, Scale("log-odds", math.log(2.0)), self.form)

    @property
    def named(self) -> dict[str, Any]:
        """The names, levels and form, for JSON, if there are any."""
        a, b = self.names
        names: dict[str, Any] = {} if (a, b) == ("A", "B") else {"player_a": a, "player_b": b}
        if self.levels is not None:
            names |= {"level_a": self.levels[0], "level_b": self.levels[1]}
        if self.skills is not None:
            names |= {
                "levels_source": self.skills.source,
                "difference": self.difference,
                "difference_error": self.error or None,
            }
        return {**names, **({"form": self.form} if self.form else {})}

    @property
    def averaged(self) -> str:
        """The sentence that says what the chances are based on; '' if they are as stated."""
        if self.skills is not None:
            return joined([self.skills.why, _AVERAGED] if self.error else [self.skills.why])
        if not self.error:
            return ""
        return "All of this allows for rating uncertainty (\N{PLUS-MINUS SIGN})."

    @property
    def by_form(self) -> str:
        """The sentence saying that day-to-day form is allowed for; '' if it isn't."""
        if not self.form:
            return ""
        from evenbreak.answers.kit.scales import form_used_words

        return form_used_words(self.form, self.scale)

    @property
    def taken_as_right(self) -> str:
        """The sentence saying that ratings are treated as exact; '' if they aren't in doubt."""
        if self.skills is not None:
            return self.skills.why
        if not self.error:
            return ""
        return (
            "Both ratings are treated as exact here; evenbreak odds allows for their uncertainty."
        )

    def noted(self, answer: Answer) -> Answer:
        """Return an answer about them, adding what is assumed about them, if anything."""
        return replace(answer, warnings=[*answer.warnings, *filter(None, [self.assumed])])

    @property
    def doubts(self) -> list[str]:
        """Anything unusual about the ratings."""
        if self.skills is not None or self.ratings is None or self.scale is None:
            return []
        return two_ratings_doubts(self.scale, *self.ratings)

    @property
    def description(self) -> str:
        """Who they are, on one line."""
        a, b = self.names
        if self.skills is not None and self.levels is not None:
            of_chart = self.skills.chart.name
            return f"{a} level {self.levels[0]}, {b} level {self.levels[1]} of {of_chart}"
        if self.ratings is not None and self.scale is not None:
            first, second = (self._rating(k) for k in (0, 1))
            return f"{a} rated {first}, {b} rated {second}, {scale_words(self.scale)}"
        if self.breaks is None:
            return f"{a} wins a game with probability {self.rack.p1:g}"
        p1, p2 = self.rack.p1, self.rack.p2
        text = f"The breaker wins a game with probability {p1:g} ({a}) or {p2:g} ({b})"
        usual = 2 if self.breaks == "b" else 1
        always = self.breaks in ("a", "b")
        who = self.names["ab".index(self.breaks)] if always else self.breaks
        text += f"; {who} {'always breaks' if always else 'breaks'}"
        if self.first_breaker != usual or not always:
            text += f", {self.names[self.first_breaker - 1]} breaks first"
        return text

    def _rating(self, k: int) -> str:
        """Return a rating as text, with its error, if any."""
        if self.ratings is None or self.scale is None or self.errors is None:
            return f"{(self.ratings or (0.0, 0.0))[k]:g}"
        decimals = decimals_of(self.scale)
        error = f" \N{PLUS-MINUS SIGN} {self.errors[k]:.{decimals}f}" if self.errors[k] else ""
        return f"{self.ratings[k]:.{decimals}f}{error}"


def odds_answer(
    players: TwoPlayers, match: Match, *, exact: bool = False, via: Way | None = None
) -> Answer:
    """Return a match's chances and its length.

    The chances are averaged over the errors of listed ratings and over day-to-day form. `exact`
    adds the chances of winning as fractions, for players without ratings; `via` is for exact
    ratings.
    """
    odds = _odds(players, match) if via is None else match_odds(match, via=via)
    p_win = _exact_wins(match) if exact else ()
    a, b = players.names
    from_now = "_from_now" if any(match.score) else ""
    values = {
        "p_game_a": _p_game(players),
        "-p1": players.rack.p1 if players.p_game_a is None else None,
        "-p2": players.rack.p2,
        "p_win_a": odds.p_win_1,
        "p_win_b": odds.p_win_2,
        **{f"p_win_{who}_exact": str(p) for who, p in zip("ab", p_win, strict=False)},
        "p_never_ends" if odds.p_never_ends else "-p_never_ends": odds.p_never_ends,
        "mean_games": odds.mean_games,
        "sd_games": odds.sd_games,
        "games_p50": odds.games_p50,
        "match_p90": odds.games_p90,
        "p_hill_hill": odds.p_hill_hill,
        f"p_shutout_a{from_now}": odds.p_shutout_1,
        f"p_shutout_b{from_now}": odds.p_shutout_2,
        "scale": None if players.scale is None else players.scale.name,
    }
    return Answer(
        f"{players.description}\n{match_words(match, players.names)}",
        [
            _in_words(odds, match, players),
            *([_exact_words(p_win, players.names)] if exact else []),
            Quantities(quantities_of(values, a=a, b=b)),
            *_way(via, odds, match),
            *filter(None, [players.averaged, players.by_form]),
        ],
        warnings=players.doubts,
        data=players.named,
    )


def _exact_wins(match: Match) -> tuple[Fraction, Fraction]:
    from evenbreak.matches.win import win_probability

    p_1, p_2 = (win_probability(match, player=player, exact=True) for player in (1, 2))
    return p_1, p_2


def _exact_words(p_win: Iterable[Fraction], names: tuple[str, str]) -> str:
    lines = (f"{name} wins: {fraction_words(p)}" for name, p in zip(names, p_win, strict=True))
    return "\n".join(("The exact chances:", *lines))


def fraction_words(p: Fraction) -> str:
    """Return a fraction and its decimal form, cut off after 30 digits.

    >>> from fractions import Fraction
    >>> fraction_words(Fraction(297, 625))
    '297/625 = 0.4752'
    >>> fraction_words(Fraction(9, 13))
    '9/13 = 0.692307692307692307692307692307...'
    """
    from decimal import ROUND_DOWN, Context, Decimal, Inexact

    if p.denominator == 1:
        return str(p)
    context = Context(prec=30, rounding=ROUND_DOWN)
    decimal = context.divide(Decimal(p.numerator), Decimal(p.denominator))
    return f"{p} = {decimal:f}" + ("..." if context.flags[Inexact] else "")


def _odds(players: TwoPlayers, match: Match) -> MatchOdds:
    if players.scale is None or not (players.error or players.form):
        return match_odds(match, form=players.form)
    return players.gap.odds(match)


def _way(via: Way | None, odds: MatchOdds, match: Match) -> list[Part]:
    if via is None:
        return []
    from evenbreak.matches.endings import is_bounded

    # A match of two racks or more that ends has states that lead to each other, but not back.
    defective = is_bounded(match) and (odds.mean_games or 0.0) > 1.0
    names = [name for name in odds._fields if name.startswith("p_")]
    kernel = match_odds(match)
    return by_way(
        via,
        [(getattr(odds, name), getattr(kernel, name)) for name in names],
        note=DEFECTIVE if via == "eigen" and defective else "",
    )


def _p_game(players: TwoPlayers) -> float | None:
    """Return P(A wins a game), averaged like the odds; None if it depends on who breaks."""
    if not players.error or players.scale is None:
        return players.p_game_a
    p_game: float = players.gap.p_game
    return p_game


def _in_words(odds: MatchOdds, match: Match, players: TwoPlayers) -> str:
    a, b = players.names
    if (winner := match.decided(*match.score)) is not None:
        return f"{players.names[winner - 1]} has won the match."
    if odds.p_never_ends:
        if odds.p_never_ends == 1.0:
            return "The match never ends."
        return f"The match may never end; the chance of that is {chance(odds.p_never_ends)}."
    ours, theirs = odds.p_win_1, odds.p_win_2
    name, p, left = (a, ours, theirs) if ours >= theirs else (b, theirs, ours)
    text = f"{name} wins the match {percent(p, left)} of the time."
    if odds.mean_games is None or odds.games_p90 is None:
        return text
    length = decimals(1)(odds.mean_games) if odds.mean_games < 1e6 else games(odds.mean_games)
    more = " more" if any(match.score) else ""
    return (
        f"{text}\nIt lasts {length}{more} games on average, and 9 out of 10 such matches end "
        f"within {odds.games_p90:,}."
    )


def match_words(match: Match, names: tuple[str, str] = ("A", "B")) -> str:
    """Return what is played.

    >>> from evenbreak.games import Race, Rack
    >>> match_words(Race(3, 1, Race(3, 3, Rack(0.6)), score=(1, 0)))
    'Race 3:1 in sets of 3:3, score 1-0'
    """
    if isinstance(match, Ahead):
        a, b = names
        by = f"{match.m} ({a}) or {match.n} ({b})" if match.m != match.n else str(match.m)
        text = f"First to lead by {by}"
    else:
        text = f"Race {match.m}:{match.n}"
    if (win_by := getattr(match, "win_by", 1)) > 1:
        text += f", win by {win_by}"
    if isinstance(match.rack, Match):
        text += f" in sets of {match.rack.m}:{match.rack.n}"
    if any(match.score):
        text += f", score {tally(match.score)}"
    if (winner := match.decided(*match.score)) is not None:
        text += f": {names[winner - 1]} has won"
    return text


def races_for(players: TwoPlayers, asked: Fair) -> list[FairRace]:
    """Return the races requested by a question about two players, fairest first."""
    from evenbreak.handicaps.charts.fair import fair_races

    limits: Any = {**asked.lengths, "target": asked.target, "top": asked.top}
    if players.error or players.form:
        if players.scale is None:
            _refuse_without_odds(players, asked)
        return players.gap.nearest_races(**limits)
    return fair_races(
        players.rack,
        breaks=players.break_format,
        first_breaker=players.first_breaker,
        via=asked.via,
        **limits,
    )


def _refuse_without_odds(players: TwoPlayers, asked: Fair) -> None:
    """Reject chances that day-to-day form can't change, or about which it says nothing."""
    if players.p_game_a is None:
        asked.refuse("{form} doesn't allow for the break. Give {p}, or two ratings.")
    if players.p_game_a in (0.0, 1.0):
        asked.refuse("{form} changes nothing when {p} is {chance:g}. Leave it out.", chance=asked.p)


def fair_answer(
    players: TwoPlayers, races: Sequence[FairRace], *, target: float = 0.5, via: Way | None = None
) -> Answer:
    """Return races found by `fair_races`, closest to the target first."""
    a, b = players.names
    rows = [
        (race.race_1, race.race_2, race.p_win_1, race.mean_games, race.games_p90) for race in races
    ]
    m, n, p_win, mean, _ = rows[0]
    wish = "fairest race" if target == 0.5 else f"race closest to {percent(target)} for {a}"
    return Answer(
        players.description,
        [
            f"The {wish} is {m}:{n}. {a} wins it {percent(p_win)} of the time, and it lasts "
            f"{mean:.1f} games on average.",
            Table("races", columns_of("race_a race_b wins_a mean_games games_p90", a=a, b=b), rows),
            *_fair_way(via, players, races),
            *filter(None, [players.averaged, players.by_form]),
        ],
        warnings=players.doubts,
        data={"target": target, **players.named},
    )


def _fair_way(via: Way | None, players: TwoPlayers, races: Sequence[FairRace]) -> list[Part]:
    if via is None:
        return []
    from evenbreak.matches.win import win_probability

    order: dict[str, Any] = {"breaks": players.break_format, "first_breaker": players.first_breaker}
    kernel = [
        win_probability(Race(race.race_1, race.race_2, players.rack, **order)) for race in races
    ]
    pairs = zip([race.p_win_1 for race in races], kernel, strict=True)
    long = any(race.race_1 + race.race_2 > 2 for race in races)
    return by_way(via, pairs, note=DEFECTIVE if via == "eigen" and long else "")
