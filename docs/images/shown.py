"""The pictures of the gallery: what each shows, and the command or the Python that makes it.

A command is run as it stands here, with FILE for the picture's name; Python is run as it stands,
and leaves its picture in `picture`.
"""

from typing import NamedTuple

NIGHT = """\
tournament new data/demo_roster.csv --race 5 --losers-race 4 --tables 2 --at 18:50
tournament draw --at 19:00
tournament call --at 19:02
tournament result 3 5-3 --at 19:40
"""

LATER = """\
tournament result 1 5-2 --at 19:45
tournament result 2 4-5 --at 20:20
tournament result 4 5-4 --at 20:30
tournament result 7 4-1 --at 21:05
tournament result 5 5-3 --at 21:10
tournament result 8 2-4 --at 21:20
tournament call --at 21:21
"""
"""The night goes on, after the essentials' first result."""

END = """\
tournament result 6 5-4 --at 22:00
tournament result 10 4-3 --at 22:05
tournament result 9 4-2 --at 22:40
tournament result 11 3-5 --at 22:55
tournament result 12 4-1 --at 23:15
tournament result 13 4-3 --at 23:40
tournament result 14 5-4 --at 00:20
"""


class Shown(NamedTuple):
    """A picture of the gallery.

    Parameters
    ----------
    name
        the file as it is written; its last part is the picture's name beside this module.
    title, says, page
        the words below it, and the page of docs about it.
    command, python
        what makes it: one of the two.
    draws
        the functions of evenbreak.plots that draw it.
    first
        commands to run before, one per line.
    then
        commands to run after those, which the page does not show.
    wide
        whether its card is as wide as the page.
    """

    name: str
    title: str
    says: str
    page: str
    command: str = ""
    python: str = ""
    draws: str = ""
    first: str = ""
    then: str = ""
    wide: bool = False


