"""Chains as models of Storm, and calls that ask it about them."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np

from evenbreak.chains import Chain


def storm_model(chain: Chain, labels: dict[str, Any], *, exact: bool = False) -> Any:
    """Return the chain as a model, its states labeled as given, in decimal fractions if exact."""
    from stormpy import Rational, datastructures, models

    value = Rational if exact else float
    number = (lambda p: Rational(str(Fraction(repr(p))))) if exact else float

    rows, n = chain.matrix.tocsr().T.tocsr().tocoo(), len(chain)
    builder = datastructures.SparseMatrixBuilder[value](n, n, rows.nnz)
    chances = [number(p) for p in rows.data.tolist()]
    builder.add_next_values(rows.row.tolist(), rows.col.tolist(), chances)
    labeling = models.StateLabeling(n)
    for label, states in {"init": [0], **labels}.items():
        labeling.add_label(label)
        for state in states:
            labeling.add_label_to_state(label, int(state))
    steps = models.SparseRewardModel[value](optional_state_reward_vector=[number(1.0)] * n)
    parts = models.SparseModelComponents[value](
        transition_matrix=builder.build(), state_labeling=labeling, reward_models={"steps": steps}
    )
    return models.SparseDtmc[value](parts)


def environment() -> Any:
    """Return the settings of Storm: sparse LU by Eigen, which is its fastest solver here."""
    import stormpy
    from stormpy import environments

    chosen = stormpy.Environment()
    chosen.solver().set_linear_equation_solver_type(environments.EquationSolverType.EIGEN)
    return chosen


def storm_values(model: Any, asked: str) -> Callable[[], Any]:
    """Return a call of Storm for the value of a property from every state."""
    import stormpy

    settings, formula = environment(), stormpy.parse_properties(asked)[0]

    def values() -> Any:
        return stormpy.model_checking(model, formula, environment=settings).get_value_vector()

    return values


def storm_law(model: Any, *, exact: bool = False) -> Callable[[], Any]:
    """Return a call of Storm for the long-run law."""
    import stormpy
    from stormpy import environments

    settings = environments.exact() if exact else environment()

    def law() -> Any:
        found = stormpy.analysis.compute_steady_state_distribution(model, environment=settings)
        return list(found) if exact else np.asarray(found.get_value_vector())

    return law
