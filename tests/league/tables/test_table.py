"""Tables against a ladder in plain Python, rules of real leagues, and laws of every table."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.league import TableMatches, TableRules, league_table, player_matches, team_matches
from evenbreak.league.tables.rules import TIE_BREAKS, Outcomes
from evenbreak.ratings import Results
from rows import each_of
from tiers import examples

NAMES = ("Ann", "Bo", "Cy", "Di", "Ed")
Row = tuple[int, int, int, int, bool]


def matches_of(rows: list[Row], names: tuple[str, ...] = NAMES) -> TableMatches:
    """Return matches: who, whom, score, score, whether it was a forfeit."""
    table = np.array([row[:4] for row in rows], dtype=np.int64).reshape(-1, 4)
    outcomes = Outcomes(table[:, 2:], forfeit=np.array([row[4] for row in rows], dtype=bool))
    dates = np.full(len(rows), "NaT", dtype="datetime64[D]")
    return TableMatches(names, table[:, :2], outcomes, dates, np.arange(len(rows)))


def places_by_hand(rows: list[Row], rules: TableRules) -> dict[str, int]:
    """Return everybody's place, group by group and rule by rule, in plain Python."""
    place: dict[str, int] = {}

    def gain(row: Row, side: int, rule: str) -> Fraction:
        own, other = row[2 + side], row[3 - side]
        result = (own > other) - (own < other)
        if rule == "points":
            of = {1: rules.win, 0: rules.draw, -1: rules.loss}[result]
            nil = result == 1 and other == 0 and not row[4]
            return Fraction(of + rules.a_set * own + rules.shutout * nil)
        if rule == "win-share":
            return Fraction(1 + result, 2)
        lost = {"wins": result > 0, "forfeits": -(row[4] and result < 0)}
        return Fraction({"difference": own - other, "scored": own, **lost}[rule])

    def value(one: int, rule: str, among: list[int]) -> Fraction:
        mine = [row for row in rows if one in row[:2]]
        if rule == "head-to-head":
            met = [{*row[:2]} for row in rows if {*row[:2]} <= {*among}]
            if len({met.count({a, b}) for a in among for b in among if a != b}) != 1:
                return Fraction(0)
            mine = [row for row in mine if {*row[:2]} <= {*among}]
            rule = "points"
        total = sum((gain(row, row[:2].index(one), rule) for row in mine), Fraction(0))
        return total / max(len(mine), 1) if rule == "win-share" else total

    def rank(group: list[int], ladder: tuple[str, ...], first: int) -> None:
        if len(group) == 1 or not ladder:
            place.update({NAMES[one]: first for one in group})
            return
        values = {one: value(one, ladder[0], group) for one in group}
        kinds = sorted(set(values.values()), reverse=True)
        for kind in kinds:
            part = [one for one in group if values[one] == kind]
            again = ladder[0] == "head-to-head" and len(kinds) > 1
            rank(part, ladder if again else ladder[1:], first)
            first += len(part)

    rank(list(range(len(NAMES))), rules.ladder, 1)
    return place


ROWS = st.lists(
    st.tuples(
        st.permutations(range(len(NAMES))).map(lambda order: order[:2]),
        st.integers(0, 3),
        st.integers(0, 3),
        st.booleans(),
    ).map(lambda row: (*row[0], row[1], row[2], row[3] and row[1] != row[2])),
    max_size=14,
)
RULES = st.builds(
    TableRules,
    win=st.sampled_from([1, 2, 3]),
    draw=st.sampled_from([0.5, 1]),
    a_set=st.sampled_from([0, 1, 0.25]),
    shutout=st.sampled_from([0, 1]),
    ties=st.lists(st.sampled_from(TIE_BREAKS), unique=True).map(tuple),
)


@settings(max_examples=examples(150))
@given(ROWS, RULES)
def test_places_are_those_of_a_ladder_by_hand(rows: list[Row], rules: TableRules) -> None:
    table = league_table(matches_of(rows), rules)
    assert dict(zip(table.names, table.place.tolist(), strict=True)) == places_by_hand(rows, rules)


