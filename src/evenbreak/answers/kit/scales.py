"""Scales in words, warnings about a scale, and how much players vary from match to match."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.parts import Show
from evenbreak.answers.kit.wording import percent, some_of
from evenbreak.ratings.scale import NAMES, SCALES, Scale
from evenbreak.words import Figure, Parameter, Sentence, say, say_count

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from evenbreak.ratings.fitted import DayForm
    from evenbreak.ratings.results import Results
    from evenbreak.ratings.roster import Roster


LIKE = {
    "npl": say("an NPL-like scale"),
    "fargo": say("a Fargo-like scale"),
    "elo": say("an Elo-like scale"),
}


def scale_words(scale: Scale) -> str:
    """Return the scale of given ratings.

    >>> from evenbreak.ratings import scale_of
    >>> scale_words(scale_of("fargo"))
    'on the Fargo scale (100 points double the odds)'
    """
    name = NAMES.get(scale.name, scale.name)
    return say("on the {scale} scale ({points})", scale=name, points=_points(scale))


def like_scale_words(scale: Scale) -> str:
    """Return the scale of estimated ratings: similar to a named scale, but never the same one.

    >>> from evenbreak.ratings import scale_of
    >>> like_scale_words(scale_of("fargo"))
    'a Fargo-like scale (100 points double the odds)'
    >>> like_scale_words(scale_of(50))
    'a scale of its own (50 points double the odds)'
    """
    like = LIKE.get(scale.name) or say("a scale of its own")
    return say("{scale} ({points})", scale=like, points=_points(scale))


def _points(scale: Scale) -> Sentence:
    return say("{points:.6g} points double the odds", points=scale.points_per_doubling)


def decimals_of(scale: Scale) -> int:
    """Return how many decimals a rating needs: about a hundredth of a doubling.

    >>> from evenbreak.ratings import scale_of
    >>> decimals_of(scale_of("npl")), decimals_of(scale_of("fargo"))
    (1, 0)
    """
    return max(0, 2 - math.floor(math.log10(scale.points_per_doubling)))


def points_on(scale: Scale, sign: str = "") -> Show:
    """Return how to show a rating on a scale; with the sign "+", how to show a change.

    >>> from evenbreak.ratings import scale_of
    >>> points_on(scale_of("npl"))(81.26), points_on(scale_of("fargo"), "+")(12.4)
    ('81.3', '+12')
    """
    spec = f"{sign}.{decimals_of(scale)}f"
    return lambda value: Figure(value, spec)


def game_chance(scale: Scale) -> str:
    """Return what a rating difference means, as a formula."""
    return (
        "a player rated d points higher wins a game with probability "
        f"1/(1 + 2^(\N{MINUS SIGN}d/{scale.points_per_doubling:.6g}))"
    )


USUAL = {"npl": (20, 130), "fargo": (200, 850)}
"""Where most of a scale's ratings are."""

FAR = 3.0
"""In doublings of the odds: a league's average is closer than this to its scale's middle."""

SCALE_OFF = 0.25
"""How much a chart's best-fitting scale may differ from the ratings' scale."""

APART = 6.0
"""In doublings of the odds: every player is closer than this to the league's average (64 games to
1)."""


AGAINST = 10.0
"""How much likelier results must be on another scale, as a logarithm: 22,000 times."""


def contradiction(scale: Scale, roster: Roster, results: Results) -> str:
    """Return what results say against the scale of the ratings before them; '' if nothing.

    The games are compared with what the rating differences mean on each known scale. On a scale
    with too few points per doubling, everyone who is ahead is a clear favorite, and players who
    don't win like one look like sandbaggers.

    >>> from evenbreak.ratings import SCALES, Results, Roster
    >>> listed = Roster(["Ann", "Bo"], [540, 450])
    >>> season = Results.from_names(["Ann"] * 20, ["Bo"] * 20, [5] * 20, [3, 2] * 10)
    >>> contradiction(SCALES["fargo"], listed, season)
    ''
    >>> contradiction(SCALES["npl"], listed, season)
    "the results don't fit NPL ratings: the higher-rated player won 67% of the games, but NPL
    ratings predict 89%, and Fargo ratings predict 65%"
    """
    import numpy as np

    rated = dict(zip(roster.players, roster.rating.tolist(), strict=True))
    rating = np.array([rated.get(name, np.nan) for name in results.players])
    ahead = rating[results.player_a] - rating[results.player_b]
    known = ~np.isnan(ahead) & (ahead != 0.0)
    turn, ahead = ahead[known] < 0.0, np.abs(ahead[known])
    games = results.score_a[known], results.score_b[known]
    won, lost = np.where(turn, games[::-1], games)
    if not won.sum() + lost.sum():
        return ""

    def likelihood(one: Scale) -> float:
        return float(
            won @ np.log(one.win_probability(ahead)) + lost @ np.log(one.win_probability(-ahead))
        )

    def share(one: Scale) -> str:
        return percent(float(one.win_probability(ahead) @ (won + lost) / (won + lost).sum()))

    other = max(SCALES.values(), key=likelihood)
    if likelihood(other) - likelihood(scale) < AGAINST:
        return ""
    own, name = NAMES.get(scale.name, scale.name), NAMES[other.name]
    seen = percent(float(won.sum() / (won + lost).sum()))
    return say(
        "the results don't fit {own} ratings: the higher-rated player won {seen} of the games, "
        "but {own} ratings predict {expected}, and {other} ratings predict {likelier}",
        own=own,
        expected=share(scale),
        other=name,
        likelier=share(other),
        seen=seen,
    )


