"""Choose the prior for players: the one that predicts later matches best.

Each stretch of a season is predicted from the days before it (see `evenbreak.ratings.stretches`),
in one search for the width of the prior, for what the file knows about players (see
`evenbreak.ratings.levels`), and for the half-life of old results. The width that makes the actual
scores most likely is chosen first, if there are enough results. Then each of the others is added in
turn if it clearly predicts better, and the width is chosen again. Knowledge about players leaves
less for the width to explain, so each addition is tried with narrower widths too.

`evenbreak.ratings.clear_gains` decides when one method clearly predicts better than another.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal, NamedTuple

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.ratings.beginning import Beginning
from evenbreak.ratings.clear_gains import by_enough_players, gains_over, is_clear
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.estimates import Estimate
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.half_lives import half_lives_for
from evenbreak.ratings.handicap_slope import race_share
from evenbreak.ratings.levels import (
    Levels,
    begun,
    joined_late,
    known_levels,
    met_as_newcomers,
)
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import DEFAULT_SCALE
from evenbreak.ratings.season_part import connected_part
from evenbreak.ratings.stretches import (
    Stretches,
    StretchLosses,
    can_be_predicted,
)
from evenbreak.workers import Share

WIDTHS = tuple(PRIOR_SD * 2.0 ** (k / 2) for k in range(-6, 6))
"""The widths tried, from an eighth of the difference that doubles the odds, in steps of √2."""

AS_GOOD = 1.92
"""Total loss, in nats, within which a width is as good as the best: half of chi-squared's 95%."""

VAGUE = 4.0
"""If widths differing by this factor are as good as the best, the results cannot choose."""

FEWEST = 100
"""Games (or matches known only by their winner) to predict before they can choose a width."""

TRIED = {
    "brought_sd": (0.05, 0.1, 0.2, 0.4, 0.8),
    "division_sd": (0.1, 0.2, 0.4, 0.8),
    "team_sd": (0.1, 0.2, 0.4, 0.8),
    "joined": (-0.4, -0.2, 0.2, 0.4, 0.6, 0.8, 1.2),
    "newcomers": (-0.4, -0.2, 0.2, 0.4, 0.6, 0.8, 1.2),
    "field": (0.25, 0.5, 0.75, 1.0, 1.25),
}
"""The values tried for the fields of `Levels`, in the order in which they are added.

The weight of stated races is not tried: it is estimated from all of them (`race_share`).
"""

OF_NEWCOMERS = ("joined", "newcomers", "field")
"""Of these similar fields, the one with the largest gain at the lower 95% bound is added first."""

NARROWER = 3
"""How many narrower widths each field is tried with."""

ENOUGH = 30_000
"""Matches used to choose if a season has twice as many; they come from clubs that meet.

They suffice to tell apart widths that differ by √2, and gains per game to about 0.4e-4 nats.
"""

MANY_NEW = 20
"""Players who must have joined late, or not, or met others as newcomers, if under a tenth have."""

STEP = 0.05
"""Distance between sizes used to compute the standard error of the best one."""

Progress = Callable[[int, int], None]


class Evidence(NamedTuple):
    """The gain from letting one more thing count.

    Parameters
    ----------
    of
        a field of `Levels`, or 'half_life'.
    tried
        the sizes that were tried; days for 'half_life'.
    gains
        the log-loss per game that each size saves, in nats, given what was added before, at the
        width that suits the best size.
    used
        whether the addition clearly predicts better and is therefore used.
    value
        the size that predicts best.
    standard_error
        None if it is not used, or if only a few sizes were compared.
    players
        how many players the gain rests on: the smallest number without whose matches no gain is
        left. For late joining, at most the size of the smaller group, if that is small.
    too_few
        whether it is not used because these players are too few.
    """

    of: str
    tried: tuple[float, ...]
    gains: tuple[Estimate, ...]
    used: bool
    value: float
    standard_error: float | None = None
    players: int = 0
    too_few: bool = False

    @property
    def gain(self) -> Estimate:
        """The gain of the best size tried."""
        return max(self.gains, key=lambda gain: gain.value)


