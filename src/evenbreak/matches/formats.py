"""Match formats as people write them: 9:5, 3:1 of 3:3, ahead 5:3, 7:7 win by 2."""

from __future__ import annotations

import re
from dataclasses import dataclass

from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.fields.kinds import BETWEEN as BETWEEN
from evenbreak.fields.kinds import LONGEST as LONGEST
from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat
from evenbreak.games.match import Match
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack

_WAYS = (
    "9:5, 'race to 7', '7:7 win by 2', 'ahead 5:3', '3:1 of 3:3' or 'best of 9', "
    "perhaps followed by 'winner breaks'"
)
WHO_BREAKS = {
    "winner": "winner",
    "loser": "loser",
    "alternate": "alternate",
    "a": "player 1",
    "b": "player 2",
}
"""Break formats as people name them, with the names that `evenbreak.games` has for them."""

WORDS = ("ahead", "best", "breaks", "by", "first", "of", "race", "to", "win", *WHO_BREAKS)
"""The words in a match format."""

_BEST_OF = re.compile(r"\bbest of (\d{1,9})\b", re.ASCII)
_ONE = re.compile(
    r"(?:(?:(?P<race>race|race to|first to) |(?P<ahead>(?:n )?ahead(?: by)? ))?)"
    r"(?P<m>\d{1,9})(?::(?P<n>\d{1,9}))?(?P<lead> ahead)?(?:,? win by (?P<by>\d{1,9}))?",
    re.ASCII,
)
_JOINED = re.compile(r"(?<!\d)[_\-–—−]|[_\-–—−](?!\d)")
_NUMBERS = (("m", "m"), ("n", "m"), ("by", "by"))
"""The numbers in a format, each with the number that replaces it if it is left out."""

_TAIL = re.compile(rf",? ({'|'.join(WHO_BREAKS)}) breaks$")


class NotAFormatError(InputError):
    """A string that is not spelled like a match, as opposed to a match that cannot exist."""


@dataclass(frozen=True)
class MatchFormat:
    """A match format, for any two players.

    Parameters
    ----------
    m, n
        the games that player 1 and player 2 need, or the sets if there is a `set_`.
    ahead
        whether they must lead by m and n instead of reaching them.
    win_by
        the race continues until one player leads by this many (see `evenbreak.games.Race`).
    set_
        the match that is played for one point of the score; None: a rack.
    breaks
        the break format, a name in `evenbreak.games.BREAK_FORMATS`; None: left open.

    Raises
    ------
    InputError
        if a number is not whole or is below 1, `breaks` is not such a name, or an n-ahead
        match has a `win_by`.

    >>> played = MatchFormat(3, 1, set_=MatchFormat(3, 3))
    >>> str(played), played.match(Rack(2 / 3)).rack.m
    ('3:1 of 3:3', 3)
    """

    m: int
    n: int
    ahead: bool = False
    win_by: int = 1
    set_: MatchFormat | None = None
    breaks: str | None = None

    def __post_init__(self) -> None:
        for name in ("m", "n", "win_by"):
            object.__setattr__(self, name, whole(getattr(self, name), name, at_least=1))
        if self.ahead and self.win_by > 1:
            raise InputError(
                "{win_by} is {value}, but the match is n-ahead. Leave it out.", value=self.win_by
            )
        if self.breaks is not None:
            one_of(self.breaks, "breaks", tuple(BREAK_FORMATS))

    def match(
        self, rack: Rack, *, breaks: BreakFormat | None = None, first_breaker: int = 1
    ) -> Match:
        """Return the match between two players with the chances of `rack`.

        Parameters
        ----------
        rack
            the chances, numbers or arrays.
        breaks
            who breaks next, if the format itself leaves it open. The break carries on from
            set to set.
        first_breaker
            who breaks the first rack, 1 or 2.

        Raises
        ------
        InputError
            if the break matters and the break format is missing.
        """
        if self.breaks is not None:
            breaks = BREAK_FORMATS[self.breaks]
        inside: Rack | Match = rack
        if self.set_ is not None:
            inside = self.set_.match(rack, breaks=breaks, first_breaker=first_breaker)
            breaks = None
        if self.ahead:
            return Ahead(self.m, self.n, inside, breaks=breaks, first_breaker=first_breaker)
        return Race(
            self.m,
            self.n,
            inside,
            breaks=breaks,
            first_breaker=first_breaker,
            win_by=self.win_by,
        )

    @property
    def scores(self) -> int:
        """The approximate number of scores, which determines how long the kernels take."""
        reach = max(self.m, self.win_by) * max(self.n, self.win_by)
        own = self.m + self.n if self.ahead else reach
        return own * (self.set_.scores if self.set_ else 1)

    def __str__(self) -> str:
        text = f"{'ahead ' if self.ahead else ''}{self.m}:{self.n}"
        if self.win_by > 1:
            text += f" win by {self.win_by}"
        if self.set_ is not None:
            text += f" of {self.set_}"
        if self.breaks is None:
            return text
        shown = {name: word for word, name in WHO_BREAKS.items()}[self.breaks]
        return f"{text} {shown.upper() if len(shown) == 1 else shown} breaks"