SHOWN: dict[str, tuple[Shown, ...]] = {
    "Tonight": (
        Shown(
            "bracket.svg",
            "The bracket, live",
            "Results, tables, and where losers go.",
            "how-to/run-an-evening.md",
            "tournament show --at 21:30 --title 'Tuesday 9-Ball' --out FILE",
            first=NIGHT + LATER,
            wide=True,
        ),
        Shown(
            "story.svg",
            "The odds through a night",
            "Who will win, after every match.",
            "how-to/run-an-evening.md",
            "tournament export --story --out FILE",
            then=END,
            wide=True,
        ),
        Shown(
            "sheet.png",
            "The sheet for the wall",
            "The fairest race for each pair, and everyone's rating.",
            "tutorial/first-evening.md",
            wide=True,
            python="""\
from evenbreak.answers import OfferedRaces, Sheet, most_active
from evenbreak.files import read_results
from evenbreak.ratings import scale_of, usual_ratings
from evenbreak.sheets import sheet_pages

file = read_results("data/demo_league.csv")
ratings, choice = usual_ratings(file.results, scale=scale_of("npl"))
offered = OfferedRaces(race_to=7)
sheet = Sheet.of(file, ratings, offered, most_active(ratings, 10), choice)
(picture,) = sheet_pages(sheet)
""",
        ),
    ),
    "Matches": (
        Shown(
            "second_chance.svg",
            "What a second chance is worth",
            "A favorite's title odds in single and in double elimination.",
            "explanation/brackets.md#exact-odds-in-brackets",
            python="""\
import numpy as np
from evenbreak.plots.picture import LINES, new_axes
from evenbreak.tournaments import double_elimination, single_elimination, title_odds

picture = new_axes("chance of winning a match", "chance of winning the tournament")
chances = np.linspace(0.5, 1.0, 26)
for players, line in ((8, LINES[0]), (16, LINES[1])):
    win = np.full((players, players), 0.5)
    for make, dashes in ((double_elimination, "-"), (single_elimination, "--")):
        title = []
        for p in chances:
            win[0, 1:], win[1:, 0] = p, 1.0 - p
            title.append(title_odds(make(players), win).title[0])
        name = f"{make.__name__.replace('_', ' ')} of {players}"
        picture.plot(chances, title, dashes, color=line.color, label=name)
picture.legend(fontsize=9)
""",
        ),
        Shown(
            "live.svg",
            "A match in progress",
            "A's chance after each game, and how much each one mattered.",
            "how-to/during-a-match.md",
            "live --p 0.6 --race 7:5 --racks abbababaab --plot FILE",
            draws="course_figure",
        ),
        Shown(
            "formats.svg",
            "Match formats side by side",
            "Who each format helps, and where two are equal.",
            "how-to/match-formats.md",
            'compare --p 0.6667 9:5 "3:1 of 3:3" "ahead 5:3" --plot FILE',
            draws="draw_formats",
        ),
        Shown(
            "breaks.svg",
            "Break formats",
            "How many racks each player wins in the long run.",
            "how-to/match-formats.md#which-break-format-is-better-for-you",
            "breaks --p1 0.9 --p2 0.5 --win 1 --lose 2 --plot FILE",
            draws="breaks_figure",
        ),
    ),
    "Handicaps": (
        Shown(
            "chart.svg",
            "A chart, audited",
            "The stronger player's chance, next to another chart.",
            "how-to/a-fair-chart.md",
            "chart audit data/house_chart.csv --scale npl --beside npl_10 --plot FILE",
            draws="draw_chart",
        ),
        Shown(
            "ladder.svg",
            "How far off ratings stay",
            "The long-run error of ratings, and how newcomers settle.",
            "how-to/how-wrong-are-our-ratings.md",
            "ladder --chart npl_10 --equal-skill --newcomer --plot FILE",
            draws="ladder_figure",
        ),
        Shown(
            "systems.svg",
            "Accurate or quick",
            "Rating errors and settling times of several systems.",
            "how-to/how-wrong-are-our-ratings.md",
            "ladder --compare --plot FILE",
            draws="draw_systems",
        ),
        Shown(
            "pay.svg",
            "What losing on purpose gains",
            "Chances in the matches that count, after dumping some.",
            "how-to/sandbagging.md",
            "sandbag pay --chart npl_12 --stake 50 --dumped-stake 5 --plot FILE",
            draws="draw_pay",
        ),
        Shown(
            "watch.svg",
            "A watch for sandbagging",
            "The evidence against each player, match by match.",
            "how-to/sandbagging.md",
            "sandbag watch data/demo_sandbag.csv --roster data/demo_sandbag_roster.csv --plot FILE",
            draws="draw_watch",
        ),
    ),
    "Leagues": (
        Shown(
            "calibration.svg",
            "Can the ratings be trusted?",
            "How often favorites won, and how often that was predicted.",
            "how-to/can-i-trust-the-ratings.md",
            "validate data/demo_league.csv --prior 30 --plot FILE",
            draws="draw_calibration",
        ),
        Shown(
            "season/errors_by_week.svg",
            "A season: the ratings",
            "How far off they are, week by week.",
            "how-to/simulate-a-season.md",
            "simulate data/demo_league_roster.csv --chart npl_10 --weeks 30 --replicas 100 "
            "--no-matches --jobs 1 --out season",
            draws="draw_errors",
        ),
        Shown(
            "season/wins_by_gap.svg",
            "A season: the handicaps",
            "How often the stronger player wins, by the gap in skill.",
            "how-to/simulate-a-season.md",
            "simulate data/demo_league_roster.csv --chart npl_10 --weeks 30 --replicas 100 "
            "--no-matches --jobs 1 --out season",
            draws="draw_gaps",
        ),
        Shown(
            "compared/even_by_decile.svg",
            "Handicap systems side by side: even matches",
            "Who gets even matches, weakest to strongest.",
            "how-to/compare-handicap-systems.md",
            "simulate data/demo_league_roster.csv --compare npl --compare 'step 2' --replicas 100 "
            "--jobs 1 --out compared",
            draws="draw_even",
        ),
        Shown(
            "compared/errors_by_night.svg",
            "Handicap systems side by side: ratings",
            "How far off each system's ratings are, night by night.",
            "how-to/compare-handicap-systems.md",
            "simulate data/demo_league_roster.csv --compare npl --compare 'step 2' --replicas 100 "
            "--jobs 1 --out compared",
            draws="draw_errors_compared",
        ),
        Shown(
            "season/standings.svg",
            "A season: the table",
            "How many matches each player wins.",
            "how-to/simulate-a-season.md",
            "simulate data/demo_league_roster.csv --chart npl_10 --weeks 30 --replicas 100 "
            "--no-matches --jobs 1 --out season",
            draws="draw_standings",
        ),
    ),
    "Practice and the table": (
        Shown(
            "shot.svg",
            "A shot, traced",
            "Where both balls go, allowing for throw.",
            "how-to/shots.md#draw-a-shot",
            "physics shot --cue-ball 30,15 --object-ball 50,15 --pocket foot-right --speed 80 "
            "--offset -0.4 --plot FILE",
            draws="shot_on_table",
        ),
        Shown(
            "shots.svg",
            "Which shot to take",
            "Your chance on the last ball, for each shot you could try.",
            "how-to/shots.md",
            "oneball --shot 0.4:0.8 --shot 0.3:0.3 --shot 0.6:0.9 --plot FILE",
            draws="draw_shots",
        ),
        Shown(
            "log.svg",
            "A drill, logged",
            "How often each level was tried, compared with the long run.",
            "tutorial/read-your-practice.md",
            "drill --log data/drill_log.csv --plot FILE",
            draws="draw_log",
        ),
        Shown(
            "long_run.svg",
            "A drill in the long run",
            "Where a player who makes 4 shots in 5 ends up.",
            "tutorial/read-your-practice.md",
            "drill --p 0.8 --plot FILE",
            draws="draw_drill",
        ),
        Shown(
            "scores.svg",
            "Was it luck?",
            "Practice scores over time, their mean, and one new score.",
            "how-to/did-my-practice-help.md",
            "practice data/practice_scores.csv --new 53 --plot FILE",
            draws="draw_scores",
        ),
        Shown(
            "two_lists.svg",
            "Did it help?",
            "Scores before and after, with the two means.",
            "how-to/did-my-practice-help.md",
            "practice data/practice_scores.csv --versus data/practice_scores_after.csv --plot FILE",
            draws="draw_two_lists",
        ),
        Shown(
            "practice_shots.svg",
            "Which shots went in",
            "Single shots by day.",
            "how-to/did-my-practice-help.md",
            "practice data/practice_shots.csv --plot FILE",
            draws="draw_practice_shots",
        ),
        Shown(
            "runs.svg",
            "How long the runs are",
            "The score of several innings, with a range shaded.",
            "how-to/did-my-practice-help.md#runs-bets-and-straight-pool",
            "runs --mean 24 --innings 5 --between 100..150 --plot FILE",
            draws="draw_score",
        ),
        Shown(
            "spot.svg",
            "A spot in straight pool",
            "A's chance for each spot.",
            "how-to/did-my-practice-help.md#runs-bets-and-straight-pool",
            "straight --averages 24:19 --points 150 --plot FILE",
            draws="draw_spot",
        ),
    ),
    "Games as graphs": (
        Shown(
            "one_ball.svg",
            "One ball left",
            "A game is a directed graph; its arcs carry probabilities.",
            "how-to/your-own-chain.md#draw-a-game",
            python="""\
from evenbreak.games import OneBall
from evenbreak.plots import draw

picture = draw(OneBall(0.4, 0.8))
""",
            draws="draw",
        ),
        Shown(
            "race.svg",
            "A race",
            "Every score, from 0-0 to the end.",
            "how-to/your-own-chain.md#draw-a-game",
            python="""\
from evenbreak.games import Race, Rack
from evenbreak.plots import draw

picture = draw(Race(3, 2, Rack(0.6)), title="Race 3:2")
""",
            draws="draw",
        ),
        Shown(
            "ahead.svg",
            "Ahead by some games",
            "A chain with no last game.",
            "how-to/your-own-chain.md#draw-a-game",
            python="""\
from evenbreak.games import Ahead, Rack
from evenbreak.plots import draw

title = "Player 1 must lead by 3, player 2 by 2"
picture = draw(Ahead(3, 2, Rack(2 / 3)), title=title)
""",
            draws="draw",
        ),
        Shown(
            "drill.svg",
            "A graph of your own",
            "Any networkx graph, here a drill.",
            "how-to/your-own-chain.md#draw-a-game",
            python="""\
import networkx as nx
from evenbreak.plots import draw

graph = nx.DiGraph()
for i in range(1, 5):
    graph.add_edge(i, min(i + 1, 4), label=f"$p_{i}$")
    graph.add_edge(i, max(i - 1, 1), label=f"$q_{i}$")
picture = draw(graph)
""",
            draws="draw",
        ),
    ),
}
