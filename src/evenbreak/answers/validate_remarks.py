"""What a validated season shows besides the verdict, each in a sentence or two."""

from collections.abc import Iterator
from dataclasses import replace

from evenbreak.answers.kit.wording import count_of, listed, percent
from evenbreak.answers.league.prior import level_words, too_few_for_prior_words
from evenbreak.answers.validate_handicaps import handicap_remarks
from evenbreak.answers.validate_judgement import (
    UNLIKELY,
    any_winner_breaks,
    best_half_life,
    clearly_off,
)
from evenbreak.handicaps.charts.fair_scale import LeagueChart
from evenbreak.ratings.advantages import FEWEST_ON_A_DATE
from evenbreak.ratings.calibration import Estimate
from evenbreak.ratings.race_fairness import RaceLengths
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.validate import Validation


def remarks(found: Validation, scale: Scale, chart: LeagueChart | None = None) -> list[str]:
    """Return what there is to say about handicaps, scores, half-life, columns and the prior."""
    chart = chart or LeagueChart()
    levels = level_words(replace(found.ratings, scale=scale), found.choice)
    said = [
        *handicap_remarks(found, chart, scale),
        *(_spread(found, scale), *levels),
        *(_experience(found, scale), _half_life(found), _first_column(found)),
    ]
    texts = [text for text in (*said, _prior(found, scale)) if text]
    if chart.scale is None and any(" points" in text for text in texts):
        texts.append(
            f"Points are such that {scale.points_per_doubling:.4g} double the odds of winning a "
            "game; --scale sets others."
        )
    return texts


def _spread(found: Validation, scale: Scale) -> str:
    """Return why scores vary more than they should, '' where they do not."""
    form = _form(found, scale)
    test = found.dispersion
    if test is None or test.p_value >= UNLIKELY or test.seen <= test.by_chance:
        return form
    more = 100.0 * (test.seen / test.by_chance - 1.0)
    causes = ["players have good and bad days"]
    if best_half_life(found):
        causes.append("the ratings lag behind")
    if any_winner_breaks(found):
        causes.append("the break is strong under winner breaks")
    if found.spots and not found.forecasts.levels.race:
        causes.append("the handicaps know more than these ratings")
    text = f"Match scores vary {more:.0f}% more than expected. Perhaps {listed(causes, 'or')}."
    return " ".join([text, *([form] if form else []), *_lengths(found)])


def _form(found: Validation, scale: Scale) -> str:
    """Return what form of the day means for scores, '' where it is not established."""
    form = found.form
    if form is None or not form.established:
        return ""
    deciders, sweeps, _ = form.shapes
    if not (deciders.nearer and sweeps.nearer):
        return ""  # scores vary for another reason, such as handicaps that the ratings do not know
    points = form.sd * scale.points_per_log_odds
    shares = [
        f"{percent(shape.seen.value)} {words} ({percent(shape.said)} expected without this, "
        f"{percent(shape.said_with_form)} with it)"
        for shape, words in (
            (deciders, "of the matches went to the last game"),
            (sweeps, "were sweeps"),
        )
    ]
    return (
        f"From match to match the difference between two players varies by about {points:.0f} "
        f"points around that of their ratings. {listed(shares)}."
    )


def _lengths(found: Validation) -> Iterator[str]:
    """Yield how often favourites won short races and long ones, where there are both."""
    if not found.lengths:
        return
    short, long = found.lengths
    shares = [
        f"{percent(half.share)} of the {races} ({percent(half.predicted)} predicted)"
        for half, races in ((short, f"races to {short.longest} or less"), (long, "longer ones"))
    ]
    ways = {"short": _way(short), "long": _way(long)}
    if not any(ways.values()):
        yield (
            "Short and long races are predicted about equally well: favourites won "
            f"{listed(shares)}."
        )
        return
    yield f"Favourites won {listed(shares)}."
    for races, way in ways.items():
        if way:
            yield f"So {races} races are {'more' if way > 0 else 'less'} certain than predicted."


def _way(half: RaceLengths) -> int:
    """Return 1 where favourites clearly won more than predicted, -1 where less, else 0."""
    return clearly_off(Estimate(half.share, half.low, half.high), half.predicted)


def _experience(found: Validation, scale: Scale) -> str:
    """Return which players with little experience are overrated or underrated, '' if none are."""
    for one in found.experience:
        way = clearly_off(one.stronger, 0.0, tests=len(found.experience))
        if way and one.most is not None:
            who = "before their first game"
            if one.most:
                who = f"after {one.fewest} to {one.most} games"
            return (
                f"Players are {'under' if way > 0 else 'over'}rated {who}: against more "
                f"experienced opponents they won {percent(one.seen)} of their games "
                f"({percent(one.predicted)} predicted), as if they were "
                f"{abs(one.stronger.value) * scale.points_per_log_odds:.0f} points "
                f"{'stronger' if way > 0 else 'weaker'} than rated."
            )
    return ""


def _half_life(found: Validation) -> str:
    """Return which half-life to use, '' where none clearly helps."""
    used = found.forecasts.half_life
    if found.half_lives and used is not None:
        return (
            f"Old games count less, because later ones are then predicted better: a match counts "
            f"half after {used:g} days. rate and report find this by themselves."
        )
    days = best_half_life(found)
    if days is None:
        return ""
    return (
        f"Use --half-life {days:g} with rate and report: where old games count less, later ones "
        "are predicted better."
    )


def _first_column(found: Validation) -> str:
    """Return why players in the first column win more or less than predicted, '' if they do not."""
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
        f"{said} If the first column is the {player}, it may be home advantage, which the ratings "
        "do not know. If the order has no meaning, ignore it."
    )


def _prior(found: Validation, scale: Scale) -> str:
    """Return that there are too few results to choose a prior, '' where there are enough."""
    choice = found.choice
    return "" if choice is None or choice.learnt else too_few_for_prior_words(choice, scale)
