"""Title odds: published figures, closed forms, enumeration, and the laws that they obey."""

from __future__ import annotations

from fractions import Fraction as Fr

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.tournaments import (
    WALKOVERS,
    Place,
    consolation,
    double_elimination,
    groups_then_knockout,
    king_of_the_hill,
    pods,
    prizes,
    round_robin,
    single_elimination,
    title_odds,
)
from rows import each_of
from tiers import examples
from tournaments import enumerated
from tournaments.fields import by_fargo, by_seed, by_strength, one_favorite


def place(odds, first: int) -> np.ndarray:
    return odds.place(next(p for p in odds.bracket.places if p.first == first))


# Strength shares, standard seeding, true double final.


def test_four_players_in_fractions() -> None:
    odds = title_odds(double_elimination(4), by_strength([4, 3, 2, 1]))
    table = {
        1: (Fr(265088, 496125), Fr(58893, 196000), Fr(1364, 10125), Fr(69157, 2268000)),
        2: (Fr(129292, 496125), Fr(67107, 196000), Fr(19657, 70875), Fr(271403, 2268000)),
        3: (Fr(206, 1575), Fr(81, 350), Fr(548, 1575), Fr(913, 3150)),
        4: (Fr(13, 175), Fr(22, 175), Fr(6, 25), Fr(14, 25)),
    }
    for first, row in table.items():
        assert place(odds, first) == pytest.approx([float(x) for x in row], rel=1e-13)
    assert odds.p_second_final == pytest.approx(169 / 360, rel=1e-13)


def test_eight_players() -> None:
    odds = title_odds(double_elimination(8), by_seed(8))
    assert odds.title == pytest.approx(
        [
            *(0.36312485, 0.256034836, 0.172601696, 0.108658694),
            *(0.061347861, 0.028356302, 0.00885551, 0.001020251),
        ],
        abs=1e-9,
    )
    assert odds.p_second_final == pytest.approx(0.485005058, abs=1e-9)


def test_eight_players_by_fargo() -> None:
    odds = title_odds(double_elimination(8), by_fargo(range(700, 380, -40)))
    assert odds.title == pytest.approx(
        [0.454415, 0.268084, 0.145224, 0.073044, 0.034337, 0.015342, 0.006688, 0.002866], abs=1e-6
    )
    assert odds.p_second_final == pytest.approx(0.474448, abs=1e-6)


JANE_STREET = [1, 16, 8, 9, 5, 12, 4, 13, 6, 11, 3, 14, 7, 10, 2, 15]


def bracketology(swap: tuple[int, int] | None = None) -> np.ndarray:
    lines = list(JANE_STREET)
    if swap:
        i, j = (lines.index(seed) for seed in swap)
        lines[i], lines[j] = lines[j], lines[i]
    seeds = np.arange(1, 17)
    win = seeds[None, :] / (seeds[:, None] + seeds)  # the lower number is the stronger
    bracket = single_elimination(16, lines=[seed - 1 for seed in lines])
    return title_odds(bracket, win).title


@pytest.mark.slow
def test_bracketology() -> None:
    before = bracketology()
    assert before[[0, 1, 2, 3, 4]] == pytest.approx(
        [0.519218, 0.216040, 0.106789, 0.056686, 0.033562], abs=1e-6
    )
    assert bracketology((3, 16))[1] == pytest.approx(0.281619, abs=1e-6)
    gains = {
        (a, b): bracketology((a, b))[1]
        for a in range(1, 17)
        for b in range(a + 1, 17)
        if 2 not in (a, b)
    }
    assert max(gains, key=gains.__getitem__) == (3, 16)


def test_better_player_wins_two_in_three() -> None:
    rank = np.arange(4)
    win = np.where(rank[:, None] < rank, 2 / 3, 1 / 3)
    np.fill_diagonal(win, 0.5)
    assert title_odds(single_elimination(4), win).title[0] == pytest.approx(4 / 9, rel=1e-14)
    ladder = [
        title_odds(king_of_the_hill(4), np.roll(np.roll(win, k, 0), k, 1)).title[k]
        for k in range(4)
    ]
    assert np.mean(ladder) == pytest.approx(23 / 54, rel=1e-14)


