"""What every public function makes of things that it cannot use: an error of this package."""

import inspect
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from evenbreak import physics
from evenbreak.errors import EvenbreakError

STUB = Path(physics.__file__).with_suffix(".pyi").read_text(encoding="utf-8")
NAMES = [line.split(" as ")[1] for line in STUB.splitlines() if " as " in line]
ASKED = [name for name in NAMES if callable(getattr(physics, name)) and name.islower()]
WRONG = [1, "x", None, object(), [1, 2], (1, 2, 3), float("nan"), {}, 1 + 2j, physics.Ball()]
TABLE = physics.PoolTable()
GOOD = {
    "strike": physics.strike(1.0),
    "cloth": physics.Cloth(),
    "table": TABLE,
    "ball": physics.Ball(),
    "pocket": physics.pockets(TABLE)[3],
    "balls": physics.BALL_SETS["pool"],
    "liquid": "water",
    "contact": physics.ContactPoint(0.1, 1.0),
    "later": physics.ContactPoint(0.1, 1.0),
    "cue_ball": (0.7, 0.4),
    "object_ball": (1.2, 0.4),
    "target": (2.5, 0.0),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", ASKED)
def test_one_wrong_thing_is_refused_or_does_no_harm(name: str) -> None:
    function = getattr(physics, name)
    parameters = inspect.signature(function).parameters.values()
    needed = [one.name for one in parameters if one.default is one.empty]
    usual: dict[str, Any] = {one: GOOD.get(one, 0.5) for one in needed}
    for wrong in WRONG:
        for one in parameters:
            with suppress(EvenbreakError):
                function(**{**usual, one.name: wrong})
        with suppress(EvenbreakError):
            function(**dict.fromkeys(needed, wrong))


def test_an_error_names_the_parameter_and_what_to_give() -> None:
    with pytest.raises(EvenbreakError, match="strike must be a Strike; you gave 1"):
        physics.shot(1, 2, 3)  # type: ignore[arg-type]
    with pytest.raises(EvenbreakError, match="ball must be a Ball; you gave 0"):
        physics.collide(0.3, ball=0)  # type: ignore[arg-type]
    with pytest.raises(EvenbreakError, match="cloth must be a Cloth"):
        physics.Slide(physics.Ball(), "cloth", [0, 0], [1, 0], [0, 0, 0])  # type: ignore[arg-type]
