"""Everything that is wrong with a file, collected so it can be corrected in one go."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import TYPE_CHECKING, Any

from evenbreak.errors import DataError
from evenbreak.words import FilePath, Sentence, joined, say

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


LONGEST_QUOTE = 40
MOST_LISTED = 12
"""How many names a message lists."""


def quoted(text: str) -> str:
    r"""Return text quoted for a message: short, on one line, harmless to a terminal.

    A tab is shown as the space it looks like.

    >>> quoted("six\nhundred"), quoted("9" * 50)
    ("'six\\nhundred'", "'9999999999999999999999999999999999999999'...")
    """
    text = text.replace("\t", " ")
    return repr(text) if len(text) <= LONGEST_QUOTE else repr(text[:LONGEST_QUOTE]) + "..."


def printable(text: str) -> str:
    r"""Return text with everything unprintable escaped, so it stays on one line.

    >>> printable("Zoë's\nfile\x1b.csv")
    "Zoë's\\nfile\\x1b.csv"
    """
    return "".join(
        letter if letter.isprintable() else letter.encode("unicode_escape").decode()
        for letter in text
    )


def quoted_list(names: Sequence[str]) -> str:
    """Return names in the form of a list for a message.

    >>> quoted_list([" name", "club"])
    "'name', 'club'"
    """
    shown = joined([quoted(name.strip()) for name in names[:MOST_LISTED]], ", ")
    more = len(names) - MOST_LISTED
    return say("{names} and {n} more", names=shown, n=more) if more > 0 else shown


def first_ones(
    warnings: Sequence[str], most: int, source: str, rest: Callable[[int], str]
) -> list[str]:
    """Return a file's first warnings, plus `rest` with the number left over.

    >>> first_ones(["r.csv: a", "r.csv: b"], 1, "r.csv", lambda n: say("and {n} more", n=n))
    ['r.csv: a', 'r.csv: and 1 more']
    """
    left = len(warnings) - most
    if left <= 0:
        return list(warnings)
    return [*warnings[:most], warning(source, None, rest(left))]


_OF_FILE, _OF_LINE = "{source}: {text}", "{source}:{line}: {text}"


def warning(source: str, line: Any, template: str, /, **values: Any) -> Sentence:
    """Return a warning about a line in a file, or the whole file, as a template and values.

    >>> warning("r.csv", None, "is empty"), warning("r.csv", 7, "{a}-{b} is tied", a=5, b=5)
    ('r.csv: is empty', 'r.csv:7: 5-5 is tied')
    """
    text = template if isinstance(template, Sentence) else say(template, **values)
    place = FilePath(source)
    return (
        say(_OF_LINE, source=place, line=line, text=text)
        if line
        else say(_OF_FILE, source=place, text=text)
    )


def form_warning(source: str, line: Any, template: str, /, **values: Any) -> Sentence:
    """Return a warning about a file's format, which doesn't affect the answer.

    >>> form_warning("r.csv", None, "columns not used: {titles}", titles="'Referee'")
    "r.csv: columns not used: 'Referee'"
    """
    about = warning(source, line, template, **values)
    return say(about.template, **about.values, of_form=True)


def source_of_form(text: str) -> str | None:
    """Return the file that a warning is about, if it is about the file's format.

    >>> source_of_form(form_warning("r.csv", 3, "is a header")), source_of_form("r.csv: a row")
    ('r.csv', None)
    """
    of_form = isinstance(text, Sentence) and "of_form" in text.values
    return str(text.values["source"]) if of_form else None  # type: ignore[attr-defined]


def of_list(problem: str, name: str = "") -> str:
    """Return a problem or a warning as a list item that doesn't repeat the file's name.

    >>> tied = warning("/tmp/list.csv", 7, "is tied")
    >>> of_list(tied), of_list(tied, "Racks")
    ('line 7: is tied', 'Racks, line 7: is tied')
    """
    if not isinstance(problem, Sentence) or problem.template not in (_OF_FILE, _OF_LINE):
        return problem
    text, line = problem.values["text"], problem.values.get("line")
    if name and line:
        return say("{list}, line {line}: {text}", list=name, line=line, text=text)
    if line:
        return say("line {line}: {text}", line=line, text=text)
    return say("{list}: {text}", list=name, text=text) if name else text


def refusal(source: str, template: str, line: Any = None, /, **values: Any) -> DataError:
    """Return the error that rejects a file for one reason, at a line if there is one.

    >>> str(refusal("r.csv", "has {n} sheets", n=2))
    'r.csv: has 2 sheets'
    """
    return DataError([warning(source, line, template, **values)])


class Problems:
    """One file's problems, reported in line order.

    Parameters
    ----------
    source
        the file's name in messages.

    >>> problems = Problems("players.csv")
    >>> problems.add(7, "rating 'six' is not a number; write digits")
    >>> problems.add(None, "there is no column 'player'; add it")
    >>> problems.raise_any()
    Traceback (most recent call last):
    ...
    evenbreak.errors.DataError: players.csv: there is no column 'player'; add it
    players.csv:7: rating 'six' is not a number; write digits
    """

    def __init__(self, source: str) -> None:
        self.source = source
        self._found: list[tuple[int, str]] = []

    def __len__(self) -> int:
        return len(self._found)

    def add(self, line: int | None, template: str, /, **values: Any) -> None:
        """Add a problem: its line (None: the whole file), what is wrong and what to do.

        The template and its values are as for `evenbreak.words.say`.
        """
        problem = template if isinstance(template, Sentence) else say(template, **values)
        self._found.append((line or 0, problem))

    def add_rows(
        self, lines: NDArray[np.int64], rows: NDArray[np.int64], message: Callable[[int], Sentence]
    ) -> None:
        """Add a problem in each of `rows`.

        Parameters
        ----------
        lines
            the line of each row in the table.
        rows
            the rows at fault.
        message
            what is wrong in a row, and what to do.
        """
        self._found += [(int(lines[row]), message(int(row))) for row in rows]

    def include(self, others: Problems) -> None:
        """Add the problems in another list for the same file."""
        self._found += others._found

    @property
    def lines(self) -> set[int]:
        """The lines with problems; 0 is the whole file."""
        return {line for line, _ in self._found}

    @property
    def by_line(self) -> Sequence[tuple[int, str]]:
        """The problems in the order they were found, each with its line."""
        return tuple(self._found)

    def outside(self, lines: Collection[int]) -> Problems:
        """Return the problems outside some lines."""
        rest = Problems(self.source)
        rest._found = [(line, text) for line, text in self._found if line not in lines]
        return rest

    def listed(self) -> tuple[str, ...]:
        """Return the problems, one per line, starting with those of the whole file."""
        # Stable: problems of one line stay in the order in which they were found.
        ordered = sorted(self._found, key=lambda problem: problem[0])
        return tuple(warning(self.source, line, problem) for line, problem in ordered)

    def raise_any(self) -> None:
        """Raise all problems, if any.

        Raises
        ------
        DataError
            with one line per problem, starting with those of the whole file.
        """
        if self._found:
            raise DataError(self.listed())
