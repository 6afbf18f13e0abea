"""Whether one new score of a drill was luck."""

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Quantities, Quantity, statistic
from evenbreak.answers.wording import chance, count_of, decimals, how_often, luck_words
from evenbreak.files.practice import ScoresFile
from evenbreak.stats.confidence import Luck, mean_interval, was_it_luck

TWO = decimals(2)


def new_score_answer(file: ScoresFile, score: float, *, confidence: float = 0.95) -> Answer:
    """Return how often luck alone gives a score like a new one.

    Parameters
    ----------
    file
        the earlier scores, two or more that differ.
    score
        the new one.
    confidence
        of the interval of the average.

    >>> import numpy as np
    >>> from evenbreak.files.practice import ScoresFile
    >>> earlier = np.array([50.0, 44, 46, 52, 47, 51, 49, 45, 48, 50])
    >>> print(new_score_answer(ScoresFile(earlier, None, "s.csv", ()), 53).sentences[0])
    53 is 4.80 above your average, and this may well be luck: if nothing has changed, a score this
    far off, up or down, happens about 12 times in 100. Several new scores would show more than
    one.
    """
    luck = was_it_luck(file.scores, score, confidence=confidence)
    sd = mean_interval(file.scores, confidence).sd
    high = score >= luck.mean
    as_high, as_low = ("this high", None) if high else (None, "this low")
    more, share = f"among {luck.n + 1} scores, by rank alone", f"{100 * confidence:g}%"
    quantities = [
        Quantity("score", score),
        Quantity("n", luck.n),
        Quantity("mean", luck.mean, "average before", TWO),
        statistic("sd", sd, "standard deviation before", TWO),
        Quantity("confidence", confidence),
        statistic("units", luck.t.units, "standard units off, by Student's t", TWO),
        Quantity("p_as_far", luck.t.as_far, "this far off by luck, up or down", chance),
        Quantity("p_as_high", luck.t.as_high, as_high and f"{as_high} by luck", chance),
        Quantity("p_as_low", luck.t.as_low, as_low and f"{as_low} by luck", chance),
        statistic(
            "p_as_high_by_rank", luck.as_high_by_rank, as_high and f"{as_high} {more}", chance
        ),
        statistic("p_as_low_by_rank", luck.as_low_by_rank, as_low and f"{as_low} {more}", chance),
        statistic(
            "units_normal", luck.normal.units, "standard units off, by the normal distribution", TWO
        ),
        statistic("p_as_far_normal", luck.normal.as_far, "this far off, by that", chance),
        statistic(
            "units_cautious",
            luck.cautious.units,
            f"standard units beyond the {share} interval",
            TWO,
        ),
        statistic("p_as_far_cautious", luck.cautious.as_far, "this far off, by that", chance),
    ]
    return Answer(
        f"{score:g} after {count_of(luck.n, 'score')} in {file.source}",
        [_in_words(luck), Quantities(quantities)],
        details=[
            "The answer is by Student's t, which allows for the average and the spread being known "
            "only from your earlier scores. The normal distribution ignores that and is too sure. "
            f"Counted from the nearer end of the {share} interval of the average, it is more "
            "cautious. The rank needs no distribution at all."
        ],
        warnings=file.warnings,
    )


def _in_words(luck: Luck) -> str:
    away = luck.score - luck.mean
    if away == 0.0:
        return f"{luck.score:g} is exactly your average, so it shows nothing new."
    return (
        f"{luck.score:g} is {abs(away):.2f} {'above' if away > 0 else 'below'} your average, and "
        f"{luck_words(luck.t.as_far)}: if nothing has changed, a score this far off, up or down, "
        f"happens {how_often(luck.t.as_far)}. Several new scores would show more than one."
    )