def two_ratings_doubts(scale: Scale, *ratings: float) -> list[str]:
    """Return a warning if these ratings look like another scale's.

    Only their difference counts, so someone may enter it as one rating, with 0 as the other.

    >>> from evenbreak.ratings import SCALES
    >>> two_ratings_doubts(SCALES["npl"], 612, 521)
    ['most NPL ratings are between 20 and 130; for Fargo ratings, set scale to fargo']
    >>> two_ratings_doubts(SCALES["fargo"], 1750, 1612)
    ['most Fargo ratings are between 200 and 850; for Elo ratings, set scale to elo']
    """
    if scale.name in USUAL and max(ratings) > 1000:
        other = "elo"
    elif scale.name == "npl" and max(ratings) > 200:
        other = "fargo"
    elif scale.name == "fargo" and 0 < min(ratings) <= max(ratings) < 150:
        other = "npl"
    else:
        return []
    low, high = USUAL[scale.name]
    return [
        say(
            "most {scale} ratings are between {low} and {high}; for {other} ratings, set {option} "
            "to {name}",
            scale=NAMES[scale.name],
            low=low,
            high=high,
            other=NAMES[other],
            option=Parameter("scale"),
            name=other,
        )
    ]


def league_doubts(
    scale: Scale, ratings: ArrayLike, remedy: str, names: Sequence[str] = ()
) -> list[str]:
    """Return a warning for each unusual thing in a league's ratings (NaN: unrated).

    `remedy` is what to do if they belong to another scale.
    """
    import numpy as np

    given = np.asarray(ratings, dtype=float)
    known = given[~np.isnan(given)]
    if not len(known):
        return []
    doubts = []
    middle = float(np.median(known))  # one slip makes no other scale
    if scale.center and abs(middle - scale.center) > FAR * scale.points_per_doubling:
        doubts.append(
            say(
                "{scale} ratings average about {usual:g}, but these average about {middle:.0f}; "
                "{remedy}",
                scale=NAMES.get(scale.name, scale.name),
                usual=scale.center,
                middle=middle,
                remedy=remedy,
            )
        )
    return doubts + far_doubts(scale, given, names)


def far_doubts(scale: Scale, ratings: ArrayLike, names: Sequence[str] = ()) -> list[str]:
    """Return a warning if ratings (NaN: none) are very far from the others, as after a typo.

    >>> from evenbreak.ratings import SCALES
    >>> far_doubts(SCALES["fargo"], [580, 5800, 612], ["Ann", "Bo", "Cy"])
    ['1 of 3 ratings (Bo: 5800) is more than 600 points from the median of 612; are they all on the
    same scale?']
    """
    import numpy as np

    given = np.asarray(ratings, dtype=float)
    known = given[~np.isnan(given)]
    edge = APART * scale.points_per_doubling
    middle = float(np.median(known)) if len(known) else 0.0
    far = np.flatnonzero(np.abs(given - middle) > edge)
    apart = len(far)
    if not apart:
        return []
    values = {"all": len(known), "edge": edge, "middle": middle}
    if not names:
        return [
            say_count(
                "{n} of {all:,} ratings is more than {edge:.0f} points from the median of "
                "{middle:.0f}; are they all on the same scale?",
                "{n:,} of {all:,} ratings are more than {edge:.0f} points from the median of "
                "{middle:.0f}; are they all on the same scale?",
                apart,
                **values,
            )
        ]
    named = some_of(
        [say("{name}: {rating:g}", name=names[k], rating=given[k]) for k in far.tolist()]
    )
    return [
        say_count(
            "{n} of {all:,} ratings ({named}) is more than {edge:.0f} points from the median of "
            "{middle:.0f}; are they all on the same scale?",
            "{n:,} of {all:,} ratings ({named}) are more than {edge:.0f} points from the median of "
            "{middle:.0f}; are they all on the same scale?",
            apart,
            named=named,
            **values,
        )
    ]


