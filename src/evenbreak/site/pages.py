"""The pages of a league's site, and all its files.

A page loads nothing from elsewhere, and works from a disk or a USB stick: its style and script are
included, and links are relative. The same league gives the same bytes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np

from evenbreak import __version__
from evenbreak.answers.kit.scales import like_scale_words
from evenbreak.answers.league.rate import unlinked_words
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.standings import rules_words
from evenbreak.league.tables.fixtures import Fixture
from evenbreak.league.tables.table import LeagueTable
from evenbreak.sheets.bracket_page import bracket_both
from evenbreak.sheets.html_page import environment, own_file, policy
from evenbreak.site import pictures
from evenbreak.site.bundle import bundle
from evenbreak.site.league import RECENT, PublishedLeague
from evenbreak.site.look import Accent
from evenbreak.site.pictures import short_day
from evenbreak.site.tournaments import Tournament
from evenbreak.words import ordinal, race

ROOM = "evenbreak.site"
MOST_BYTES = 60_000
"""The largest page, in bytes."""

MOST_ROWS, MOST_LISTED = 100, 80
"""The most players on a page, and the most matches on a player's; the rest are on further pages or
in the tables."""

_ROUND_A_BRACKET = 14_000  # bytes of a bracket's page besides

_TABLES = {
    "standings.csv": "Standings",
    "ratings.csv": "Ratings, each with its margin of error",
    "races.csv": "Every pair's race",
    "matches.csv": "All matches",
    "changes.csv": "What has changed in a week",
    "manifest.json": "A list of these files, with their checksums",
}


def site_files(
    league: PublishedLeague,
    tournaments: Sequence[Tournament] = (),
    fixtures: Sequence[Fixture] = (),
) -> dict[str, bytes]:
    """Return every file on a site by name, including the tables and their manifest."""
    maker = _Pages(league, tournaments, fixtures)
    written = {**maker.standings(), **maker.ratings()}
    written |= {"races.html": maker.races(), "season.html": maker.season()}
    if fixtures:
        written["fixtures.html"] = maker.fixture_list()
    if tournaments:
        written["tournaments.html"] = maker.tournaments()
        for one in tournaments:
            written |= maker.tournament(one)
    written |= {file: maker.player(name) for name, file in league.pages.items()}
    written["about.html"] = maker.about()
    if league.logo is not None:
        name, content = league.logo
        written[name] = content
    return {**written, **bundle(league, written)}


class _Pages:
    """What all of a site's pages share."""

    def __init__(
        self,
        league: PublishedLeague,
        tournaments: Sequence[Tournament],
        fixtures: Sequence[Fixture],
    ) -> None:
        self.league, self.played, self.fixtures = league, tournaments, fixtures
        days = league.days
        self.last = str(days[-1]) if days else ""
        self.year = len(days) > 1 and bool((days[-1] - days[0]).astype(int) > 300)
        self.tabs = [
            ("index.html", "Standings"),
            ("ratings.html", "Ratings"),
            ("races.html", "Races"),
            *([("fixtures.html", "Fixtures")] if fixtures else []),
            ("season.html", "Season"),
            *([("tournaments.html", "Tournaments")] if tournaments else []),
        ]

    def _page(self, template: str, title: str, *, here: str = "", **values: Any) -> bytes:
        league = self.league
        style = _style(league.accent, bracket="panels" in values)
        script = values.get("script", "")
        filled = environment(ROOM)
        filled.filters.update(self._filters())
        page = filled.get_template(template).render(
            league=league,
            title=title,
            here=here,
            tabs=self.tabs,
            root="../" if template == "player.html" else "",
            style=style,
            csp=policy(style, script, images="'self' file: data:" if league.logo else "data:"),
            **{"two": False, **values},
        )
        return page.encode()

    def _filters(self) -> dict[str, Callable[..., str]]:
        decimals = self.league.decimals
        return {
            "day": lambda day: short_day(str(day), year=True),
            "short_day": lambda day: short_day(day, year=self.year),
            "points": lambda points: f"{points:.{decimals}f}",
            "change": lambda points: signed(points, decimals),
        }

    def standings(self) -> dict[str, bytes]:
        """Return the first page, and more if there are too many players for one."""
        league = self.league
        players = self._table(league.standings, "Player", players=True)
        teams = []
        if league.team_standings is not None:
            teams = [self._table(league.team_standings, "Team", players=False)]
        made = {}
        for parts, file, rows in _parted(players["rows"], "index.html", "standings"):
            first = file == "index.html"
            made[file] = self._page(
                "standings.html",
                league.title,
                here="index.html",
                two=first,
                parts=parts,
                file=file,
                tables=[*(teams if first else []), {**players, "rows": rows}],
                rule=_sentence(rules_words(league.rules, sets=False)),
                last=self._last_night() if first else None,
            )
        return made

    def _table(self, table: LeagueTable, who: str, *, players: bool) -> dict[str, Any]:
        """Return a table of players or teams for its template."""
        drawn, matches = bool(table.drawn.any()), self.league.matches
        rows = []
        for k, name in enumerate(table.names):
            if not table.played[k]:
                continue
            figures = [table.won[k], *([table.drawn[k]] if drawn else []), table.lost[k]]
            form = [one.won for one in matches[name][:RECENT]][::-1] if players else None
            games = f"{table.scored[k]}-{table.conceded[k]}"
            rows.append((table.place[k], name, figures, games, f"{table.points[k]:g}", form))
        counted = ["Won", *(["Drawn"] if drawn else []), "Lost"]
        games = "Games" if players or self.league.count_games else "Sets"
        return {"who": who, "counted": counted, "rows": rows, "players": players, "games": games}

    def _last_night(self) -> dict[str, Any] | None:
        league, results = self.league, self.league.results
        if not league.days:
            return None
        day = str(league.days[-1])
        rows = [row for row in league.rows if league.day_of(row) == day][::-1]
        matches = []
        for row in rows[:8]:
            seats = [results.player_a[row], results.player_b[row]]
            scores = [int(results.score_a[row]), int(results.score_b[row])]
            if league.winner[row] == 2:
                seats, scores = seats[::-1], scores[::-1]
            a, b = (results.players[int(seat)] for seat in seats)
            matches.append({"a": a, "b": b, "score": f"{scores[0]}-{scores[1]}" * any(scores)})
        return {"day": day, "matches": matches, "more": len(rows) - len(matches)}

    def ratings(self) -> dict[str, bytes]:
        """Return the ratings page, and more if there are too many players for one."""
        league = self.league
        decimals = league.decimals
        changed = {}
        if league.week_before is not None:
            rows: Any = league.changes.itertuples(index=False)
            changed = {row.player: _arrow(row.change, decimals) for row in rows}
        about = (
            f"From {league.ratings.matches:,} matches, on "
            f"{like_scale_words(league.ratings.scale)}. About two times in three, a player's "
            "true rating is within the ± shown."
        )
        return {
            file: self._page(
                "ratings.html",
                "Ratings",
                here="ratings.html",
                parts=parts,
                file=file,
                rated=rated,
                changed=changed,
                unlinked=" ".join(unlinked_words(league.ratings)),
                about=about,
            )
            for parts, file, rated in _parted(league.rated, "ratings.html", "ratings")
        }

    def races(self) -> bytes:
        """Return the page where two taps show a race."""
        data = self.league.races.for_script(self.league.names.hidden)
        text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
        return self._page(
            "races.html",
            "Races",
            here="races.html",
            json=text.replace("<", "\\u003c").replace("\u2028", "\\u2028"),
            script=own_file("race.js", ROOM),
            tonight=self._tonight(),
        )

    def _tonight(self) -> dict[str, Any] | None:
        """Return the next night's races, if its players are known."""
        days = sorted(
            {str(one.date) for one in self.fixtures if one.date and str(one.date) > self.last}
        )
        rows = [self._to_play(one) for one in self.fixtures if days and str(one.date) == days[0]]
        if not any(row["race"] for row in rows):
            return None
        title = f"Races on {short_day(days[0], year=True)}"
        return {"title": title, "rows": rows, "placed": any(row["where"] for row in rows)}

    def _to_play(self, one: Fixture) -> dict[str, str]:
        found = self.league.races.by_pair.get((one.home, one.away))
        table = f"table\N{NO-BREAK SPACE}{one.table}" if one.table else ""
        return {
            "where": ", ".join(filter(None, [one.venue, table])),
            "a": one.home,
            "b": one.away,
            "race": race(found[:2]) if found else "",
            "chance": _percent(found[2]) if found else "",
        }

    def fixture_list(self) -> bytes:
        """Return the fixtures page, night by night."""
        days: dict[str, list[dict[str, str]]] = {}
        for one in self.fixtures:
            days.setdefault(str(one.date or ""), []).append(self._to_play(one))
        nights = [
            {
                "title": (short_day(day, year=True) or "No date yet")
                + ", postponed" * ("" < day <= self.last),
                "rows": rows,
                "placed": any(row["where"] for row in rows),
                "raced": any(row["race"] for row in rows),
            }
            for day, rows in sorted(days.items(), key=lambda item: (not item[0], item[0]))
        ]
        return self._page("fixtures.html", "Fixtures", here="fixtures.html", nights=nights)

    def season(self) -> bytes:
        """Return the page with pictures of the season."""
        league = self.league
        games = int(league.ratings.won.sum())
        hill = _decided_late(league)
        figures = [
            ("players", f"{int((~league.ratings.idle).sum()):,}"),
            ("matches", f"{league.ratings.matches:,}"),
            *([("games", f"{games:,}")] if games else []),
            *([("went hill-hill", hill)] if hill else []),
        ]
        return self._page(
            "season.html",
            "Season",
            here="season.html",
            figures=figures,
            pictures=pictures.season(league),
        )

    def player(self, name: str) -> bytes:
        """Return a player's page."""
        league = self.league
        matches = league.matches.get(name, [])
        table = league.standings
        place = table.names.index(name) if name in table.names else None
        rated = next((one for one in league.rated if one.player == name), None)
        figures = []
        if name in league.races.levels:
            figures.append(("skill level", str(league.races.levels[name])))
        if rated is not None:
            points = f"{rated.rating:.{league.decimals}f}"
            figures.append((f"rating, ±{rated.error:.{league.decimals}f}", points))
        if place is not None and table.played[place]:
            figures.append(("won-lost", f"{table.won[place]}-{table.lost[place]}"))
            figures.append(("in the standings", ordinal(int(table.place[place]))))
        listed = matches[:MOST_LISTED]
        played = name in league.results.players
        return self._page(
            "player.html",
            name,
            player=name,
            two=True,
            figures=figures,
            provisional=rated is not None and rated.provisional,
            marks=[one.won for one in matches[:RECENT]][::-1],
            chart=pictures.history(league, name) if played else None,
            why=self._why(name),
            races=self._races_of(name),
            matches=listed,
            left_out=len(matches) - len(listed),
            raced=any(one.race for one in listed),
            worth=any(one.worth is not None for one in listed),
        )

    def _races_of(self, name: str) -> list[tuple[str, str, str]]:
        """Return the race against everyone; in a large league, recent opponents come first."""
        races, met = self.league.races.by_pair, self.league.matches.get(name, [])
        others = dict.fromkeys([*(one.opponent for one in met), *self.league.pages])
        chosen = [one for one in others if one in self.league.pages and (name, one) in races]
        return [
            (other, race((m, n)), _percent(p))
            for other in sorted(chosen[:MOST_ROWS], key=str.casefold)
            for m, n, p in [races[name, other]]
        ]

    def _why(self, name: str) -> tuple[str, list[str]] | None:
        """Return the reason for the race against the last opponent, and what would change it."""
        league = self.league
        opponent = next((one.opponent for one in league.matches.get(name, ())), "")
        found = league.races.by_pair.get((name, opponent))
        if found is None:
            return None
        m, n, p = found
        seats = [np.array([league.races.roster.players.index(one)]) for one in (name, opponent)]
        gap = league.races.gap(*seats)
        first, second = (float(league.races.roster.rating[seat[0]]) for seat in seats)
        alone = "" if gap is None else _percent(float(gap.p_game[0]))
        game = f"{name} wins a single game {alone} of the time"
        if league.races.levels:
            won = f" {game}, and the race {_percent(p)} of the time." if alone else ""
            said = (
                f"{name} is a skill level {first:g}, and the last opponent, {opponent}, is a skill "
                f"level {second:g}. The chart's race is {race((m, n))}.{won}"
            )
        else:
            apart = abs(first - second)
            points = f"{{:.{league.decimals}f}}".format
            fair = isinstance(league.races.rule, OfferedRaces)
            played = race((m, n))
            reason = "The race closest to even is" if fair else "The chart's race is"
            said = (
                f"{name} is rated {points(first)}, and the last opponent, {opponent}, is rated "
                f"{points(second)}: a difference of {points(apart)} points. {game}. "
                f"{reason} {played}, which {name} wins {_percent(p)} of the time."
            )
        more = [
            f"If {one.winner} wins their next match {one.score}, the race becomes "
            f"{race(one.then.race)}."
            for one in league.one_more(name, opponent)
            if one.then.race is not None
        ]
        if isinstance(league.races.rule, OfferedRaces) and not more:
            more = ["No matter who wins their next match, the race stays the same."]
        return race((m, n)), [said, *more]

    def tournaments(self) -> bytes:
        """Return the list of tournaments."""
        return self._page(
            "tournaments.html", "Tournaments", here="tournaments.html", tournaments=self.played
        )

    def tournament(self, one: Tournament) -> dict[str, bytes]:
        """Return a tournament with its bracket: one page, or one per side if it is large."""
        whole = bracket_both(one.panels)
        if len(whole) < MOST_BYTES - _ROUND_A_BRACKET:
            return {one.file: self._bracket(one, [("bracket", "Bracket", whole)], [], one.file)}
        panels = [
            (f"side-{k}", panel.title or "Bracket", bracket_both([panel], sight=False))
            for k, panel in enumerate(one.panels, 1)
        ]
        stem = one.file.removesuffix(".html")
        files = [one.file, *(f"{stem}-side-{k}.html" for k in range(2, len(panels) + 1))]
        parts = [(file, title) for file, (_, title, _) in zip(files, panels, strict=True)]
        return {
            file: self._bracket(one, [panel], parts, file)
            for file, panel in zip(files, panels, strict=True)
        }

    def _bracket(
        self, one: Tournament, panels: Sequence[Any], parts: Sequence[Any], file: str
    ) -> bytes:
        return self._page(
            *("tournament.html", one.title),
            here="tournaments.html",
            one=one,
            panels=panels,
            parts=parts,
            file=file,
        )

    def about(self) -> bytes:
        """Return the page about the site: its sources, how players are named, the tables."""
        league = self.league
        return self._page(
            "about.html",
            "About this site",
            ratings_words=(
                "The ratings use every game in the results, and show how far off they may be."
            ),
            names_words=_names_words(league.names.ways),
            tables=[(f"data/{file}", text) for file, text in _TABLES.items()],
            made_by=f"Made by evenbreak {__version__}.",
        )


