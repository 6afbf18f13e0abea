"""Every number of sections 1 to 4 of the text, beside what the library computes."""

import csv
import math
from collections import Counter
from fractions import Fraction

import pytest

from evenbreak.physics import collide, gearing_side, gearing_tip, roll_side
from evenbreak.source_text.answers import PHYSICS, compute, physics_findings
from evenbreak.source_text.pages import place_of
from evenbreak.source_text.published import PublishedNumber, physics_errata, physics_numbers
from places import SHARED

SEED = SHARED / "seed"
NUMBERS = physics_numbers()
FOUND = {finding.published[:3]: finding for finding in physics_findings()}
MU = 4 / 72


def complaint(row: PublishedNumber) -> str:
    """Return what is wrong with the computed number of a row, or nothing."""
    found = FOUND[row[:3]]
    off = 0.0 if None in (row.printed, found.computed) else abs(found.computed - float(row.printed))
    far = row.verdict in {"agrees", "formula"} and off > float(row.tolerance)
    near = row.verdict == "erratum" and off <= 0.5 * 10.0 ** row.printed.as_tuple().exponent
    if found.verdict == row.verdict and not far and not near:
        return ""
    what = f"{row.quantity} {row.inputs}"
    return f"{what}: {found.computed} {found.verdict}; {row.printed} {row.verdict}"


@pytest.mark.parametrize("problem", sorted({row.problem for row in NUMBERS}))
def test_the_numbers_of_a_problem_have_the_verdicts_that_are_expected(problem: str) -> None:
    off = [complaint(row) for row in NUMBERS if row.problem == problem]
    assert not any(off), "\n".join(filter(None, off))


def test_tolerance_is_half_the_last_printed_place_unless_the_number_is_exact() -> None:
    # Called about so much in the text, or the leading term of what is computed.
    rough = {"g on the moon over g", "departure angle below 90, deg"}
    rough |= {"dcos(gamma)/dJ_0z for small J_0y"}
    rough |= {"cut of a right angle, about midway between a half-ball hit and 45, deg"}
    for row in NUMBERS:
        if row.printed is not None and row.quantity not in rough:
            half = 0.5 * 10.0 ** row.printed.as_tuple().exponent
            assert float(row.tolerance) <= half * (1 + 1e-12) or float(row.tolerance) <= 1e-6, row


def test_how_many_there_are() -> None:
    assert Counter(row.verdict for row in NUMBERS) == {
        "agrees": 140,
        "formula": 165,
        "given": 32,
        "erratum": 19,
        "derived": 6,
    }


