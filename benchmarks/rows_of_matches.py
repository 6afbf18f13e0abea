"""Rows of `peers_of_chains.py` about matches, tournaments, ratings and the command line."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Callable
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import networkx as nx
import numpy as np
from bench_chains import fresh, ladder_law, walk
from bench_ratings import league
from bench_tournaments import dice, names, strengths
from rows_of_chains import HERE, STORM, Call, Question, kept, question
from scipy.linalg import solve_banded
from scipy.special import betainc
from storm_of_chains import storm_law, storm_model, storm_values

from evenbreak.chains import (
    chain_of,
    limit_matrix,
    limits_over,
    steps_to_absorption,
    stochastic_limit,
)
from evenbreak.game import graph_of
from evenbreak.games import Ahead, OneBall, Race, Rack, winner_breaks
from evenbreak.matches import match_length, race_win_probability, win_probability
from evenbreak.ratings import fit
from evenbreak.tournaments import double_elimination, title_odds

# Matches -------------------------------------------------------------------------------


def n_ahead(n: int) -> Question:
    p = 0.5001
    match = Ahead(n, n, Rack(p))

    def closed_form() -> Any:
        win, needed = np.broadcast_arrays(np.asarray(p), np.asarray(n))
        ratio = np.log1p(-win) - np.log(win)
        with np.errstate(invalid="ignore"):
            return np.where(
                ratio == 0, 0.5, np.expm1(needed * ratio) / np.expm1(2 * needed * ratio)
            )

    with localcontext(prec=40):
        exact = float(1 / (1 + ((1 - Decimal(p)) / Decimal(p)) ** n))
    peers: dict[str, Call] = {"closed form": closed_form}
    return question(f"n-ahead {n:,}", lambda: win_probability(match), peers, 2, exact=exact)


def one_ball() -> Question:
    p1, p2 = np.random.default_rng(1).random((2, 10**6))
    wide = p1.astype(np.longdouble)
    exact = wide / (wide + (1 - wide) * p2)

    def error(found: Any) -> float:
        won = found if isinstance(found, np.ndarray) else found["W"]
        return float(np.max(np.abs(won / exact - 1)))

    peers: dict[str, Call] = {"formula": lambda: p1 / (p1 + (1 - p1) * p2)}
    ours = partial(limits_over, OneBall, p1=p1, p2=p2)
    return question("10^6 one-ball games", ours, peers, 4, error=error)


def race(asked: str) -> Question:
    match = Race(50, 50, Rack(0.6, 0.55), breaks=winner_breaks)
    chain = chain_of(match)
    won = np.array([match.winner(state) == 1 for state in chain.states])
    over = [k for k, state in enumerate(chain.states) if match.winner(state)]
    peers: dict[str, Call] = {}
    if "stormpy" in HERE:
        model = storm_model(chain, {"won": np.flatnonzero(won), "over": over})
        formula = {"chance": 'P=? [F "won"]', "length": 'R{"steps"}=? [F "over"]'}[asked]
        peers[STORM] = storm_values(model, formula)

    def chance_from_all() -> Any:
        part = fresh(chain).transient
        return part.values((chain.matrix.T @ won)[part.states])

    if asked == "chance":
        rack = Rack(Fraction(0.6), Fraction(0.55))
        exact = float(win_probability(Race(50, 50, rack, breaks=winner_breaks), exact=True))
        ours = chance_from_all
    else:
        exact = match_length(match).mean
        ours = lambda: steps_to_absorption(fresh(chain)).mean  # noqa: E731

    def error(found: Any) -> float:
        return abs(float(np.atleast_1d(found)[0]) / exact - 1)

    most = {"chance": 0.3, "length": 0.6}[asked]
    return kept(f"race 50:50, {asked} from every state", ours, peers, most, error=error)


# Lines and graphs ----------------------------------------------------------------------


def ruin(n: int) -> Question:
    p = 0.5001
    up, down = np.full(n, p), np.full(n, 1.0 - p)
    up[[0, -1]] = down[[0, -1]] = 0.0
    chain = walk(up, down)
    band, arrive = np.zeros((3, n - 2)), np.zeros(n - 2)
    band[0, 1:], band[1], band[2, :-1], arrive[-1] = -p, 1.0, -(1.0 - p), p
    peers: dict[str, Call] = {}
    if "stormpy" in HERE:
        peers[STORM] = storm_values(storm_model(chain, {"top": [n - 1]}), 'P=? [F "top"]')
    peers["solve_banded"] = lambda: solve_banded((1, 1), band, arrive)
    log_r = np.log((np.longdouble(1) - np.longdouble(p)) / np.longdouble(p))
    exact = (np.expm1(np.arange(n) * log_r) / np.expm1((n - 1) * log_r))[1:-1]

    def error(found: Any) -> float:
        top = found.tocsr()[[n - 1], :].toarray()[0] if hasattr(found, "tocsr") else found
        return float(np.max(np.abs(np.asarray(top)[-n + 1 : n - 1][-n + 2 :] / exact - 1)))

    work = f"ruin from every state of a line of {n:,}"
    return kept(work, lambda: limit_matrix(fresh(chain)), peers, 0.4, error=error)


def ladder(n: int) -> Question:
    lead = (np.arange(n) - n // 2) / 400.0
    up, down = 1.0 / (1.0 + 2.0**lead), 1.0 / (1.0 + 2.0**-lead)
    up[-1] = down[0] = 0.0
    chain = walk(up, down)
    peers = {STORM: storm_law(storm_model(chain, {}))} if "stormpy" in HERE else {}
    ours = lambda: stochastic_limit(fresh(chain), 0)  # noqa: E731
    return kept(f"law of a ladder of {n:,}", ours, peers, 0.5, exact=ladder_law(up, down))


def ladder_in_fractions() -> Question:
    n, up, down = 201, Fraction(9, 20), Fraction(1, 2)
    rows = {
        i: {k: p for k, p in ((i - 1, down), (i + 1, up)) if 0 <= k < n} | {i: 1 - up - down}
        for i in range(n)
    }
    rows[0][0], rows[n - 1][n - 1] = 1 - up, 1 - down
    chain = chain_of(rows)
    model = storm_model(chain, {}, exact=True) if "stormpy" in HERE else None
    peers = {STORM: storm_law(model, exact=True)} if model else {}
    ours = partial(stochastic_limit, chain, 0, exact=True)
    return kept("law of a ladder of 201 in fractions", ours, peers, 0.05)


def digraph_to_limit() -> Question:
    match = Race(224, 224, Rack(0.6, 0.55), breaks=winner_breaks)
    graph = graph_of(match)

    def error(limit: Any) -> float:
        if not hasattr(limit, "items"):
            return 0.0  # it only converts
        won = sum(p for state, p in limit.items() if p and match.winner(state) == 1)
        return abs(won / win_probability(match) - 1)

    return kept(
        f"DiGraph of {len(graph):,} states to its limit",
        lambda: stochastic_limit(chain_of(graph)),
        {"networkx's conversion": lambda: nx.to_scipy_sparse_array(graph, weight="probability")},
        0.47,
        error=error,
    )


# Many matches, ratings, tournaments ----------------------------------------------------


def many_races() -> Question:
    rng, size = np.random.default_rng(1), 10**6
    p, m, n = rng.random(size), rng.integers(1, 26, size), rng.integers(1, 26, size)
    exact = betainc(m, n, p)
    peers: dict[str, Call] = {"betainc": lambda: betainc(m, n, p)}
    work = "W(p; m, n) of 10^6 matches"
    return kept(work, lambda: race_win_probability(p, m, n), peers, 1.1, exact=exact)


def ratings() -> Question:
    games = league("mixed")
    peers: dict[str, Call] = {}
    if "evalica" in HERE:
        import evalica

        a, b = (np.array(games.players)[k].tolist() for k in (games.player_a, games.player_b))
        won = [evalica.Winner.X if score else evalica.Winner.Y for score in games.score_a]
        peers["evalica"] = lambda: evalica.bradley_terry(a, b, won)
    return kept("fit of 10^6 games of 5,000 players", lambda: fit(games, prior_sd=1.0), peers, 0.17)


def double() -> Question:
    bracket, win = double_elimination(names(16)), strengths(16)
    assert title_odds(bracket, win).exact
    peers: dict[str, Call] = {"dice of 10,000 evenings": dice(31)}
    work = "double elimination of 16, default drops, exact"
    return question(work, lambda: title_odds(bracket, win), peers, 2)


# The command line ----------------------------------------------------------------------


def start() -> Question:
    folder = tempfile.mkdtemp()
    file = Path(folder, "arcs.csv")
    file.write_text("source,target,probability\na,b,.5\na,c,.5\nb,a,.25\nb,d,.75\n", "utf-8")

    def run(*arguments: str) -> Call:
        return partial(
            subprocess.run, [sys.executable, *arguments], check=True, capture_output=True
        )

    peers = {"bare imports": run("-c", "import numpy, scipy.sparse, networkx, click")}
    ours = run("-m", "evenbreak", "chain", str(file))
    return question("start and answer of `evenbreak chain`", ours, peers, 1.2)


MATCH_ROWS: dict[str, list[Callable[[], Question]]] = {
    "ahead": [partial(n_ahead, n) for n in (50, 5_000, 50_000)],
    "oneball": [one_ball],
    "double": [double],
    "start": [start],
    "ruin": [partial(ruin, n) for n in (10_001, 100_001)],
    "races": [partial(race, asked) for asked in ("chance", "length")],
    "ladder": [partial(ladder, n) for n in (2_001, 20_001)],
    "fractions": [ladder_in_fractions],
    "networkx": [digraph_to_limit],
    "betainc": [many_races],
    "ratings": [ratings],
}
