"""A team night: two squads, an order of nomination, and the possible results of each set."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, array_values, owned
from evenbreak.checks import floats, number_probability, one_of, whole
from evenbreak.errors import InputError
from evenbreak.teams.squad import LineUps, Squad, line_ups
from evenbreak.words import Parameter, say


@array_values
@dataclass(frozen=True, eq=False, init=False)
class TeamNight:
    """A team night as a game of two captains.

    Parameters
    ----------
    laws
        the possible results of each set: laws[k][i, j, w, d] is P(our pick i beats (w = 0) or loses
        to (w = 1) their pick j, and the set adds d - reach to our lead), where the last axis has
        length 2 reach + 1. `set_laws` makes them from ratings. A single array stands for every set.
    sets
        how many sets are played, if one array stands for all.
    order
        who names first, set by set; see `order_of`.
    sizes
        the number of players per side in each set: 1, or 2 for doubles; a single number stands for
        every set.
    tie
        the value of a tied night, between 0 (lost) and 1 (won).

    Raises
    ------
    InputError
        if the laws are not probabilities, do not fit the squads, or a squad has no lineup.

    Notes
    -----
    The night is won with a lead above 0 after the last set.

    >>> coin = np.zeros((2, 2, 2, 3))
    >>> coin[:, :, 0, 2] = coin[:, :, 1, 0] = 0.5
    >>> night = TeamNight(Squad(("Ann", "Bo")), Squad(("Cy", "Di")), coin, sets=2)
    >>> night.order, night.reach
    ('AB', 1)
    """

    ours: Squad
    theirs: Squad
    laws: tuple[Floats, ...]
    order: str
    sizes: tuple[int, ...]
    tie: float
    our_line_ups: LineUps
    their_line_ups: LineUps

    def __init__(
        self,
        ours: Squad,
        theirs: Squad,
        laws: ArrayLike | Sequence[ArrayLike],
        *,
        sets: int | None = None,
        order: str = "alternate",
        sizes: int | Sequence[int] = 1,
        tie: float = 0.5,
    ) -> None:
        given: list[Any] = [laws] * sets if sets is not None else list(laws)  # type: ignore[arg-type]
        each = tuple(sizes) if not isinstance(sizes, int) else (sizes,) * len(given)
        if len(each) != len(given):
            raise InputError(
                "{sizes} has {n_each} sets, but laws has {n_given}. Give both for every set.",
                n_each=len(each),
                n_given=len(given),
            )
        for size in each:
            one_of(size, "sizes", (1, 2))
        mine, others = line_ups(ours, each), line_ups(theirs, each)
        checked: dict[tuple[int, int], Floats] = {}
        for k, law in enumerate(given):
            key = id(law), each[k]
            if key not in checked:
                checked[key] = _law(law, len(mine.picks[k]), len(others.picks[k]))
        for name, value in {
            "ours": ours,
            "theirs": theirs,
            "laws": tuple(checked[id(law), size] for law, size in zip(given, each, strict=True)),
            "order": order_of(order, len(given)),
            "sizes": each,
            "tie": number_probability(tie, "tie"),
            "our_line_ups": mine,
            "their_line_ups": others,
        }.items():
            object.__setattr__(self, name, value)

    def with_laws(self, laws: Sequence[ArrayLike]) -> TeamNight:
        """Return the same night with other distributions, one for each set."""
        changed = copy(self)
        checked = tuple(_law(law, *old.shape[:2]) for law, old in zip(laws, self.laws, strict=True))
        object.__setattr__(changed, "laws", owned(checked))
        return changed

    @property
    def sets(self) -> int:
        """The number of sets."""
        return len(self.laws)

    @property
    def reach(self) -> int:
        """The largest change in the lead in one set."""
        return max(int(law.shape[3]) for law in self.laws) // 2

    def leads_after(self, sets: int) -> set[int]:
        """Return the possible leads after this many sets, whichever they are.

        >>> coin = np.zeros((1, 1, 2, 3))
        >>> coin[:, :, 0, 2] = coin[:, :, 1, 0] = 0.5
        >>> night = TeamNight(Squad(["Ann"], times=2), Squad(["Bo"], times=2), coin, sets=2)
        >>> sorted(night.leads_after(2))
        [-2, 0, 2]
        """
        each: set[int] = set()
        for law in self.laws:
            each.update((np.flatnonzero(law.any(axis=(0, 1, 2))) - law.shape[3] // 2).tolist())
        found = {0}
        for _ in range(sets):
            found = {before + lead for before in found for lead in each}
        return found

    def payoff(self, leads: ArrayLike) -> Floats:
        """Return the value of each final lead: 1 won, 0 lost, `tie` tied."""
        lead = np.asarray(leads)
        return np.where(lead > 0, 1.0, np.where(lead < 0, 0.0, self.tie))


def _law(given: ArrayLike, ours: int, theirs: int) -> Floats:
    law = floats(given, "laws", low=0.0, high=1.0)
    if law.ndim != 4 or law.shape[2] != 2 or not law.shape[3] % 2:
        raise InputError(
            "each entry in laws must have shape (our picks, their picks, 2, an odd number); one "
            "has shape {law_shape}",
            law_shape=law.shape,
        )
    if law.shape[:2] != (ours, theirs):
        raise InputError(
            "an entry in laws has shape {law_shape}, but the squads have {ours} and {theirs} "
            "picks for the set",
            law_shape=law.shape,
            ours=ours,
            theirs=theirs,
        )
    off = np.abs(law.sum(axis=(2, 3)) - 1.0)
    if off.max() > 1e-9:
        i, j = np.unravel_index(off.argmax(), off.shape)
        raise InputError(
            "the chances of picks {i} and {j} add up to {sum:.9g}; they must be 1",
            i=i,
            j=j,
            sum=law[i, j].sum(),
        )
    return law


# The order of nomination: which team names its player first, set by set.


OURS, THEIRS, BOTH, WINNER, LOSER = "A", "B", "=", "W", "L"
_MIRROR = {OURS: THEIRS, THEIRS: OURS}
NAMED = {
    "alternate": "AB",
    "home": "A",
    "blind": "=",
    "winner": "AW",
    "loser": "AL",
}
"""Named orders, as patterns; the last letters are repeated (AB), or the last one (AW)."""


def order_of(text: str, sets: int, more: Sequence[str] = ()) -> str:
    """Return who names first in each set, as one letter per set.

    Parameters
    ----------
    text
        a pattern such as 'ABABA', a shorter one that is repeated, or a name: 'alternate' (AB...),
        'home' (A...), 'blind' (=...), 'winner' and 'loser' (A, then who won or lost the last set).
        A: we name first and they answer; B: the other way round; =: both at once, blind; W and L:
        the winner or the loser of the last set names first.
    more
        more names that the caller accepts, for the error message.

    Raises
    ------
    InputError
        if `text` is not an order, is longer than the night, or depends on a winner before the first
        set.

    >>> order_of("alternate", 5), order_of("ABBA", 5), order_of("loser", 3)
    ('ABABA', 'ABBAA', 'ALL')
    """
    whole(sets, "sets", at_least=1)
    pattern = NAMED.get(text.strip().lower(), "")[:sets] or text.strip().upper()
    wanted = say(
        "Write who names first in each set: A (your team), B (the other team), = (both at once, "
        "blind), W or L (the winner or loser of the last set); or write one of these names: "
        "{names}.",
        names=", ".join((*NAMED, *more)),
    )
    if not pattern or set(pattern) - {OURS, THEIRS, BOTH, WINNER, LOSER}:
        raise InputError(
            "{order} {text!r} isn't an order. {wanted}",
            order=Parameter("order"),
            text=text,
            wanted=wanted,
        )
    if len(pattern) > sets:
        raise InputError(
            "{order} is {text!r}, which has {letters} letters, but there are {sets} sets. {wanted}",
            order=Parameter("order"),
            text=text,
            letters=len(pattern),
            sets=sets,
            wanted=wanted,
        )
    repeated = pattern[-1:] if pattern[-1] in (WINNER, LOSER) else pattern
    found = (pattern + repeated * sets)[:sets]
    if found[0] in (WINNER, LOSER):
        raise InputError(
            "{order} is {text!r}, but no one has won before the first set. {wanted}",
            order=Parameter("order"),
            text=text,
            wanted=wanted,
        )
    return found


def mirrored(order: str) -> str:
    """Return the order if the other team wins the toss: A and B change places.

    >>> mirrored("AB=AW")
    'BA=BW'
    """
    return "".join(_MIRROR.get(letter, letter) for letter in order)
