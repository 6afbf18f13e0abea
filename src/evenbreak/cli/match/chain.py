"""`evenbreak chain`: the stochastic limit of any chain, from a file."""

from __future__ import annotations

from evenbreak import files
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.questions.games import Chain


@command_of(Chain, "chain")
def command(asked: Chain) -> Answer:
    """Find where a Markov chain ends."""
    from evenbreak.answers.match.chain import chain_answer

    file = files.read_chain(asked.path, states=asked.states, rows=asked.rows)
    chain = file.chain(asked.start_state)
    return chain_answer(chain, steps=asked.steps, warnings=file.warnings, via=asked.via)
