"""Read square matrices: numpy and scipy sparse arrays, DataFrames, and lists of lists.

Half of the literature uses a matrix's rows for the state that a step leaves, and half uses its
columns. A matrix whose rows and columns all sum to 1 reads either way, and the two chains differ.
So the reading must be given, unless only one makes sense or the matrix is symmetric.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from numbers import Real
from typing import Any, Literal, TypeAlias

import numpy as np
from scipy.sparse import csc_array, issparse

from evenbreak.chains.arcs import sums
from evenbreak.checks import one_of
from evenbreak.errors import ChainError

SUM_TOLERANCE = 1e-9
"""Tolerance for the sum of a state's arcs, which should be 1."""
ROUNDING = 1e-15
"""Tolerance for a column's sum within which it is left unchanged."""

Rows: TypeAlias = Literal["from", "to"]
"""The meaning of a matrix's row: the state that a step leaves, or the one it enters."""


def is_matrix(source: object) -> bool:
    """Whether the source is a numpy array, a scipy sparse matrix, a DataFrame, or square lists."""
    is_array = isinstance(source, np.ndarray) or issparse(source) or _is_frame(source)
    return is_array or _is_nested(source)


def read_matrix(source: Any, rows: Rows | None) -> tuple[list[Hashable], csc_array]:
    """Return a square matrix's states, its labels or 0, 1, 2, ..., and the intended M.

    Raises ChainError if the matrix is not square and stochastic, its labels differ or repeat, or if
    both readings are possible and `rows` is not given.

    >>> import numpy as np
    >>> states, matrix = read_matrix(np.array([[0.9, 0.1], [0.5, 0.5]]), None)
    >>> states, matrix.toarray()
    ([0, 1], array([[0.9, 0.5],
           [0.1, 0.5]]))
    """
    if rows is not None:
        one_of(rows, "rows", ("from", "to"))
    states, matrix = _labeled(source) if _is_frame(source) else (None, csc_of(source))
    n, columns = matrix.shape
    if n != columns:
        raise ChainError(
            "the matrix must be square, or a list of (source, target, probability); its "
            f"shape is {matrix.shape}"
        )
    if states is None:
        states = list(range(n))
    if (rows or _only_reading(matrix)) == "from":
        matrix = csc_of(matrix.T)
    return states, matrix


def _only_reading(matrix: csc_array) -> Rows:
    """Return the one reading by which the matrix is stochastic."""
    by_rows, by_columns = sums_to_1(matrix, axis=1), sums_to_1(matrix, axis=0)
    if not by_rows and not by_columns:
        raise ChainError(
            "the matrix's rows or its columns must all sum to 1; neither do. Give probabilities "
            "that sum to 1 within 1e-9, with a 1 on the diagonal for any state that is never left."
        )
    if by_rows and by_columns and (matrix - matrix.T).count_nonzero():
        raise ChainError(
            "the matrix's rows and columns all sum to 1, so it can be read two ways. Give "
            "rows='from' if a row holds the chances of leaving its state, or rows='to' if it "
            "holds the chances of entering it."
        )
    return "from" if by_rows else "to"


def _is_nested(source: object) -> bool:
    """Whether the source is n lists of n numbers; 3 such lists may also be arcs between numbers."""
    if not isinstance(source, list | tuple):
        return False
    n = len(source)
    for row in source:
        if not isinstance(row, list | tuple) or len(row) != n:
            return False
        if not all(isinstance(entry, Real) for entry in row):
            return False
    if n != 3:
        return n > 0
    matrix = csc_of(source)
    # No three arcs between whole numbers sum to 1 like a matrix and also state by state.
    return sums_to_1(matrix, axis=0) or sums_to_1(matrix, axis=1)


def _is_frame(source: object) -> bool:
    return all(hasattr(source, name) for name in ("index", "columns", "to_numpy"))


