"""Lists as people paste them: each line is read right, or asked about, never misread."""

import itertools
import math
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.lists.entrants import read_entrants
from evenbreak.files.lists.pasted import Typed, readings
from evenbreak.files.lists.roster import RosterFile
from tiers import examples
from tries import tries

TRIES = tries("pasted lists", 60)

FIRST = ("Ann", "Bo", "José", "Élodie", "Łukasz", "D’Angelo", "Mei-Lin", "J. R.", "Zoë", "Đặng")
LAST = (
    "Lee",
    "O’Neil",
    "Żak",
    "St. John",
    "van der Berg",
    "Smith Jr.",
    "Girard",
    "Ng",
    "李",
    "MacKay",
)
SURNAME_FIRST = ("LEE, Ann", "Diaz, Bo", "O’NEIL, Cy")
ODD = ("Player 7", "Team 9er", "Ann 2", "Bo #3", "8 Ball Bob", "Cy (Downtown)", "Ann 🎱 Lee")
NO_DOUBT = (
    "{n}, {r}",
    "{n},{r}",
    "{n}\t{r}",
    "{n}; {r}",
    "{n}: {r}",
    "{n} ({r})",
    "{n} [{r}]",
    "{n} - {r}",
    "{n} – {r}",
    "{n}\u00a0– {r}",
    "{n} = {r}",
    "{n} | {r}",
    "{n}({r})",
)
BLANKS = ("{n} {r}", "{n}   {r}", "{n}\u00a0{r}", "{n} \u202f{r} ")
FRONTS = (
    "",
    "{k}. ",
    "{k}) ",
    "{k}.",
    "#{k} ",
    "({k}) ",
    "{k} - ",
    "{k}\t",
    "{k}: ",
    "No. {k} ",
    "{k}.\u00a0",
    "{k} ",
)
TRAILS = ("", ",", ";", "\t", " ,", ";;", "\t\t", ", ")
BULLETS = ("", "- ", "• ", "* ", "🎱 ", "  ", "– ")
ODD_MAKES = (
    "{n} {r} pts",
    "{r} {n}",
    "{n}: Fargo {r}",
    "{n} (Fargo {r})",
    "{n} / {r}",
    "{r} - {n}",
    "{n} ... {r}",
    "{n} Fargo: {r}",
)
SLIPS = (
    "{n} {r} +/- 20",
    "{n} {r} ± 20",
    "{n} {r}±20",
    "{n}, Downtown, {r}",
    "{n}\tDowntown\t{r}",
    "{n} {r} Downtown",
    "{n} {r} (Downtown)",
    "{n} -{r}",
    "{n}, {r}, 5",
    "{n} 1,{r}",
    "{n} {r}/5",
    "{n},{r},Downtown",
)


def read(path: Path, text: str) -> RosterFile | None:
    path.write_text(text, encoding="utf-8")
    try:
        return read_entrants(path)
    except DataError:
        return None


def names(rng: np.random.Generator, size: int) -> list[str]:
    every = [*(f"{a} {b}" for a, b in itertools.product(FIRST, LAST)), *SURNAME_FIRST]
    return [every[k] for k in rng.permutation(len(every))[:size]]


def ratings(rng: np.random.Generator, size: int) -> list[float]:
    scale = rng.integers(3)
    low, high = ((20, 130), (200, 800), (1100, 2400))[scale]
    whole = rng.integers(low, high, size).astype(float)
    return (whole + 0.5 * rng.integers(0, 2, size) if rng.random() < 0.3 else whole).tolist()


def shown(rating: float, comma: bool) -> str:
    return f"{rating:g}".replace(".", "," if comma else ".")


