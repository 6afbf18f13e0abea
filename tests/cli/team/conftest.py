"""What a command of team nights answers, as JSON."""

import json

import pytest


@pytest.fixture
def ask(run):
    """Run the words of a command line and return its JSON."""

    def answer(*words: str):
        result = run(*words, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return answer