class PriorChoice(NamedTuple):
    """The width of the prior that predicts best.

    Attributes
    ----------
    prior_sd
        that width, in natural log-odds; the one nearest to `PRIOR_SD` if `learned` is false.
    tried
        all widths, in rising order.
    log_loss
        for each width, the mean of -ln P(score | earlier days) per game: each game is predicted
        from earlier days and the earlier games of its match. A match known only by its winner
        counts as one game.
    predicted
        how many games and such matches were predicted.
    low, high
        the ends of the range of widths that predict as well as the best (95%).
    learned
        whether the range is narrow enough to choose by, and 100 results were predicted.
    as_it_went
        the log-loss if each stretch uses the width that did best before it.
    levels
        what the file knows about players, as far as it clearly helps.
    half_life
        in days; None: old games count in full.
    evidence
        the gain from each of these.
    part
        how many matches were used to choose, if not all; None: all.
    """

    prior_sd: float
    tried: tuple[float, ...]
    log_loss: tuple[float, ...]
    predicted: int
    low: float
    high: float
    learned: bool
    as_it_went: float
    levels: Levels = Levels()
    half_life: float | None = None
    evidence: tuple[Evidence, ...] = ()
    part: int | None = None


def best_prior(
    results: Results,
    *,
    widths: Sequence[float] = WIDTHS,
    half_life: float | Literal["best"] | None = "best",
    beginning: Beginning | None = None,
    break_advantage: float | str | None = None,
    scale: Any = DEFAULT_SCALE,
    progress: Progress = lambda _done, _all: None,
    share: Share | None = None,
) -> PriorChoice:
    """Return the prior and half-life whose ratings predict later matches best.

    Predictions are averaged over the uncertainty of the ratings. Players who have not played yet
    are predicted from their prior alone, so newcomers' matches count too. If fewer than 100 games
    are predicted, or widths four times apart predict equally well, there are too few results to
    choose by, and the width nearest to the default is returned.

    Levels and half-lives are added one after another if they clearly predict better (see
    `evenbreak.ratings.prior`). From more than 60,000 matches, about 30,000 are used (see
    `evenbreak.ratings.season_part`).

    Parameters
    ----------
    results
        matches on at least two days, all with a date; forfeits and 0-0 may lack one.
    widths
        the standard deviations to try, in natural log-odds.
    half_life
        'best' to choose it; else as for `fit`.
    beginning
        ratings that players bring with them; None: there are none.
    break_advantage, scale
        as for `fit`; the scale only matters for a break advantage in points.
    progress
        called with the work done so far and the total.
    share
        as for `stretch_losses`.

    Raises
    ------
    InputError
        if a date is missing, all matches are on one day, or a width is not in 0.001 to 100.

    Notes
    -----
    Prequential validation: Dawid (1984), "The prequential approach".

    >>> season = Results.from_names(
    ...     ["A"] * 4, ["B"] * 4, [7] * 4, [4] * 4, date=["2026-01-0" + day for day in "1234"]
    ... )
    >>> choice = best_prior(season, widths=[0.1, 0.5])
    >>> choice.prior_sd, choice.predicted
    (0.5, 33)
    """
    check_results(results)
    if not len(widths):
        raise InputError("widths must not be empty. Give at least one standard deviation.")
    tried = np.sort(np.asarray(widths, dtype=float))
    known = known_levels(results, beginning)
    races = race_share(results) if "race" in known else None
    half_lives = half_lives_for(results)
    part = None
    if can_be_predicted(results) and results.counted.sum() > 2 * ENOUGH:
        results = connected_part(results, ENOUGH)
        part = int(results.counted.sum())
        known = tuple(name for name in known_levels(results, beginning) if name in known)
    more = _sizes(known, races)
    if half_life == "best":
        more["half_life"] = half_lives
    way: dict[str, Any] = {
        "half_life": None if half_life == "best" else half_life,
        "break_advantage": break_advantage,
        "scale": scale,
        "levels": Levels(beginning=beginning),
    }
    search = _Search(results, 2 * len(more) + 2, progress, share, races)
    choice = search.width(tried, way)
    if not choice.learned:
        return choice._replace(levels=begun(beginning), part=part)
    evidence: list[Evidence] = []
    chosen_for, left, beside = way, list(more), False
    while left:
        if left[0] == "half_life" and way != chosen_for:
            # Under a prior that is too wide, old games would seem to count too much.
            choice, chosen_for = search.width(tried, way)._replace(learned=True), way
        now = (
            [name for name in left if name in OF_NEWCOMERS] if left[0] in OF_NEWCOMERS else left[:1]
        )
        so_far = {**way, "prior_sd": choice.prior_sd}
        tested = [search.add(name, more[name], so_far, tried) for name in now]
        clear = [test for test in tested if test[0].used]
        if not clear:
            evidence += [without for without, _ in tested]
            left = left[len(now) :]
            continue
        best, width = max(clear, key=lambda test: test[0].gain.low)
        evidence.append(best)
        left.remove(best.of)
        if beside:  # what does not help beside one of these will not beside two
            evidence += [without for without, _ in tested if not without.used]
            left = [name for name in left if name not in {each.of for each in evidence}]
        beside = best.of in OF_NEWCOMERS
        way, choice = _with(way, best.of, best.value), choice._replace(prior_sd=width)
    if any(found.used for found in evidence):
        if way != chosen_for:
            choice = search.width(tried, way)._replace(learned=True)
        so_far = {**way, "prior_sd": choice.prior_sd}
        evidence = [search.sharpened(found, so_far) for found in evidence]
        for found in evidence:
            way = _with(way, found.of, found.value) if found.used else way
    return choice._replace(
        levels=way["levels"], half_life=way["half_life"], evidence=tuple(evidence), part=part
    )