def starter_doubts(scale: Scale, ratings: ArrayLike) -> list[str]:
    """Return a warning if the scale's middle, where new players (NaN) start, is far from all."""
    import numpy as np

    known = np.asarray(ratings, dtype=float)
    rated = known[~np.isnan(known)]
    if not 0 < len(rated) < len(known):
        return []
    least, most, edge = rated.min(), rated.max(), scale.points_per_doubling
    if least - edge <= scale.center <= most + edge:
        return []
    return [
        say(
            "new players start at {start:g}, the middle of the {scale} scale, but the other "
            "ratings range from {least:g} to {most:g}. Set the rating of a new player with "
            "{starter}.",
            start=scale.center,
            scale=NAMES.get(scale.name, scale.name),
            least=least,
            most=most,
            starter=Parameter("starter"),
        )
    ]


def chart_doubts(chart: Any, scale: Scale) -> list[str]:
    """Return a warning if a chart's races fit a different scale than the ratings'.

    Only charts of rating differences are checked.
    """
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.handicaps.charts.chart import Chart

    if not isinstance(chart, Chart):
        return []
    best, own = audit(chart, scale=scale).best_fit, scale.points_per_doubling
    if best is None or abs(best.points_per_doubling / own - 1.0) <= SCALE_OFF:
        return []
    return [
        say(
            "the races in {chart} fit a scale on which about {points:.0f} points double the "
            "odds, but on the scale used here {own:.4g} points do. Make sure that it's the "
            "chart for these ratings.",
            chart=chart.name,
            points=best.points_per_doubling,
            own=own,
        )
    ]


def form_words(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield the effect of day-to-day form, if there is evidence of it.

    >>> from evenbreak.ratings.estimates import Estimate
    >>> from evenbreak.ratings.fitted import DayForm
    >>> from evenbreak.ratings import SCALES
    >>> print(*form_words(DayForm(Estimate(0.12, 0.06, 0.18), 900), SCALES["npl"]))
    Day-to-day form: from match to match the difference in strength between two players
    varies by 15 ± 2 points, so sweeps are likelier and hill-hill games rarer than ratings alone
    would suggest. This list of ratings includes that figure (0.35 in log-odds). The errors on the
    list allow for it, and so do the commands odds, fair, live and matchups.
    """
    if form is None or not form.established:
        return
    points, error = scale.points(form.sd), scale.points(form.sd_error)
    yield (
        f"Day-to-day form: from match to match the difference in strength between two players "
        f"varies by {points:.0f} ± {error:.0f} points, so sweeps are likelier and hill-hill "
        "games rarer than ratings alone would suggest. This list of ratings includes that figure "
        f"({form.sd:.2f} in log-odds). The errors on the list allow for it, and so do the "
        f"commands odds, fair, live and matchups."
    )


def form_details(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield the findings about day-to-day form, with its interval."""
    if form is None:
        return
    v, low, high = form.variance
    end = "The effect is clear." if form.established else "It may be luck, so it isn't used."
    yield (
        f"Day-to-day form, estimated from {form.races:,} matches, each compared with the ratings "
        f"from all others: a standard deviation of {scale.points(form.sd):.1f} points (variance "
        f"{v:.3f} in squared log-odds, 95% interval {low:.3f} to {high:.3f}). {end}"
    )


def form_used_words(form: float, scale: Scale | None = None) -> str:
    """Return the sentence that an answer allows for day-to-day form; '' if there is none.

    >>> form_used_words(0.35)
    'Day-to-day form is allowed for: from match to match the log-odds of a game vary by 0.35.'
    """
    if not form:
        return ""
    if scale is None:
        return (
            "Day-to-day form is allowed for: from match to match the log-odds of a game vary by "
            f"{form:g}."
        )
    return (
        f"Day-to-day form is allowed for: from match to match the difference in strength "
        f"between two players varies by {scale.points(form):.0f} points."
    )


def form_data(form: DayForm | None) -> dict[str, Any] | None:
    """Return day-to-day form for JSON, in log-odds."""
    if form is None:
        return None
    variance, low, high = form.variance
    return {
        "sd": form.sd,
        "sd_standard_error": form.sd_error if form.sd else None,
        "variance": variance,
        "variance_low": low,
        "variance_high": high,
        "matches": form.races,
        "established": form.established,
    }
