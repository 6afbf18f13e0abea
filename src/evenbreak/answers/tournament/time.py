"""Times of day, such as 08:05, and the sentence that says when an evening ends."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, quantities_of, quantity_of
from evenbreak.answers.kit.parts import Part, Quantities, Quantity, Table
from evenbreak.answers.kit.scales import form_used_words
from evenbreak.answers.kit.wording import clock, percent
from evenbreak.answers.tournament.tournament import Tournament, pair_words
from evenbreak.arrays import Floats
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.numbering import match_numbers
from evenbreak.tournaments.clock.event_pace import EarlierNight, event_pace, nights_of, venue_ratio
from evenbreak.tournaments.clock.finish import QUANTILES, Finish, bands_of, finish, minutes_later
from evenbreak.tournaments.odds.races import Fairest, Race, Races
from evenbreak.words import Sentence, joined, say, say_count

_DAY = 24 * 60


def time_of_day(minutes: float) -> str:
    """Return minutes after midnight as a time of day.

    >>> time_of_day(8 * 60 + 5), time_of_day(26 * 60 + 27.2)
    ('08:05', '02:27')
    """
    moment = round(minutes) % _DAY
    return f"{moment // 60:02d}:{moment % 60:02d}"


def minute_of_day(moment: datetime) -> int:
    """Return a time of day as minutes after midnight.

    >>> minute_of_day(datetime(2025, 3, 1, 19, 30))
    1170
    """
    return 60 * moment.hour + moment.minute


def ends_words(early: float, middle: float, late: float) -> Sentence:
    """Return when something ends, given times in minutes after midnight on the starting day.

    >>> ends_words(23 * 60, 24 * 60 + 15, 26 * 60)
    'It ends at about 00:15 the next day (8 nights in 10: 23:00 to 02:00).'
    """
    days = round(middle) // _DAY
    end: str = time_of_day(middle)
    if days == 1:
        end = say("{time} the next day", time=end)
    elif days > 1:
        end = say("{time} {days} days later", time=end, days=days)
    return say(
        "It ends at about {end} (8 nights in 10: {early} to {late}).",
        end=end,
        early=time_of_day(early),
        late=time_of_day(late),
    )


def finish_quantities(finishes: Floats, *more: Quantity) -> Quantities:
    """Return the finish times and their largest standard error, and more figures.

    >>> import numpy as np
    >>> [(one.name, round(one.value)) for one in finish_quantities(np.arange(101.0)).of]
    [('finish_p10', 10), ('finish_p50', 50), ('finish_p90', 90), ('finish_error', 5)]
    """
    bands, error = bands_of(finishes)
    times = [
        quantity_of("finish", at, quantile=f"p{100 * q:.0f}")
        for q, at in zip(QUANTILES, bands, strict=True)
    ]
    return Quantities([*times, *quantities_of({"finish_error": error}), *more])


def finish_luck(finishes: Floats) -> str:
    """Return how much different luck would move the finish times.

    >>> import numpy as np
    >>> finish_luck(np.arange(101.0))
    '101 evenings were simulated; the sampling error is at most about 10 min.'
    """
    _, error = bands_of(finishes)
    return say(
        "{n:,} evenings were simulated; the sampling error is at most about {minutes:.0f} min.",
        n=len(finishes),
        minutes=2.0 * error,
    )


def tournament_time_answer(
    tournament: Tournament,
    *,
    tables: int,
    pace: Pace | str,
    earlier: Sequence[EarlierNight] = (),
    turnover: Turnover | None = None,
    start: int | None = None,
    seed: int = 0,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return when a tournament ends and when each of its matches starts.

    `earlier` nights at this venue adjust a discipline's usual pace. The start is in minutes after
    midnight; None: times are counted from the start.

    >>> import numpy as np
    >>> from evenbreak.files.lists.roster import RosterFile
    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.tournaments import Races, double_elimination
    >>> club = Roster(["Ann", "Bo", "Cy", "Di"], [640, 600, 560, 520])
    >>> file = RosterFile(club, np.arange(2, 6), "club.csv", (), "")
    >>> asked = double_elimination(club.players), Races(5), SCALES["fargo"], "as listed"
    >>> tonight = Tournament(file, club, *asked)
    >>> answer = tournament_time_answer(tonight, tables=2, pace="9-ball", start=19 * 60)
    >>> print(answer.sentences[0].splitlines()[0])
    It ends at about 22:26 (8 nights in 10: 21:37 to 23:28).
    """
    asked: Any = {"pace": event_pace(pace, earlier), "turnover": turnover, "seed": seed}
    laws_now = tournament.laws
    found = finish(tournament.bracket, laws_now, tables=tables, **asked)
    show = clock if start is None else (lambda minutes: time_of_day(start + minutes))

    def ask(tables: int, races: Races) -> Finish:
        laws = laws_now if races is tournament.races else tournament.laws_of(races)
        return finish(tournament.bracket, laws, tables=tables, **asked)

    changes = what_if(found, ask, tournament.bracket, tables, tournament.races)
    saved = (quantity_of("minutes_saved", by, change=what) for what, by in savings(changes).items())
    quantities = finish_quantities(found.finishes, *saved)
    table = starts_table(found, show)
    when = _takes(found) if start is None else ends_words(*(start + at for at in found.bands))
    words = joined(filter(None, [when, savings_words(changes)]), "\n")
    parts: list[Part] = [words, quantities, table, changes]
    assumed = assumed_words(tables, pace, turnover)
    learned = venue_words(pace, earlier) if isinstance(pace, str) else ""
    unrated = tournament.unrated_words(spread=False)
    form_words = form_used_words(tournament.file.form, tournament.scale)
    lines = [tournament.byes, unrated, learned, assumed, form_words, finish_luck(found.finishes)]
    parts += filter(None, lines)
    return Answer(
        tournament.heading, parts, warnings=[*tournament.file.warnings, *warnings], csv=table
    )