def _labeled(frame: Any) -> tuple[list[Hashable], csc_array]:
    """Return a DataFrame's row labels, and its numbers with the columns in the same order."""
    states, columns = list(frame.index), list(frame.columns)
    for labels in (states, columns):
        if len(set(labels)) < len(labels):
            raise ChainError("the frame has a state twice. Give each state one row and one column.")
    if set(states) != set(columns):
        label = next(iter(set(states) ^ set(columns)))
        raise ChainError(
            f"{label!r} labels only a row or only a column of the frame. Give each state both, or "
            "give a table of arcs as frame.itertuples(index=False)."
        )
    place = {state: k for k, state in enumerate(columns)}
    numbers = frame.to_numpy()[:, [place[state] for state in states]]
    return states, csc_of(numbers)


def csc_of(matrix: Any) -> csc_array:
    """Return a matrix of numbers in CSC form, its columns sorted and without duplicates.

    Raises ChainError if it is neither a sparse matrix nor a two-dimensional array of numbers.

    >>> from scipy.sparse import coo_array
    >>> csc_of(coo_array(([0.25, 0.25], ([0, 0], [1, 1])))).toarray()
    array([[0.  , 0.5]])
    """
    if type(matrix) is csc_array and matrix.dtype == np.float64 and matrix.has_canonical_format:
        return matrix
    try:
        entries: Any = matrix if issparse(matrix) else np.asarray(matrix)
        if entries.ndim != 2 or entries.dtype.kind not in "biufO" or np.ma.is_masked(matrix):
            raise TypeError
        converted: csc_array[np.float64] = csc_array(entries.astype(np.float64))
    except (TypeError, ValueError, AttributeError):
        raise ChainError(
            "the matrix must be sparse or a two-dimensional array of numbers; it is "
            f"{type(matrix).__name__} {matrix!r:.60}"
        ) from None
    converted.sum_duplicates()
    return converted


def adding_up(matrix: csc_array, states: Sequence[Hashable]) -> csc_array:
    """Return the matrix with columns that sum to 1 to within about one rounding.

    If a column does not, its self-loop becomes the remainder of the other arcs; without a
    self-loop, the arcs are scaled. Raises ChainError if a sum differs from 1 by more than 1e-9; it
    names the state and its sum.

    >>> adding_up(csc_array([[0.3, 0.0], [0.7 + 1e-10, 1.0]]), "AB").toarray()
    array([[0.3, 0. ],
           [0.7, 1. ]])
    """
    n = len(states)
    columns = np.repeat(np.arange(n), np.diff(matrix.indptr))
    total = sums(columns, matrix.data, n)
    missed = np.abs(total - 1.0)
    wrong = ~(missed <= ROUNDING)
    if not wrong.any():
        return matrix
    if (far := np.flatnonzero(~(missed <= SUM_TOLERANCE))).size:
        besides = far.size - 1
        more = (
            f" ({besides} other state{'s are' if besides > 1 else ' is'} off too)"
            if besides
            else ""
        )
        raise ChainError(
            f"the arcs out of state {states[far[0]]!r} sum to {total[far[0]]:.12g}{more}. Give "
            "probabilities that sum to 1 within 1e-9, including any self-loop."
        )
    loops = (matrix.indices == columns) & (matrix.data > 0.0)
    others = sums(columns, np.where(loops, 0.0, matrix.data), n)
    looped = np.zeros(n, dtype=bool)
    looped[columns[loops]] = True
    scale = np.where(wrong & ~looped, others, 1.0)
    data = matrix.data / scale[columns]
    kept = loops & wrong[columns]
    data[kept] = np.maximum(1.0 - others[columns[kept]], 0.0)
    completed = csc_array((data, matrix.indices, matrix.indptr), shape=matrix.shape)
    completed.has_canonical_format = True
    completed.eliminate_zeros()
    return completed


def sums_to_1(matrix: csc_array, *, axis: Literal[0, 1]) -> bool:
    """Whether all columns (axis 0) or all rows (axis 1) of a square matrix sum to 1 within 1e-9."""
    n = matrix.shape[0]
    columns = np.repeat(np.arange(n), np.diff(matrix.indptr))
    total = sums(columns if axis == 0 else matrix.indices, matrix.data, n)
    return bool((np.abs(total - 1.0) <= SUM_TOLERANCE).all())