def seed_rows(name: str) -> list[dict[str, str]]:
    if not SEED.is_dir():
        pytest.skip("the list of printed numbers lies beside the repository only in development")
    with (SEED / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def number_in(text: str) -> float | None:
    """Return a listed number; None for words and ranges, for which a row stands in its way."""
    try:
        return 1.0 if text == "true" else float(Fraction(text))
    except ValueError:
        return None


def same(row: PublishedNumber, listed: dict[str, str]) -> bool:
    problem = listed["problem"].replace("Ex2", "Exercise 2")
    if problem.startswith("S"):
        problem = f"Section {problem[1:]}"
    expected = number_in(listed["expected"])
    if row.problem != problem:
        return False
    if expected is None or row.printed is None or listed["expected"] == "true":
        return True
    # What a misprinted formula gives is listed with more digits than a print would have.
    return float(row.printed) == pytest.approx(expected, rel=3e-3 if expected else 0, abs=1e-9)


def test_every_number_of_the_list_is_here_in_its_order() -> None:
    rows = iter(NUMBERS)
    verdicts = {"yes": {"agrees", "formula", "derived"}, "no": {"erratum"}, "given": {"given"}}
    listed = seed_rows("physics_numbers.csv")
    extra: list[PublishedNumber] = []
    for line in listed:
        for row in rows:
            if same(row, line):
                break
            extra.append(row)
        else:
            pytest.fail(f"not found: {line}")
        assert row.verdict in verdicts[line["agrees"]], (row, line)
        recomputed, computed = number_in(line["recomputed"]), FOUND[row[:3]].computed
        if "off-level drift" in line["quantity"]:  # the list has the time saved here
            recomputed = 100 * (1 - 54 / 125)
        if recomputed is not None and computed is not None and line["recomputed"] != "True":
            assert computed == pytest.approx(recomputed, rel=5e-3, abs=1e-7), (row, line)
    # The ranges of four table speeds, the two J of P4.22, and time and drift of Exercise 2.1 are
    # listed in one row each.
    left = [*extra, *rows]
    assert len(listed) == 357
    assert len(left) == len(NUMBERS) - 357 == 5, left
    assert {row.problem for row in left} == {"Section 1", "Exercise 2.1", "P4.22"}


def test_all_that_is_computed_is_asked_for() -> None:
    answered = {key for part in PHYSICS for key in part.ANSWERS}
    assert answered <= {row[:2] for row in NUMBERS}
    unknown = {row.quantity for row in NUMBERS if FOUND[row[:3]].computed is None}
    assert unknown == {
        "table speed of new worsted cloth, least",
        "table speed of new worsted cloth, most",
        "lag time, s",
        "time of a collision, s",
        "typical V_bx, in/s",
    }


def by_hand() -> dict[tuple[str, str], list[float]]:
    """Return what is right in place of each erratum, without the library."""
    ounce, deg = 28.349523125, math.degrees

    def slope(alpha: float, topspin: float, side: float) -> float:
        up, left = topspin * math.cos(alpha), math.sin(alpha) + side
        return up**2 / math.hypot(up, left) ** 3

    thick, thin = math.radians(5), math.atan(math.sqrt(2 / 3))
    sideways = MU * math.cos(thick)
    speed = 36 * math.cos(0.6) * math.hypot(1, MU)
    left, up = math.sin(0.7) + 0.2, 0.6 * math.cos(0.7)
    return {
        ("P1.2", "M_min in the line of rho_min, g"): [5.5 * ounce],
        ("P1.2", "density, g/cm^3"): [1.33],
        ("Section 1", "dV/dt of a rolling ball, in/s^2"): [-3.86],
        (
            "Exercise 2.1",
            "by how much off-level drift falls against natural roll all the way, %",
        ): [100 * (1 - 54 / 125)],
        ("P3.3", "T as printed"): [0.5 * 18 * (14 * 9) ** 2 + 36 * (14 * 9) ** 2 / 6],
        ("P3.3", "stick that breaks best, oz"): [6 * (0.5 + math.sqrt(0.25 + 50 / 3))],
        ("P3.6", "V_NR as printed"): [5 * 2 / (7 * 6) * 0.8],
        ("Section 4", "k component of e, first line"): [-up / math.hypot(left, up)],
        ("P4.3", "tan(epsilon) of stun"): [math.tan(math.radians(10)) / 7],
        ("P4.5", "dcos(gamma)/dJ_0z as printed"): [
            slope(math.pi / 6, 0.5, 0.1),
            slope(math.pi / 6, -1, -0.7),
            slope(0.8, 0.2, -0.6),
        ],
        ("P4.8", "level spin in natural roll, rad/s"): [5 * speed / (7 * 1.125)],
        ("P4.10", "least E_inelastic/(M V_0^2)"): [sideways * math.sin(thick) - 3.5 * sideways**2],
        ("P4.12", "L_y - L_0y with the jump over M R V_0"): [0.0],
        ("P4.13", "V_bNR j'/V_0 as printed"): [-5 / 7 * math.cos(0.6) * math.sin(0.6)],
        ("P4.15", "alpha_max, deg"): [deg(math.asin(math.sqrt(2) / 3))],
        ("P4.19", "T_cNR/T_0 as printed"): [5 / 14],
        ("P4.25", "error of that, %"): [100 * (1 - deg(thin) / 45)],
    }


def test_what_is_right_in_place_of_a_wrong_number() -> None:
    found: dict[tuple[str, str], list[float]] = {}
    for row in NUMBERS:
        if row.verdict == "erratum":
            found.setdefault(row[:2], []).append(float(compute(*row[:3])))
    assert found == {
        key: pytest.approx(values, rel=1e-8, abs=1e-12) for key, values in by_hand().items()
    }


def test_what_the_text_implies_and_does_not_print() -> None:
    derived = {row.quantity: FOUND[row[:3]].computed for row in NUMBERS if row.printed is None}
    assert derived == pytest.approx(
        {
            "full throw, deg": math.degrees(math.atan(MU)),
            "J at which V_NR is 0": -5 / 2,
            "by how much the time falls against natural roll all the way, %": 40.0,
            "largest J_z,NR of a tip": 7 / 2,
            "cut from which stun has its full throw, deg": math.degrees(math.atan(7 * MU)),
            "stun cut below which the text's law makes energy, deg": math.degrees(
                math.atan(3.5 * MU)
            ),
        },
        rel=1e-12,
    )


def test_energy_is_lost_where_the_law_of_the_text_makes_some() -> None:
    thick = math.radians(5)
    assert collide(thick, 0.0, friction="shepard").delta_inelastic < 0
    assert collide(thick, 0.0).delta_inelastic > 0
    assert math.tan(collide(thick, 0.0).throw) == pytest.approx(math.tan(thick) / 7)


@pytest.mark.parametrize("height", [0.3, 1.0, 1.4])
def test_a_ball_struck_on_the_gearing_line_throws_nothing_once_it_rolls(height: float) -> None:
    tip = gearing_tip(0.7, height)
    side = roll_side(*tip)
    assert tip.y > 0.0 > side
    assert side == pytest.approx(gearing_side(0.7))
    assert collide(0.7, 1.0, side).throw == pytest.approx(0.0, abs=1e-15)


def test_every_slip_of_the_list_is_here() -> None:
    ours = [place_of(slip.where) for slip in physics_errata()]
    places = {
        "S1 rolling resistance": (1, 5),
        "Ex2.1": (2, 2),
        "S4 e_hat": (4, 2),
        "P3.6 vs P4.27": (3, 6),
        "P4.19,P4.23,P4.24 text": (4, 19),
    }
    listed = Counter(
        places.get(row["where"]) or place_of(row["where"]) for row in seed_rows("errata.csv")
    )
    # Of what the list has on P4.12 two are in one row, and here in two; so are two remarks.
    assert {place: count for place, count in listed.items() if ours.count(place) < count} == {}


def test_every_number_called_a_slip_is_among_them() -> None:
    listed = {place_of(slip.where) for slip in physics_errata()}
    listed |= {(4, 10)}  # listed with P4.3
    for row in NUMBERS:
        if row.verdict == "erratum" and not row.problem.startswith("Section"):
            assert place_of(row.problem) in listed, row
    assert len(physics_errata()) == len(set(physics_errata()))


def test_order_is_that_of_the_text() -> None:
    rows = [row for row in NUMBERS if row.problem.startswith("P")]
    first = list(dict.fromkeys(place_of(row.problem) for row in rows))
    sections = [section for section, _ in first]
    assert sections == sorted(sections)
    assert {(4, n) for n in range(1, 28)} <= set(first)
    assert {(3, n) for n in range(1, 12)} <= set(first)
    assert {(2, n) for n in range(1, 7)} <= set(first)
    assert {(1, n) for n in range(1, 8)} <= set(first)
