"""Scales in words, doubts about a scale, and how much players vary from match to match."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.parts import Show
from evenbreak.answers.kit.wording import percent, some_of
from evenbreak.ratings.scale import NAMES, SCALES, Scale

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from evenbreak.ratings.fitted import DayForm
    from evenbreak.ratings.results import Results
    from evenbreak.ratings.roster import Roster


LIKE = {"npl": "an NPL-like scale", "fargo": "a Fargo-like scale", "elo": "an Elo-like scale"}


def scale_words(scale: Scale) -> str:
    """Return the scale of given ratings.

    >>> from evenbreak.ratings import scale_of
    >>> scale_words(scale_of("fargo"))
    'on the Fargo scale (100 points double the odds)'
    """
    return f"on the {NAMES.get(scale.name, scale.name)} scale ({_points(scale)})"


def like_scale_words(scale: Scale) -> str:
    """Return the scale of estimated ratings: like a named one, but never that one itself.

    >>> from evenbreak.ratings import scale_of
    >>> like_scale_words(scale_of("fargo"))
    'a Fargo-like scale (100 points double the odds)'
    >>> like_scale_words(scale_of(50))
    'a scale of its own (50 points double the odds)'
    """
    return f"{LIKE.get(scale.name, 'a scale of its own')} ({_points(scale)})"


def _points(scale: Scale) -> str:
    return f"{scale.points_per_doubling:.6g} points double the odds"


def decimals_of(scale: Scale) -> int:
    """Return how many decimals of a rating a person needs: about a hundredth of a doubling.

    >>> from evenbreak.ratings import scale_of
    >>> decimals_of(scale_of("npl")), decimals_of(scale_of("fargo"))
    (1, 0)
    """
    return max(0, 2 - math.floor(math.log10(scale.points_per_doubling)))


def points_on(scale: Scale, sign: str = "") -> Show:
    """Return how a rating on a scale is shown; with the sign "+", how a change of it is.

    >>> from evenbreak.ratings import scale_of
    >>> points_on(scale_of("npl"))(81.26), points_on(scale_of("fargo"), "+")(12.4)
    ('81.3', '+12')
    """
    return f"{{:{sign}.{decimals_of(scale)}f}}".format


def game_chance(scale: Scale) -> str:
    """Return what a rating difference means, as a formula."""
    return (
        "a player rated d points higher wins a game with probability "
        f"1/(1 + 2^(\N{MINUS SIGN}d/{scale.points_per_doubling:.6g}))"
    )


USUAL = {"npl": (20, 130), "fargo": (200, 850)}
"""Where most ratings of a scale lie."""

FAR = 3.0
"""Doublings of the odds; the average of a league is nearer to the middle of its scale."""

SCALE_OFF = 0.25
"""How much the scale that a chart fits best may differ from that of the ratings."""

APART = 6.0
"""Doublings of the odds; every player is nearer to the average of the league: 64 games to 1."""


AGAINST = 10.0
"""By how much results must be likelier on another scale, as a logarithm: 22,000 times."""


def contradiction(scale: Scale, roster: Roster, results: Results) -> str:
    """Return what results say against the scale of the ratings before them; '' if nothing.

    The games are compared with what the differences of the ratings mean on each known scale. Read
    on one with too few points to a doubling, everyone ahead is a clear favorite, and those who do
    not win like one look like sandbaggers.

    Parameters
    ----------
    scale
        by which the ratings are read.
    roster
        the ratings.
    results
        of the players.

    >>> from evenbreak.ratings import SCALES, Results, Roster
    >>> listed = Roster(["Ann", "Bo"], [540, 450])
    >>> season = Results.from_names(["Ann"] * 20, ["Bo"] * 20, [5] * 20, [3, 2] * 10)
    >>> contradiction(SCALES["fargo"], listed, season)
    ''
    >>> contradiction(SCALES["npl"], listed, season)
    'the results contradict NPL ratings: by them the player rated higher would have won 89% of the
    games, by Fargo ratings 65%; they won 67%'
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
    return (
        f"the results contradict {own} ratings: by them the player rated higher would have won "
        f"{share(scale)} of the games, by {name} ratings {share(other)}; they won {seen}"
    )


