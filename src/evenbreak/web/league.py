"""The league's results, stored next to the tournament's file, rated in a thread, and shown.

The results are a plain file, such as tonight.league.csv next to tonight.db, so that commands can
read it too. A file put there by hand is read at the next start. Evenings added later are files next
to it, such as tonight.league-20250301-193000.csv. The code for reading and rating is loaded only
when needed: a page without a league uses half the memory.
"""

from __future__ import annotations

import asyncio
import glob
import json
import logging
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from evenbreak.errors import DataError, EvenbreakError
from evenbreak.files.store.folder import write_files
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, Scale, scale_of
from evenbreak.web.beside import Beside
from evenbreak.web.forms import ending_of, read_upload
from evenbreak.web.night import problem_of
from evenbreak.words import Sentence, say

if TYPE_CHECKING:
    from evenbreak.answers.kit.answer import Answer
    from evenbreak.answers.league.sheet import Sheet

_LOG = logging.getLogger(__name__)


@dataclass
class Progress:
    """Progress: the current step, and how much of it is done."""

    step: Sentence = say("Reading the results…")
    done: int = 0
    of: int = 0


@dataclass(eq=False)
class League:
    """A league: its results, and the files calculated from them, named after the tournament's."""

    beside: Path
    sheet: Sheet | None = None
    problem: str = ""
    progress: Progress | None = None
    _thread: Beside = field(default_factory=Beside)
    _asked: int = 0
    _whys: dict[tuple[int, int], asyncio.Future[Answer]] = field(default_factory=dict)

    @property
    def paths(self) -> list[Path]:
        """The results files: the league's, if there is one, and the evenings added later."""
        return self._given + self._evenings

    @property
    def _given(self) -> list[Path]:
        named = [self._named(ending) for ending in ("csv", "xlsx")]
        return [path for path in named if path.exists()][:1]

    @property
    def _evenings(self) -> list[Path]:
        folder = self.beside.parent
        return sorted(folder.glob(f"{glob.escape(self.beside.stem)}.league-*.csv"))

    def add_evening(self, content: bytes, begun: datetime) -> None:
        """Add an evening's results, replacing earlier ones; DataError lists all problems."""
        from evenbreak.files.results.results_file import read_results

        read_upload(content, read_results)
        name = f"{self.beside.stem}.league-{begun:%Y%m%d-%H%M%S}.csv"
        write_files(self.beside.parent, {name: content})

    def keep(self, content: bytes, scale: str, race: int) -> None:
        """Store results, and how they are shown, in place of earlier ones.

        Earlier files are kept with the extension .replaced. Raises DataError listing every problem;
        nothing changes then.
        """
        from evenbreak.files.results.results_file import read_results

        read_upload(content, read_results)
        ending = ending_of(content)
        shown = json.dumps({"scale": scale, "race": race}).encode()
        written = {self._named(ending).name: content, self._named("json").name: shown}
        written |= {f"{one.name}.replaced": one.read_bytes() for one in self._given}
        write_files(self.beside.parent, written)
        for other in {"csv", "xlsx"} - {ending}:
            self._named(other).unlink(missing_ok=True)
        for evening in self._evenings:
            evening.replace(evening.with_suffix(".replaced"))

    def known(self, name: str) -> tuple[str, float, float, bool] | None:
        """Return a player's data for a tournament (see `Entrant`); None if not in the league."""
        if self.sheet is None:
            return None
        ratings, wanted = self.sheet.ratings, " ".join(name.split()).casefold()
        for seat, player in enumerate(ratings.players):
            if player.casefold() == wanted:
                rating, error = float(ratings.rating[seat]), float(ratings.standard_error[seat])
                return player, rating, error, bool(ratings.provisional[seat])
        return None

    async def why(
        self, pair: tuple[int, int], work: Callable[[Sheet, tuple[int, int]], Answer], wait: float
    ) -> Answer | None:
        """Return what is calculated for two players on the sheet; None if not ready yet.

        Only a few pairs can wait at once, so that asking for many doesn't hold up the ratings.
        """
        sheet = self.sheet
        assert sheet is not None  # noqa: S101 - asked of a sheet that is shown
        if pair not in self._whys:
            if sum(not one.done() for one in self._whys.values()) >= _MOST_WAITING:
                return None
            if len(self._whys) >= _MOST_WHYS:
                self._whys.clear()
            self._whys[pair] = asyncio.ensure_future(self._thread.run(lambda: work(sheet, pair)))
        await asyncio.wait({self._whys[pair]}, timeout=wait)
        return self._whys[pair].result() if self._whys[pair].done() else None

    def begin(self) -> None:
        """Read and rate the results in the background; an earlier run no longer counts."""
        self._asked += 1
        self.problem, self.progress = "", Progress()
        task = asyncio.create_task(self._run(self._asked))
        _TASKS.add(task)
        task.add_done_callback(_TASKS.discard)

    async def _run(self, asked: int) -> None:
        try:
            sheet = await self._thread.run(lambda: self._rated(asked))
        except Exception as error:
            if not isinstance(error, EvenbreakError):
                _LOG.exception("the league could not be rated", exc_info=error)
            problem = problem_of(error)
        else:
            if asked == self._asked:
                self.sheet, self.progress = sheet, None
                self._whys.clear()
            return
        if asked == self._asked:
            self.problem, self.progress = problem, None

    def _rated(self, asked: int) -> Sheet:
        """Return the sheet; the steps are shown to anyone looking meanwhile."""
        from evenbreak.answers.league.roster_matchups import OfferedRaces
        from evenbreak.answers.league.sheet import MOST_ON_SHEET, Sheet, most_active
        from evenbreak.files.results.seasons import read_seasons
        from evenbreak.ratings.usual import usual_ratings

        paths = self.paths
        if not paths:
            raise DataError(["there are no results"])
        scale, race = self._shown()

        def at(step: Sentence) -> Callable[[int, int], None]:
            def told(done: int, of: int) -> None:
                if asked == self._asked:
                    self.progress = Progress(step, done, of)

            told(0, 0)
            return told

        at(say("Reading the results…"))
        file = read_seasons(paths)
        file = replace(file, source=file.source.replace(f"{self.beside.parent}/", ""))
        ratings, choice = usual_ratings(
            file.results, scale=scale, progress=at(say("Rating the players…"))
        )
        at(say("Finding the fairest races…"))
        offered = OfferedRaces(race_to=race)
        return Sheet.of(file, ratings, offered, most_active(ratings, MOST_ON_SHEET), choice)

    def _shown(self) -> tuple[Scale, int]:
        """Return the ratings' scale, and the stronger player's target."""
        try:
            shown = json.loads(self._named("json").read_text(encoding="utf-8"))
            return scale_of(shown["scale"]), int(shown["race"])
        except (OSError, ValueError, KeyError, TypeError):
            return SCALES[DEFAULT_SCALE], 7

    def _named(self, ending: str) -> Path:
        return self.beside.with_name(f"{self.beside.stem}.league.{ending}")


_MOST_WHYS, _MOST_WAITING = 50, 4
_TASKS: set[asyncio.Task[None]] = set()
