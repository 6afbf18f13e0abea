"""`evenbreak lineup`: who to put up in a team match, at any point in it."""

from __future__ import annotations

from evenbreak import teams
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.scales import chart_doubts
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.team.league import race_of, two_teams, weights_of
from evenbreak.files.lists.teams import form_of_lists
from evenbreak.files.tables.names import KnownNames
from evenbreak.questions.teams import InPlay, Lineup, usual_sets
from evenbreak.ratings.results_frame import without_accents
from evenbreak.teams.evening.events import meeting_by
from evenbreak.teams.meeting import SEALED, Meeting
from evenbreak.teams.night import LOSER, WINNER, order_of
from evenbreak.teams.pairs import pairs_of
from evenbreak.teams.set_laws import brought
from evenbreak.words import Parameter

_SIDES = ("ours", "theirs")


@command_of(Lineup, "lineup")
def command(asked: Lineup) -> Answer:
    """Find who to put up in a team match."""
    from evenbreak.answers.league.prior import starters_words
    from evenbreak.answers.team.lineup import lineup_answer

    race = race_of(asked)
    lists, found = two_teams(asked, race)
    warnings = found.warnings
    weights = [weights_of(asked, each) for each in lists]
    fewest = min(len(each) for each in found.rosters)
    meeting = meeting_by(
        asked,
        (found.rosters[0], found.rosters[1]),
        weights,
        race=race,
        scale=found.scale,
        sets=asked.sets or usual_sets(fewest * asked.times, asked.cap),
        form=form_of_lists(each.file.form for each in lists),
        levels=found.levels,
    )
    begun = {"used", "score", "playing", "named", "last"} & asked.given.keys()
    point = _point(asked, meeting) if begun else None
    warnings += chart_doubts(meeting.race, found.scale)
    for each, roster in zip(lists, found.rosters, strict=True):
        warnings += filter(None, [starters_words(each.file.roster, roster)])
    return lineup_answer(meeting, point, seed=asked.seed, warnings=warnings)


def _point(asked: Lineup, meeting: Meeting) -> teams.Point:
    """Return the point in the match that is described, or refuse what cannot be."""
    if meeting.order == SEALED:
        asked.refuse(
            "{order} sealed works only before the match. Leave out what has happened since."
        )
    both: tuple[list[str], list[str]] = ([], [])
    for text in asked.used:
        side, name = _player(asked, meeting, text, "used")
        both[side].append(name)
    laws = []
    for play in asked.playing:
        names = _in_play(asked, meeting, play)
        laws.append(meeting.law_in_play(*names, play[2]))
        for side in (0, 1):
            both[side].extend(names[side])
    if asked.score is None and len(both[0]) > len(laws):
        asked.refuse(
            "{used} names players whose sets are over. Give the score so far with {score}."
        )
    letters = order_of(meeting.order, len(meeting.sizes))
    if asked.last is not None and not set(letters) & {WINNER, LOSER}:
        asked.refuse(
            "{last} is for an order in which the winner or loser of the last set names first"
        )
    if asked.score is not None:
        _check_score(asked, meeting, asked.score, _sets_over(meeting, len(both[0]), len(laws)))
    lead = 0 if asked.score is None else asked.score[0] - asked.score[1]
    return teams.Point(
        tuple(both[0]),
        tuple(both[1]),
        lead,
        None if asked.last is None else asked.last == "won",
        tuple(_player(asked, meeting, text, "named", any_side=True)[1] for text in asked.named),
        tuple(laws),
    )


def _sets_over(meeting: Meeting, used: int, playing: int) -> int:
    """Return how many sets are over, if so many of our players are used up or playing."""
    begun = next((k for k in range(len(meeting.sizes) + 1) if sum(meeting.sizes[:k]) >= used), 0)
    return max(0, begun - playing)


