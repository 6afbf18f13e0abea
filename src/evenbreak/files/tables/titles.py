"""Column titles used by leagues in six languages, and words for unplayed matches.

They are declared only here, for readers, suggested columns and the reference. No title is a single
letter, because letters mean different things in different languages: G means won in French and
drawn in Dutch.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Collection, Iterator, Mapping
from functools import cache, lru_cache

from evenbreak.ratings.results_frame import FORFEITS

LANGUAGES = {
    "en": "English",
    "de": "German",
    "fr": "French",
    "es": "Spanish",
    "nl": "Dutch",
    "pl": "Polish",
}

_Words = Mapping[str, str]

SIDES: Mapping[str, tuple[str, str]] = {
    "en": ("home", "away, visitor, visitors, guest"),
    "de": ("Heim", "Gast, Gäste, Auswärts"),
    "fr": ("domicile, recevant", "extérieur, visiteur, visiteurs"),
    "es": ("local", "visitante"),
    "nl": ("thuis", "uit, gast, gasten"),
    "pl": ("gospodarz, gospodarze", "gość, goście"),
}
"""The two sides of a match; alone, these mean the players, or the teams if players have titles."""

_PLAYER: _Words = {
    "en": "player, name, player name",
    "de": "Spieler, Spielerin, Name, Spielername",
    "fr": "joueur, joueuse, nom, nom du joueur",
    "es": "jugador, jugadora, nombre",
    "nl": "speler, speelster, naam",
    "pl": "zawodnik, zawodniczka, gracz, nazwisko, imię i nazwisko",
}
_GAMES: _Words = {
    "en": "score, games, frames, racks, games won, frames won, racks won",
    "de": "Spiele, Partien, Frames, Racks, Ergebnis, Spielstand, gewonnene Spiele",
    "fr": "parties, manches, frames, score, parties gagnées, manches gagnées",
    "es": "partidas, marcador, partidas ganadas",
    "nl": "partijen, frames, racks, gewonnen partijen",
    "pl": "frame'y, wynik, wygrane partie",
}
_RACE: _Words = {
    "en": "race, race to, needs, gtw, games to win",
    "de": "Ausspielziel, Gewinnspiele, Distanz",
    "fr": "distance, parties gagnantes",
    "es": "distancia",
    "nl": "racelengte, afstand",
    "pl": "dystans, do wygranych",
}
TEAM_WORDS: _Words = {
    "en": "team, club",
    "de": "Mannschaft, Team, Verein",
    "fr": "équipe, club",
    "es": "equipo, club",
    "nl": "team, ploeg, club",
    "pl": "drużyna, zespół, klub",
}
_LEVEL: _Words = {
    "en": "level, skill level, sl, hcp, class, rating",
    "de": "Stufe, Spielstärke",
    "fr": "niveau",
    "es": "nivel, categoría",
    "nl": "niveau",
    "pl": "poziom, kategoria",
}

SIDED: Mapping[str, _Words] = {
    "player": _PLAYER,
    "score": _GAMES,
    "race": _RACE,
    "team": TEAM_WORDS,
    "level": _LEVEL,
}
"""What a column of one side holds: `player` of player_a, `score` of score_a or home_score."""

_ROUND: _Words = {
    "en": "round, week, matchday",
    "de": "Spieltag, Runde, Woche",
    "fr": "journée, tour, semaine",
    "es": "jornada, ronda, semana",
    "nl": "ronde, speelronde, speeldag, week",
    "pl": "kolejka, runda, tydzień",
}

WHOLE: Mapping[str, _Words] = {
    "date": {
        "de": "Datum, Spieldatum, Termin",
        "fr": "date, date du match",
        "es": "fecha",
        "nl": "datum, speeldatum",
        "pl": "data, termin",
    },
    "score": {
        "de": "Ergebnis, Spielstand, Resultat",
        "fr": "score, résultat",
        "es": "resultado, marcador",
        "nl": "uitslag, score",
        "pl": "wynik",
    },
    "race": _RACE,
    "winner": {
        "de": "Sieger, Gewinner",
        "fr": "vainqueur, gagnant",
        "es": "ganador, ganadora",
        "nl": "winnaar",
        "pl": "zwycięzca",
    },
    "loser": {
        "de": "Verlierer",
        "fr": "perdant",
        "es": "perdedor, perdedora",
        "nl": "verliezer",
        "pl": "przegrany",
    },
    "event": {
        "de": "Turnier, Wettbewerb",
        "fr": "tournoi, compétition",
        "es": "torneo, competición",
        "nl": "toernooi, competitie",
        "pl": "turniej, zawody",
    },
    "division": {
        "de": "Liga, Staffel, Klasse, Gruppe",
        "fr": "division, poule",
        "es": "división, grupo",
        "nl": "klasse, divisie, poule",
        "pl": "liga, grupa",
    },
    "round": _ROUND,
    "week": _ROUND,
    "player": _PLAYER,
    "given_name": {
        "en": "first name, given name, forename",
        "de": "Vorname",
        "fr": "prénom",
        "es": "nombre de pila",
        "nl": "voornaam",
        "pl": "imię",
    },
    "surname": {
        "en": "last name, surname, family name",
        "de": "Nachname, Familienname, Zuname",
        "fr": "nom de famille",
        "es": "apellido, apellidos",
        "nl": "achternaam",
    },
    "team": TEAM_WORDS,
    "rating": {
        "de": "Wertung, Wertungszahl, Elo, Rating, Punkte",
        "fr": "cote, Elo, points",
        "es": "puntuación, Elo, puntos",
        "nl": "rating, Elo, punten",
        "pl": "rating, Elo, punkty, pkt",
    },
    "level": {**_LEVEL, "en": "skill level, sl"},
    "forfeit": {
        "de": "kampflos",
        "fr": "forfait",
        "es": "incomparecencia",
        "nl": "reglementair, niet opgekomen",
        "pl": "walkower",
    },
    "status": {
        "en": "status, match status, state",
        "de": "Status",
        "fr": "statut, état",
        "es": "estado",
        "nl": "status",
        "pl": "status, stan",
    },
    "remark": {
        "en": "remark, remarks, note, notes, comment, comments",
        "de": "Bemerkung, Bemerkungen, Anmerkung, Anmerkungen",
        "fr": "remarque, remarques, observation, observations",
        "es": "observación, observaciones, nota, notas",
        "nl": "opmerking, opmerkingen",
        "pl": "uwagi, uwaga",
    },
}

"""Other columns' titles besides their English names."""

