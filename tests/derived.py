"""The rows that a module of section 5 adds to a problem, by quantity and inputs."""

from types import ModuleType
from typing import Any


def derived(module: ModuleType, problem: str) -> dict[tuple[str, str], Any]:
    return {(row.quantity, row.inputs): row.computed for row in module.DERIVED[problem]()}