def _sizes(known: Sequence[str], races: Estimate | None) -> dict[str, tuple[float, ...]]:
    """Return the sizes to try for each field."""
    first = {} if races is None or "race" not in known else {"race": (races.value,)}
    return first | {name: TRIED[name] for name in known if name in TRIED}


def _with(way: Mapping[str, Any], name: str, value: float) -> dict[str, Any]:
    """Return a rating method with one more thing that counts."""
    if name == "half_life":
        return {**way, name: value}
    return {**way, "levels": replace(way["levels"], **{name: value})}


class _Search:
    """The steps of a search, each of which goes through the whole season once."""

    def __init__(
        self,
        results: Results,
        steps: int,
        progress: Progress,
        share: Share | None,
        races: Estimate | None,
    ) -> None:
        self._season, self._share, self._races = Stretches(results), share, races
        played = results.select(results.counted)
        here = np.union1d(played.player_a, played.player_b)
        late = int(joined_late(played)[here].sum())
        self._enough_new = min(MANY_NEW, 0.1 * len(here))
        self._new = {
            "joined": min(late, len(here) - late),
            "newcomers": int(met_as_newcomers(played).sum()),
        }
        self._steps, self._done = steps, 0
        self._progress = progress
        # What each way lost, in stretches and in matches, so that none is tried twice.
        self._known: dict[tuple[Any, ...], tuple[Floats, Floats]] = {}

    def _losses(self, ways: Sequence[Mapping[str, Any]]) -> StretchLosses:
        """Return the loss of each method; any two differ in width, half-life or levels."""
        names = [(way["prior_sd"], way["half_life"], way["levels"]) for way in ways]
        new = {name: way for name, way in zip(names, ways, strict=True) if name not in self._known}
        if new:
            self._predicted = self._tried(list(new.values()))
            each = zip(self._predicted.losses.T, self._predicted.of_match.T, strict=True)
            self._known |= zip(new, each, strict=True)
        losses, of_match = zip(*(self._known[name] for name in names), strict=True)
        return self._predicted._replace(
            losses=np.column_stack(losses), of_match=np.column_stack(of_match)
        )

    def _tried(self, ways: Sequence[Mapping[str, Any]]) -> StretchLosses:
        steps = max(self._steps, self._done + 1)

        def progress(done: int, stretches: int) -> None:
            self._progress(100 * self._done + 100 * done // stretches, 100 * steps)

        losses = self._season.losses(ways, progress=progress, share=self._share)
        self._done += 1
        return losses

    def width(self, tried: Floats, way: Mapping[str, Any]) -> PriorChoice:
        """Return the width that predicts best, given the rest of the method."""
        of_width = self._losses([{**way, "prior_sd": width} for width in tried.tolist()])
        total = of_width.losses.sum(0)
        good = tried[total <= total.min() + AS_GOOD]
        predicted = int(of_width.predicted.sum())
        learned = predicted >= FEWEST and round(float(good[-1] / good[0]), 6) < VAGUE
        best = total if learned else _from_default(tried)
        return PriorChoice(
            float(tried[best.argmin()]),
            tuple(tried.tolist()),
            tuple(of_width.means.tolist()),
            predicted,
            float(good[0]),
            float(good[-1]),
            learned,
            _as_it_went(of_width, tried),
            half_life=way["half_life"],
        )

    def add(
        self, name: str, sizes: Sequence[float], way: Mapping[str, Any], tried: Floats
    ) -> tuple[Evidence, float]:
        """Return the gain from letting one more thing count, and the width that suits it."""
        width = float(way["prior_sd"])

        def losses(width: float) -> StretchLosses:
            return self._losses(
                [way, *({**_with(way, name, size), "prior_sd": width} for size in sizes)]
            )

        of_sizes = losses(width)
        best = int(of_sizes.means[1:].argmin())
        gained = of_sizes.means[1 + best] < of_sizes.means[0]
        if name == "race" or (gained and name != "half_life"):
            width = self._narrowed(_with(way, name, sizes[best]), tried)
            of_sizes = losses(width)
            best = int(of_sizes.means[1:].argmin())
        clear = is_clear(of_sizes)
        enough, players = self._behind(name, of_sizes, 1 + best)
        found = Evidence(
            name,
            tuple(sizes),
            gains_over(of_sizes),
            clear and enough,
            sizes[best],
            players=players,
            too_few=clear and not enough,
        )
        return found, width

    def _narrowed(self, way: Mapping[str, Any], tried: Floats) -> float:
        """Return a method's width, or a narrower one, as long as each predicts better."""
        best = float(way["prior_sd"])
        least = self._losses([way]).means[0]
        narrower = tried[tried < best][: -NARROWER - 1 : -1].tolist()
        together = len(narrower) if self._season.is_small else 1
        for k in range(0, len(narrower), max(together, 1)):
            some = narrower[k : k + together]
            losses = self._losses([{**way, "prior_sd": width} for width in some]).means
            if losses.min() >= least:
                break
            best, least = some[int(losses.argmin())], losses.min()
        return best

    def _behind(self, name: str, of_sizes: StretchLosses, best: int) -> tuple[bool, int]:
        """Return whether a gain rests on enough players, and on how many."""
        if name in self._new and self._new[name] < self._enough_new:
            return False, self._new[name]
        return by_enough_players(of_sizes, best)

    def sharpened(self, coarse: Evidence, way: Mapping[str, Any]) -> Evidence:
        """Return the same with the best size between those tried, and its standard error.

        It takes one Newton step from the best of them. The error is the larger of two sandwich
        estimates: with independent stretches, and with independent matches unless they share a
        player. The newcomers' disadvantage is shrunk toward 0 according to its uncertainty, since
        it is used only when it looks large.
        """
        if coarse.of == "race" and coarse.used and self._races is not None:
            return coarse._replace(standard_error=self._races.standard_error)
        if not coarse.used or coarse.of not in ("newcomers", "joined", "field"):
            return coarse
        sizes = coarse.value + np.array([-STEP, 0.0, STEP])
        found = self._losses([_with(way, coarse.of, size) for size in sizes.tolist()])
        losses, each = found.losses, found.of_match
        slope = (losses[:, 2] - losses[:, 0]) / (2.0 * STEP)
        bend = float((losses[:, 0] - 2.0 * losses[:, 1] + losses[:, 2]).sum()) / STEP**2
        if bend <= 0.0:
            return coarse
        shift = -float(slope.sum()) / bend
        of_stretches = float(np.sqrt(((slope - slope.mean()) ** 2).sum()))
        of_players = found.players.spread((each[:, 2] - each[:, 0]) / (2.0 * STEP))
        error = max(of_stretches, of_players) / bend
        if error > max(abs(coarse.value), STEP):  # the losses are nearly straight: nothing to see
            return coarse
        apart = max(np.diff(coarse.tried).max(), 4.0 * STEP)
        value = coarse.value + float(np.clip(shift, -apart, apart))
        if value:
            value *= max(1.0 - (error / value) ** 2, 0.0)
        return coarse._replace(value=value, standard_error=error)


def _from_default(widths: Floats) -> Floats:
    return np.abs(np.log(widths / PRIOR_SD))


def _as_it_went(of_width: StretchLosses, tried: Floats) -> float:
    """Return the log-loss if each stretch uses the width that did best before it."""
    before = np.cumsum(of_width.losses, axis=0) - of_width.losses
    # Before the first stretch nothing is known: then the width nearest to the default is used.
    before[0] = _from_default(tried)
    chosen = of_width.losses[np.arange(len(before)), before.argmin(1)]
    return float(chosen.sum() / of_width.predicted.sum())
