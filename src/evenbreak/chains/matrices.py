"""Chains from square matrices: numpy and scipy sparse arrays, DataFrames, lists of lists.

Half of the literature puts the state that a step leaves in the row of a matrix and half in the
column. A matrix whose rows and columns all sum to 1 reads either way, and the two chains differ.
So the reading must be given, unless one alone makes sense or the matrix is symmetric.
"""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from scipy.sparse import issparse

from evenbreak.chains.chain import Chain, csc_of, sums_to_1
from evenbreak.checks import one_of
from evenbreak.errors import ChainError

if TYPE_CHECKING:
    from collections.abc import Hashable

    from scipy.sparse import csc_array

Rows: TypeAlias = Literal["from", "to"]
"""What the row of a matrix says: the state that a step leaves, or the one it enters."""


def is_matrix(source: object) -> bool:
    """Whether the source is a numpy array, a scipy sparse matrix, a DataFrame or square lists."""
    known = isinstance(source, np.ndarray) or issparse(source) or _is_frame(source)
    return known or _is_nested(source)


def chain_of_matrix(source: Any, rows: Rows | None, start: Hashable | None) -> Chain:
    """Return the chain of a square matrix; its states are the labels, or 0, 1, 2, ...

    Raises
    ------
    ChainError
        if the matrix is not square and stochastic, its labels differ or repeat, or both
        readings are possible and `rows` does not say which is meant.

    >>> import numpy as np
    >>> chain_of_matrix(np.array([[0.9, 0.1], [0.5, 0.5]]), None, 0).matrix.toarray()
    array([[0.9, 0.5],
           [0.1, 0.5]])
    """
    if rows is not None:
        one_of(rows, "rows", ("from", "to"))
    states, matrix = _labelled(source) if _is_frame(source) else (None, csc_of(source))
    n, columns = matrix.shape
    if n != columns:
        raise ChainError(
            f"the matrix has shape {matrix.shape}; give a square one, or a list of "
            "(source, target, probability)"
        )
    if states is None:
        states = list(range(n))
    if start is not None and start not in states:
        raise ChainError(f"start is {start!r}, which is not a state of the chain")
    if (rows or _only_reading(matrix)) == "from":
        matrix = csc_of(matrix.T)
    return Chain(states, matrix, start)


def _only_reading(matrix: csc_array) -> Rows:
    """Return the one reading by which the matrix is stochastic."""
    by_rows, by_columns = sums_to_1(matrix, axis=1), sums_to_1(matrix, axis=0)
    if not by_rows and not by_columns:
        raise ChainError(
            "neither the rows nor the columns of the matrix all sum to 1; give probabilities that "
            "sum to 1 within 1e-9, with a 1 on the diagonal for a state that is never left"
        )
    if by_rows and by_columns and (matrix - matrix.T).count_nonzero():
        raise ChainError(
            "the rows and the columns of the matrix all sum to 1, so it can be read two ways; give "
            "rows='from' if a row holds the chances out of its state, or rows='to' if into it"
        )
    return "from" if by_rows else "to"


def _is_nested(source: object) -> bool:
    """Whether the source is n lists of n numbers; 3 such may also be arcs between numbers."""
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


def _labelled(frame: Any) -> tuple[list[Hashable], csc_array]:
    """Return the row labels of a frame, and its numbers with the columns in their order."""
    states, columns = list(frame.index), list(frame.columns)
    for labels in (states, columns):
        if len(set(labels)) < len(labels):
            raise ChainError("the frame has a state twice; give each one row and one column")
    if set(states) != set(columns):
        other = next(iter(set(states) ^ set(columns)))
        raise ChainError(
            f"{other!r} labels a row or a column of the frame, not both; give each state one of "
            "each, or give a table of arcs as frame.itertuples(index=False)"
        )
    place = {state: k for k, state in enumerate(columns)}
    numbers = frame.to_numpy()[:, [place[state] for state in states]]
    return states, csc_of(numbers)
