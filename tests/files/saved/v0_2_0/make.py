"""Write the files beside this one, as version 0.2.0 keeps them; they were made with that version.

    git checkout v0.2.0 && python tests/files/saved/v0_2_0/make.py

They stay as they are: later versions must open them. `states.json` says what they hold; it is
what `earlier_files.held` returned then.
"""

import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from click.testing import CliRunner

HERE = Path(__file__).parent
sys.path.append(str(HERE.parents[2]))

from earlier_files import held  # noqa: E402
from evenbreak.cli.program import program  # noqa: E402
from evenbreak.files.team_night_store import add_team_events  # noqa: E402
from evenbreak.files.tournament_desk import (  # noqa: E402
    Proposal,
    keep_prizes,
    kept_secrets,
    propose,
)
from evenbreak.files.tournament_store import (  # noqa: E402
    add_events,
    new_tournament,
    read_tournament,
)
from evenbreak.handicaps.charts.chart import CHARTS, chart  # noqa: E402
from evenbreak.teams.evening import moves as team_moves  # noqa: E402
from evenbreak.teams.evening.events import Begun, Undone  # noqa: E402
from evenbreak.teams.evening.plan import NightPlan, TeamSheet  # noqa: E402
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS  # noqa: E402
from evenbreak.tournaments.evening import moves  # noqa: E402
from evenbreak.tournaments.evening.events import (  # noqa: E402
    Entrant,
    Event,
    Opened,
    Plan,
    What,
)
from evenbreak.tournaments.evening.fold import Evening  # noqa: E402
from evenbreak.tournaments.evening.settling import break_ties  # noqa: E402
from evenbreak.tournaments.money.prize_money import PrizeMoney  # noqa: E402

AT = "2025-03-01T{}:{:02}:00"
PAGE = "director's page"
RNG = np.random.default_rng(1)
NAMES = ("Ann Lee", "Bo", "Cem Öz", "Dora", "Eli", "Fay", "Gus", "Hui")
ENTRANTS = tuple(Entrant(name, 620.0 - 20 * k, 12.5) for k, name in enumerate(NAMES))
MARKS = {name: f"{name} of 0.2.0" for name in ("cookie", "director", "match")}


def begun(name: str, plan: Plan, entrants: Sequence[Entrant] = ENTRANTS) -> Path:
    """Begin a tournament in a new file."""
    path = HERE / name
    path.unlink(missing_ok=True)
    new_tournament(path, [Event(AT.format(19, 30), Opened(plan, tuple(entrants)))])
    kept_secrets(path, {"pin": "482913", **MARKS})
    return path


def play(path: Path, *happens: Callable[[Evening], What | Sequence[What]], by: str = PAGE) -> None:
    """Let one thing after another happen, a minute apart."""
    for happen in happens:

        def decide(state: Evening, happen: Callable[..., object] = happen) -> list[Event]:
            found = happen(state)
            at = AT.format(20, len(state.events))
            return [Event(at, what) for what in (found if isinstance(found, list) else [found])]

        add_events(path, decide, by=by)


def wins(state: Evening, match: str, first: bool = True) -> What:
    """Let a player win by one game."""
    m, n = state.needed(match, state.pair(match))
    return moves.result(state, match, (m, n - 1) if first else (m - 1, n))


def tournament() -> None:
    """A double elimination in the middle, with something of every kind."""
    plan = Plan("double", 5, losers_race=4, scale="fargo", starter=500.0, tables=3)
    path = begun("tournament.db", plan, ENTRANTS[:7])
    play(path, lambda s: moves.late(s, ENTRANTS[7]), lambda s: moves.draw(s, RNG))
    play(path, lambda s: moves.call(s, "W1.1", 1), lambda s: moves.score(s, "W1.1", (3, 1)), by="")
    play(
        path,
        lambda s: wins(s, "W1.1"),
        lambda s: wins(s, "W1.2", first=False),
        lambda s: moves.correct(s, "W1.2", (5, 1)),
        lambda s: moves.forfeit(s, s.pair("W1.3")[1]),
        lambda s: wins(s, "W1.4"),
        lambda s: moves.undo(s),
        lambda s: wins(s, "W1.4", first=False),
        lambda s: moves.call(s, "W2.1", 2),
        lambda s: moves.score(s, "W2.1", (2, 3)),
        lambda s: moves.change(s, tables=4, final_race=7),
        lambda s: moves.drop(s, s.pair("L1.1")[0]),
    )
    propose(
        path, Proposal("W2.1", "Ann Lee", {"Ann Lee": 5, "Dora": 3}, "a phone", AT.format(21, 5))
    )
    keep_prizes(path, PrizeMoney(20.0, 100.0, 0.1, "50/30/20"))