def match_format(text: str) -> MatchFormat:
    """Parse a match format.

    Parameters
    ----------
    text
        `9:5` (player 1, called A, needs 9 games, player 2, called B, needs 5), `7:7 win by 2`,
        `ahead 5:3`, or one of these `of` another, which is then the set: `3:1 of 3:3`. `best of 9`
        means `5:5`; `9-5` and `9/5` mean `9:5`; `race to 7` or `first to 7` means `7:7`, and `3
        ahead` or `n-ahead 3` means `ahead 3:3`. Words may be joined by hyphens or underscores. The
        break format may follow: `winner breaks`, or loser, alternate, A or B. Each number is from 1
        to 1000.

    Raises
    ------
    InputError
        if `text` is not a match format; the message says what to write.

    Notes
    -----
    Source: problems P5.7 and P5.8, where the notation comes from.

    >>> match_format("3:1 of 3:3").scores
    27
    >>> str(match_format("ahead 5:3, A breaks"))
    'ahead 5:3 A breaks'
    >>> str(match_format("9-5")), str(match_format("3/1 of 3/3"))
    ('9:5', '3:1 of 3:3')
    >>> str(match_format("best of 5 of 3:3"))
    '3:3 of 3:3'
    >>> str(match_format("race to 7")), str(match_format("n-ahead 3"))
    ('7:7', 'ahead 3:3')
    >>> match_format("nine games")
    Traceback (most recent call last):
    ...
    evenbreak.matches.formats.NotAFormatError: 'nine games' isn't a match format. Write 9:5, 'race
        to 7', '7:7 win by 2', 'ahead 5:3', '3:1 of 3:3' or 'best of 9', perhaps followed by 'winner
        breaks'.
    """
    words = " ".join(str(text).lower().split())
    words = re.sub(rf"(?<=\d) ?{BETWEEN} ?(?=\d)", ":", words)
    words = " ".join(_JOINED.sub(" ", words).split())
    for most in map(int, _BEST_OF.findall(words)):
        if most % 2 == 0:
            raise InputError(
                "{text!r}: a best of {most} can end in a tie. Give an odd number, or write "
                "{most_2}.",
                text=text,
                most=most,
                most_2=_half(most),
            )
    words = _BEST_OF.sub(lambda best: _half(int(best[1])), words)
    breaks = None
    if tail := _TAIL.search(words):
        words, breaks = words[: tail.start()], WHO_BREAKS[tail[1]]
    parts = [_ONE.fullmatch(part) for part in words.split(" of ")]
    inner: MatchFormat | None = None
    for part in reversed(parts):
        kinds = [] if part is None else [part[kind] for kind in ("race", "ahead", "lead")]
        if part is None or kinds.count(None) < 2 or not (part["n"] or any(kinds)):
            raise NotAFormatError(
                "{text!r} isn't a match format. Write {ways}.", text=text, ways=_WAYS
            )
        ahead = bool(part["ahead"] or part["lead"])
        m, n, win_by = (int(part[name] or part[spelled] or 1) for name, spelled in _NUMBERS)
        if not 1 <= min(m, n, win_by) <= max(m, n, win_by) <= LONGEST:
            raise InputError(
                "{text!r} has a number that isn't from 1 to {longest}. Correct it.",
                text=text,
                longest=LONGEST,
            )
        if ahead and win_by > 1:
            raise InputError(
                "{text!r}: 'ahead' can't be combined with 'win by'. Leave one out.", text=text
            )
        innermost = inner is None
        inner = MatchFormat(m, n, ahead, win_by, inner, breaks if innermost else None)
    assert inner is not None  # noqa: S101  a split has at least one part
    return inner


def _half(most: int) -> str:
    """Return the race that is the best of this many games, or one more if the number is even.

    >>> _half(9), _half(10)
    ('5:5', '6:6')
    """
    need = most // 2 + 1
    return f"{need}:{need}"