def _player(
    asked: Lineup, meeting: Meeting, text: str, option: str, *, any_side: bool = False
) -> tuple[int, str]:
    """Return the side of a player, and the name as the file spells it."""
    players = meeting.ours.players, meeting.theirs.players
    part = Parameter(option)
    head, colon, name = text.partition(":")
    side = head.strip().lower() if colon else ""
    sides = [_SIDES.index(side)] if side in _SIDES else [0, 1]
    wanted = name.strip() if len(sides) == 1 else text
    named = [
        (side, players[side][place])
        for side in sides
        if (place := KnownNames(players[side]).place(wanted)) is not None
    ] or _by_beginning([(side, name) for side in sides for name in players[side]], wanted)
    if not named:
        if (
            option == "playing"
            and len(sides) == 1
            and KnownNames(players[1 - sides[0]]).place(wanted) is not None
        ):
            asked.refuse(
                "{part}: {name!r} is in the other team. Write your player, then theirs.",
                part=part,
                name=wanted,
            )
        hint = KnownNames([*players[0], *players[1]]).hint(wanted)
        asked.refuse("{part}: {name!r} is in neither team{hint}", part=part, name=wanted, hint=hint)
    if len(named) > 1 and not any_side:
        asked.refuse(
            "{part}: both teams have a {name!r}. Write ours:{name} or theirs:{name}.",
            part=part,
            name=wanted,
        )
    return named[0]


def _by_beginning(players: list[tuple[int, str]], wanted: str) -> list[tuple[int, str]]:
    """Return the one player whose first or last name starts like this; none if there are more."""
    begin = f" {without_accents(wanted)}"
    such = [one for one in players if wanted and begin in f" {without_accents(one[1])}"]
    return such if len(such) == 1 else []


def _in_play(asked: Lineup, meeting: Meeting, play: InPlay) -> tuple[list[str], list[str]]:
    """Return our players in a set that is being played, and theirs."""
    ours, theirs = (
        [_player(asked, meeting, f"{side}:{name}", "playing")[1] for name in names]
        for side, names in zip(_SIDES, play[:2], strict=True)
    )
    return ours, theirs


# Whether a score can be.


def _check_score(asked: Lineup, meeting: Meeting, score: tuple[int, int], over: int) -> None:
    """Refuse a score that so many sets cannot bring, or that contradicts who won the last one."""
    each = _of_a_set(meeting)
    possible = {(0, 0)}
    for _ in range(over):
        possible = {(a + x, b + y) for a, b in possible for x, y in each}
    if score not in possible:
        asked.refuse(
            "{score} {a}-{b} is impossible: going by the players used, {sets}, and {counted} count"
            + (
                ". List those who have played with {used}."
                if asked.count == "sets" and not over
                else ""
            ),
            a=score[0],
            b=score[1],
            sets="1 set is over" if over == 1 else f"{over} sets are over",
            counted=asked.count,
        )
    if asked.last is not None and not over:
        asked.refuse("{last} {how}: going by the players used, no set is over", how=asked.last)
    if asked.last is not None and asked.count == "sets" and not score[asked.last == "lost"]:
        asked.refuse(
            "{last} {how} contradicts {score} {a}-{b}", how=asked.last, a=score[0], b=score[1]
        )


def _of_a_set(meeting: Meeting) -> set[tuple[int, int]]:
    """Return what a set can bring to both teams, whoever plays it."""
    if meeting.count == "sets":
        return {(1, 0), (0, 1)}
    pairs = pairs_of(
        meeting.ours, meeting.theirs, meeting.race, meeting.scale, levels=meeting.levels
    )
    needs = zip(pairs.needs_1.ravel().tolist(), pairs.needs_2.ravel().tolist(), strict=True)
    scores: set[tuple[int, int]] = set()
    for m, n in set(needs):
        ends = [(m, lost) for lost in range(n)] + [(won, n) for won in range(m)]
        scores |= {brought((m, n), end, meeting.count) for end in ends}
    return scores