def chips() -> None:
    """A chip tournament of six players in the middle."""
    plan = Plan("chips", 1, scale="fargo", tables=2, chips=CHIP_CHARTS[min(CHIP_CHARTS)])
    path = begun("chips.db", plan, ENTRANTS[:6])
    play(path, lambda s: moves.draw(s, RNG))
    for k in range(5):
        play(path, lambda s, k=k: wins(s, to_play(path)[k % 2], first=k % 3 > 0))


def swiss() -> None:
    """A Swiss by a chart in its second round."""
    plan = Plan("swiss", 1, rounds=3, chart=chart(min(CHARTS)), scale="npl", tables=4)
    entrants = [Entrant(name, 90.0 - 8 * k) for k, name in enumerate(NAMES)]
    path = begun("swiss.db", plan, entrants)
    play(path, lambda s: moves.draw(s, RNG))
    play(path, lambda s: moves.draw_next(s, RNG))
    play(path, *[lambda s, m=m: wins(s, m) for m in to_play(path)])
    play(path, lambda s: moves.draw_next(s, RNG))
    play(path, lambda s: wins(s, s.standing.to_play[0]))


def to_play(path: Path) -> list[str]:
    """Return what can be played now."""
    return list(read_tournament(path).standing.to_play)


def groups() -> None:
    """Groups with a tie that was broken by hand."""
    plan = Plan("groups", 3, groups=2, qualifiers=1, handicapped=True, scale="fargo", tables=4)
    path = begun("groups.db", plan, ENTRANTS[:6])
    play(path, lambda s: moves.draw(s, RNG))
    for match in to_play(path):
        play(path, lambda s, m=match: wins(s, m, first=cyclic(s, m)))
    play(path, lambda s: break_ties(s, RNG).ranked)


def cyclic(state: Evening, match: str) -> bool:
    """Return whether the first of a pair wins, so that a group of three is tied."""
    group = next(one for one in state.bracket.groups if match in one.matches)
    one, other = (group.members.index(state.order.index(name)) for name in state.pair(match))
    return (other - one) % 3 == 1


def team_night() -> None:
    """A team night after one of three sets, beside one that was put aside."""
    path = HERE / "team_night.db"
    path.unlink(missing_ok=True)
    racks = TeamSheet(
        "Racks", ("Ann", "Bo", "Cleo"), (640.0, 560.0, 500.0), (0.0,) * 3, (6.0, 5.0, 5.0)
    )
    cues = TeamSheet(
        "Cues", ("Uli", "Vic", "Wim"), (600.0, 580.0, 490.0), (0.0,) * 3, (6.0, 5.0, 4.0)
    )
    plan = NightPlan((racks, cues), 3, race=4, cap=16.0)
    by = ("team A's page", "team B's page")
    kept = [
        (Begun(NightPlan((racks, cues), 2, race=5)), PAGE, "form 1"),
        (Begun(plan), PAGE, "form 2"),
        (lambda s: team_moves.put_up(s, 0, 1, ("Ann",)), by[0], "form 3"),
        (lambda s: team_moves.put_up(s, 1, 1, ("Uli",)), by[1], "form 4"),
        (lambda s: team_moves.propose(s, 0, 1, (4, 2)), by[0], "form 5"),
        (lambda s: team_moves.propose(s, 1, 1, (4, 2)), by[1], "form 6"),
        (
            lambda s: team_moves.put_up(s, s.due[0], 2, (s.plan.teams[s.due[0]].players[1],)),
            PAGE,
            None,
        ),
        (Undone(), PAGE, "form 7"),
        (lambda s: team_moves.result(s, 1, (4, 3)), PAGE, "form 8"),
    ]
    for minute, (what, author, form) in enumerate(kept):
        add_team_events(
            path,
            lambda _, state, what=what: what(state) if callable(what) else [what],
            at=AT.format(20, minute),
            by=author,
            form=form,
        )
    kept_secrets(path, {"pin": "120973", **MARKS})


def league() -> None:
    """The results of a league beside a tournament, as the page keeps them, and saved ratings."""
    from evenbreak.web.league import League

    rows = (HERE.parents[3] / "data" / "demo_league.csv").read_bytes().splitlines(keepends=True)
    kept = League(HERE / "tournament.db")
    kept.keep(b"".join(rows[:41]), "fargo", 7)
    from datetime import datetime

    kept.add_evening(b"".join(rows[:1] + rows[41:61]), datetime(2025, 2, 22, 19, 30))
    rate = ["rate", *map(str, kept.paths), "--scale", "fargo", "--save", str(HERE / "ratings.csv")]
    ran = CliRunner().invoke(program, rate)
    assert ran.exit_code == 0, ran.output


if __name__ == "__main__":
    for make in (tournament, chips, swiss, groups, team_night, league):
        make()
    found = json.dumps(held(HERE), indent=1, ensure_ascii=False) + "\n"
    (HERE / "states.json").write_text(found, encoding="utf-8")
