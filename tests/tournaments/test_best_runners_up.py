"""Groups of which the best of one rank go on: settled, tied, and their odds by brute force."""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest

from evenbreak.answers.tournament.night import night_answer
from evenbreak.answers.tournament.tournament import pair_words
from evenbreak.errors import InputError
from evenbreak.tournaments import groups_then_knockout, title_odds
from evenbreak.tournaments.brackets.bracket import Bracket, Group, Source
from evenbreak.tournaments.brackets.standing import ranked
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan, Result
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.settling import break_ties, tied_groups
from evenbreak.tournaments.odds.uncertain import over_ratings
from rows import each_of
from tournament_nights import AT, timed_night


def by_lots(keys: dict[int, object]) -> list[tuple[float, tuple[int, ...]]]:
    """Return the orders of players by a key, those who are level by lot, and their chances."""
    parts = [
        list(itertools.permutations([p for p in keys if keys[p] == key]))
        for key in sorted(set(keys.values()))  # type: ignore[type-var]
    ]
    orders = list(itertools.product(*parts))
    return [(1.0 / len(orders), tuple(itertools.chain(*order))) for order in orders]


def group_ends(group: Group, win: np.ndarray) -> Iterator[tuple[float, tuple[int, ...], int]]:
    """Yield all ends of a group: the chance, the order, and who won as a number."""
    for code in range(1 << len(group.pairs)):
        p, winners = 1.0, []
        for k, (one, other) in enumerate(group.pairs):
            won = one if code >> k & 1 else other
            p *= win[won, other if won == one else one]
            winners.append(won)
        ahead = ranked(group.members, group.pairs, winners)
        for share, order in by_lots(dict(zip(group.members, ahead, strict=True))):
            yield p * share, order, tuple(winners)  # type: ignore[misc]


def brute_force(bracket: Bracket, win: np.ndarray) -> np.ndarray:
    """Return P(each place) by all results of the groups, all lots, and all knockouts."""
    runners_up = bracket.runners_up
    assert runners_up is not None
    law = np.zeros((len(bracket.players), len(bracket.places)))
    fields: dict[tuple, float] = defaultdict(float)
    for ends in itertools.product(*(list(group_ends(g, win)) for g in bracket.groups)):
        p = float(np.prod([end[0] for end in ends]))
        sent = {}
        share = {}
        for group, (_, order, winners) in zip(bracket.groups, ends, strict=True):
            sent |= {Source(group.name, k): player for k, player in enumerate(order, 1)}
            runner = order[runners_up.rank - 1]
            played = sum(runner in pair for pair in group.pairs)
            share[runner] = -Fraction(winners.count(runner), played)  # type: ignore[attr-defined]
        for lot, order in by_lots(share):
            all_sent = sent | {
                Source(runners_up.name, k): player for k, player in enumerate(order, 1)
            }
            fields[tuple(sorted(all_sent.items(), key=str))] += p * lot
    for field, p in fields.items():
        _add_places(law, bracket, dict(field), p, win)
    return law


def _add_places(law, bracket, sent, p, win) -> None:
    """Add the places of one outcome of the groups, over all knockouts."""
    column = {place: k for k, place in enumerate(bracket.places)}
    for group in bracket.groups:
        for rank, place in enumerate(group.places, 1):
            if place is not None and Source(group.name, rank) in sent:
                law[sent[Source(group.name, rank)], column[place]] += p
    for rank, place in enumerate(bracket.runners_up.places, 1):
        if place is not None:
            law[sent[Source(bracket.runners_up.name, rank)], column[place]] += p
    knock_out = [m for m in bracket.matches if m.side in ("knock-out", "final")]
    for code in range(1 << len(knock_out)):
        now, chance = dict(sent), p
        taken = []
        for k, match in enumerate(knock_out):
            one, other = (now[slot] for slot in match.slots)  # type: ignore[index]
            won, lost = (one, other) if code >> k & 1 else (other, one)
            chance *= win[won, lost]
            now |= {Source(match.name, "winner"): won, Source(match.name, "loser"): lost}
            ends_here = ((won, match.winner_place), (lost, match.loser_place))
            taken += [(who, place) for who, place in ends_here if place is not None]
        for who, place in taken:
            law[who, column[place]] += chance


def chances(players: int) -> np.ndarray:
    skill = np.random.default_rng(players).normal(0.0, 1.0, players)
    return 1.0 / (1.0 + np.exp(skill - skill[:, None]))