def two_ratings_doubts(scale: Scale, *ratings: float) -> list[str]:
    """Return a warning if a few ratings look like those of another scale.

    Only their difference counts, so somebody may give it as one rating and 0 as the other.

    >>> from evenbreak.ratings import SCALES
    >>> two_ratings_doubts(SCALES["npl"], 612, 521)
    ['most NPL ratings are between 20 and 130; for Fargo ratings add --scale fargo']
    >>> two_ratings_doubts(SCALES["fargo"], 1750, 1612)
    ['most Fargo ratings are between 200 and 850; for Elo ratings add --scale elo']
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
        f"most {NAMES[scale.name]} ratings are between {low} and {high}; "
        f"for {NAMES[other]} ratings add --scale {other}"
    ]


def league_doubts(
    scale: Scale, ratings: ArrayLike, remedy: str, names: Sequence[str] = ()
) -> list[str]:
    """Return a warning for each thing that is unusual in the ratings of a league.

    Parameters
    ----------
    scale
        by which they are read.
    ratings
        NaN is no rating.
    remedy
        what to do if they are ratings of another scale.
    names
        of the players, to name those who are far from the others.

    >>> from evenbreak.ratings import SCALES
    >>> league_doubts(SCALES["npl"], [560, 600, 640], "say which with --scale")
    ['NPL ratings average about 80, but these average about 600; say which with --scale']
    >>> league_doubts(SCALES["npl"], [70, 80, 94, 560], "")
    ['1 of 4 ratings is more than 180 points from the median of 87; are they all on the same
    scale?']
    """
    import numpy as np

    given = np.asarray(ratings, dtype=float)
    known = given[~np.isnan(given)]
    if not len(known):
        return []
    doubts = []
    middle = float(np.median(known))  # one slip makes no other scale
    if scale.centre and abs(middle - scale.centre) > FAR * scale.points_per_doubling:
        doubts.append(
            f"{NAMES.get(scale.name, scale.name)} ratings average about {scale.centre:g}, but "
            f"these average about {middle:.0f}; {remedy}"
        )
    return doubts + far_doubts(scale, given, names)


def far_doubts(scale: Scale, ratings: ArrayLike, names: Sequence[str] = ()) -> list[str]:
    """Return a warning if some ratings are very far from the others, as after a slip.

    Parameters
    ----------
    scale
        of the ratings.
    ratings
        NaN is no rating.
    names
        of the players, to name those who are far from the others.

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
    named = [f"{names[k]}: {given[k]:g}" for k in far.tolist()] if names else []
    who = f" ({some_of(named)})" if named else ""
    return [
        f"{apart:,} of {len(known):,} ratings{who} {'is' if apart == 1 else 'are'} more than "
        f"{edge:.0f} points from the median of {middle:.0f}; are they all on the same scale?"
    ]


def starter_doubts(scale: Scale, ratings: ArrayLike) -> list[str]:
    """Return a warning if new players start at a middle that is far from everybody else.

    Parameters
    ----------
    scale
        whose middle a new player is given.
    ratings
        NaN is a new player.

    >>> from evenbreak.ratings import SCALES
    >>> starter_doubts(SCALES["fargo"], [92, 71, float("nan")])
    ['new players start at 500, the middle of the Fargo scale, but the other ratings go from 71 to
    92; give the rating of a new player with --starter']
    """
    import numpy as np

    known = np.asarray(ratings, dtype=float)
    rated = known[~np.isnan(known)]
    if not 0 < len(rated) < len(known):
        return []
    least, most, edge = rated.min(), rated.max(), scale.points_per_doubling
    if least - edge <= scale.centre <= most + edge:
        return []
    return [
        f"new players start at {scale.centre:g}, the middle of the "
        f"{NAMES.get(scale.name, scale.name)} scale, but the other ratings go from {least:g} to "
        f"{most:g}; give the rating of a new player with --starter"
    ]


def chart_doubts(chart: Any, scale: Scale) -> list[str]:
    """Return a warning if the races of a chart fit another scale than that of the ratings.

    What is not a chart of rating differences is not doubted.
    """
    from evenbreak.handicaps.charts.audit import audit
    from evenbreak.handicaps.charts.chart import Chart

    if not isinstance(chart, Chart):
        return []
    best, own = audit(chart, scale=scale).best_fit, scale.points_per_doubling
    if best is None or abs(best.points_per_doubling / own - 1.0) <= SCALE_OFF:
        return []
    return [
        f"the races of {chart.name} fit a scale on which about {best.points_per_doubling:.0f} "
        f"points double the odds, but here {own:.4g} do; make sure that it is the chart for these "
        "ratings"
    ]


def form_words(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield what form of the day is worth, where it is established.

    >>> from evenbreak.ratings.estimates import Estimate
    >>> from evenbreak.ratings.fitted import DayForm
    >>> from evenbreak.ratings import SCALES
    >>> print(*form_words(DayForm(Estimate(0.12, 0.06, 0.18), 900), SCALES["npl"]))
    Form of the day: from match to match the strength difference of two players varies by 15
    points, give or take 2, so sweeps are likelier and hill-hill games rarer than ratings alone
    would say. This list of ratings states it (0.35 in log-odds), and odds, fair, live and
    matchups allow for it.
    """
    if form is None or not form.established:
        return
    points, error = scale.points(form.sd), scale.points(form.sd_error)
    yield (
        f"Form of the day: from match to match the strength difference of two players varies by "
        f"{points:.0f} points, give or take {error:.0f}, so sweeps are likelier and hill-hill "
        "games rarer than ratings alone would say. This list of ratings states it "
        f"({form.sd:.2f} in log-odds), and odds, fair, live and matchups allow for it."
    )


def form_details(form: DayForm | None, scale: Scale) -> Iterator[str]:
    """Yield what was found out about form of the day, with its interval."""
    if form is None:
        return
    v, low, high = form.variance
    end = "This is established." if form.established else "This may be luck, so nothing uses it."
    yield (
        f"Form of the day, estimated from {form.races:,} matches, each compared with the ratings "
        f"from all others: a standard deviation of {scale.points(form.sd):.1f} points (variance "
        f"{v:.3f} in squared log-odds, 95% interval {low:.3f} to {high:.3f}). {end}"
    )


def form_used_words(form: float, scale: Scale | None = None) -> str:
    """Return that an answer allows for form of the day; '' if there is none.

    >>> form_used_words(0.35)
    'Form of the day is allowed for: from match to match the log-odds of a game vary by 0.35.'
    """
    if not form:
        return ""
    if scale is None:
        return (
            "Form of the day is allowed for: from match to match the log-odds of a game vary by "
            f"{form:g}."
        )
    return (
        f"Form of the day is allowed for: from match to match the strength difference of two "
        f"players varies by {scale.points(form):.0f} points."
    )


def form_data(form: DayForm | None) -> dict[str, Any] | None:
    """Return form of the day for JSON, in log-odds."""
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
