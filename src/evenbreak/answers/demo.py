"""The demo's files: what was written, and what to try on them."""

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from subprocess import list2cmdline

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Column, Table


def demo_answer(folder: str, files: Mapping[str, str], new: Sequence[str]) -> Answer:
    """Return what the folder of the demo holds, and three commands to try.

    Parameters
    ----------
    folder
        where the files are.
    files
        what each of them holds.
    new
        those that were not there before.

    >>> print(demo_answer("try", {"drill_log.csv": "a drill"}, ["drill_log.csv"]).sentences[0])
    Wrote 1 file to try. The players are made up.
    """
    wrote = f"Wrote {len(new)} file{'' if len(new) == 1 else 's'} to {folder}"
    if not new:
        wrote = f"{folder} has all the files of the demo already"
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
            Table(
                "commands",
                [
                    Column("who", "if you", left=True),
                    Column("command", "type", left=True, whole=True),
                ],
                commands,
                "Three commands to try next:",
            ),
            Table(
                "files",
                [Column("file", "file", left=True), Column("holds", "what it holds", left=True)],
                list(files.items()),
            ),
        ],
    )
