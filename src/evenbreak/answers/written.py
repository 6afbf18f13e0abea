"""Written files: the demo's, a league's new file, the source text's numbers; what to do next."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import PurePath
from subprocess import list2cmdline
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Quantities, Table
from evenbreak.words import FilePath, listed, say


def demo_answer(folder: str, files: Mapping[str, str], new: Sequence[str]) -> Answer:
    """Return the contents of the demo's folder, and three commands to try.

    >>> print(demo_answer("try", {"drill_log.csv": "a drill"}, ["drill_log.csv"]).sentences[0])
    Wrote 1 file to try. The players are made up.
    """
    wrote = f"Wrote {len(new)} file{'' if len(new) == 1 else 's'} to {folder}"
    if not new:
        wrote = f"{folder} already has all the demo's files"
    league, log = (
        list2cmdline([str(PurePath(folder, name))]) for name in ("demo_league.csv", "drill_log.csv")
    )
    commands = [
        ("run a tournament", "evenbreak serve --demo"),
        ("run a league", f"evenbreak report {league} --out sheet"),
        ("practice", f"evenbreak drill --log {log}"),
    ]
    return Answer(
        f"The demo, in {folder}",
        [
            f"{wrote}. The players are made up.",
            Table("commands", columns_of("who command"), commands, "Three commands to try next:"),
            Table("files", columns_of("file holds"), list(files.items())),
        ],
    )


def league_answer(
    path: str, files: Sequence[tuple[str, str, str]], commands: Any, warnings: Sequence[str] = ()
) -> Answer:
    """Return what a league's new file was written from, and what can be run now.

    Each of `files` has a name, what it is used as ('' if nothing), and its content in words.

    >>> answer = league_answer("league.toml", [("a.csv", "results", "9 matches")], [])
    >>> print(answer.sentences[0])
    Wrote league.toml. Commands in its folder now take their defaults from it.
    """
    return Answer(
        "League file",
        [
            say(
                "Wrote {file}. Commands in its folder now take their defaults from it.",
                file=FilePath(path),
            ),
            Table("files", columns_of("file taken_as holds"), list(files)),
            Table("commands", columns_of("for_what command"), list(commands), "To try next:"),
        ],
        warnings=warnings,
    )


MEANINGS = {
    "agrees": "the computed number confirms the printed one",
    "formula": "the printed formula gives the computed number",
    "given": "a number that the text quotes from elsewhere",
    "derived": "the text prints nothing, or nothing that can be read",
    "erratum": "the text is wrong, and the computed number is right",
    "differs": "the computed number is not the one expected",
}
"""What a verdict on a number means."""


def reproduction_answer(folder: str, verdicts: Mapping[str, int], files: Iterable[str]) -> Answer:
    """Return how the source text's numbers compare, and what was written."""
    names = list(files)
    total, wrong = sum(verdicts.values()), verdicts.get("erratum", 0)
    confirmed = verdicts.get("agrees", 0) + verdicts.get("formula", 0)
    pages = listed([f"{folder}/{name}" for name in names if name.endswith(".md")], "or")
    tables, figures = (sum(name.endswith(kind) for name in names) for kind in (".csv", ".png"))
    return Answer(
        f"The source text recalculated, in {folder}",
        [
            f"Of {total:,} numbers in the source text, {confirmed:,} are confirmed and {wrong:,} "
            f"{'is' if wrong == 1 else 'are'} wrong in the text. Start with {pages}.",
            Table(
                "verdicts",
                columns_of("verdict numbers meaning"),
                [
                    (verdict, verdicts[verdict], meaning)
                    for verdict, meaning in MEANINGS.items()
                    if verdicts.get(verdict)
                ],
            ),
            Quantities(quantities_of({"tables": tables, "figures": figures})),
        ],
    )