@settings(max_examples=examples(60))
@given(ROWS, RULES, st.randoms())
def test_no_order_of_rows_sides_or_names_changes_a_table(rows, rules, random) -> None:
    table = league_table(matches_of(rows), rules)
    turned = [row if random.random() < 0.5 else (row[1], row[0], row[3], row[2], row[4])
              for row in rows]  # fmt: skip
    random.shuffle(turned)
    order = list(range(len(NAMES)))
    random.shuffle(order)
    moved = [(order.index(a), order.index(b), *rest) for a, b, *rest in turned]
    other = league_table(matches_of(moved, tuple(NAMES[k] for k in order)), rules)
    for column in ("names", "decided_by"):
        assert getattr(other, column) == getattr(table, column)
    for column in ("place", "level", "points", "won", "drawn", "lost", "scored", "forfeits"):
        assert getattr(other, column).tolist() == getattr(table, column).tolist()
    # Places count those ahead: who is level shares one, and the next is left out.
    assert table.place.tolist() == [1 + int((table.place < own).sum()) for own in table.place]
    assert table.level.tolist() == [int((table.place == own).sum()) for own in table.place]
    assert (table.won + table.drawn + table.lost == table.played).all()
    assert table.scored.sum() == table.conceded.sum()
    home, away = (league_table(matches_of(rows), rules, side=side) for side in ("home", "away"))
    by_name = [dict(zip(one.names, one.points, strict=True)) for one in (table, home, away)]
    assert all(by_name[0][n] == pytest.approx(by_name[1][n] + by_name[2][n]) for n in NAMES)


A, B, C, D, E = range(5)


@each_of(
    "rules, rows, order",
    [
        # All beat one another: games decide; where they are equal too, a place is shared.
        (TableRules(ties=("head-to-head", "difference")),
         [(A, B, 5, 3), (B, C, 5, 4), (C, A, 5, 0)], "C1 B2 A3 D4 E4"),
        (TableRules(ties=("head-to-head", "difference")),
         [(A, B, 5, 3), (B, C, 5, 3), (C, A, 5, 3)], "A1 B1 C1 D4 E4"),
        # Three are level on 4; C beat both, and then it is A's win over B that counts, though B
        # has the better difference.
        (TableRules(ties=("head-to-head", "difference")),
         [(C, A, 5, 4), (C, B, 5, 4), (A, B, 5, 4), (A, D, 5, 4), (B, D, 5, 0), (B, E, 5, 0),
          (D, C, 5, 4), (E, C, 5, 4)], "C1 A2 B3 E4 D5"),
        # German Bundesliga: 3 / 1 / 0.
        (TableRules(3, 1, 0), [(A, B, 5, 3), (A, C, 4, 4), (B, C, 4, 4), (B, D, 4, 4)],
         "A1 C2 B3 D4 E5"),
        # A BCA-type program: wins, then games won minus lost, games won, a shared rank.
        (TableRules(1, 0, 0, ties=("difference", "scored")),
         [(A, B, 13, 12), (B, C, 14, 11), (C, A, 13, 12), (D, E, 18, 7)], "D1 B2 A3 C4 E5"),
        # Snooker: one a frame and one for the match.
        (TableRules(1, 0, 0, 1), [(A, B, 4, 2), (C, D, 3, 3), (B, E, 6, 0)], "B1 A2 C3 D3 E5"),
        # A win league counts shares: one win of one is ahead of two of three.
        (TableRules(1, 0, 0, ties=("win-share", "points")),
         [(A, B, 5, 1), (A, C, 5, 1), (B, A, 5, 1), (D, C, 5, 4)], "D1 A2 B3 E4 C4"),
        # The last rung: who gave away fewer matches.
        (TableRules(ties=("forfeits",)),
         [(A, B, 5, 3), (B, C, 5, 0, True), (C, A, 5, 3)], "A1 B1 C3 D4 E4"),
    ],
)  # fmt: skip
def test_ties_of_small_leagues(rules: TableRules, rows: list[Row], order: str) -> None:
    table = league_table(matches_of([(*row, False)[:5] for row in rows]), rules)
    found = sorted(zip(table.place.tolist(), (name[0] for name in table.names), strict=True))
    wanted = sorted((int(one[1]), one[0]) for one in order.split())
    assert found == wanted


