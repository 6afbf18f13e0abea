"""The JSON of `evenbreak ladder`."""

import json

import pytest


@pytest.fixture
def ladder(run):
    def ask(*words):
        result = run("ladder", "--json", *words)
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return ask


@pytest.fixture(scope="module")
def compared(run):
    """Return the comparison on each chart, against each kind of opponents, asked only once."""
    known = {}

    def ask(*words):
        if words not in known:
            result = run("ladder", "--compare", "--json", *words)
            assert result.exit_code == 0, result.stderr
            known[words] = json.loads(result.stdout)
        return known[words]

    return ask
