"""--system, --scale and --chart: what goes together, and what is worth a warning."""

import pytest

from evenbreak.answers.kit.systems import chart_for, on_scale
from evenbreak.errors import InputError
from evenbreak.fields.question import AskedError, declaration
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.questions.systems import BySystem
from evenbreak.ratings.scale import SCALES, scale_of

NPL = system_of("npl")


def test_a_system_by_its_name():
    kind = declaration(BySystem, "system").kind
    assert kind.read("step 2 1").name == "step 2 1"
    with pytest.raises(InputError, match="'chess'"):
        kind.read("chess")


def test_the_rule_stays_when_the_scale_is_another():
    fargo = on_scale(NPL, SCALES["fargo"])
    assert (fargo.name, fargo.scale) == ("npl", SCALES["fargo"])
    assert on_scale(NPL, None) is NPL
    elo = system_of("elo 16")
    assert on_scale(elo, elo.scale).scale == elo.scale


@pytest.mark.parametrize(
    ("system", "scale", "named"), [("npl", 0.9, "scale 0.9"), ("elo 16", 30, "scale")]
)
def test_scales_that_a_system_cannot_have(system, scale, named):
    with pytest.raises(AskedError, match=named):
        on_scale(system_of(system), scale_of(scale))


def test_without_a_name_it_is_the_chart_of_the_system():
    chart, warnings = chart_for(NPL, None)
    assert (chart.name, warnings) == ("npl_10", [])


def test_a_chart_of_another_scale_is_a_warning_and_one_of_skill_levels_is_refused():
    chart, [warning] = chart_for(NPL, "fargo_r6_hot")
    assert chart.name == "fargo_r6_hot"
    assert "30" in warning
    assert chart_for(on_scale(NPL, SCALES["fargo"]), "fargo_r6_hot")[1] == []
    with pytest.raises(AskedError, match="'apa_8ball'"):
        chart_for(NPL, "apa_8ball")


LEVELS = "Name,Skill Level\nAnn,7\nBob,4\nCy,5\n"
NIGHT = "player_a,player_b,games_a,games_b\nAnn,Bob,7,3\n"


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    ("command", "has_scale"),
    [
        (("ladder", "--league", "{roster}"), True),
        (("sandbag", "watch", "{night}", "--roster", "{roster}"), False),
        (("rate", "{night}", "--system", "npl", "--roster", "{roster}"), False),
    ],
)
def test_skill_levels_are_not_taken_as_points(run, tmp_path, command, has_scale):
    (tmp_path / "apa.csv").write_text(LEVELS, encoding="utf-8")
    (tmp_path / "night.csv").write_text(NIGHT, encoding="utf-8")
    places = {"roster": "apa.csv", "night": "night.csv", "out": "season"}
    asked = [part.format_map({k: tmp_path / v for k, v in places.items()}) for part in command]
    refused = run(*asked)
    assert refused.exit_code == 2
    assert "skill levels" in refused.stderr
    if has_scale:
        assert "skill levels" not in run(*asked, "--scale", "2").stderr