def test_it_says_what_decided() -> None:
    rows = [(A, B, 5, 4), (B, C, 5, 0), (C, D, 5, 0), (A, C, 0, 5)]
    table = league_table(
        matches_of([(*row, False) for row in rows]), TableRules(ties=("head-to-head", "difference"))
    )
    assert table.names == ("Cy", "Ann", "Bo", "Ed", "Di")
    assert table.decided_by == ("", "points", "head-to-head", "points", "difference")


NINE = """2 3 4 6 7 8 10 11 13
3 5 7 8 10 12 14 16 18
4 6 9 11 14 16 19 21 24
5 8 11 14 18 21 24 27 30
6 10 14 18 22 26 29 33 37
8 12 17 22 27 31 36 40 45
10 15 21 26 32 37 43 49 54
13 19 26 32 39 45 52 58 64
17 24 31 38 46 53 60 67 74"""
"""The most points of a loser of level 1, 2, ... that are worth 0, 1, ... 8 of 20 (score apps)."""


def test_the_twenty_points_of_apa_9ball_are_those_of_the_chart() -> None:
    rules = TableRules(split="apa_9ball")
    for line in NINE.splitlines():
        most = [int(cell) for cell in line.split()]
        target = most[-1] + 1
        for score in range(target):
            share = next(k for k, limit in enumerate(most) if score <= limit)
            found = rules.points_of(Outcomes([[score, 40]], [2], [[target, 40]]))
            assert found.tolist() == [[share, 20 - share]]
    with pytest.raises(InputError, match="a player needed 60 points"):
        rules.points_of(Outcomes([[5, 40]], [2], [[60, 40]]))


@each_of(
    "score, race, winner, points",
    [
        ((5, 0), (5, 3), 1, (3, 0)),
        ((5, 2), (5, 3), 1, (2, 1)),
        ((5, 1), (5, 3), 1, (2, 0)),
        ((4, 3), (5, 3), 2, (1, 2)),
        ((0, 2), (7, 2), 2, (0, 3)),
        ((1, 2), (2, 2), 2, (1, 2)),
    ],
)
def test_the_three_points_of_apa_8ball(score, race, winner, points) -> None:
    rules = TableRules(split="apa_8ball")
    outcomes = Outcomes([score], [winner], [race])
    assert rules.points_of(outcomes).tolist() == [list(points)]
    forfeited = Outcomes([[0, 0]], [winner], [race], [True])
    assert rules.points_of(forfeited).tolist() == [[2.0 * (winner == 1), 2.0 * (winner == 2)]]
    finals = TableRules(split="apa_8ball", forfeit=3)
    assert finals.points_of(forfeited).max() == 3.0
    with pytest.raises(InputError, match="1 of 1 matches have no race"):
        rules.points_of(Outcomes([score], [winner]))


def test_what_matches_bring() -> None:
    # "5-4 is 6-4": one a game, and one for the match.
    assert TableRules(1, 0, 0, 1).points(5, 4) == (6.0, 4.0)
    assert TableRules(2, 1, 0, shutout=1).points(7, 0) == (3.0, 0.0)
    table = league_table(
        matches_of([(A, B, 5, 3, False)]), TableRules(bye=1.5), byes=[0, 0, 2, 0, 0]
    )
    assert table.names[:2] == ("Cy", "Ann")
    docked = league_table(matches_of([(A, B, 5, 3, False)]), head_start=[-3, 0, 0, 0, 0])
    assert (docked.names[-1], docked.points[-1]) == ("Ann", -1.0)