BYES: Mapping[str, str] = {
    "en": "bye",
    "de": "spielfrei, Freilos",
    "fr": "exempt",
    "es": "descansa, exento",
    "nl": "vrij",
    "pl": "pauza, wolny los",
}
"""What is written in place of an opponent, or of a score, for a bye."""

NOT_YET: Mapping[str, str] = {
    "en": "scheduled, postponed, cancelled, canceled, not played, unplayed, pending, upcoming, "
    "in progress",
    "de": "verlegt, abgesagt, nicht gespielt, offen, geplant",
    "fr": "reporté, annulé, non joué, à jouer",
    "es": "aplazado, suspendido, no jugado, pendiente",
    "nl": "uitgesteld, afgelast, niet gespeeld, gepland",
    "pl": "przełożony, odwołany, nierozegrany, zaplanowany",
}
"""Statuses of a match that hasn't been played."""

PLAYED: Mapping[str, str] = {
    "en": "played, complete, completed, final, finished, done, closed, ok, confirmed, approved",
    "de": "gespielt, beendet, abgeschlossen, bestätigt",
    "fr": "joué, terminé, validé",
    "es": "jugado, finalizado, terminado, confirmado",
    "nl": "gespeeld, afgelopen, bevestigd",
    "pl": "rozegrany, zakończony, potwierdzony",
}
"""Statuses of a match that has been played."""


