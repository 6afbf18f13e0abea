"""What happens if a player goes home or forfeits, in words, before it is entered."""

from __future__ import annotations

from evenbreak.tournaments.evening.fold import Evening
from evenbreak.words import Sentence, say


def would_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, who would go home, and which matches would be forfeited."""
    gone = set(after.dropped) - set(before.dropped) or set(before.entrants) - set(after.entrants)
    said = [say("{player} would withdraw.", player=name) for name in sorted(gone)]
    if after.drawn and after.plan.form != "chips":
        said += [
            say(
                "{loser} would forfeit to {winner} in {match}.",
                loser=result.loser,
                winner=result.winner,
                match=after.match_words(name),
            )
            for name, result in after.counted.items()
            if name not in before.counted and result.forfeit
        ]
    return said
