import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.files.tables.similar_names import similar_names
from rows import each_of


@each_of(
    "one, other",
    [
        ("Ann Lee", "ANN LEE"),
        ("AnnLee", "Ann Lee"),
        ("Zoe Kestleman", "Zoë Kestleman"),
        ("Jarek Polomski", "Jarek Połomski"),
        ("Soren Lind", "Søren Lind"),
        ("Finn O'Garrow", "Finn OGarrow"),
        ("Ann-Marie Lee", "Ann Marie Lee"),
        ("Ann Lee", "Lee, Ann"),
        ("Mark Davies", "Mark Davis"),
        ("Bo Petersen", "Bo Peterson"),
        ("Winston Peake", "Wisnton Peake"),
        ("Winston Peake", "Winston Peak"),
        ("Winston Peake", "Winnston Peake"),
        ("Bob", "Bobb"),
        ("Ann", "Anne"),
        ("Anna", "Anne"),
        ("Anton Müller", "Anton Mueller"),
        ("Jörg Groß", "Joerg Gross"),
        ("Dave Jones", "David Jones"),
        ("Jones, Dave", "David Jones"),
        ("Chris B Lee", "Christopher B Lee"),
        ("Dan Müller", "Daniel Mueller"),
    ],
)
def test_names_that_may_mean_one_player(one, other):
    assert similar_names([one, other, "Somebody Else"]) == [tuple(sorted([one, other]))]


@each_of(
    "one, other",
    [
        ("John Smith J", "John Smith K"),
        ("Player 0012", "Player 0013"),
        ("Team 12 East", "Team 13 East"),
        ("Tim", "Tom"),
        ("Lee", "Leo"),
        ("J Jones", "K Jones"),
        ("Dave Jones", "David Janos"),
        ("Dave", "David"),
        ("Cambridge A", "Camden A"),
        ("Table1 East", "Table2 East"),
        ("Winston Peake", "Winston Paeks"),
        ("Winston Peake", "Winsten Peaks"),
        ("!", "?"),
    ],
)
def test_names_that_mean_two_players(one, other):
    assert similar_names([one, other]) == []


def test_groups_are_listed_once_and_in_order():
    names = ["cy", "CY", "Cy", "Bo Petersen", "bo petersen"]
    assert similar_names(names) == [("Bo Petersen", "bo petersen"), ("CY", "Cy", "cy")]


def test_no_group_is_part_of_another():
    names = ["Dave Jones", "DAVE JONES", "David Jones", "Dave Janes"]
    assert similar_names(names) == [
        ("DAVE JONES", "Dave Jones", "David Jones"),
        ("DAVE JONES", "Dave Janes", "Dave Jones"),
    ]


def test_names_that_differ_in_the_same_letter_are_one_group():
    assert similar_names(["Anna", "Anne", "Anni", "Ann"]) == [("Ann", "Anna", "Anne", "Anni")]
    # Two that are a letter longer are one slip from it, and two from each other.
    assert similar_names(["Wong", "Wrong", "Wongs"]) == [("Wong", "Wongs", "Wrong")]
    assert similar_names(["Wrong", "Wongs"]) == []


def test_names_that_played_each_other_mean_two_players():
    names = ["Anna", "Anne", "Bob", "Bobb", "Dan Lee", "Dana Lee", "Danny Lee"]
    met = [("Anne", "Anna"), ("Dan Lee", "Dana Lee")]
    assert similar_names(names, met) == [("Dan Lee", "Dana Lee", "Danny Lee"), ("Bob", "Bobb")]
    met += [("Dana Lee", "Danny Lee"), ("Danny Lee", "Dan Lee")]
    assert similar_names(names, met) == [("Bob", "Bobb")]
    assert similar_names(["Ann", "ann"], [("ann", "Ann")]) == [("Ann", "ann")]


@given(st.lists(st.text(max_size=12), max_size=12))
def test_any_names_are_compared_whatever_their_order(names):
    groups = similar_names(names)
    assert groups == similar_names(names[::-1])
    assert all(len(group) > 1 and set(group) <= set(names) for group in groups)


def test_thousands_of_names_that_differ_in_one_letter_take_no_time():
    names = [f"Ann Le{chr(0x4E00 + k)}an" for k in range(2_000)]
    started = time.perf_counter()
    assert similar_names(names) == [tuple(names)]
    assert time.perf_counter() - started < 5


@pytest.mark.slow
def test_thousands_of_names_take_no_time():
    syllables = ["ba", "de", "fi", "go", "ku", "lam", "mer", "nol", "ris", "tun"]
    names = [
        " ".join(
            "".join(syllables[int(digit)] for digit in f"{k * 7919 % 10**6:06d}"[i : i + 3])
            for i in (0, 3)
        )
        for k in range(5_000)
    ]
    started = time.perf_counter()
    similar_names(names)
    assert time.perf_counter() - started < 10


def test_names_with_a_second_surname_may_be_one_players():
    names = ["Lisa Müller", "Lisa Mueller-Stone", "Lisa Stone", "Bo Lee", "Al B Lee", "Al Lee"]
    assert similar_names(names) == [
        ("Lisa Mueller-Stone", "Lisa Müller"),
        ("Lisa Mueller-Stone", "Lisa Stone"),
    ]
    assert similar_names(names[:2], met=[("Lisa Müller", "Lisa Mueller-Stone")]) == []
