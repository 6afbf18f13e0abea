"""A bracket from a list of its matches, as another program has laid it out."""

from __future__ import annotations

from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Source
from evenbreak.tournaments.brackets.drafts import Draft, DraftSlot, Rank, bracket_of, loser, winner


def laid_out(form: str, players: tuple[str, ...], drafts: Sequence[Draft]) -> Bracket:
    """Return the bracket for a list of matches, in any order.

    A slot has a player, by position, a bye (None), or the winner or loser of another match. A match
    between the winner and the loser of the same match is a second final, played if the undefeated
    player lost that match. Raises InputError if a match leads to itself, two matches take one
    player, or there is no final.
    """
    ordered = [_with_undefeated(draft, drafts) for draft in _in_order(drafts)]
    return bracket_of(form, players, ordered, _ranks(ordered))


def _in_order(drafts: Sequence[Draft]) -> list[Draft]:
    """Return the matches ordered so that each comes after those that feed it, the final last."""
    by_name = {draft.name: draft for draft in drafts}
    feeds: dict[str, set[str]] = {name: set() for name in by_name}
    taken: set[Source] = set()
    for draft in drafts:
        for slot in draft.slots:
            if not isinstance(slot, Source):
                continue
            if slot.match not in by_name or (slot in taken and not _again(draft)):
                raise InputError(
                    "{draft} is waiting for the {outcome} of {match}, who isn't sent there",
                    draft=draft.name,
                    outcome=slot.outcome,
                    match=slot.match,
                )
            taken.add(slot)
            feeds[draft.name].add(slot.match)
    try:
        order = list(TopologicalSorter(feeds).static_order())
    except CycleError:
        raise InputError("a match leads to itself") from None
    depth: dict[str, int] = {}
    for name in order:
        depth[name] = 1 + max((depth[one] for one in feeds[name]), default=0)
    place = {draft.name: k for k, draft in enumerate(drafts)}
    last = {"third place": 0, "final": 1, "second final": 2}
    return sorted(
        drafts,
        key=lambda draft: (last.get(draft.side, -1), depth[draft.name], place[draft.name]),
    )


def _again(draft: Draft) -> bool:
    """Return whether a match is a second final."""
    one, other = draft.slots
    return isinstance(one, Source) and isinstance(other, Source) and one.match == other.match


def _with_undefeated(draft: Draft, drafts: Sequence[Draft]) -> Draft:
    if not _again(draft):
        return draft
    by_name = {one.name: one for one in drafts}
    first = by_name[draft.slots[0].match]  # type: ignore[union-attr]
    undefeated = 1
    for number, slot in enumerate(first.slots, 1):
        if isinstance(slot, Source) and by_name[slot.match].side == "winners":
            undefeated = number
    slots: tuple[DraftSlot, DraftSlot] = (
        Source(first.name, "loser", via=undefeated),
        Source(first.name, "winner", via=3 - undefeated),
    )
    return draft._replace(slots=slots)


def _ranks(drafts: Sequence[Draft]) -> list[Rank]:
    """Return who leaves at which point: the closer to the final, the better the place."""
    ends = [draft for draft in drafts if draft.side in ("final", "second final")]
    if not ends or len(ends) > 2:
        raise InputError("the bracket has {what} finals", what=len(ends) or "no")
    names = tuple(draft.name for draft in ends)
    ranks = [Rank(tuple(map(winner, names)), 1), Rank(tuple(map(loser, names)), 1)]
    follows = {
        slot: draft.name for draft in drafts for slot in draft.slots if isinstance(slot, Source)
    }
    distance: dict[str, int] = {}
    for draft in reversed(drafts):
        on = follows.get(winner(draft.name))
        distance[draft.name] = 0 if on is None else 1 + distance[on]
    leaving: dict[int, list[Source]] = {}
    for draft in drafts:
        if draft in ends:
            continue
        if draft.side == "third place":
            ranks += [Rank((winner(draft.name),)), Rank((loser(draft.name),))]
        elif loser(draft.name) not in follows:
            leaving.setdefault(distance[draft.name], []).append(loser(draft.name))
    return ranks + [Rank(tuple(leaving[far])) for far in sorted(leaving)]
