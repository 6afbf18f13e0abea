"""What form of the day gains in predicting the scores of a season, with paired standard errors.

python benchmarks/form_of_the_day.py RESULTS.csv WIDTH NEWCOMERS [DATE]

WIDTH and NEWCOMERS, in log-odds, are those of the prior. The matches are predicted date by date,
from DATE on by the form found before DATE; without it by the form of the whole season.
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.special import betainc, expit, gammaln, log_expit, logit, logsumexp

from evenbreak.arrays import Bools, Floats
from evenbreak.files import read_results
from evenbreak.matches.form import center_of_form
from evenbreak.ratings import Forecasts, Levels, fit, walk_forward
from evenbreak.ratings.day_form import with_form
from evenbreak.ratings.validation.within_matches import score_shapes


def main(path: str, width: float, newcomers: float, date: str | None = None) -> None:
    results = read_results(path).results
    how = {"prior_sd": width, "levels": Levels(newcomers=newcomers)}
    walk = walk_forward(results, **how)
    known, rows = results, (walk.race_a > 1) & (walk.race_b > 1) & (walk.date_of > 0)
    if date is not None:
        day = np.datetime64(date)
        known = results.select(np.asarray(results.date < day))
        rows &= walk.results.date >= day
    form = with_form(known, fit(known, **how)).form
    if form is None:
        raise SystemExit("too few matches")
    formed_walk = walk_forward(results, **how, form=form.sd)
    print(f"form {form.sd:.3f} ± {form.sd_error:.3f}; {rows.sum():,} matches predicted")
    plain, formed = predicted(walk, rows), predicted(formed_walk, rows)
    for what in ("score", "winner"):
        saved = formed[what] - plain[what]
        error = over_dates(saved, walk.date_of[rows])
        print(f"log-loss of the {what} saved: {saved.mean():.4f} ± {error:.4f}")
    a, b = walk.results.score_a[rows], walk.results.score_b[rows]
    decided = a + b == walk.race_a[rows] + walk.race_b[rows] - 1
    seen = [decided.mean(), (np.minimum(a, b) == 0).mean(), (a + b).mean()]
    said = zip(plain["shapes"].mean(1), formed["shapes"].mean(1), seen, strict=True)
    for what, numbers in zip(("deciders", "sweeps", "games"), said, strict=True):
        print(what, "without form {:.3f}, with form {:.3f}, seen {:.3f}".format(*numbers))
    for name, one in (("without", plain), ("with", formed)):
        print(f"slope of the winner's chances {name} form: {slope(one['p_win'], a > b):.2f}")


def predicted(walk: Forecasts, rows: Bools) -> dict[str, Floats]:
    """Return the log-likelihood of each score and winner, and what is said of deciders."""
    points, weights = np.polynomial.hermite_e.hermegauss(41)
    weights /= weights.sum()
    sd = walk.sd[rows]
    x = center_of_form(walk.difference[rows], sd, walk.form)[:, None]
    x = x + np.hypot(sd, walk.form)[:, None] * points
    a, b = walk.results.score_a[rows, None], walk.results.score_b[rows, None]
    m, n = walk.race_a[rows, None], walk.race_b[rows, None]
    orders = gammaln(a + b) - gammaln(np.maximum(a, b)) - gammaln(np.minimum(a, b) + 1)
    likely = orders + a * log_expit(x) + b * log_expit(-x) + np.log(weights)
    p_win = betainc(m, n, expit(x)) @ weights
    shapes = [w * score_shapes(expit(x[:, k]), m[:, 0], n[:, 0]) for k, w in enumerate(weights)]
    return {
        "score": logsumexp(likely, axis=1),
        "winner": np.log(np.where((a > b)[:, 0], p_win, 1.0 - p_win)),
        "shapes": np.sum(shapes, axis=0),
        "p_win": p_win,
    }


def over_dates(gain: Floats, date: Floats) -> float:
    """Return the standard error of a mean where the matches of a date may depend on each other."""
    _, code = np.unique(date, return_inverse=True)
    totals = np.bincount(code, gain)
    return float(np.sqrt(((totals - totals.mean()) ** 2).sum()) / len(gain))


def slope(p: Floats, won: Bools) -> float:
    """Return by how much the log-odds of chances have to be multiplied to fit the results."""
    x, found = logit(p), 1.0
    for _ in range(20):
        q = expit(found * x)
        found += float(((won - q) * x).sum() / (q * (1.0 - q) * x * x).sum())
    return found


if __name__ == "__main__":
    file, width, newcomers, *since = sys.argv[1:]
    main(file, float(width), float(newcomers), *since)