@pytest.mark.slow_after(18)
@pytest.mark.parametrize("seed", range(TRIES))
def test_a_list_of_one_form_is_read_as_it_was_meant(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    size = int(rng.integers(3, 9))
    who, how = names(rng, size), ratings(rng, size)
    front, bullet, trail = (rng.choice(some) for some in (FRONTS, BULLETS, TRAILS))
    form = rng.choice([*NO_DOUBT, *BLANKS])
    unrated = rng.random(size) < 0.2 * (form in NO_DOUBT and "," not in form)
    lines = [
        bullet
        + front.format(k=k + 1)
        + (n if gone else form.format(n=n, r=shown(r, form == "{n}\t{r}")))
        + trail
        for k, (n, r, gone) in enumerate(zip(who, how, unrated, strict=True))
    ]
    if any("," in name for name in who) and (unrated.any() or form in ("{n},{r}", "{n}, {r}")):
        return  # asked about: Ann could be a club
    file = read(tmp_path / "list.txt", "\n".join(lines))
    assert file is not None, lines
    assert list(file.roster.players) == who
    wanted = [math.nan if gone else r for r, gone in zip(how, unrated, strict=True)]
    assert file.roster.rating.tolist() == pytest.approx(wanted, nan_ok=True)
    assert not file.warnings


@pytest.mark.parametrize("sign", [",", ";", "\t", " | "])
def test_two_numbers_behind_a_name_are_its_rating_and_its_level(sign: str) -> None:
    rows = list(
        itertools.product(("Ann", "Bo B.", "Player 7"), ("612", "545.5", ""), ("6", "6.5", ""))
    )
    lines = [sign.join((f"{name} {chr(97 + k)}", *cells)) for k, (name, *cells) in enumerate(rows)]
    read = readings(lines, 2)
    assert [one.doubt for one in read] == [""] * len(rows)
    for one, (name, *cells) in zip(read, rows, strict=True):
        (player,) = one.players
        assert player.name.startswith(name)
        assert [*player.cells, "", ""][:2] == cells


@pytest.mark.parametrize("seed", range(TRIES))
def test_a_line_of_a_mixed_list_is_read_right_or_doubted(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(1000 + seed)
    size = int(rng.integers(2, 7))
    who, how = names(rng, size), ratings(rng, size)
    forms = rng.choice([*NO_DOUBT, *BLANKS, "{n}", *SLIPS], size)
    trails = rng.choice(TRAILS, size)
    fronts = rng.choice(FRONTS, size) if rng.random() < 0.5 else [rng.choice(FRONTS)] * size
    for k in range(size):
        if rng.random() < 0.15:
            who[k] = ODD[k]
    lines = [
        front.format(k=k + 1) + form.format(n=n, r=shown(r, comma=False)) + trail
        for k, (front, form, n, r, trail) in enumerate(
            zip(fronts, forms, who, how, trails, strict=True)
        )
    ]
    file = read(tmp_path / "list.txt", "\n".join(lines))
    if file is None:
        return
    wanted = [math.nan if form == "{n}" else r for form, r in zip(forms, how, strict=True)]
    right = list(file.roster.players) == who and file.roster.rating.tolist() == pytest.approx(
        wanted, nan_ok=True
    )
    assert right or file.warnings, (lines, file.roster.players, file.roster.rating)


PEOPLE = st.lists(
    st.tuples(
        st.sampled_from(
            [
                *(f"{a} {b}" for a, b in itertools.product(FIRST, LAST)),
                "Bob “The Hammer” Kowalski",
                "Rosa Delgado-Ibáñez",
                "Player 2",
                "Player 3",
                "محمد علي",
                "Nguyễn Văn An",
            ]
        ),
        st.one_of(st.none(), st.integers(200, 800)),
    ),
    min_size=2,
    max_size=9,
    unique_by=lambda one: one[0],
)
TITLES = st.sampled_from([[], ["Players:"], ["Tonight's list"], ["Spieler:"], ["", "----"]])


@settings(max_examples=examples(60))
@given(PEOPLE, st.data())
def test_a_list_of_any_make_is_read_back_or_asked_about(
    people: list[tuple[str, int | None]], data: st.DataObject
) -> None:
    """Each line in a make of its own: read as meant, or what is meant is among the choices."""
    lines = [*data.draw(TITLES)]
    one_front = data.draw(st.sampled_from([*FRONTS, "[ ] ", "• ", "🎱 ", "> "]))
    for k, (name, rating) in enumerate(people, 1):
        makes = [*NO_DOUBT, *BLANKS, *ODD_MAKES] if rating else ["{n}", "{n} (unrated)", "{n},"]
        text = data.draw(st.sampled_from(makes)).format(n=name, r=rating)
        if data.draw(st.booleans()):
            wide = {ord(str(d)): chr(0xFF10 + d) for d in range(10)}
            text = text.translate(wide)
        lines.append(one_front.format(k=k) + text + data.draw(st.sampled_from(TRAILS)))
        lines += data.draw(st.sampled_from([[], [""], ["   "]]))
    read = [one for one in readings(lines) if one.players or one.doubt]
    wanted = [
        (Typed(name, (str(rating),)),) if rating else (Typed(name),) for name, rating in people
    ]
    assert len(read) == len(wanted)
    for one, meant in zip(read, wanted, strict=True):
        assert one.players == meant or (one.doubt and meant in one.choices), (lines, one)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("Ann Lee 555-123-4567", (Typed("Ann Lee"),)),
        ("Ann Lee <ann@lee.example>", (Typed("Ann Lee"),)),
        ("Ann Lee, 612, paid", (Typed("Ann Lee", ("612",)),)),
        ("Ann Lee 612 $20", (Typed("Ann Lee", ("612",)),)),
        ("Ann Lee 612   Bo Diaz 540", (Typed("Ann Lee", ("612",)), Typed("Bo Diaz", ("540",)))),
        ("Ann, Bo, Cy", (Typed("Ann"), Typed("Bo"), Typed("Cy"))),
    ],
)
def test_what_is_likeliest_comes_first(text: str, meant: tuple[Typed, ...]) -> None:
    (one, _) = readings([text, "Di Ray, 480"])
    assert one.doubt
    assert one.choices[0] == one.players == meant
    assert one.choices[-1] == ()  # nobody