def _takes(found: Finish) -> str:
    early, middle, late = map(clock, found.bands)
    return say(
        "It takes about {middle} (8 nights in 10: {early} to {late}).",
        middle=middle,
        early=early,
        late=late,
    )


def starts_table(
    found: Finish, show: Callable[[float], str], numbers: Mapping[str, int] | None = None
) -> Table:
    """Return when each remaining match starts, soonest first."""
    if numbers is None:
        numbers = match_numbers(found.standing.bracket)
    columns = columns_of(
        "match pair_12 start_p50 start_band p_played",
        show={
            "start_p50": show,
            "start_band": lambda band: (
                ""
                if band[0] == band[1]
                else say("{early} and {late}", early=show(band[0]), late=show(band[1]))
            ),
        },
    )
    rows: list[list[Any]] = []
    for name in found.names:
        players = pair_words(found.standing, name, numbers)
        early, middle, late, played = found.start(name)
        if played:  # some of a consolation event never are
            rows.append([numbers[name], players, middle, (early, late), played])
    rows.sort(key=lambda row: row[2])
    return Table("matches", columns, rows)


def venue_words(discipline: str, earlier: Iterable[EarlierNight]) -> Sentence | str:
    """Return how fast a discipline's nights were at a venue; '' if there were none.

    >>> nights = [EarlierNight(f"2025-03-0{k}T19:30:00", "9-ball", 1.1) for k in (1, 2)]
    >>> print(venue_words("9-ball", nights))
    Your last 2 nights of 9-ball at this venue ran 10% longer than usual; the times here are 5%
    longer than usual, because part of the difference may be chance.
    """
    nights = nights_of(discipline, earlier)
    if not nights:
        return ""
    ran = _against_usual(venue_ratio(nights, prior_nights=0.0))
    times = _against_usual(venue_ratio(nights))
    allowed = say(
        "the times here are {times}, because part of the difference may be chance", times=times
    )
    return say_count(
        "Your last night of {game} at this venue ran {longer}; {allowed}.",
        "Your last {n} nights of {game} at this venue ran {longer}; {allowed}.",
        len(nights),
        game=discipline,
        longer=ran,
        allowed=say("the times allow for it") if times == ran else allowed,
    )