@pytest.mark.slow
@each_of("players, groups, size", [(6, 2, 3), (7, 2, 3), (7, 2, 5), (6, 3, 2), (7, 3, 4)])
def test_odds_against_all_results(players: int, groups: int, size: int) -> None:
    bracket, win = groups_then_knockout(players, groups, knockout_size=size), chances(players)
    found = title_odds(bracket, win, samples=20_000)
    exact = brute_force(bracket, win)
    assert exact.sum(axis=1) == pytest.approx(1.0)
    assert found.p_place.sum(axis=1) == pytest.approx(1.0)
    assert not found.exact
    assert (np.abs(found.p_place - exact) < 4.5 * found.error + 1e-3).all()


@each_of("groups, size, each, best", [(5, 16, 3, 1), (3, 8, 2, 2), (6, 16, 2, 4), (3, 2, 0, 2)])
def test_as_many_as_were_asked_for_go_on(groups: int, size: int, each: int, best: int) -> None:
    bracket = groups_then_knockout(4 * groups, groups, knockout_size=size)
    slots = [s for m in bracket.matches for s in m.slots if isinstance(s, Source)]
    from_groups = [s for s in slots if isinstance(s.outcome, int)]
    letters = [group.name for group in bracket.groups]
    wanted = {Source(name, rank) for name in letters for rank in range(1, each + 1)}
    wanted |= {Source(str(each + 1), k) for k in range(1, best + 1)}
    assert (set(from_groups), len(from_groups)) == (wanted, size)
    seats = sum(place.last - place.first + 1 for place in bracket.places)
    assert seats == len(bracket.players)
    assert bracket.graph.has_edge(letters[0], str(each + 1))


def test_a_multiple_needs_no_runners_up() -> None:
    assert groups_then_knockout(16, 4, knockout_size=8) == groups_then_knockout(16, 4)
    with pytest.raises(InputError, match="fewer groups"):
        groups_then_knockout(13, 4, knockout_size=13)
    with pytest.raises(
        InputError, match="knockout_size must be a whole number from 2 to 12; you gave 13"
    ):
        groups_then_knockout(12, 4, knockout_size=13)
    with pytest.raises(InputError, match="knockout_size"):
        groups_then_knockout(12, 4, knockout_size=1)


def cup(scores: dict[str, tuple[int, int]], **plan: object) -> list[Event]:
    """Return the events of groups of 3 and of 4 players: the first of each and the best second.

    The stronger of each pair wins 5:0 unless a score of the first of the list says otherwise.
    """
    entrants = tuple(Entrant(f"P{k}", 600.0 - 10 * k) for k in range(1, 8))
    asked = {"scale": "fargo", "groups": 2, "knockout_size": 3, **plan}
    events = [Event(AT, Opened(Plan("groups", 5, **asked), entrants))]  # type: ignore[arg-type]
    events.append(Event(AT, moves.draw(evening(events), np.random.default_rng(0))))
    state = evening(events)
    for group in state.bracket.groups:
        for name in group.matches:
            pair = state.pair(name)
            score = scores.get(name, (5, 0) if int(pair[0][1:]) < int(pair[1][1:]) else (0, 5))
            winner = pair[score[0] < score[1]]
            events.append(Event(AT, Result(name, pair, score, winner)))
    return events


def test_runners_up_are_compared_by_the_share_of_matches_won() -> None:
    state = evening(cup({}))
    second = {len(group.members): group.members[1] for group in state.bracket.groups}
    # Two of three matches are more than one of two.
    assert state.standing.sent[Source("2", 1)] == second[4]
    assert tied_groups(state) == []
    odds = Outlook(state, AT).odds
    assert odds.exact
    fourth = [str(place) for place in odds.bracket.places].index("4")
    assert odds.p_place[second[3], fourth] == 1.0


def tied_cup() -> list[Event]:
    """Return groups of three, whose seconds have won one of two matches each."""
    events = cup({}, knockout_size=3)
    first = events[0].what
    assert isinstance(first, Opened)
    six = Opened(first.plan, first.entrants[:6])
    begun = [Event(AT, six)]
    begun.append(Event(AT, moves.draw(evening(begun), np.random.default_rng(0))))
    state = evening(begun)
    for group in state.bracket.groups:
        for name in group.matches:
            pair = state.pair(name)
            lost = 4 if group.name == "A" else 1
            score = (5, lost) if int(pair[0][1:]) < int(pair[1][1:]) else (lost, 5)
            begun.append(Event(AT, Result(name, pair, score, pair[score[0] < score[1]])))
    return begun


