"""Chains as models of Storm, and calls that ask it about them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from evenbreak.chains import Chain


def storm_model(chain: Chain, labels: dict[str, Any]) -> Any:
    """Return the chain as a model, its states labelled as given."""
    from stormpy import datastructures, models

    rows, n = chain.matrix.tocsr().T.tocsr().tocoo(), len(chain)
    builder = datastructures.SparseMatrixBuilder[float](n, n, rows.nnz)
    builder.add_next_values(rows.row.tolist(), rows.col.tolist(), rows.data.tolist())
    labeling = models.StateLabeling(n)
    for label, states in {"init": [0], **labels}.items():
        labeling.add_label(label)
        for state in states:
            labeling.add_label_to_state(label, int(state))
    steps = models.SparseRewardModel[float](optional_state_reward_vector=[1.0] * n)
    parts = models.SparseModelComponents[float](
        transition_matrix=builder.build(), state_labeling=labeling, reward_models={"steps": steps}
    )
    return models.SparseDtmc[float](parts)


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


def storm_law(model: Any) -> Callable[[], Any]:
    """Return a call of Storm for the long-run law."""
    import stormpy

    settings = environment()

    def law() -> Any:
        found = stormpy.analysis.compute_steady_state_distribution(model, environment=settings)
        return np.asarray(found.get_value_vector())

    return law
