"""Markov chains and their stochastic limits; nothing here knows what a game is about."""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "chain": ["Chain"],
        "limits": [
            "Limit",
            "absorption",
            "expected_visits",
            "limit_matrix",
            "stationary_laws",
            "stochastic_limit",
        ],
        "structure": ["Structure"],
        "transient": ["TransientPart"],
        "explore": ["chain_from_arrays", "chain_of"],
        "powers": ["propagate"],
        "steps": ["Passage", "first_passage", "steps_to_absorption"],
        "mixing": ["mixing_time", "spectral_gap"],
        "rewards": ["long_run_reward", "total_reward"],
        "sensitivity": ["Sensitivity", "sensitivity"],
        "spectrum": ["Spectrum", "spectrum"],
        "symbolic": ["symbolic_limit"],
    },
)
