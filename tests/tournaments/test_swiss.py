"""Swiss tournaments; pairing needs the extra."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    Pairing,
    swiss,
    swiss_odds,
    swiss_round,
    swiss_standings,
)
from tournaments.fields import by_seed

NAMES = ["Ann", "Bo", "Cy", "Di", "Ed"]
FIRST = [Pairing("Ann", "Cy", "Ann"), Pairing("Di", "Bo", "Bo"), Pairing("Ed", None)]


def test_standings() -> None:
    event = swiss(NAMES, 3)
    second = [Pairing("Ann", "Bo", "Bo"), Pairing("Ed", "Cy", "Cy"), Pairing("Di", None)]
    rows = swiss_standings(event, [FIRST, second])
    assert [(row.player, row.score, row.buchholz) for row in rows] == [
        ("Bo", 2, 2),
        ("Ann", 1, 3),
        ("Cy", 1, 2),
        ("Di", 1, 2),
        ("Ed", 1, 1),
    ]


@pytest.mark.parametrize(
    ("played", "named"),
    [
        ([FIRST[:2]], "round 1"),
        ([[*FIRST[:2], Pairing("Ann", None)]], "round 1"),
        ([[FIRST[0]._replace(winner="Bo"), *FIRST[1:]]], "'Bo'"),
        ([FIRST, FIRST[:2], FIRST], "round 3"),
        ([FIRST] * 4, "4 rounds"),
    ],
)
def test_rounds_that_are_not_complete_are_refused(played, named: str) -> None:
    with pytest.raises(InputError, match=named):
        swiss_standings(swiss(NAMES, 3), played)


def test_too_many_rounds_are_refused() -> None:
    assert swiss(NAMES, 5).rounds == 5
    with pytest.raises(InputError, match=r"rounds must be .* it is 6"):
        swiss(NAMES, 6)


def test_without_the_extra_it_says_what_to_install(monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "caissify_pairings", None)
    with pytest.raises(InputError, match=r"evenbreak\[swiss\]"):
        swiss_round(swiss(NAMES, 3))


@pytest.mark.parametrize("system", ["dutch", "casual"])
@pytest.mark.parametrize("players", [8, 9])
def test_rounds_are_paired_as_results_come(system, players: int) -> None:
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    event = swiss(players, 4, system=system)
    rng = np.random.default_rng(1)
    played: list[list[Pairing]] = []
    for _ in range(4):
        pairings = swiss_round(event, played)
        winners = [p.second if p.second and rng.random() < 0.4 else p.first for p in pairings]
        played.append(
            [
                p._replace(winner=w if p.second else None)
                for p, w in zip(pairings, winners, strict=True)
            ]
        )
    met = [frozenset((p.first, p.second)) for r in played for p in r if p.second]
    byes = [p.first for r in played for p in r if p.second is None]
    assert len(met) == 4 * (players // 2)
    if system == "dutch":
        assert len(set(met)) == len(met)
    assert len(byes) == len(set(byes)) == 4 * (players % 2)
    with pytest.raises(InputError, match="all 4 rounds"):
        swiss_round(event, played)


def test_odds() -> None:
    pytest.importorskip("caissify_pairings", reason="needs the extra 'swiss'")
    event = swiss(6, 3)
    odds = swiss_odds(event, by_seed(6), runs=300)
    assert odds.p_place.sum(axis=0) == pytest.approx(np.ones(6))
    assert odds.title[0] > odds.title[5]
    level = swiss_odds(event, np.full((6, 6), 0.5), runs=600)
    assert (np.abs(level.title - 1 / 6) < 5 * level.error[:, 0]).all()
    with pytest.raises(InputError, match="win"):
        swiss_odds(event, np.full((3, 3), 0.5))
