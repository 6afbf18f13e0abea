"""The warnings about a file, as a sheet that is handed out has them."""

from collections.abc import Iterator, Sequence

from evenbreak.answers.file_words import file_name
from evenbreak.answers.remarks import Remark
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.results_file import ResultsFile


def warnings_of(
    file: ResultsFile | RosterFile, warnings: Sequence[str] | None = None
) -> Iterator[Remark]:
    """Yield warnings about a file, by default its own, without its folder, which is private."""
    for warning in file.warnings if warnings is None else warnings:
        text = warning.removeprefix(f"{file.source}:")
        if text == warning:
            yield Remark("Warning", warning)
        else:  # after the name comes a blank, or the number of a line
            why = text.lstrip() if text.startswith(" ") else f"line {text}"
            yield Remark(f"Warning about {file_name(file)}", why)