OTHER_COUNTS: Mapping[str, str] = {
    "en": "innings, total innings, defensive shots, defenses, defence, safeties, timeouts, fouls, "
    "break and runs, breaks and runs, high run, points available, match, match number, table",
    "de": "Aufnahmen, Sicherheiten, Höchstserie, Tisch, Begegnung",
    "fr": "reprises, sécurités, meilleure série, table, rencontre",
    "es": "entradas, defensas, serie mayor, mesa, encuentro",
    "nl": "beurten, hoogste serie, tafel, wedstrijd",
    "pl": "podejścia, odstawne, stół, mecz",
}
"""Numbers about a match that are never games won."""


@lru_cache(1 << 14)
def key_of(text: str) -> str:
    """Return a title or word in the form used for comparing: letters and digits, in one case.

    >>> key_of("Extérieur") == key_of("exterieur"), key_of("W/O"), key_of("Gość")
    (True, 'wo', 'gosc')
    """
    text = text.casefold()
    if not text.isascii():
        plain = unicodedata.normalize("NFKD", text.replace("ł", "l"))
        text = "".join(letter for letter in plain if not unicodedata.combining(letter))
    return "".join(letter for letter in text if letter.isalnum())


def words_of(*declared: Mapping[str, str]) -> frozenset[str]:
    """Return the keys of all words in some declarations.

    >>> sorted(words_of({"de": "spielfrei, Freilos", "en": "bye"}))
    ['bye', 'freilos', 'spielfrei']
    """
    return frozenset(
        key_of(word) for words in declared for text in words.values() for word in text.split(", ")
    )


FORFEIT, BYE = words_of(FORFEITS), words_of(BYES)
PLAYERS = words_of(_PLAYER)
NOT_GAMES = words_of(OTHER_COUNTS)
UNPLAYED, WAS_PLAYED = words_of(NOT_YET), words_of(PLAYED)


@cache
def titles_of(column: str) -> Mapping[str, tuple[str, ...]]:
    """Return a column's titles besides its English names, by language.

    The title of a one-sided column, such as `player_a` or `home_score`, names the side and the
    content, in either order; for a player or a team, the side alone is enough.

    >>> titles_of("player_a")["de"][:3], titles_of("race")["pl"]
    (('Heim', 'Spieler Heim', 'Heim Spieler'), ('dystans', 'do wygranych'))
    """
    sided = _side_of(column)
    if sided is None:
        return {lang: tuple(words.split(", ")) for lang, words in WHOLE.get(column, {}).items()}
    what, side = sided
    return {lang: tuple(dict.fromkeys(_with_side(what, side, lang))) for lang in LANGUAGES}


def _side_of(column: str) -> tuple[str, int] | None:
    """Return what a one-sided column holds, and for which side: 0 or 1."""
    if column in ("home", "away"):
        return "team", int(column == "away")
    if column in ("home_score", "away_score"):
        return "score", int(column == "away_score")
    what, _, side = column.rpartition("_")
    return (what, "ab".index(side)) if side in ("a", "b") and what in SIDED else None


def _with_side(what: str, side: int, lang: str) -> Iterator[str]:
    sides = SIDES[lang][side].split(", ")
    if what in ("player", "team"):
        yield from sides
    for word in SIDED[what].get(lang, "").split(", "):
        for mark in (*sides, "AB"[side], "12"[side]):
            yield f"{word} {mark}"
            yield f"{mark} {word}"


@cache
def keys_of(column: str) -> tuple[str, ...]:
    """Return the keys of all titles for a column, by language."""
    titles = titles_of(column)
    return tuple(dict.fromkeys(key_of(title) for lang in titles for title in titles[lang]))


@cache
def marks() -> Collection[tuple[str, str]]:
    """Return the keys that tell two similar titles apart: the first side's and the second's.

    Single letters count only in pairs: H and G are Heim and Gast, T and U are thuis and uit.
    """
    pairs = {tuple(pair) for pair in ("ab", "12", "hg", "ha", "hv", "rv", "de", "lv", "tu")}
    for first, other in SIDES.values():
        pairs |= {
            (key_of(one), key_of(two)) for one in first.split(", ") for two in other.split(", ")
        }
    return frozenset((one, two) for one, two in pairs)