# A favorite among equals, whatever the draw and the drops.


def closed_form(k: int, p: Fr, *, true_final: bool) -> Fr:
    q = 1 - p
    if true_final:
        return (
            p**k * (1 - q**2)
            + q * p ** (2 * k)
            + sum((q * p ** (2 * k - r + 2) for r in range(2, k + 1)), Fr(0))
        )
    return (
        p ** (k + 1)
        + q * p ** (2 * k - 1)
        + sum((q * p ** (2 * k - r + 1) for r in range(2, k + 1)), Fr(0))
    )


def test_the_closed_form_gives_the_table() -> None:
    table = {2: (20, 27), 4: (128, 243), 8: (800, 2187), 16: (4928, 19683), 32: (30080, 177147)}
    table[64] = (182528, 1594323)
    for n, (top, bottom) in table.items():
        k = n.bit_length() - 1
        assert closed_form(k, Fr(2, 3), true_final=True) == Fr(top, bottom)
        assert closed_form(k, Fr(1, 2), true_final=True) == Fr(1, n)


@each_of("n", [2, 4, 8, 16])
@each_of("drops", ["fewest rematches", "usual", "straight"])
@each_of("final", ["true", "single"])
def test_a_favorite_among_equals(n: int, drops, final) -> None:
    k = n.bit_length() - 1
    bracket = double_elimination(n, drops=drops, final=final)
    for p in (Fr(2, 3), Fr(1, 2)):
        want = float(closed_form(k, p, true_final=final == "true"))
        for at in (0, n // 2, n - 1):
            odds = title_odds(bracket, one_favorite(n, float(p), at))
            assert odds.title[at] == pytest.approx(want, rel=1e-12)
    single = title_odds(single_elimination(n), one_favorite(n, 2 / 3)).title[0]
    assert single == pytest.approx((2 / 3) ** k, rel=1e-13)


@pytest.mark.parametrize("n", [32, 64])
def test_a_favorite_in_large_brackets(n: int) -> None:
    odds = title_odds(double_elimination(n, drops="straight"), one_favorite(n, 2 / 3))
    want = closed_form(n.bit_length() - 1, Fr(2, 3), true_final=True)
    assert odds.exact
    assert odds.title[0] == pytest.approx(float(want), rel=1e-11)


@pytest.mark.parametrize(
    ("n", "p", "want"),
    [
        *((n, 1 / 2, Fr(1, 2)) for n in (4, 8, 16)),
        (4, 2 / 3, Fr(77, 162)),
        (4, 3 / 4, Fr(55, 128)),
        (8, 2 / 3, Fr(713, 1458)),
        (8, 3 / 4, Fr(943, 2048)),
    ],
)
def test_second_final(n: int, p: float, want: Fr) -> None:
    odds = title_odds(double_elimination(n), one_favorite(n, p))
    assert odds.p_second_final == pytest.approx(float(want), rel=1e-12)


def test_title_after_the_first_match() -> None:
    bracket = double_elimination(8)
    win = np.full((8, 8), 0.5)
    lost = title_odds(bracket, win, results={"W1.1": "8"}).title
    assert lost[0] == pytest.approx(1 / 64, rel=1e-13)
    assert lost[7] == pytest.approx(15 / 64, rel=1e-13)


# Against every course of the tournament, one after the other.

SMALL = [
    *(double_elimination(n, final=final) for n in (2, 3, 4, 5, 6) for final in ("true", "single")),
    double_elimination(8, final="single"),
    double_elimination(7),
    double_elimination(8, qualifiers=4),
    double_elimination(6, qualifiers=2),
    double_elimination(5, qualifiers=8),
    single_elimination(5),
    single_elimination(8, third_place=True),
    consolation(5),
    consolation(7),
    consolation(8),
    king_of_the_hill(5),
    pods(8, size=4),
    pods(8, size=4, qualifiers=2),
    round_robin(4),
    round_robin(3, times=2),
    groups_then_knockout(6, 2),
    groups_then_knockout(7, 2),
    groups_then_knockout(9, 3, qualifiers=1),
]


@pytest.mark.slow_after(8)
@pytest.mark.parametrize("bracket", SMALL, ids=lambda b: f"{b.format} {len(b.players)}")
def test_all_courses(bracket) -> None:
    strengths = list(range(len(bracket.players), 0, -1))
    chance = enumerated.by_strength(strengths)
    odds = title_odds(bracket, by_strength(strengths))
    want, matches = enumerated.odds(bracket, chance)
    assert odds.exact
    assert odds.p_place == pytest.approx(np.array(want, dtype=float), rel=1e-12, abs=1e-15)
    assert odds.matches_mean == pytest.approx(float(matches))


@pytest.mark.slow
@pytest.mark.parametrize("players", [5, 8])
def test_handicapped_races_by_round(players: int) -> None:
    """Each match has chances of its own, in fractions, byes included."""
    bracket = double_elimination(players)
    tables = {
        match.name: [
            [
                Fr(1, 2) if i == j else Fr(players - i + k % 3, 2 * players - i - j + 2 * (k % 3))
                for j in range(players)
            ]
            for i in range(players)
        ]
        for k, match in enumerate(bracket.matches)
    }
    want = enumerated.place_odds(bracket, lambda name, i, j: tables[name][i][j])
    win = {name: np.array(table, dtype=float) for name, table in tables.items()}
    assert title_odds(bracket, win).p_place == pytest.approx(np.array(want, dtype=float), rel=1e-12)


def test_rare_titles_have_their_digits() -> None:
    """Whoever is seeded lower wins once in 2^20 matches, a chance that doubles hold exactly."""
    bracket, rare = double_elimination(6), 2.0**-20
    win = np.triu(np.full((6, 6), 1.0 - rare), 1) + np.tril(np.full((6, 6), rare), -1)
    np.fill_diagonal(win, 0.5)
    want = enumerated.place_odds(bracket, lambda _, i, j: Fr(win[i, j]))
    exact = np.array(want, dtype=float)
    found = title_odds(bracket, win).p_place
    np.testing.assert_allclose(found, exact, rtol=1e-14)


def test_who_meets_whom() -> None:
    bracket = double_elimination(5)
    chance = enumerated.by_strength([5, 4, 3, 2, 1])
    odds = title_odds(bracket, by_seed(5))
    for i in range(5):
        for j in range(i):
            want = enumerated.expected(
                bracket, chance, lambda met, i=i, j=j: sum({a, b} == {i, j} for _, a, b, _ in met)
            )
            assert odds.expected_meetings()[i, j] == pytest.approx(float(want), rel=1e-12)
    final = odds.meetings["F"]
    assert final.probability.sum() == pytest.approx(1.0)
    assert odds.meetings["F2"].played == pytest.approx(odds.p_second_final)


# Evidence.


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("bracket", [double_elimination(6), consolation(6), pods(8, size=4)])
def test_total_probability(bracket) -> None:
    """Odds now are the mean of the odds after each result of any match, players known or not."""
    win = by_seed(len(bracket.players))
    now = title_odds(bracket, win)
    for match in bracket.matches:
        meeting = now.meetings[match.name]
        won = meeting.probability * meeting.first_wins
        p = np.bincount(meeting.first, won, len(win))
        p += np.bincount(meeting.second, meeting.probability - won, len(win))
        assert p.sum() == pytest.approx(meeting.played)
        if meeting.played < 1.0 - 1e-12:
            continue  # it may not be played: nobody wins it then
        mean = sum(
            p[k] * title_odds(bracket, win, results={match.name: player}).p_place
            for k, player in enumerate(bracket.players)
            if p[k] > 0.0
        )
        assert mean == pytest.approx(now.p_place, rel=1e-11, abs=1e-14)


def test_results_of_groups() -> None:
    bracket, win = groups_then_knockout(6, 2), by_seed(6)
    now = title_odds(bracket, win)
    for match in bracket.groups[0].matches:
        one, other = bracket.match(match).slots
        p = win[one, other]
        mean = sum(
            share * title_odds(bracket, win, results={match: bracket.players[k]}).p_place
            for k, share in ((one, p), (other, 1.0 - p))
        )
        assert mean == pytest.approx(now.p_place, rel=1e-12)
    settled = {"A:1.1": "4", "A:2.1": "5", "A:3.1": "1"}  # each beat one: level
    lots = {"A": ["5", "1", "4"]}
    level = title_odds(bracket, win, results=settled)
    assert 0.0 < level.place(Place(5, 6))[0] < 1.0
    assert title_odds(bracket, win, results={**settled, **lots}).place(Place(5, 6))[3] == 1.0


def test_a_tournament_to_the_end() -> None:
    bracket, win = double_elimination(4), by_seed(4)
    results = {"W1.1": "4", "W1.2": "2", "L1.1": "1", "W2.1": "4", "L2.1": "1", "F": "1"}
    assert title_odds(bracket, win, results=results).p_second_final == 1.0
    done = title_odds(bracket, win, results={**results, "F2": "4"})
    assert done.p_place.argmax(axis=1).tolist() == [1, 2, 3, 0]
    assert done.p_place.max(axis=1).tolist() == [1.0] * 4
    assert done.matches_mean == 7.0
    short = title_odds(bracket, win, results={**results, "F": "4"})
    assert short.title.tolist() == [0.0, 0.0, 0.0, 1.0]
    assert short.matches_mean == 6.0


def test_live_chance_and_walkovers() -> None:
    bracket, win = double_elimination(4), by_seed(4)
    lead = title_odds(bracket, win, live={"W1.1": 0.9}).title
    up, down = (title_odds(bracket, win, results={"W1.1": who}).title for who in ("1", "4"))
    assert lead == pytest.approx(0.9 * up + 0.1 * down)
    assert WALKOVERS == 0.047
    level = title_odds(bracket, win, walkovers=1.0).title
    assert level == pytest.approx([0.25] * 4)
    mixed = title_odds(bracket, win, walkovers={"F": 0.2})
    by_hand = title_odds(
        bracket, {m.name: 0.1 + 0.8 * win if m.name == "F" else win for m in bracket.matches}
    )
    assert mixed.title == pytest.approx(by_hand.title)


# Laws.

strengths = st.lists(st.floats(0.05, 20.0), min_size=2, max_size=9)
formats = st.sampled_from(
    [
        single_elimination,
        double_elimination,
        lambda n: double_elimination(n, final="single", drops="straight"),
        lambda n: double_elimination(n, qualifiers=2),
        lambda n: round_robin(min(n, 6)),
        king_of_the_hill,
        lambda n: consolation(max(n, 4)),
        lambda n: groups_then_knockout(max(n, 4), 2),
    ]
)


def field(bracket, drawn: list[float]) -> np.ndarray:
    count = len(bracket.players)
    return by_strength((drawn * 3)[:count])


@settings(max_examples=examples(30))
@given(strengths, formats)
def test_chances_add_up(drawn: list[float], form) -> None:
    bracket = form(len(drawn))
    odds = title_odds(bracket, field(bracket, drawn))
    assert odds.p_place.min() >= 0.0
    assert odds.p_place.sum(axis=1) == pytest.approx(np.ones(len(bracket.players)))
    for k, spot in enumerate(bracket.places):
        if not any(p.event for p in bracket.places):
            assert odds.p_place[:, k].sum() == pytest.approx(spot.last - spot.first + 1)


@settings(max_examples=examples(40))
@given(st.permutations(range(7)), st.sampled_from([single_elimination, double_elimination]))
def test_players_can_be_renamed(order: list[int], form) -> None:
    """Who sits on a line decides, not where the name is in the list."""
    win = by_strength([1, 2, 4, 7, 11, 16, 22])
    lines = [0, None, 3, 4, 1, 6, 2, 5]
    odds = title_odds(form(7, lines=lines), win).p_place
    moved = [None if k is None else order.index(k) for k in lines]
    again = title_odds(form(7, lines=moved), win[np.ix_(order, order)]).p_place
    assert again == pytest.approx(odds[order], rel=1e-12)


@settings(max_examples=examples(30))
@given(strengths, formats, st.floats(1.01, 5.0), st.data())
def test_a_stronger_player_never_loses_by_it(drawn, form, factor: float, data) -> None:
    bracket = form(len(drawn))
    field_strengths = (drawn * 3)[: len(bracket.players)]
    k = data.draw(st.integers(0, len(bracket.players) - 1))
    before = title_odds(bracket, by_strength(field_strengths)).title[k]
    field_strengths[k] *= factor
    after = title_odds(bracket, by_strength(field_strengths)).title[k]
    assert after >= before - 1e-12


@pytest.mark.slow
@settings(max_examples=examples(10))
@given(st.lists(st.floats(0.1, 10.0), min_size=5, max_size=8), st.data())
def test_odds_move_fairly_through_a_tournament(drawn, data) -> None:
    """At every point the odds are the mean of those after the next result."""
    bracket, win = double_elimination(len(drawn)), by_strength(drawn)
    results: dict[str, str] = {}
    odds = title_odds(bracket, win)
    for match in bracket.matches:
        meeting = odds.meetings[match.name]
        if not meeting.played:
            continue
        assume(len(meeting.first) == 1)
        one, other, p = int(meeting.first[0]), int(meeting.second[0]), float(meeting.first_wins[0])
        after = [
            title_odds(bracket, win, results={**results, match.name: bracket.players[k]})
            for k in (one, other)
        ]
        mean = p * after[0].p_place + (1.0 - p) * after[1].p_place
        assert mean == pytest.approx(odds.p_place, rel=1e-9, abs=1e-13)
        took = data.draw(st.integers(0, 1))
        results[match.name] = bracket.players[(one, other)[took]]
        odds = after[took]
    assert sorted(odds.title) == pytest.approx([0.0] * (len(drawn) - 1) + [1.0])


# Money, and what is refused.


def test_prizes() -> None:
    bracket = double_elimination(8)
    assert prizes(bracket, [50, 30, 15, 5, 4, 2]).tolist() == [50, 30, 15, 5, 3, 0]
    odds = title_odds(bracket, by_seed(8))
    assert odds.expected_prize([50, 30, 15, 5]).sum() == pytest.approx(100.0)
    assert prizes(consolation(8), [10])[-1] == 0.0
    with pytest.raises(InputError, match="payouts"):
        prizes(bracket, [1] * 9)


def test_odds_as_a_table() -> None:
    odds = title_odds(double_elimination(8), by_seed(8))
    table = odds.to_frame()
    assert list(table.columns) == ["1", "2", "3", "4", "5-6", "7-8"]
    assert table.to_numpy().tolist() == odds.p_place.tolist()
    assert tuple(table.index) == odds.bracket.players


def test_a_function_of_names() -> None:
    bracket = single_elimination(["Ann", "Bo", "Cy"])
    odds = title_odds(bracket, lambda i, j: 0.75 if i < j else 0.25)
    assert odds.title == pytest.approx([0.75, 0.1875, 0.0625])


@each_of(
    "asked, named",
    [
        ({"win": np.full((3, 3), 0.5)}, "shape"),
        ({"win": np.full((4, 4), 0.6)}, "add up"),
        ({"win": np.full((4, 4), 1.5)}, "1.5"),
        ({"win": {"W1.1": np.full((4, 4), 0.5)}}, "W1.2"),
        ({"results": {"X1.1": "1"}}, "X1.1"),
        ({"results": {"W1.1": "9"}}, "'9'"),
        ({"results": {"W1.1": "2"}}, "W1.1"),
        ({"results": {"W1.1": "1", "W1.2": "2", "L1.1": "1"}}, "L1.1"),
        ({"live": {"W2.1": 0.5}}, "W2.1"),
        ({"live": {"W1.1": 1.5}}, "W1.1"),
        ({"walkovers": 2}, "walkovers"),
        ({"walkovers": {"X": 0.1}}, "'X'"),
    ],
)
def test_what_cannot_be_answered_is_refused(asked: dict, named: str) -> None:
    with pytest.raises(InputError, match=named):
        title_odds(double_elimination(4), **{"win": by_seed(4), **asked})


@pytest.mark.parametrize("results", [{"W2.1": "1", "L2.1": "1"}, {"W1.1": "4", "W2.1": "1"}])
def test_results_that_cannot_all_happen(results: dict[str, str]) -> None:
    with pytest.raises(InputError, match="can't all happen"):
        title_odds(double_elimination(4), by_seed(4), results=results)
