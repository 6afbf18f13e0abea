"""The registry of columns: each has one entry, and nothing else makes a column or a quantity."""

import ast
import re
from collections import Counter

import pytest

from evenbreak.answers.kit.columns import (
    COLUMNS,
    SUBJECTS,
    column_of,
    columns_of,
    quantities_of,
    quantity_of,
)
from places import SRC, trees_of

ANSWERS = SRC / "answers"
MAKERS = {ANSWERS / "kit" / "columns.py", ANSWERS / "columns" / "shown.py"}


def test_each_key_has_one_entry():
    keys = Counter(key for entries in SUBJECTS.values() for key, _ in entries)
    assert [key for key, times in keys.items() if times > 1] == []


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted(set(ANSWERS.rglob("*.py")) - MAKERS), ids=lambda p: p.stem)
def test_only_the_registry_makes_columns_and_quantities(path):
    nodes = [node for tree in trees_of([path]) for node in ast.walk(tree)]
    calls = [node for node in nodes if isinstance(node, ast.Call)]
    made = [node.lineno for node in calls if getattr(node.func, "id", "") in ("Column", "Quantity")]
    assert made == []


def test_words_have_the_names_of_an_answer_filled_in_and_these_are_never_looked_into():
    column = column_of("race_a", a="{b}")
    assert column.words == "{b}\nneeds"
    assert (column.words.template, dict(column.words.values)) == ("{a}\nneeds", {"a": "{b}"})


def test_a_hyphen_keeps_a_column_for_files():
    shown, hidden = columns_of("rating -rating")
    assert (shown.names, shown.words) == (("rating",), "rating")
    assert (hidden.names, hidden.words) == (("rating",), None)


def test_an_answer_may_show_a_column_in_its_own_way():
    (rating,) = columns_of("rating", show={"rating": "{:.3f}".format})
    assert rating.text(1.0) == "1.000"
    assert column_of("times_equal_share", detail=True).detail


def test_a_name_may_hold_what_only_an_answer_knows():
    assert column_of("against", level=5).names == ("against 5",)
    assert column_of("ball_speed", unit="m_s", units="meters per second").names == (
        "ball_speed_m_s",
    )


def test_quantities_keep_their_order_and_have_their_notes():
    mean, sd = quantities_of({"mean": 4.5, "-sd": 1.25}, notes={"mean": "(4 to 5)"})
    assert (mean.name, mean.label, mean.text, mean.note) == ("mean", "average", "4.50", "(4 to 5)")
    assert (sd.name, sd.words, sd.value) == ("sd", None, 1.25)


def test_words_of_several_lines_are_one_line_of_a_quantity():
    games = quantity_of("mean_games", 9.5)
    assert (games.words, games.label) == ("games, on\naverage", "games, on average")


def test_a_key_without_an_entry_is_refused():
    with pytest.raises(KeyError, match="nobody"):
        column_of("nobody")


def test_headings_say_nothing_of_files():
    words = [entry.words for entry in COLUMNS.values() if entry.words]
    assert [text for text in words if re.search(r"[a-z]_[a-z]", re.sub(r"\{.*?\}", "", text))] == []