@pytest.mark.parametrize("form", SLIPS)
def test_a_slip_among_clear_lines_is_never_silent(tmp_path: Path, form: str) -> None:
    for at in range(3):
        lines = ["Ann Lee, 612", "Bo Diaz, 540", "Cy Young, 500"]
        lines[at] = form.format(n="Di Ray", r=480)
        file = read(tmp_path / "list.txt", "\n".join(lines))
        assert file is None or file.warnings, lines


@pytest.mark.parametrize(
    ("text", "players", "ratings"),
    [
        (
            "1. Ann Lee 612\n2) José\nÉlodie Girard (560)\nŁukasz Żak - 620\n",
            ("Ann Lee", "José", "Élodie Girard", "Łukasz Żak"),
            [612, np.nan, 560, 620],
        ),
        ("#3 Bo\n4 - Cy - 500\n", ("Bo", "Cy"), [np.nan, 500]),
        ("LEE, Ann 612\nDiaz, Bo 540\n", ("LEE, Ann", "Diaz, Bo"), [612, 540]),
        ("Ann 92,5\nBo 71,5\n", ("Ann", "Bo"), [92.5, 71.5]),
        ("Player 1,612\nPlayer 2,540\n", ("Player 1", "Player 2"), [612, 540]),
        ("1\tAnn\t612\n2\tBo\t540\n", ("Ann", "Bo"), [612, 540]),
        ("Ann Lee 612\n4\tBo Diaz\t455\t\n", ("Ann Lee", "Bo Diaz"), [612, 455]),
        ("612 Ann\n540 Bo\n", ("Ann", "Bo"), [612, 540]),
        ("2. Ann\n1. Bo\n", ("Ann", "Bo"), [np.nan, np.nan]),
        ("Player 7\nAnn Lee 612\n", ("Player 7", "Ann Lee"), [np.nan, 612]),
        ("Ann SL 5\nBo (SL4)\n", ("Ann", "Bo"), [5, 4]),
        ("[x] Ann (unrated)\n[ ] Bo ６１２\n", ("Ann", "Bo"), [np.nan, 612]),
        ("Ida Quist 512,\nAnn Lee 612\n", ("Ida Quist", "Ann Lee"), [512, 612]),
    ],
)
def test_lists_as_they_are_pasted(tmp_path, text, players, ratings):
    file = read(tmp_path / "list.txt", text)
    assert file is not None
    assert file.roster.players == players
    assert file.roster.rating.tolist() == pytest.approx(ratings, nan_ok=True)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Players:\nAnn\nBo\n", "'Players:' was left out, because it looks like a heading"),
        ("Ann Lee,0\nBo,612\n", "'Ann Lee' has a rating of 0. Leave it out if it means no rating"),
        ("Ann Lee,-30\nBo,612\n", "'Ann Lee' has a rating of -30"),
        (
            "3) Ann\n5) Bo\n",
            "the numbers in front of names, such as the 3 before 'Ann', were left out",
        ),
    ],
)
def test_what_could_mean_something_else_is_said(tmp_path, text, said):
    file = read(tmp_path / "list.txt", text)
    assert file is not None
    assert said in " ".join(file.warnings)


@pytest.mark.parametrize(
    "text",
    [
        "Ann 5 612\nBo 4 540\n",
        "Ann Lee 612\nAnn Lee 540\nBo 500\n",
        "Ann 1,612\nBo 1,540\n",
        "Ann Lee 612 Downtown\nBo,540\n",
        "Ann Lee\tDowntown\t612\n",
        "Ann Lee 612 ± 20\n",
    ],
)
def test_what_could_mean_two_things_is_refused(tmp_path, text):
    assert read(tmp_path / "list.txt", text) is None


def test_a_message_shows_a_tab_as_a_blank(tmp_path: Path) -> None:
    path = tmp_path / "list.txt"
    path.write_text("Ann Lee\tDowntown\t612\n", encoding="utf-8")
    with pytest.raises(DataError, match="'Ann Lee Downtown 612': this may be more"):
        read_entrants(path)


@pytest.mark.parametrize("sign", ["x", ",", "\t", "9 ", "((", " -", "a 1"])
def test_a_line_without_end_is_refused_at_once(tmp_path: Path, sign: str) -> None:
    path, began = tmp_path / "list.txt", time.monotonic()
    path.write_text(f"Ann Lee 612\n{sign * 40_000}\n", encoding="utf-8")
    with pytest.raises(DataError, match="characters, too many for a name") as caught:
        read_entrants(path)
    assert len(caught.value.problems) == 1
    assert time.monotonic() - began < 5.0
