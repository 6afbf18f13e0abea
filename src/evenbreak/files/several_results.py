"""Several files of results as one: the seasons of a league in a row."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import reduce
from pathlib import Path
from typing import Any

import numpy as np

from evenbreak.errors import InputError
from evenbreak.files.player_names import same_name
from evenbreak.files.results import ResultsFile, met_pairs, read_results
from evenbreak.files.similar_names import similar_name_warnings, similar_names
from evenbreak.ratings.results import Results


def read_seasons(paths: Sequence[str | Path], **reading: Any) -> ResultsFile:
    r"""Read several files of results as one career of each player.

    Names that differ in case or spaces alone are one player's, by the name in the first file.

    Parameters
    ----------
    paths
        the files, in any order: matches go by their dates.
    reading
        as for `read_results`.

    Raises
    ------
    InputError
        if two of the files hold the same.
    DataError
        as `read_results` does.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     last, this = (pathlib.Path(folder) / name for name in ("last.csv", "this.csv"))
    ...     _ = last.write_text("player_a,player_b,score_a,score_b\nAnn,Bo,7,5\n")
    ...     _ = this.write_text("player_a,player_b,score_a,score_b\nBO,Cy,7,2\n")
    ...     read_seasons([last, this]).results.players
    ('Ann', 'Bo', 'Cy')
    """
    found = [read_results(path, **reading) for path in paths]
    if len(found) == 1:
        return found[0]
    prints = [file.sha256 for file in found]
    for k, file in enumerate(found):
        if file.sha256 in prints[:k]:
            first = found[prints.index(file.sha256)].source
            raise InputError(f"{first} and {file.source} hold the same results; give each once")
    results = _joined([file.results for file in found])
    groups = tuple(similar_names(results.players, met_pairs(results)))
    source = " and ".join(file.source for file in found)
    known = {group for file in found for group in file.similar_names}
    across = [group for group in groups if group not in known]
    remedy = "if so, use the same name throughout"
    return ResultsFile(
        results,
        source,
        (
            *(text for file in found for text in file.warnings),
            *similar_name_warnings(across, source, remedy),
            *_in_two_files(found, results),
        ),
        groups,
        hashlib.sha256("".join(prints).encode()).hexdigest(),
        ties=tuple(text for file in found for text in file.ties),
        skipped=sum(file.skipped for file in found),
        read=tuple((file.source, file.sha256) for file in found),
    )


def _in_two_files(found: Sequence[ResultsFile], results: Results) -> Iterator[str]:
    """Yield how many dated matches of a file are in an earlier one, with the same score."""
    if results.date is None:
        return
    columns = (results.player_a, results.player_b, results.score_a, results.score_b)
    days = results.date.astype("datetime64[D]").astype(np.int64)
    rows = list(zip(days.tolist(), *(column.tolist() for column in columns), strict=True))
    dated = (~np.isnat(results.date)).tolist()
    seen: set[tuple[int, ...]] = set()
    start = 0
    for file in found:
        end = start + len(file.results)
        own = [row for row, known in zip(rows[start:end], dated[start:end], strict=True) if known]
        again = sum(row in seen for row in own)
        if again:
            matches = "match is" if again == 1 else "matches are"
            yield (
                f"{file.source}: {again:,} {matches} in an earlier file too, with the same "
                "players, score and day; leave them out of one of the files, or they count twice"
            )
        seen.update(own)
        start = end


def _joined(seasons: Sequence[Results]) -> Results:
    """Return the matches of all seasons, between the players of all."""
    spelling: dict[str, str] = {}
    for season in seasons:
        for name in season.players:
            spelling.setdefault(same_name(name), name)
    players = tuple(sorted(spelling.values()))
    position = {name: k for k, name in enumerate(players)}
    renumbered = []
    for season in seasons:
        places = [position[spelling[same_name(name)]] for name in season.players]
        place = np.array(places, dtype=np.int64)
        a, b = place[season.player_a], place[season.player_b]
        renumbered.append(replace(season, players=players, player_a=a, player_b=b))
    return reduce(Results.joined, renumbered)
