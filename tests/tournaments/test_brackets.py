"""Brackets: layouts as they are played, byes, places, numbers of matches."""

from __future__ import annotations

from collections import Counter

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    Bracket,
    Source,
    consolation,
    double_elimination,
    groups_then_knockout,
    king_of_the_hill,
    pods,
    round_robin,
    single_elimination,
    title_odds,
)
from rows import each_of


def short(slot: int | Source) -> str:
    """Return a slot as the layouts write it: lW2.1, wL1.1, or the seed."""
    return str(slot + 1) if isinstance(slot, int) else f"{slot.outcome[0]}{slot.match}"


def layout(bracket: Bracket) -> dict[str, tuple[str, str]]:
    return {match.name: tuple(map(short, match.slots)) for match in bracket.matches}


def losers(bracket: Bracket, number: int) -> list[str]:
    """Return what drops into a round of the losers' side, match by match."""
    drops = layout(bracket)
    names = [name for name in drops if name.startswith(f"L{number}.")]
    return [drops[name][0] for name in names]


def test_four_players() -> None:
    assert layout(double_elimination(4)) == {
        "W1.1": ("1", "4"),
        "W1.2": ("2", "3"),
        "L1.1": ("lW1.1", "lW1.2"),
        "W2.1": ("wW1.1", "wW1.2"),
        "L2.1": ("lW2.1", "wL1.1"),
        "F": ("wW2.1", "wL2.1"),
        "F2": ("lF", "wF"),
    }


def test_eight_players() -> None:
    found = layout(double_elimination(8))
    assert [found[f"W1.{i}"] for i in (1, 2, 3, 4)] == [
        ("1", "8"),
        ("4", "5"),
        ("2", "7"),
        ("3", "6"),
    ]
    assert found["L1.1"] == ("lW1.1", "lW1.2")
    assert found["L1.2"] == ("lW1.3", "lW1.4")
    assert found["L2.1"] == ("lW2.2", "wL1.1")
    assert found["L2.2"] == ("lW2.1", "wL1.2")
    assert found["L3.1"] == ("wL2.1", "wL2.2")
    assert found["L4.1"] == ("lW3.1", "wL3.1")


def test_sixteen_players() -> None:
    fewest, usual = double_elimination(16), double_elimination(16, drops="usual")
    assert losers(fewest, 2) == ["lW2.4", "lW2.3", "lW2.2", "lW2.1"]
    assert losers(fewest, 4) == ["lW3.1", "lW3.2"]
    assert layout(fewest)["L2.3"] == ("lW2.2", "wL1.3")
    assert layout(fewest)["L3.2"] == ("wL2.3", "wL2.4")
    assert layout(fewest)["L6.1"] == ("lW4.1", "wL5.1")
    assert losers(usual, 2) == ["lW2.2", "lW2.1", "lW2.4", "lW2.3"]
    assert losers(usual, 4) == ["lW3.2", "lW3.1"]


def test_thirty_two_players_as_usual() -> None:
    bracket = double_elimination(32, drops="usual")
    assert losers(bracket, 2) == [f"lW2.{i}" for i in range(8, 0, -1)]
    assert losers(bracket, 4) == ["lW3.3", "lW3.4", "lW3.1", "lW3.2"]
    assert losers(bracket, 6) == ["lW4.1", "lW4.2"]


def test_drops_of_ones_own() -> None:
    bracket = double_elimination(16, drops=[[2, 3, 4, 1]])
    assert losers(bracket, 2) == ["lW2.2", "lW2.3", "lW2.4", "lW2.1"]
    assert losers(bracket, 4) == ["lW3.1", "lW3.2"]
    with pytest.raises(InputError, match="round 1"):
        double_elimination(16, drops=[[1, 1, 2, 3]])
    with pytest.raises(InputError, match="'reverse'"):
        double_elimination(16, drops="reverse")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("players", "qualifiers", "matches"),
    [(32, 8, 59), (16, 8, 27), (16, 4, 29), (64, 16, 119), (24, 8, 43), (256, 64, 479)],
)
def test_down_to_qualifiers(players: int, qualifiers: int, matches: int) -> None:
    assert len(double_elimination(players, qualifiers=qualifiers).matches) == matches


def test_qualifiers_meet_by_half_shift() -> None:
    found = layout(double_elimination(16, qualifiers=8))
    assert found["K1.1"] == ("wW2.1", "wL2.3")
    assert found["K1.2"] == ("wW2.2", "wL2.4")
    assert found["K1.3"] == ("wW2.3", "wL2.1")
    assert found["K1.4"] == ("wW2.4", "wL2.2")


