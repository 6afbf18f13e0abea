import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import races_by_name
from leagues import league, sheet_of, two_groups


def test_every_two_players_have_their_race_from_either_side():
    sheet = sheet_of(league(4))
    assert len(sheet.races) == 12
    for row in sheet.paired.itertuples():
        assert sheet.races[row.player_a, row.player_b] == f"{row.race_a}:{row.race_b}"
        assert sheet.races[row.player_b, row.player_a] == f"{row.race_b}:{row.race_a}"
    assert sheet.races == races_by_name(sheet.paired)


@pytest.mark.parametrize("most", [2, 3, 99])
def test_the_strongest_are_cut_out_and_the_rest_stays(most):
    sheet = sheet_of(league(6), top=4)
    cut = sheet.strongest(most)
    names = sheet.listed["player"].tolist()[:most]
    assert cut.listed["player"].tolist() == names
    assert cut.races == {pair: race for pair, race in sheet.races.items() if set(pair) <= {*names}}
    assert cut.rated is sheet.rated
    assert list(cut.listed.index) == [sheet.rated["player"].tolist().index(name) for name in names]


def test_bands_reach_the_furthest_pair():
    sheet = sheet_of(league(5))
    furthest = max(pair.difference for pair in sheet.sure)
    assert sheet.bands[-1].first <= furthest <= sheet.bands[-1].after
    assert sheet_of(league(5), offered=OfferedRaces((5, 13))).bands == []
    assert sheet_of(two_groups(), players=["Ann", "Cy"]).bands == []


def test_the_summary_counts_the_pairs():
    summary = sheet_of(two_groups()).summary
    values = dict(zip(summary["key"], summary["value"], strict=True))
    assert (values["pairs"], values["pairs_without_race"]) == (6, 4)
