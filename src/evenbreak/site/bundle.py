"""The site's tables as files that can be compared from week to week.

Their order is fixed, and they contain no timestamps: the same league gives the same bytes. The
manifest has the columns' version and each table's SHA-256.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable

import numpy as np
import pandas as pd

from evenbreak.files.csv_writer import to_csv
from evenbreak.league.tables.table import LeagueTable
from evenbreak.site.league import PublishedLeague

MANIFEST = "data/manifest.json"

SCHEMA_VERSION = 1
"""Incremented when a column is renamed or removed or changes its meaning; new columns are added
last."""


def bundle(league: PublishedLeague, pages: Iterable[str]) -> dict[str, bytes]:
    """Return the tables and their manifest by name; the manifest also lists the site's pages."""
    tables = {
        "standings.csv": _standings(league.standings),
        "matches.csv": _matches(league),
        "ratings.csv": league.ratings.to_frame(),
        "races.csv": league.races.frame,
        "changes.csv": league.changes,
    }
    if league.team_standings is not None:
        tables["teams.csv"] = _standings(league.team_standings)
    written = {f"data/{name}": to_csv(table) for name, table in tables.items()}
    manifest = {
        "schema_version": SCHEMA_VERSION,
        "league": league.title,
        "scale": league.ratings.scale.text,
        "last_match": str(league.days[-1]) if league.days else None,
        "files": {
            name: {
                "rows": len(table),
                "columns": list(map(str, table.columns)),
                "sha256": hashlib.sha256(written[f"data/{name}"]).hexdigest(),
            }
            for name, table in tables.items()
        },
        "pages": sorted(pages),
    }
    text = json.dumps(manifest, indent=1, ensure_ascii=False) + "\n"
    return {**written, MANIFEST: text.encode()}


_OURS = re.compile(
    r"(?:players/)?[a-z0-9-]+\.html|logo\.(?:png|jpg|webp)|data/[a-z]+\.csv", re.ASCII
)


def files_of(manifest: bytes) -> set[str]:
    """Return the site's files listed in a manifest (ValueError if it isn't a manifest).

    >>> sorted(files_of(b'{"files": {"races.csv": {}}, "pages": ["index.html", "../x.html"]}'))
    ['data/races.csv', 'index.html']
    """
    match json.loads(manifest):
        case {"pages": list(pages), "files": dict(tables)}:
            names = [*pages, *(f"data/{one}" for one in tables)]
            return {one for one in names if isinstance(one, str) and _OURS.fullmatch(one)}
    raise ValueError("this isn't a site's manifest")


def _standings(table: LeagueTable) -> pd.DataFrame:
    columns = ("place", "played", "won", "drawn", "lost", "scored", "conceded", "points")
    made = pd.DataFrame({name: getattr(table, name) for name in columns})
    made.insert(1, "name", list(table.names))
    return made


def _matches(league: PublishedLeague) -> pd.DataFrame:
    """Return the matches that count, in chronological order."""
    results, rows = league.results, league.rows[::-1]
    players = np.array(results.players, dtype=object)
    made = pd.DataFrame(
        {
            "date": [league.day_of(row) or None for row in rows],
            "player_a": players[results.player_a[rows]],
            "player_b": players[results.player_b[rows]],
            "score_a": results.score_a[rows],
            "score_b": results.score_b[rows],
        }
    )
    for name in ("race_a", "race_b"):
        column = getattr(results, name)
        if column is not None:
            made[name] = pd.array(np.where(column[rows] > 0, column[rows], -1), dtype="Int64")
            made[name] = made[name].mask(made[name] < 0)
    winner = {0: None, 1: "a", 2: "b"}
    made["winner"] = [winner[int(league.winner[row])] for row in rows]
    return made
