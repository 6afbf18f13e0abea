"""How results are read, as people say it."""

import pytest

from evenbreak.errors import InputError
from evenbreak.fields.question import declaration
from evenbreak.questions.results import Reading


def columns_of(*texts: str) -> dict[str, str]:
    kind = declaration(Reading, "columns").kind
    columns: dict[str, str] = Reading(columns=tuple(map(kind.read, texts))).reading["columns"]
    return columns


@pytest.mark.parametrize(
    ("texts", "columns"),
    [
        ((), {}),
        (("player_a=Home, Player B = Away",), {"player_a": "Home", "player_b": "Away"}),
        (("player_a=Name, first,score=S",), {"player_a": "Name, first", "score": "S"}),
        (("player_a=x", "score=y"), {"player_a": "x", "score": "y"}),
    ],
)
def test_columns_by_their_titles(texts: tuple[str, ...], columns: dict[str, str]) -> None:
    assert columns_of(*texts) == columns


@pytest.mark.parametrize(
    "texts",
    [
        ("Home",),
        ("=Home",),
        ("player_a=",),
        ("player_a=x,player_a=y",),
        ("a=x,b=X",),
        ("player_a=x", "player_a=y"),
    ],
)
def test_what_names_no_column_is_refused(texts: tuple[str, ...]) -> None:
    with pytest.raises(InputError):
        columns_of(*texts)


def test_the_order_of_dates() -> None:
    kind = declaration(Reading, "dates").kind
    assert kind.read("mdy") == "mdy"
    with pytest.raises(InputError, match="ymd"):
        kind.read("ymd")
