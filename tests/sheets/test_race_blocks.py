import pytest

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.sheets.race_blocks import Bars, parts_of, player_lines, race_blocks, race_cards
from leagues import league, sheet_of, two_groups


def lines_of(sheet):
    return player_lines(sheet.rated, sheet.ratings.scale, Bars(sheet.rated), grouped=False)


@pytest.mark.parametrize(("many", "most", "sizes"), [(5, 9, [5]), (25, 24, [13, 12]), (1, 1, [1])])
def test_parts_are_as_equal_as_can_be(many, most, sizes):
    assert [len(part) for part in parts_of(list(range(many)), most)] == sizes


@pytest.mark.parametrize("sheet", [sheet_of(league(5)), sheet_of(two_groups())])
def test_blocks_hold_every_race_once(sheet):
    found = {}
    for block in race_blocks(lines_of(sheet), sheet.races, 2):
        assert len(block.across) <= 2
        for line, races in block.rows:
            for other, race in zip(block.across, races, strict=True):
                found[line.name, other.name] = race
    assert {pair for pair, race in found.items() if race is None} == {
        (name, name) for name in sheet.rated["player"]
    }
    assert {pair: race for pair, race in found.items() if race not in (None, "-")} == sheet.races


def test_wide_races_make_narrow_blocks():
    def blocks(to):
        sheet = sheet_of(league(40), offered=OfferedRaces(race_to=to))
        return [len(block.across) for block in race_blocks(lines_of(sheet), sheet.races)]

    assert blocks(7) == [20, 20]
    assert blocks(12) == [14, 14, 12]


def test_cards_have_each_opponent_with_race_and_chance():
    sheet = sheet_of(league(4))
    chances = {(row.player_a, row.player_b): row.p_win_a for row in sheet.paired.itertuples()}
    chances |= {(b, a): 1 - p for (a, b), p in chances.items()}
    cards = race_cards(lines_of(sheet), sheet.races, sheet.paired)
    found = {
        (card.player.name, other.name): (race, chance)
        for card in cards
        for other, race, chance in card.races
    }
    assert found == {pair: (sheet.races[pair], f"{p:.2f}") for pair, p in chances.items()}
