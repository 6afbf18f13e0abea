"""Who plays: two ratings, two names on a list, a chance in a game, or one for each breaker."""

import math
from dataclasses import replace

import click

from evenbreak.answers.match.two_players import FORMATS, TwoPlayers
from evenbreak.cli.kit import completion
from evenbreak.cli.kit.options import SAY_WHICH, Command, scale_option, with_options
from evenbreak.cli.kit.values import CHANCE, number_of, refuse
from evenbreak.games.rack import Rack
from evenbreak.ratings.scale import Scale, unstated_scale

REMEDY = "give two ratings A B, or two names with --from, or --p, or --p1 and --p2 with --breaks"


def players_of(
    ratings: tuple[str, ...],
    scale: Scale | None,
    p: float | None,
    p1: float | None,
    p2: float | None,
    breaks: str | None,
    first_break: str | None,
    from_file: str | None = None,
    form: float | None = None,
) -> TwoPlayers:
    """Return the players that the options describe, or refuse options that contradict."""
    by_break = p1 is not None or p2 is not None
    ways = bool(ratings) + (p is not None) + by_break
    if ways != 1:
        refuse(("the players are given twice; " if ways else "the players are missing; ") + REMEDY)
    if from_file is not None and not ratings:
        refuse("--from is for two players by name, but none are named; leave it out")
    if scale is not None and not ratings:
        refuse("--scale is for ratings, but none are given; leave it out")
    if by_break:
        if p1 is None or p2 is None or breaks is None:
            refuse("--p1, --p2 and --breaks go together; give all three")
        first = first_break or ("b" if breaks == "b" else "a")
        return TwoPlayers(Rack(p1, p2), breaks, 1 if first == "a" else 2, form=form or 0.0)
    if breaks is not None or first_break is not None:
        refuse("the break matters only with --p1 and --p2; leave --breaks and --first-break out")
    if p is not None:
        return TwoPlayers(Rack(p), form=form or 0.0)
    if from_file is not None:
        return _named(ratings, from_file, scale, form)
    if len(ratings) != 2:
        given = "only one rating is" if len(ratings) == 1 else f"{len(ratings)} ratings are"
        refuse(f"{given} given, {' '.join(ratings)}; {REMEDY}")
    a, b = map(number_of, ratings)
    if not math.isfinite(a - b):
        refuse("the ratings are too far apart to calculate with; give smaller numbers")
    scale = scale or unstated_scale([a, b], ["A", "B"], SAY_WHICH)
    return replace(TwoPlayers.rated(a, b, scale), form=form or 0.0)


def _named(
    names: tuple[str, ...], path: str, scale: Scale | None, form: float | None
) -> TwoPlayers:
    """Return two players of a list, with its ratings, scale, errors and form of the day."""
    from evenbreak.answers.league.players import find_players, games_words
    from evenbreak.answers.league.roster_matchups import cannot_be_compared
    from evenbreak.cli.kit.systems import refuse_levels, refuse_other_scale
    from evenbreak.cli.kit.terminal import say
    from evenbreak.files.lists.roster import read_roster
    from evenbreak.ratings.roster import NOT_STATED, Roster

    if len(names) != 2:
        refuse(f"--from needs two players, and {len(names)} are named; quote a name with blanks")
    file = read_roster(path)
    if scale is not None:
        refuse_other_scale(
            file, scale, "--scale", "leave --scale out, or correct the file", stated=True
        )
    elif file.scale is None:
        refuse_levels(file, "say with --scale how many levels double the odds")
    points = file.scale_by(scale, SAY_WHICH)
    roster = file.roster.with_starters(points.centre, points.points_per_doubling, points)
    places = find_players(roster, names, said="--from", where=file.source)
    if len(places) < 2:
        refuse(f"{names[0]!r} and {names[1]!r} are one player; name two")
    for place in places:
        if math.isnan(file.roster.rating[place]):
            refuse(f"{roster.players[place]!r} has no rating in {file.source}; give two ratings")
    a, b = places
    if cannot_be_compared(roster, a, b):
        refuse(
            f"no chain of opponents links {roster.players[a]!r} and {roster.players[b]!r}, so "
            "their ratings cannot be compared"
        )
    pair = [
        Roster(names, one.rating[places], one.standard_error[places], one.games[places])
        for one in (file.roster, roster)
    ]
    if (pair[0].games == NOT_STATED).any() and (said := games_words(*pair)):
        say(said)
    errors = [0.0 if math.isnan(error) else error for error in roster.standard_error.tolist()]
    players = TwoPlayers.rated(
        float(roster.rating[a]),
        float(roster.rating[b]),
        points,
        names=(roster.players[a], roster.players[b]),
        errors=(errors[a], errors[b]),
    )
    return replace(players, form=file.form if form is None else form)


def refuse_uncertain(players: TwoPlayers) -> None:
    """Refuse --via where chances are averaged over the errors of ratings: they are no limit."""
    if players.form:
        refuse(
            "--via is for one chain, but with --form the answer is an average over many; leave one "
            "out"
        )
    if players.error:
        refuse(
            "--via is for one chain, but with --from the answer is an average over how far the "
            "ratings may be off; give the two ratings as numbers"
        )


from_option = click.option(
    "--from",
    "from_file",
    metavar="RATINGS.csv",
    help="Take A and B as names on this list of ratings, with its scale and errors.",
)


def player_options(command: Command) -> Command:
    """Add the arguments and options that describe the players."""
    return with_options(
        command,
        click.option(
            "--first-break",
            type=click.Choice(["a", "b"]),
            help="Who breaks the next game.  [default: a; b with --breaks b]",
        ),
        click.option(
            "--breaks",
            type=click.Choice(list(FORMATS)),
            help="Who breaks: winner, loser, in turn, or always A or B.",
        ),
        click.option(
            "--p2", metavar="P", type=CHANCE, help="Chance that B wins a game that B breaks."
        ),
        click.option(
            "--p1", metavar="P", type=CHANCE, help="Chance that A wins a game that A breaks."
        ),
        click.option("--p", metavar="P", type=CHANCE, help="Chance that A wins a game."),
        scale_option(
            "the one that the file of --from states, else the one that the ratings can only be on",
            fixed=False,
        ),
        from_option,
        click.argument("ratings", nargs=-1, metavar="[A B]", shell_complete=completion.players),
    )