def night(**more) -> Results:
    """Acers meet Bankers in five sets of APA 8-ball, and Bankers meet Caroms a week later."""
    rows = [
        ("Al", "Xi", 5, 0, 5, 3, "Acers", "Bankers", "2026-09-01"),
        ("Yu", "Bea", 2, 2, 4, 2, "Bankers", "Acers", "2026-09-01"),
        ("Cas", "Zed", 4, 2, 4, 3, "Acers", "Bankers", "2026-09-01"),
        ("Dee", "Ugo", 1, 3, 5, 3, "Acers", "Bankers", "2026-09-01"),
        ("Eli", "Vic", 1, 3, 4, 3, "Acers", "Bankers", "2026-09-01"),
        ("Xi", "Joe", 3, 1, 3, 2, "Bankers", "Caroms", "2026-09-08"),
        ("Yu", "Kim", 0, 0, 4, 2, "Bankers", "Caroms", "2026-09-08"),
    ]
    order = np.array(more.get("order", range(len(rows))))
    a, b, score_a, score_b, race_a, race_b, team_a, team_b, date = zip(
        *(rows[k] for k in order), strict=True
    )
    return Results.from_names(
        a, b, score_a, score_b, race_a=race_a, race_b=race_b, team_a=team_a, team_b=team_b,
        date=np.array(date, dtype="datetime64[D]"),
        forfeit=order == 6, winner=np.where(order == 6, 1, 0),
    )  # fmt: skip


def test_a_team_match_is_the_sets_of_its_players() -> None:
    rules = TableRules(split="apa_8ball", ties=("head-to-head",))
    played = team_matches(night(), rules=rules)
    assert played.names == ("Acers", "Bankers", "Caroms")
    # Acers: 3 + 2 + 2 + 0 + 0, Bankers: 0 + 0 + 1 + 2 + 2; Zed alone was on the hill.
    assert played.outcomes.given.tolist() == [[7.0, 5.0], [4.0, 1.0]]
    assert played.pairs.tolist() == [[0, 1], [1, 2]]
    assert played.outcomes.winner.tolist() == [1, 1]
    assert played.outcomes.score.tolist() == [[3, 2], [2, 0]]
    table = league_table(played, rules)
    assert table.names == ("Bankers", "Acers", "Caroms")
    assert table.points.tolist() == [9, 7, 1]
    games = team_matches(night(), count_games=True)
    assert games.outcomes.score.tolist() == [[13, 10], [3, 1]]
    assert len(team_matches(night()).until("2026-09-05")) == 1


@settings(max_examples=examples(20))
@given(st.permutations(range(7)))
def test_the_order_of_sets_does_not_matter(order: list[int]) -> None:
    one, other = (league_table(team_matches(night(order=o))) for o in (range(7), order))
    assert one.names == other.names
    assert one.points.tolist() == other.points.tolist()
    singles = [league_table(player_matches(night(order=o))) for o in (range(7), order)]
    assert singles[0].names == singles[1].names


def test_the_winner_is_who_reached_the_race() -> None:
    season = Results.from_names(
        ["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [3, 0, 0], [2, 0, 0],
        race_a=[5, 0, 5], race_b=[2, 0, 4], forfeit=[False, True, False],
        winner=[0, 0, 2], unscored=[False, False, True],
    )  # fmt: skip
    found = player_matches(season)
    assert found.outcomes.winner.tolist() == [2, 2]
    assert (found.undecided, found.unscored, found.rows.tolist()) == (1, 1, [0, 2])


def test_unknown_rules_are_refused() -> None:
    with pytest.raises(InputError, match="ties"):
        TableRules(ties=("lots",))
    with pytest.raises(InputError, match="split"):
        TableRules(split="tap")
    with pytest.raises(InputError, match="team_a and team_b"):
        team_matches(Results.from_names(["Ann"], ["Bo"], [5], [3]))
