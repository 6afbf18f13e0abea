"""Two made-up offices and their files as they export them: a league by levels, one by Fargo."""

import random
from datetime import date, timedelta
from pathlib import Path

TEAMS = ["Chalk Dust", "Bank Shots", "Rack Attack", "Cue Tips"]
GIVEN = (
    *("Ann", "Bea", "Cy", "Di", "Ed", "Fay", "Gus", "Hal", "Ida", "Jo"),
    *("Ken", "Lou", "Max", "Nan", "Otto", "Pia", "Quin", "Ray", "Sam", "Tess"),
)
FAMILY = (
    *("Adams", "Baker", "Cole", "Diaz", "Evans", "Frost"),
    *("Green", "Hill", "Irwin", "Jones", "King", "Lopez"),
)
APA = {  # levels of the higher and the lower player: the games that each needs
    (2, 2): "22", (3, 2): "32", (3, 3): "22", (4, 2): "42", (4, 3): "32", (4, 4): "33",
    (5, 2): "52", (5, 3): "42", (5, 4): "43", (5, 5): "44", (6, 2): "62", (6, 3): "52",
    (6, 4): "53", (6, 5): "54", (6, 6): "55", (7, 2): "72", (7, 3): "62", (7, 4): "52",
    (7, 5): "53", (7, 6): "54", (7, 7): "55",
}  # fmt: skip


def apa_race(a: int, b: int) -> tuple[int, int]:
    """Return what the two players need."""
    high, low = map(int, APA[max(a, b), min(a, b)])
    return (high, low) if a >= b else (low, high)


def apa_office(folder: Path) -> list[tuple[str, str, int, int, str, str, int, int]]:
    """Write the files of a league by levels, and return its sets: team, player, level, wins.

    Half-way one player's level goes up, as the score sheets alone say.
    """
    draw = random.Random(11)
    names = [
        f"{family}, {given}" for family, given in zip(FAMILY * 2, (GIVEN * 2)[:24], strict=True)
    ]
    levels = [7, 6, 5, 4, 3, 2, 6, 5, 4, 4, 3, 2, 7, 5, 5, 3, 3, 2, 6, 6, 4, 4, 3, 2]
    level = dict(zip(names, levels, strict=True))
    squads = {team: names[6 * k : 6 * k + 6] for k, team in enumerate(TEAMS)}
    riser = squads["Cue Tips"][2]
    sets, sheet, fixtures = [], [], []
    for week in range(1, 10):
        day = (date(2026, 9, 1) + timedelta(7 * (week - 1))).strftime("%m/%d/%Y")
        k = (week - 1) % 3
        pairs = [((0, 1), (2, 3)), ((0, 2), (1, 3)), ((0, 3), (1, 2))][k]
        fixtures += [f"{week},{day},{TEAMS[a]},{TEAMS[b]}" for a, b in pairs]
        if week > 8:
            continue
        level[riser] = 4 if week < 5 else 5
        for a, b in pairs:
            ours, theirs = (draw.sample(squads[TEAMS[side]], 5) for side in (a, b))
            for one, other in zip(ours, theirs, strict=True):
                m, n = apa_race(level[one], level[other])
                chance = 1 / (1 + 2 ** ((level[other] - level[one]) * 0.9))
                won = [0, 0]
                while won[0] < m and won[1] < n:
                    won[draw.random() > chance] += 1
                row = (TEAMS[a], one, level[one], won[0], TEAMS[b], other, level[other], won[1])
                sets.append(row)
                cells = [day, len(sets), *row, draw.randint(5, 40), draw.randint(0, 6)]
                cells[3], cells[7] = f'"{one}"', f'"{other}"'
                sheet.append(",".join(map(str, cells)))
    title = "Date,Match,Home Team,Home Player,SL,Wins,Away Team,Away Player,SL,Wins"
    _write(folder / "scores fall.csv", f"{title},Innings,Defensive Shots", sheet)
    _write(folder / "schedule.csv", "Week,Date,Home,Away", fixtures)
    players = [f'{t},7{k:04},"{p}",{level[p]}' for t in TEAMS for k, p in enumerate(squads[t])]
    _write(folder / "roster.csv", "Team,Member Number,Player,SL", players)
    return sets


def fargo_office(folder: Path, *, teams: bool = False) -> list[tuple[str, int, str, int]]:
    """Write the files of a Fargo league, and return its matches: player and games of each.

    The last round of the first file is the first of the second too; one match there was won by
    default, and nothing says by whom.
    """
    draw = random.Random(5)
    names = [f"{GIVEN[k]} {FAMILY[(5 * k) % 12]}" for k in range(16)]
    rating = {name: round(draw.gauss(500, 80)) for name in names}
    rows, played = {}, []
    for week in range(1, 13):
        order = draw.sample(names, 16)
        for one, other in zip(order[::2], order[1::2], strict=True):
            m, n = fairest(rating[one], rating[other], 6)
            chance = 1 / (1 + 2 ** ((rating[other] - rating[one]) / 100))
            won = [0, 0]
            while won[0] < m and won[1] < n:
                won[draw.random() > chance] += 1
            rows.setdefault(week, []).append((one, m, won[0], other, n, won[1]))
    first, second = [], []
    for week, matches in rows.items():
        day = date(2026, 8, 25) + timedelta(7 * week)
        for k, (one, m, a, other, n, b) in enumerate(matches):
            default = week == 10 and k == 0
            score = "kampflos" if default else f"{a}:{b}"
            if week <= 7:
                first.append(f"{week},{day},{one},{m},{a},{other},{n},{b},")
            if week >= 7:
                second.append(f"{day:%d.%m.%Y};{week};{one};{other};{score};{m};{n}")
            if not default:
                played.append((one, a, other, b))
    title = "Round,Date,Player 1,Race,Games Won,Player 2,Race,Games Won,Status"
    _write(folder / "lms weeks 1-7.csv", title, first)
    german = "Datum;Spieltag;Heim;Gast;Ergebnis;Distanz Heim;Distanz Gast"
    _write(folder / "cuescore weeks 7-12.csv", german, second)
    listed = []
    for k, name in enumerate(names):
        given, family = name.split()
        new = k % 7 == 3
        stated = (
            f"0,{rating[name]},150,{rating[name]}"
            if new
            else f"{rating[name]},{rating[name]},{600 + k},"
        )
        team = f",{TEAMS[k % 4]}" if teams else ""
        listed.append(f"10{k:04},,{given},{family},Boise ID,{stated}{team}")
    head = "readableId,membershipId,firstName,lastName,location,rating,effectiveRating,robustness"
    _write(folder / "players.csv", f"{head},provisionalRating{',Team' * teams}", listed)
    return played


def fairest(a: int, b: int, race_to: int) -> tuple[int, int]:
    """Return the most even race in which the stronger player needs so many games, by hand."""
    p = 1 / (1 + 2 ** (-abs(a - b) / 100))
    n = min(range(1, race_to + 1), key=lambda n: abs(win(p, race_to, n) - 0.5))
    return (race_to, n) if a >= b else (n, race_to)


def win(p: float, m: int, n: int) -> float:
    """Return the chance to win m games before the other has won n, game by game."""
    if not m or not n:
        return float(m == 0)
    return p * win(p, m - 1, n) + (1 - p) * win(p, m, n - 1)


def _write(path: Path, title: str, rows: list[str]) -> None:
    path.write_text("\n".join([title, *rows, ""]), encoding="utf-8")