def test_who_is_level_is_ranked_by_games_for_each_match_and_then_by_lot() -> None:
    events = tied_cup()
    # The second of A loses 4:5 and wins 5:4; that of B loses 1:5 and wins 5:1: level in games too.
    state = evening(events)
    assert tied_groups(state) == ["2"]
    assert "The best 2nd is still undecided" in night_answer(Outlook(state, AT)).sentences[0]
    drawn = {break_ties(state, np.random.default_rng(k)).ranked.order for k in range(20)}
    assert len(drawn) == 2
    assert break_ties(state, np.random.default_rng(0)).by_lot
    loss = next(
        one.what
        for one in events
        if isinstance(one.what, Result)
        and one.what.score in ((1, 5), (5, 1))
        and one.what.loser == state.order[state.standing.runners_up[1][1]]
    )
    closer = Result(
        loss.match, loss.players, tuple(4 if g == 1 else g for g in loss.score), loss.winner
    )
    state = evening([*events, Event(AT, closer)])
    broken = break_ties(state, np.random.default_rng(0))
    assert broken.ranked.order[0] == loss.loser
    assert not broken.by_lot
    settled = evening([*events, Event(AT, closer), Event(AT, broken.ranked)])
    assert settled.standing.sent[Source("2", 1)] == settled.order.index(loss.loser)
    assert tied_groups(settled) == []
    with pytest.raises(InputError, match="already broken"):
        break_ties(settled, np.random.default_rng(0))


def test_a_correction_opens_a_broken_tie_again() -> None:
    events = tied_cup()
    state = evening(events)
    events.append(Event(AT, break_ties(state, np.random.default_rng(0)).ranked))
    assert tied_groups(evening(events)) == []
    match = state.bracket.groups[0].matches[0]
    before = state.counted[match]
    events.append(Event(AT, Result(match, before.players, before.score[::-1], before.loser)))
    after = evening(events)
    assert Source("2", 1) not in after.standing.sent  # a group is tied, or others are second
    events.append(Event(AT, Result(match, before.players, before.score, before.winner)))
    assert Source("2", 1) in evening(events).standing.sent  # as it was


def test_until_the_tie_is_broken_the_odds_share_the_place() -> None:
    state = evening(tied_cup())
    win = np.full((6, 6), 0.5)
    odds = title_odds(state.bracket, win, results=state.results, samples=20_000)
    for _, player, _ in state.standing.runners_up:
        assert odds.title[player] == pytest.approx(1 / 8, abs=0.01)
    assert odds.title.sum() == pytest.approx(1.0)
    assert Outlook(state, AT).finish().finish(0.5) > 0.0


@pytest.mark.slow
@each_of("players, plan", [(20, {"groups": 5, "knockout_size": 16}), (11, {"knockout_size": 4})])
def test_a_whole_evening(players: int, plan: dict[str, int]) -> None:
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(1, players + 1))
    begun = [Event(AT, Opened(Plan("groups", 3, scale="fargo", tables=4, **plan), entrants))]  # type: ignore[arg-type]
    events = timed_night(begun, AT)
    state = evening(events)
    assert all(match.name in state.standing.winners for match in state.bracket.matches)
    assert night_answer(Outlook(state, events[-1].at)).sentences[0].startswith("P")
    for stop in range(2, len(events), max(1, len(events) // 8)):
        part = evening(events[:stop])
        assert Outlook(part, events[stop - 1].at).as_if_sure.title.sum() == pytest.approx(1.0)
    start = evening(events[:2])
    words = [word for m in start.bracket.matches for word in pair_words(start.standing, m.name)]
    assert f"best {'4th' if players == 20 else '2nd'}" in words


def test_ratings_with_errors_are_averaged_over() -> None:
    bracket = groups_then_knockout(7, 2, knockout_size=3)

    def by_points(ratings):
        return 1.0 / (1.0 + 2.0 ** ((ratings - ratings[:, None]) / 100.0))

    found = over_ratings(bracket, by_points, [500.0 + 20 * k for k in range(7)], [60.0] * 7)
    assert found.averaged.p_place.sum(axis=1) == pytest.approx(1.0)