def test_qualifiers_redrawn() -> None:
    samples = [
        layout(
            double_elimination(16, qualifiers=8, placement="redraw", rng=np.random.default_rng(k))
        )
        for k in range(20)
    ]
    assert len({tuple(draw[f"K1.{i}"][1] for i in (1, 2, 3, 4)) for draw in samples}) > 10
    assert all(draw["K1.1"][0] == "wW2.1" for draw in samples)
    with pytest.raises(InputError, match="rng"):
        double_elimination(16, qualifiers=8, placement="redraw")


@each_of("players", [*range(2, 34), 100, 256])
def test_number_of_matches(players: int) -> None:
    assert len(single_elimination(players).matches) == players - 1
    assert len(double_elimination(players).matches) == 2 * players - 1
    assert len(double_elimination(players, final="single").matches) == 2 * players - 2


@given(st.integers(2, 70), st.sampled_from(["fewest rematches", "usual", "straight"]))
def test_byes_leave_a_sound_bracket(players: int, drops) -> None:
    bracket = double_elimination(players, drops=drops)
    seats = Counter(slot for match in bracket.matches for slot in match.slots)
    assert max(seats.values()) == 1
    assert sorted(slot for slot in seats if isinstance(slot, int)) == list(range(players))
    size = max(2, 1 << (players - 1).bit_length())
    assert [player for _, player in sorted(bracket.byes, key=lambda bye: bye[1])] == list(
        range(size - players)
    )
    names = [match.name for match in bracket.matches]
    for at, match in enumerate(bracket.matches):
        for slot in match.slots:
            if isinstance(slot, Source):
                assert slot.match in names[:at]
    # A winner's place is given once, a loser's by each match that sends them nowhere.
    spans = [place.last - place.first + 1 for place in bracket.places]
    assert sum(spans) == players


def test_a_bye_drops_a_bye_and_two_of_them_pass_one_on() -> None:
    found = layout(double_elimination(5))
    assert double_elimination(5).byes == (("W1.1", 0), ("W1.3", 1), ("W1.4", 2))
    assert found["W1.2"] == ("4", "5")
    # L1.1 is between a bye and the loser of W1.2, L1.2 between two byes.
    assert found["L2.1"] == ("lW2.2", "lW1.2")
    assert found["L3.1"] == ("wL2.1", "lW2.1")
    assert "L1.1" not in found
    assert "L2.2" not in found


def test_places() -> None:
    assert [str(place) for place in double_elimination(32).places] == [
        *("1", "2", "3", "4", "5-6", "7-8", "9-12", "13-16", "17-24", "25-32")
    ]
    assert [str(place) for place in single_elimination(16, third_place=True).places] == [
        *("1", "2", "3", "4", "5-8", "9-16")
    ]
    assert [str(place) for place in double_elimination(6).places] == ["1", "2", "3", "4", "5-6"]
    assert [str(place) for place in double_elimination(16, qualifiers=8).places] == [
        *("1", "2", "3-4", "5-8", "9-12", "13-16")
    ]
    assert [str(place) for place in king_of_the_hill(4).places] == ["1", "2", "3", "4"]
    assert [str(place) for place in pods(16).places] == [
        *("1", "2", "3-4", "5-6", "7-8", "9-12", "13-16")
    ]


def test_third_place_needs_semifinals() -> None:
    assert len(single_elimination(3, third_place=True).matches) == 2
    assert layout(single_elimination(4, third_place=True))["T"] == ("lW1.1", "lW1.2")


def test_consolation_takes_those_who_lose_their_first_match() -> None:
    bracket = consolation(6)  # byes for 1 and 2
    found = layout(bracket)
    assert found["W2.1"] == ("1", "wW1.2")
    sources = {
        slot for match in bracket.matches if match.side == "consolation" for slot in match.slots
    }
    assert {source for source in sources if source.match[0] == "W"} == {
        Source("W1.2", "loser"),
        Source("W1.4", "loser"),
        Source("W2.1", "loser", via=1),
        Source("W2.2", "loser", via=1),
    }


def test_pods_end_in_one_match_each() -> None:
    found = layout(pods(32))
    assert found["P2"] == ("wW3.2", "wL4.2")
    assert found["K1.1"] == ("wP1", "wP2")
    # Within a pod drops cross over, and never leave the pod.
    assert losers(pods(32), 2) == [f"lW2.{i}" for i in (2, 1, 4, 3, 6, 5, 8, 7)]
    two = layout(pods(32, qualifiers=2))
    assert two["K1.1"] == ("wW3.1", "wL4.3")
    with pytest.raises(InputError, match="smaller pods"):
        pods(8)


