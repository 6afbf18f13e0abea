"""Whether a league can trust its ratings: the verdict, and anything else worth acting on."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.scales import form_used_words
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.answers.league.prior import evidence_rows, groups_warnings, levels_data
from evenbreak.answers.league.validate_findings import details, findings_table
from evenbreak.answers.league.validate_handicaps import (
    UNLIKELY,
    VAGUE,
    clearly_off,
    handicap_remarks,
    more_or_less,
    points_text,
    scored_of,
    share_of,
    span_of,
    starts_way,
    wrong_chances,
)
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validation.advantages import FEWEST_ON_A_DATE
from evenbreak.ratings.validation.validate import Validation
from evenbreak.words import joined, listed, say


def validate_answer(
    file: ResultsFile,
    found: Validation,
    scale: Scale,
    *,
    seed: int = 1,
    chart: LeagueChart | None = None,
) -> Answer:
    """Return whether a league can trust its ratings.

    Parameters
    ----------
    file, found
        the results, and the findings from `validate`.
    scale
        the scale for priors given in points.
    seed
        the seed for intervals and simulated seasons.
    chart
        the findings of `league_chart` for the same results.

    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, scale_of, validate
    >>> season = Results.from_names(["Ann"] * 3, ["Bo"] * 3, [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> file = ResultsFile(season, "r.csv", (), (), "")
    >>> print(validate_answer(file, validate(season), scale_of("npl")).sentences[0])
    There are too few matches to say whether these ratings can be trusted.
    """
    chart = chart or LeagueChart()
    text = verdict(found, scale, chart)
    parts: list[Part] = [text, _games(found), *remarks(found, scale, chart)]
    parts += filter(None, [form_used_words(found.forecasts.form, scale)])
    return Answer(
        _heading(file, found),
        parts,
        details=list(details(found, scale)),
        warnings=[*file.warnings, *file.ties, *groups_warnings(file, found.choice)],
        data={
            "verdict": text,
            "rows_left_out": file.skipped,
            **_figures(found, scale),
            **_chart(chart),
            "seed": seed,
        },
        csv=findings_table(found, chart),
    )


def _heading(file: ResultsFile, found: Validation) -> str:
    forecasts = found.forecasts
    forfeits = count_of(forecasts.forfeits, "forfeit")
    left = {
        f"{forecasts.undated:,} without a date": forecasts.undated,
        forfeits: forecasts.forfeits,
        f"{forecasts.empty:,} at 0-0": forecasts.empty,
        f"{forecasts.unscored:,} without scores": forecasts.unscored,
        count_of(file.skipped, "bad row"): file.skipped,
    }
    out = ", ".join(words for words, count in left.items() if count)
    return (
        f"{file.source}: {count_of(len(forecasts), 'match', 'matches')} on "
        f"{count_of(_dates(found), 'date')}, each date predicted from the earlier ones"
        + (f" (left out: {out})" if out else "")
    )


def _dates(found: Validation) -> int:
    return int(found.forecasts.date_of[-1]) + 1


def _games(found: Validation) -> Table:
    """Return how often favorites won games, compared with their predicted chances."""
    columns = columns_of("predicted games seen_percent range_percent")
    rows = [(row.predicted, row.games, row.seen, (row.low, row.high)) for row in found.games]
    title = (
        "How often favorites won single games. The ratings are right where the prediction is "
        "within the range."
    )
    return Table("", columns, rows, title)


def _figures(found: Validation, scale: Scale) -> dict[str, Any]:
    """Return the JSON data other than the findings."""
    forecasts = found.forecasts
    return {
        "matches_read": len(forecasts),
        "dates": _dates(found),
        **{name: getattr(forecasts, name) for name in _LEFT_OUT},
        "newcomers": int(forecasts.new.sum()),
        "prior_sd": found.prior_sd,
        "prior_points": found.prior_sd * scale.points_per_log_odds,
        "half_life": forecasts.half_life,
        **_choice(found),
        "group_effects": levels_data(replace(found.ratings, scale=scale), found.choice),
        "evidence": evidence_rows(found.choice),
        **{name: getattr(found, name) for name in _AS_FOUND},
    }


def _choice(found: Validation) -> dict[str, Any]:
    """Return how the prior was chosen; each figure is None if the prior was given."""
    choice = found.choice
    if choice is None:
        return {"priors": [], **dict.fromkeys(_OF_CHOICE)}
    tried = zip(choice.tried, choice.log_loss, strict=True)
    figures = choice.learned, [choice.low, choice.high], choice.as_it_went
    return {
        "priors": [{"prior_sd": sd, "log_loss": loss} for sd, loss in tried],
        **dict(zip(_OF_CHOICE, figures, strict=True)),
    }


def _chart(chart: LeagueChart) -> dict[str, Any]:
    """Return the chart that the races come from, and the scale that fits the results."""
    return {"chart": chart.nearest, "fair_scale": chart.scale}


_OF_CHOICE = ("prior_learned", "prior_range", "log_loss_as_it_went")
_LEFT_OUT = ("undated", "forfeits", "empty", "unscored")
_AS_FOUND = (
    *("scored", "usual", "games", "matches", "matches_plug_in", "spots", "gain", "toss_ups"),
    *("skill", "form", "dispersion", "streaks", "side", "first_column", "breaker", "first_breaks"),
    *("half_lives", "lengths", "experience", "starts", "drawn"),
)


# The verdict: a sentence or two that say what to do.

TOO_SPREAD = 1.5
"""Match odds shouldn't be used if scores vary by at least this many times the expected amount."""

PLENTY = 100.0
"""The average number of games per player needed for strengths to show differences."""


def verdict(found: Validation, scale: Scale, chart: LeagueChart | None = None) -> str:
    """Return whether the ratings can be trusted, and what to do."""
    slope = scored_of(found, "game").slope
    if found.skill.low <= 0.0 or slope is None:
        return _no_skill(found, slope, scale)
    faults = list(_faults(found, chart))
    wrong = wrong_chances(found.scored, found)
    if wrong:
        more = f" Also, {listed(faults)}." if faults else ""
        return _do_not(found, wrong, scale) + more
    spread = found.dispersion
    if spread is not None and spread.p_value < UNLIKELY:
        times = spread.seen / spread.by_chance
        if times > TOO_SPREAD:
            return f"{_good_and_bad_days(times)} {_NOT_CORRECTED}"
    default = _default_is_wrong(found, scale)
    if faults:
        held = f"You can trust the ratings for single games, but {listed(faults)}."
    elif slope.high - slope.low > VAGUE:
        held = (
            "Nothing suggests that the ratings are wrong, but there are too few matches to be sure."
        )
    else:
        held = "You can trust these ratings: players win as often as they predict."
    return f"{held} {default}" if default else held


def _no_skill(found: Validation, slope: Estimate | None, scale: Scale) -> str:
    season = found.forecasts.results
    players = {*season.player_a.tolist(), *season.player_b.tolist()}
    games_each = 2.0 * float(found.forecasts.games.sum()) / len(players)
    turned = slope is not None and clearly_off(slope, 0.0) < 0
    plenty = games_each >= PLENTY and found.skill.low <= 0.0 and not turned
    if plenty and found.choice is None:
        return say(
            "With a prior of {points} points, the ratings predict no better than a coin toss. "
            "Leave {prior} out to find the best one.",
            points=points_text(found.prior_sd, scale),
        )
    if plenty:
        return (
            "The ratings predict no better than a coin toss: these players are too equal for "
            "ratings to separate them."
        )
    if found.skill.high < 0.0:
        return "Do not trust these ratings: for this league they predict worse than a coin toss."
    return "There are too few matches to say whether these ratings can be trusted."


def _too_sure(wrong: Mapping[str, int]) -> str:
    """Return which favorites win too little or too often.

    >>> _too_sure({"game": -1, "match": -1})
    'favorites win games and matches less often than predicted'
    """
    plural = {"game": "games", "match": "matches"}
    if len(set(wrong.values())) == 1:
        often = more_or_less(next(iter(wrong.values())) > 0)
        return f"favorites win {listed([plural[of] for of in wrong])} {often} often than predicted"
    return "favorites win " + listed(
        [f"{plural[of]} {more_or_less(way > 0)} often than predicted" for of, way in wrong.items()]
    )


def _do_not(found: Validation, wrong: Mapping[str, int], scale: Scale) -> str:
    if found.choice is None:
        size = "smaller" if -1 in wrong.values() else "larger"
        return say(
            "Don't use a prior of {points} points: {why}. Use a {size} {prior}, or leave it out "
            "to find the best one.",
            points=points_text(found.prior_sd, scale),
            why=_too_sure(wrong),
            size=size,
        )
    even = "even with the best prior"
    if not found.choice.learned:
        even = "and there are too few results to choose a better prior"
    text = f"Do not take the chances at face value: {_too_sure(wrong)}, {even}."
    return f"{text} {_NOT_CORRECTED}"


_NOT_CORRECTED = "No command corrects this."


def _good_and_bad_days(times: float) -> str:
    return (
        f"Do not rely on the chances of whole matches: scores vary {times:.1f} times as much as "
        "expected."
    )


def _default_is_wrong(found: Validation, scale: Scale) -> str:
    """Return what the default prior would do, if it is clearly wrong; otherwise ''."""
    wrong = wrong_chances(found.usual, found)
    if not wrong or found.choice is None or found.prior_sd == PRIOR_SD:
        return ""
    use, default = (points_text(sd, scale) for sd in (found.prior_sd, PRIOR_SD))
    return say(
        "All of this is for a prior of {use} points, which rate and report use too if {prior} is "
        "left out. With a prior of {default} points, {why}.",
        use=use,
        default=default,
        why=_too_sure(wrong),
    )


def _faults(found: Validation, chart: LeagueChart | None) -> Iterator[str]:
    """Yield the evidence against the model behind the ratings."""
    spread, runs, first = found.dispersion, found.streaks, found.first_breaks
    if spread is not None and spread.p_value < UNLIKELY:
        yield f"match scores vary {more_or_less(spread.seen > spread.by_chance)} than expected"
    if runs is not None and runs.p_value < UNLIKELY:
        yield (
            "games are won in streaks" if runs.z < 0 else "wins alternate more often than by chance"
        )
    if first is not None and first.p_value < UNLIKELY:
        more = more_or_less(first.won > first.expected)
        yield f"players who break first win {more} often than predicted"
    if found.breaker is not None and (way := clearly_off(found.breaker, 0.0)):
        yield f"the breaker has {'an advantage' if way > 0 else 'a disadvantage'}"
    if found.spots:
        share = share_of(found.spots[-1])
        if way := clearly_off(share, 0.5) or starts_way(found, chart):
            yield f"the handicaps give too {'little' if way > 0 else 'much'}"
        if way := clearly_off(share, found.spots[-1].expected):
            yield f"players who give games win {more_or_less(way > 0)} often than predicted"


# What there is to say besides the verdict.


def remarks(found: Validation, scale: Scale, chart: LeagueChart | None = None) -> list[str]:
    """Return what there is to say about handicaps, newcomers and the order of the columns."""
    chart = chart or LeagueChart()
    every = (*handicap_remarks(found, chart, scale), *_lengths(found), _newcomers(found, scale))
    texts = [text for text in (*every, _first_column(found)) if text]
    if chart.scale is None and any(" points" in text for text in texts):
        texts.append(
            say(
                "Here {points:.4g} points double the odds of winning a game; to change that, "
                "use {scale}.",
                points=scale.points_per_doubling,
            )
        )
    return texts


def _lengths(found: Validation) -> Iterator[str]:
    """Yield the races that favorites win more or less often than predicted."""
    for half, of in zip(found.lengths, ("shorter", "longer"), strict=False):
        share = Estimate(half.share, half.low, half.high)
        if way := clearly_off(share, half.predicted, tests=len(found.lengths)):
            yield (
                f"In the {of} races ({span_of(half)} games), favorites win "
                f"{more_or_less(way > 0)} often than predicted: {percent(half.share)} of "
                f"{half.matches:,} ({percent(half.predicted)} predicted)."
            )


def _newcomers(found: Validation, scale: Scale) -> str:
    """Return which inexperienced players a given prior gets wrong, and the remedy; otherwise ''.

    Players start where the prior puts them, and stay near there for their first games. The best
    prior already includes the best start for newcomers, so nothing is left to improve.
    """
    if found.choice is not None:
        return ""
    for one in found.experience:
        way = clearly_off(one.stronger, 0.0, tests=len(found.experience))
        if way and one.most is not None:
            who = "before their first game"
            if one.most:
                who = f"after {one.fewest} to {one.most} games"
            text = (
                f"Players are {'under' if way > 0 else 'over'}rated {who}: against more "
                f"experienced opponents they won {percent(one.seen)} of their games "
                f"({percent(one.predicted)} predicted), as if they were "
                f"{abs(one.stronger.value) * scale.points_per_log_odds:.0f} points "
                f"{'stronger' if way > 0 else 'weaker'} than rated."
            )
            remedy = say(
                "Leave {prior} out: finding the best one also finds where newcomers start."
            )
            return joined([text, remedy])
    return ""


def _first_column(found: Validation) -> str:
    """Return why players in the first column win more or less than predicted; '' if they don't."""
    column = found.first_column
    if column is None:
        return ""
    won = f"Players in the first column won {percent(column.won / column.matches)} of the matches"
    if column.winners_first:
        return f"{won}: the file seems to list winners first. That does not change the ratings."
    if column.winners_first_on_some_dates:
        return (
            f"On {column.dates_won:,} of {count_of(column.dates, 'date')} with "
            f"{FEWEST_ON_A_DATE} matches or more, the player in the first column won every match: "
            "the file seems to list winners first there. That does not change the ratings."
        )
    way = 0 if found.side is None else clearly_off(found.side, 0.0)
    if not way:
        return ""
    said = f"{won} ({percent(column.expected / column.matches)} predicted)."
    if column.varies < UNLIKELY:
        return (
            f"{said} This differs too much from date to date to be an advantage, so it shows only "
            "how the file was written."
        )
    if way == column.stronger_first:
        place = "first" if way > 0 else "second"
        return (
            f"{said} The file tends to list the stronger player {place}, so this is hardly an "
            "advantage."
        )
    player = "home player" if way > 0 else "visitor"
    return (
        f"{said} If the first column is the {player}, it may be home advantage, which the "
        f"ratings don't account for. If the order has no meaning, ignore it."
    )
