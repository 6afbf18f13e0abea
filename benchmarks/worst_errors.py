"""A pytest plugin: print the worst relative error that each accuracy test saw.

PYTHONPATH=benchmarks python -m pytest -q -p worst_errors tests/chains/test_accuracy.py
"""

from __future__ import annotations

from typing import Any

import pytest

_WORST: dict[str, float] = {}
_CHAINS: dict[str, int] = {}


@pytest.fixture(autouse=True)
def _note_errors(request: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    import oracle

    measure = oracle.worst_relative_error
    name = request.node.originalname

    def noted(*arguments: Any) -> float:
        error = measure(*arguments)
        _WORST[name] = max(_WORST.get(name, 0.0), error)
        _CHAINS[name] = _CHAINS.get(name, 0) + 1
        return error

    monkeypatch.setattr(oracle, "worst_relative_error", noted)
    return


def pytest_terminal_summary(terminalreporter: Any) -> None:
    terminalreporter.line("| test | comparisons | worst relative error |")
    terminalreporter.line("|---|---|---|")
    for name, error in _WORST.items():
        terminalreporter.line(f"| `{name}` | {_CHAINS[name]} | {error:.1e} |")
