"""How soon the watch flags a sandbagger, and how often an honest player: by simulation."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.checks import number, number_probability, one_of, seed_of, whole
from evenbreak.handicaps.ladders.form import deviation_grid, difference_law
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.league.result_likelihood import Likelihood, units
from evenbreak.league.sandbag_evidence import (
    DEPTHS,
    FARTHEST,
    HONEST,
    SHARES,
    SHARES_MARKED,
    SandbagEvidence,
)
from evenbreak.league.sandbag_pay import refuse_drift, start_law
from evenbreak.league.sandbag_watch import at_skills, drift_room, skill_prior

_CHUNK = 250
"""Players simulated side by side, which limits the memory."""

_WAYS = len(DEPTHS) + 1
"""The ways in which a sandbagger may dump: each depth below the skill, or a feigned defeat."""

_ZERO = 2000
"""The place of the difference 0 in a table of likelihoods."""


class WatchPower(NamedTuple):
    """How often players of one kind are flagged.

    Parameters
    ----------
    share
        P(a match that may be dumped is dumped).
    points
        how far below their skill the player plays it; None: they lose on purpose, with the
        score of an honest defeat.
    replicas
        players simulated.
    flagged
        the share of them who were flagged within 1, 2, ... matches, shape (matches,).
    se
        its standard error, shape (matches,).
    rating_error
        mean rating less skill before each match, in points, shape (matches,).
    p_win
        the share of the matches in earnest that were won; None if none was played in earnest.
    """

    share: float
    points: int | None
    replicas: int
    flagged: Floats
    se: Floats
    rating_error: Floats
    p_win: float | None


def watch_power(
    ladder: Ladder,
    *,
    share: float,
    points: int | None = None,
    matches: int = 60,
    alpha: float = 0.01,
    honest: str = "any",
    marked: float | None = None,
    start: int | None = None,
    replicas: int = 1000,
    seed: int | np.random.Generator = 1,
) -> WatchPower:
    """Return how often players who sandbag in one way are flagged, match by match.

    Each opponent is rated at the player's skill, with an independent error drawn from the
    ladder's distribution.

    Parameters
    ----------
    ladder
        how ratings move; its chart sets the races. The form of all players varies from match to
        match by its `day_sd` and `match_sd`, and the watch knows by how much.
    share
        P(a match that may be dumped is dumped); 0 for honest players, of whom at most the share
        alpha is flagged.
    points
        how far below their skill players play it; None: they lose it on purpose, with the score
        of an honest defeat.
    matches
        how many matches each plays.
    alpha
        the watch flags at 1 / alpha.
    honest
        who counts as honest, as for `watch`.
    marked
        the share of the matches known to be those that may be dumped, evenly spread; None: any
        match may be dumped, and nobody knows which.
    start
        the rating error at the start, in points; None: drawn from the ladder's distribution.
    replicas
        players simulated.
    seed
        of the simulation: a whole number, or a generator.

    Raises
    ------
    InputError
        if a number is out of range, or the ladder's player drifts.

    >>> from evenbreak.handicaps import Ladder
    >>> found = watch_power(Ladder("npl"), share=0.5, matches=40, replicas=100)
    >>> bool(found.flagged[9] < found.flagged[39])
    True
    """
    dumps = number_probability(share, "share")
    many, players = whole(matches, "matches", at_least=1), whole(replicas, "replicas", at_least=2)
    number(alpha, "alpha", above=0.0, below=1.0)
    one_of(honest, "honest", HONEST)
    refuse_drift(ladder)
    part = None if marked is None else number_probability(marked, "marked")
    may = np.ones(many, dtype=bool)
    if part is not None:
        may = np.diff(np.floor(np.arange(many + 1) * part + 1e-9)) > 0
    simulated = _Simulated(ladder, None if points is None else whole(points, "points"))
    first = np.zeros(many, dtype=np.int64)
    error, earnest = np.zeros(many), np.zeros(2)
    sizes = [min(_CHUNK, players - done) for done in range(0, players, _CHUNK)]
    for size, child in zip(
        sizes, np.random.SeedSequence(seed_of(seed)).spawn(len(sizes)), strict=True
    ):
        rng = np.random.default_rng(child)
        begin = rng.choice(ladder.errors, size, p=np.asarray(_start(ladder, start)))
        shares = SHARES if part is None else SHARES_MARKED
        alarm, errors, wins = simulated.played(
            rng, begin, np.where(may, dumps, 0.0), may, shares, honest, -math.log(alpha)
        )
        first += np.bincount(alarm, minlength=many + 1)[:many]
        error += errors.sum(axis=0)
        earnest += wins
    flagged = np.cumsum(first) / players
    return WatchPower(
        dumps,
        simulated.points,
        players,
        flagged,
        np.sqrt(flagged * (1.0 - flagged) / players),
        error / players,
        float(earnest[0] / earnest[1]) if earnest[1] else None,
    )


def _start(ladder: Ladder, start: int | None) -> Floats:
    law = start_law(ladder, ladder.law() if start is None else start)
    return np.asarray(law / law.sum())


def _advantages(ladder: Ladder, form: float) -> tuple[Ints, Floats]:
    """Return the player's advantages by the opponent's error and both forms, with chances."""
    law = ladder.law()
    points = np.array(law.values, dtype=np.int64)
    chances = np.array([float(chance) for chance in law.probability])
    if form:
        widest = int(np.abs(points).max())
        errors = np.bincount(points + widest, weights=chances, minlength=2 * widest + 1)
        points, chances = deviation_grid(
            np.convolve(errors, difference_law(form)), ladder.system.scale.points_per_doubling
        )
    return points, chances / chances.sum()


class _Simulated:
    """The tables of a simulation: how matches end, and what each end says of a skill."""

    def __init__(self, ladder: Ladder, points: int | None) -> None:
        self.points, self.widest = points, int(ladder.errors[-1])
        self.table = match_table(ladder.system, ladder.chart, widest=self.widest)
        scale, form = ladder.system.scale, math.hypot(ladder.day_sd, ladder.match_sd)
        self.likelihood = Likelihood(scale, ladder.law(), form)
        self.errors, self.chance = _advantages(ladder, form)
        # The opponent is rated at the player's skill, so the player's advantage is the opponent's
        # error plus the difference of the two forms.
        honest = self.table.chances(scale.win_probability(self.errors))
        if points is None:
            lost = np.where(self.table.won[..., None], 0.0, honest)
            dumped = lost / lost.sum(axis=1, keepdims=True)
        else:
            dumped = self.table.chances(scale.win_probability(self.errors - points))
        self.ends = np.cumsum([honest, dumped], axis=2)
        self._known: dict[tuple[int, int, int, int], Floats] = {}

    def played(
        self,
        rng: np.random.Generator,
        error: Ints,
        dumps: Floats,
        may: Bools,
        shares: tuple[float, ...],
        honest: str,
        threshold: float,
    ) -> tuple[Ints, Ints, Floats]:
        """Return each player's first alarm (`many` if none), errors, and wins in earnest."""
        size, many = error.size, dumps.size
        rated = np.array([units(float(one), self.likelihood.scale) for one in error])
        evidence = SandbagEvidence(skill_prior(self.likelihood).repeat(size, axis=0), shares, _WAYS)
        alarm = np.full(size, many)
        errors = np.empty((size, many), dtype=np.int64)
        earnest = np.zeros(2)
        for place in range(many):
            errors[:, place] = error
            x = np.clip(error, -self.widest, self.widest) + self.widest
            dumped = rng.random(size) < dumps[place]
            other = rng.choice(self.errors.size, size, p=self.chance)
            ends = self.ends[dumped.astype(np.int64), x, :, other]
            end = np.minimum(
                (rng.random(size)[:, None] >= ends).sum(axis=1),
                (self.table.games[x, :, 0] >= 0).sum(axis=1) - 1,
            )
            won = self.table.won[x, end]
            earnest += won[~dumped].sum(), (~dumped).sum()
            evidence.add(*self._chances(x, end, rated, place), marked=bool(may[place]))
            over = (evidence.log_e(honest) >= threshold) & (alarm == many)
            alarm[over] = place
            error = np.clip(error + self.table.moves[x, end, 0], -self.widest, self.widest)
        return alarm, errors, earnest

    def _chances(self, x: Ints, end: Ints, rated: Ints, place: int) -> tuple[Floats, Floats]:
        """Return the likelihoods of the final scores, by skill less the rating at the start."""
        rise, fall = drift_room(place)
        low = FARTHEST + fall
        length = low + FARTHEST + rise + 1
        needs = self.table.needs[x]
        games = self.table.games[x, end]
        keys = np.column_stack([rated, needs, games])
        unique, which = np.unique(keys, axis=0, return_inverse=True)
        both = np.empty((2, len(unique), length))
        for row, (start, m, n, a, b) in enumerate(unique.tolist()):
            both[:, row] = self._likelihoods(a, b, m, n)[
                :, start - low + _ZERO : start - low + _ZERO + length
            ]
        chance, feigned = both[:, which.ravel()]
        return at_skills(chance, feigned, place)

    def _likelihoods(self, a: int, b: int, m: int, n: int) -> Floats:
        key = (a, b, m, n)
        if key not in self._known:
            self._known[key] = np.stack(
                self.likelihood.of((a, b), (m, n), won=a == m, first=-_ZERO, last=_ZERO)
            )
        return self._known[key]