@pytest.mark.parametrize("players", [2, 3, 4, 7, 8])
def test_round_robin_lets_everybody_meet_everybody(players: int) -> None:
    bracket = round_robin(players)
    pairs = Counter(frozenset(match.slots) for match in bracket.matches)
    assert len(pairs) == players * (players - 1) // 2
    assert set(pairs.values()) == {1}
    for number in {match.round for match in bracket.matches}:
        seats = [slot for match in bracket.matches if match.round == number for slot in match.slots]
        assert len(set(seats)) == len(seats)


def test_groups_cross_over() -> None:
    bracket = groups_then_knockout(16, 4)
    assert [group.members for group in bracket.groups] == [
        (0, 7, 8, 15),
        (1, 6, 9, 14),
        (2, 5, 10, 13),
        (3, 4, 11, 12),
    ]
    found = {match.name: match.slots for match in bracket.matches if match.side == "knock-out"}
    assert found["K1.1"] == (Source("A", 1), Source("B", 2))
    assert found["K1.3"] == (Source("B", 1), Source("A", 2))
    assert [str(place) for place in bracket.places] == ["1", "2", "3-4", "5-8", "9-12", "13-16"]


@pytest.mark.parametrize(("players", "groups", "qualifiers"), [(12, 3, 2), (20, 5, 1), (18, 3, 3)])
def test_odd_groups_have_byes_and_stay_apart(players: int, groups: int, qualifiers: int) -> None:
    bracket = groups_then_knockout(players, groups, qualifiers=qualifiers)
    first = [match for match in bracket.matches if match.side in ("knock-out", "final")]
    seated = [slot for match in first for slot in match.slots if slot.match in "ABCDE"]
    assert len(seated) == len(set(seated)) == groups * qualifiers
    for match in first:
        if match.round == 1:
            assert match.slots[0].match != match.slots[1].match
    spans = [place.last - place.first + 1 for place in bracket.places]
    assert sum(spans) == players


def test_the_graph_says_where_players_go() -> None:
    graph = double_elimination(4).graph
    assert nx.is_directed_acyclic_graph(graph)
    assert nx.is_frozen(graph)
    assert graph.edges["W1.1", "W2.1"] == {"winner": 1}
    assert graph.edges["W1.1", "L1.1"] == {"loser": 1}
    assert graph.edges["F", "F2"] == {"loser": 1, "winner": 2}
    assert graph.nodes["L2.1"]["side"] == "losers"
    groups = groups_then_knockout(8, 2).graph
    assert groups.edges["A", "K1.1"] == {"ranks": {1: 1}}
    assert groups.has_edge("A:1.1", "A")


def test_equal_brackets_are_one() -> None:
    assert double_elimination(9) == double_elimination(9)
    assert hash(double_elimination(9)) == hash(double_elimination(9))
    assert double_elimination(9) != double_elimination(9, final="single")


@each_of(
    "build, named",
    [
        (lambda: single_elimination(["Ann"]), "names"),
        (lambda: single_elimination(257), "257"),
        (lambda: single_elimination("Ann"), "'Ann'"),
        (lambda: single_elimination(["Ann", "Ann"]), "'Ann' twice"),
        (lambda: single_elimination(3, lines=[0, 1, 2]), "lines"),
        (lambda: single_elimination(3, lines=[0, 1, 1, 2]), "lines"),
        (lambda: double_elimination(8, qualifiers=3), "qualifiers must be .* is 3"),
        (lambda: double_elimination(8, qualifiers=16), "qualifiers must be .* is 16"),
        (lambda: double_elimination(8, final="best"), "final"),
        (lambda: groups_then_knockout(8, 5), "groups is 5"),
        (lambda: groups_then_knockout(8, 1, qualifiers=1), "qualifiers"),
        (lambda: consolation(3), "names"),
    ],
)
def test_what_cannot_be_drawn_is_refused(build, named: str) -> None:
    with pytest.raises(InputError, match=named):
        build()


@each_of("players, groups, qualifiers", [(12, 6, 1), (18, 6, 2), (24, 8, 1)])
def test_a_group_and_a_match_never_share_a_name(players, groups, qualifiers):
    bracket = groups_then_knockout(players, groups, qualifiers=qualifiers, third_place=True)
    names = [*bracket.by_name, *(group.name for group in bracket.groups)]
    assert len(set(names)) == len(names)
    assert bracket.matches[-2].side == "final"
    skill = np.linspace(1.0, 0.0, players)
    win = 1.0 / (1.0 + np.exp(skill - skill[:, None]))
    sampled = title_odds(bracket, win, most_states=1, samples=4000)
    assert sampled.title.sum() == pytest.approx(1.0)
    odds = title_odds(bracket, win)
    assert (np.abs(odds.title - sampled.title) < 5.0 * sampled.error.max() + 1e-3).all()
