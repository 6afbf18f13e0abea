"""Where a chain ends, or what it does in the long run."""

from collections.abc import Mapping, Sequence
from typing import Any

from evenbreak.answers.answer import Answer
from evenbreak.answers.by_way import by_way
from evenbreak.answers.parts import Column, Part, Table
from evenbreak.answers.wording import chance, count_of, games, listed
from evenbreak.chains.chain import Chain
from evenbreak.chains.limits import Limit, stochastic_limit
from evenbreak.chains.passage_times import steps_to_absorption
from evenbreak.chains.powers import propagate
from evenbreak.chains.ways import Way
from evenbreak.errors import AccuracyError

NAMED = 5
"""States that a sentence names, the likeliest ones."""


def chain_answer(
    chain: Chain,
    *,
    steps: int | None = None,
    warnings: Sequence[str] = (),
    via: Way | None = None,
) -> Answer:
    """Return the stochastic limit of a chain from its start, or its density after some steps.

    Parameters
    ----------
    chain
        the chain; its states are texts.
    steps
        files then hold the density after so many steps, in place of the limit.
    warnings
        what may be wrong with the chain, a sentence each.
    via
        the way to the limit, as for `stochastic_limit`.

    >>> from evenbreak.chains import chain_of
    >>> arcs = [("S1", "W", 0.3), ("S1", "S2", 0.7), ("S2", "L", 0.2), ("S2", "S1", 0.8)]
    >>> print(chain_answer(chain_of(arcs, start="S1")).sentences[0])
    The chain ends in 'W' (0.6818) or 'L' (0.3182), after 3.86 steps on average.
    """
    limit = stochastic_limit(chain, via=via)
    mean_steps, doubts = mean_steps_of(chain)
    states, structure = list(chain.states), chain.structure
    columns = [Column("state", "state", left=True), Column("kind", "kind", left=True)]
    values: list[Sequence[Any]] = [states, structure.kinds]
    sentences = [in_the_end(limit, structure.kinds, mean_steps)]
    density = None
    if steps is not None:
        after = f"after {count_of(steps, 'step')}"
        density = dict(zip(states, propagate(chain, steps=steps).tolist(), strict=True))
        columns.append(Column("density", after, chance))
        values.append(list(density.values()))
        sentences.insert(0, f"A{after[1:]} the chain is in {_places(density)}.")
    columns.append(Column("limit", "in the long run", chance))
    values.append(limit.probability.tolist())
    classes = zip(states, structure.label.tolist(), structure.kinds, strict=True)
    return Answer(
        f"A chain of {count_of(len(states), 'state')} that starts in {chain.start!r}",
        [
            "\n".join(sentences),
            Table("", columns, list(zip(*values, strict=True))),
            *_way(via, limit),
        ],
        [
            "A transient state is left for good, an absorbing state is never left, and a recurrent "
            "state is returned to again and again."
        ],
        warnings=[*warnings, *doubts],
        data={
            "start": chain.start,
            "limit": limit.to_dict(),
            "states": {state: {"class": label, "kind": kind} for state, label, kind in classes},
            "period": limit.period,
            "mean_steps": mean_steps,
            "bound": limit.bound,
            "steps": steps,
            "density": density,
        },
        csv=Table(
            "probabilities",
            [Column("state"), Column("probability", exact=True)],
            list((density or limit.to_dict()).items()),
        ),
    )


def _way(via: Way | None, limit: Limit) -> list[Part]:
    """Return how the limit was found, beside the closed form of a line or else elimination."""
    if via is None:
        return []
    beside: Way = "kernel" if limit.chain.line is not None else "elimination"
    known = stochastic_limit(limit.chain, via=beside)
    pairs = zip(limit.probability.tolist(), known.probability.tolist(), strict=True)
    return by_way(via, pairs, beside=beside)


def mean_steps_of(chain: Chain) -> tuple[float | None, list[str]]:
    """Return the mean number of steps to absorption, and why there is none where it is lost."""
    try:
        return steps_to_absorption(chain).mean, []
    except AccuracyError as error:
        doubt = f"the mean number of steps could not be calculated ({error}); absorption may be "
        return None, [doubt + "certain nevertheless"]


def in_the_end(limit: Limit, kinds: Sequence[str], mean_steps: float | None) -> str:
    """Return where the chain ends, or where it is in the long run."""
    where = _places(limit.to_dict())
    if any(p and kind != "absorbing" for p, kind in zip(limit.probability, kinds, strict=True)):
        text = f"In the long run the chain is in {where}."
        if limit.is_cesaro:
            text += f" It never settles (period {limit.period}): these are long-run averages."
        return text
    steps = f", after {games(mean_steps)} steps on average" if mean_steps else ""
    return f"The chain ends in {where}{steps}."


def _places(density: Mapping[Any, float]) -> str:
    """Return the likeliest states, each with its chance."""
    likeliest = sorted((item for item in density.items() if item[1]), key=lambda item: -item[1])
    named = [f"{state!r} ({chance(p)})" for state, p in likeliest[:NAMED]]
    more = len(likeliest) - len(named)
    return listed([*named, f"{more:,} other states"] if more > 0 else named, "or")
