"""`evenbreak tournament`: tonight's tournament, each of its commands in a module of its own."""

from itertools import chain, pairwise

import click

from evenbreak.cli.kit.groups import Entry, LazyGroup
from evenbreak.cli.kit.said import works_on
from evenbreak.questions.moves import COMMANDS as MOVES

COMMANDS = {
    "new": Entry("Start a tournament that you run here.", "tournament.new"),
    "import": Entry("Import a tournament from another program.", "tournament.new:import_"),
    "second-chance": Entry(
        "Start another event for players who are out.", "tournament.new:second_chance"
    ),
    **{name: Entry(line, f"tournament.moves:{name}") for name, (_, line) in MOVES.items()},
    "show": Entry("Show the bracket.", "tournament.paper:show"),
    "next": Entry("Show who plays next, and on which table.", "tournament.paper:next_matches"),
    "export": Entry(
        "List the matches that were played, to use for ratings.", "tournament.paper:export"
    ),
    "print": Entry("Make score cards or a bracket to print.", "tournament.paper:print_paper"),
    "token": Entry("Let other programs enter scores, or anything else.", "tournament.paper:token"),
    "prizes": Entry(
        "What each place pays, and each player's expected prize.", "tournament.odds:prizes"
    ),
    "odds": Entry("Find each player's odds of winning the tournament.", "tournament.odds"),
    "time": Entry(
        "Find when the tournament ends and when each match starts.",
        "tournament.odds:time",
    ),
}
"""Each command, in the module of its name, with its line of help."""


_NAMES_IT = ("--file", "--out", "--pace", "--like", "import")
"""What stands before a file that has an option already, or is what is imported."""


class _OfFile(LazyGroup):
    """The commands of a tournament; its file may be named without an option, as for `serve`."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the words."""
        option = "--out" if args[:1] in (["new"], ["import"]) else "--file"
        words = [
            [option, word] if word.endswith(".db") and last not in _NAMES_IT else [word]
            for last, word in zip(["", *args], args, strict=False)
        ]
        typed = [part for word in chain.from_iterable(words) for part in _apart(word, option)]
        named = dict(pairwise(typed)).get(option)
        works_on(None if named == "tonight.db" else named)
        return super().parse_args(ctx, typed)


def _apart(word: str, option: str) -> list[str]:
    """Return an option and its value as two words."""
    value = word.removeprefix(f"{option}=")
    return [word] if value == word else [option, value]


@click.command("tournament", cls=_OfFile, table=COMMANDS)
def command() -> None:
    """Run tonight's tournament, and find its odds and finish time.

    Its file is tonight.db unless you name another, as in evenbreak tournament show saturday.db.
    """