def _parted(
    rows: Sequence[Any], first: str, then: str
) -> Iterator[tuple[list[tuple[str, str]], str, Sequence[Any]]]:
    """Yield the pages of a long list: links to all of them, the page's file, and its rows."""
    starts = range(0, max(len(rows), 1), MOST_ROWS)
    files = [first, *(f"{then}-{k}.html" for k in range(2, len(starts) + 1))]
    parts = [
        (file, f"{start + 1} to {min(start + MOST_ROWS, len(rows))}")
        for file, start in zip(files, starts, strict=True)
    ]
    for file, start in zip(files, starts, strict=True):
        yield parts if len(parts) > 1 else [], file, rows[start : start + MOST_ROWS]


def _names_words(ways: Mapping[str, str]) -> str:
    many = {way: [*ways.values()].count(way) for way in ("full", "initials", "hidden")}
    if many["full"] == len(ways):
        return "Everyone's full name is shown."
    said = [
        (many["full"], "by full name"),
        (many["initials"], "by initials"),
        (many["hidden"], "by a number, without a page"),
    ]
    parts = [
        f"{n:,} {'player is' if n == 1 else 'players are'} shown {how}" for n, how in said if n
    ]
    return f"{'; '.join(parts)}."


def _decided_late(league: PublishedLeague) -> str:
    """Return the share of races in which both players needed one more game; '' if unknown."""
    race_a, race_b = league.results.races
    rows = [row for row in league.rows if race_a[row] and race_b[row] and league.winner[row]]
    if not rows:
        return ""
    needed = race_a[rows] + race_b[rows] - 1
    games = league.results.score_a[rows] + league.results.score_b[rows]
    return f"{100 * float((games == needed).mean()):.0f}%"


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def _percent(p: float) -> str:
    """Return a chance as text; '' if it isn't known."""
    return "" if math.isnan(p) else f"{100 * p:.0f}%"


def signed(points: float, decimals: int) -> str:
    """Return a change with a typographic sign.

    >>> signed(-3.24, 0), signed(2.0, 1), signed(0.04, 1)
    ('−3', '+2.0', '0.0')
    """
    text = f"{abs(points):.{decimals}f}"
    sign = "" if float(text) == 0.0 else "+" if points > 0 else "\N{MINUS SIGN}"
    return sign + text


def _arrow(change: Any, decimals: int) -> str:
    return "new" if change is None or change != change else signed(float(change), decimals)


@cache
def _style(accent: Accent | None, *, bracket: bool) -> str:
    """Return a page's style: what all evenbreak pages share, the site's, and the color."""
    drawn = own_file("bracket.css") if bracket else ""
    color = accent.style() if accent else ""
    return own_file("common.css", ROOM) + drawn + own_file("site.css", ROOM) + color