def _against_usual(ratio: float) -> Sentence:
    if round(ratio, 2) == 1.0:
        return say("as long as usual")
    share = percent(round(abs(ratio - 1.0), 2))
    if ratio < 1.0:
        return say("{share} shorter than usual", share=share)
    return say("{share} longer than usual", share=share)


def assumed_words(tables: int, pace: Pace | str, turnover: Turnover | None) -> str:
    """Return what the times assume."""
    if isinstance(pace, str):
        of_games = say("Matches take as long as {game} matches do in real tournaments", game=pace)
    else:
        of_games = say("A game takes {minutes:g} minutes on average", minutes=pace.per_game)
    between = say("about {minutes} minutes", minutes=4)
    if turnover is not None:
        between = say("{minutes:g} minutes on average", minutes=turnover.mean)
    return say(
        "{games}. The times are for {tables}, with {between} between matches on the same table. "
        "As on most evenings, a round starts when the rounds that feed it are over, and the "
        "match with the most rounds still to follow goes first. Calling each match as soon as "
        "both players and a table are free saves some of this time.",
        games=of_games,
        tables=say_count("{n} table", "{n} tables", tables),
        between=between,
    )


WORTH_SAYING = 10.0
"""How many minutes must be saved to be worth a sentence."""

CHANGES = {
    "one_more_table": say("one more table"),
    "one_table_fewer": say("one fewer table"),
    "races_one_shorter": say("all races one game shorter"),
    "losers_races_one_shorter": say("the losers' side one game shorter"),
}


def what_if(
    found: Finish,
    ask: Callable[[int, Races], Finish],
    bracket: Bracket,
    tables: int,
    races: Races,
    *,
    taken: int = 0,
) -> Table:
    """Return how much other tables or races move the finish; tables in use can't be removed."""
    changes = {"one_more_table": (tables + 1, races)}
    if tables > max(1, taken):
        changes["one_table_fewer"] = tables - 1, races
    if (fewer := shorter(races)) is not None:
        changes["races_one_shorter"] = tables, fewer
    losers = _one_less(races.race if races.losers is None else races.losers)
    if losers is not None and any(match.side == "losers" for match in bracket.matches):
        changes["losers_races_one_shorter"] = tables, replace(races, losers=losers)
    rows = []
    for key, change in changes.items():
        later, error = minutes_later(ask(*change), found)
        rows.append([key, say("With {change}", change=CHANGES[key]), later, error])
    columns = columns_of("-change in_words minutes_later minutes_later_error")
    return Table("what_if", columns, rows, title=say("What if"))


def savings(changes: Table) -> dict[str, float]:
    """Return how many minutes sooner one more table and shorter races would finish."""
    found = {row[0]: -row[2] for row in changes.rows}
    return {key: found[key] for key in ("one_more_table", "races_one_shorter") if key in found}


def savings_words(changes: Table) -> str:
    """Return the changes that are worth making, in words; '' if none are."""
    return joined(
        earlier_words(key, saved)
        for key, saved in savings(changes).items()
        if saved >= WORTH_SAYING
    )


def earlier_words(change: str, minutes: float) -> Sentence:
    """Return how much sooner a change would finish."""
    return say(
        "With {change} it would end {time} earlier.", change=CHANGES[change], time=clock(minutes)
    )


def shorter(races: Races) -> Races | None:
    """Return all races shortened by one game; None if a chart sets them or one is too short."""
    found = [_one_less(race) for race in (races.race, races.losers, races.final)]
    given = [race for race in (races.race, races.losers, races.final) if race is not None]
    if found.count(None) > 3 - len(given) or found[0] is None:
        return None
    return replace(races, race=found[0], losers=found[1], final=found[2])


def _one_less(race: Race | None) -> Race | None:
    match race:
        case Fairest(race_to=games) if games > 1:
            return Fairest(games - 1)
        case int() if race > 1:
            return race - 1
    return None
