"""Many small rows as one test, which lists those on which it fails; tests of POSIX alone."""

import functools
import inspect
import os
from collections.abc import Callable, Iterable
from typing import Any

import pytest

posix = pytest.mark.skipif(os.name != "posix", reason="signals, forks and links are POSIX")

Test = Callable[..., None]


def each_of(names: str, rows: Iterable[Any]) -> Callable[[Test], Test]:
    """Run a test on every row, as `pytest.mark.parametrize` does, but in one test.

    It takes a hundredth of the time where a row takes microseconds. A test may not change what
    its fixtures give, which all rows share.

    >>> @each_of("a, b", [(1, 1), (2, 3), (4, 5)])
    ... def test_equal(a, b):
    ...     assert a == b
    >>> try:
    ...     test_equal()
    ... except ExceptionGroup as failed:
    ...     print(failed.message, *(error.__notes__ for error in failed.exceptions))
    2 of 3 rows fail ['a, b = (2, 3)'] ['a, b = (4, 5)']
    """
    keys = [name.strip() for name in names.split(",")]
    all_rows = list(rows)

    def in_one_test(test: Test) -> Test:
        @functools.wraps(test)
        def on_every_row(*args: Any, **fixtures: Any) -> None:
            failed: list[Exception] = []
            skipped = None
            skips = 0
            for row in all_rows:
                values = row.values if hasattr(row, "marks") else row
                if len(keys) == 1 and not hasattr(row, "marks"):
                    values = (row,)
                try:
                    test(*args, **dict(zip(keys, values, strict=True)), **fixtures)
                except pytest.skip.Exception as error:
                    skipped, skips = error, skips + 1
                except Exception as error:
                    error.add_note(f"{names} = {row!r}")
                    failed.append(error)
            if failed:
                raise ExceptionGroup(f"{len(failed)} of {len(all_rows)} rows fail", failed)
            if skipped is not None and skips == len(all_rows):
                raise skipped

        signature = inspect.signature(test)
        left = [value for name, value in signature.parameters.items() if name not in keys]
        vars(on_every_row)["__signature__"] = signature.replace(parameters=left)
        return on_every_row

    return in_one_test
