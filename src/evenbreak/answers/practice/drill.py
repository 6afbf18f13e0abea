"""Where a progressive drill settles, and which level to practice."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

from evenbreak import files, games, practice
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way, luck_words
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Quantity, Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.chains.ways import Way
from evenbreak.files.practice import DrillLogFile
from evenbreak.practice.drills import MORE, DrillStatistics, drill_statistics
from evenbreak.practice.log_analysis import LogAnalysis
from evenbreak.practice.log_tests import PlayedAgainTest
from evenbreak.questions.practice import EIGHT_BALL_LEVELS, DrillPlayed
from evenbreak.stats.summary import Distribution


def drill_answer(
    statistics: DrillStatistics, description: str, *, via: Way | None = None
) -> Answer:
    """Return where a drill settles in the long run, and what to practice."""
    law = statistics.distribution
    success = statistics.drill.success
    rows = zip(law.values, success, law.probability, statistics.gain, statistics.lift, strict=True)
    parts: list[Part] = [f"{_advice(statistics)} {_settled(law)}"]
    if statistics.period > 1:
        parts.append(
            "Odd-numbered and even-numbered attempts stay at different levels forever; the long "
            "run is the average of both."
        )
    columns = columns_of("level p_success long_run_share gain lift_of_five")
    return Answer(
        description,
        [*parts, Table("drill_levels", columns, list(rows)), *_way(via, statistics)],
        details=[Quantities([*quantities_of({"mean_level": law.mean}), *spread(law)]), GAIN_WORDS],
        data={"practice_next": statistics.practice_next, "period": statistics.period},
    )


def _way(via: Way | None, statistics: DrillStatistics) -> list[Part]:
    if via is None:
        return []
    kernel = drill_statistics(statistics.drill).distribution.probability
    return by_way(via, zip(statistics.distribution.probability, kernel, strict=True))


def _advice(statistics: DrillStatistics) -> str:
    level = statistics.practice_next
    if level is None:
        return "More success at any level would not raise your average level."
    lift = statistics.lift[level - 1]
    return (
        f"Practice level {level}: {better(statistics.drill.success[level - 1])} there raises your "
        f"average level by {lift:.2f}, more than at any other level."
    )


def _settled(law: Distribution) -> str:
    return f"For now your average level settles at {law.mean:.2f}."


GAIN_WORDS = (
    "'Gain' is how fast the average level rises with the chance of success at that level (the "
    "slope)."
)


def spread(law: Distribution) -> list[Quantity]:
    """Return the long-run summary of the level, without its mean."""
    return quantities_of({"median_level": law.median, "mode_level": law.mode, "sd_level": law.sd})


def better(p: float) -> str:
    """Return the improvement used to compare levels, starting from a chance p."""
    return "making five more in 100" if p <= 1.0 - MORE else "making every one"


UNLIKELY = 0.05
"""A p-value below which chance is no longer accepted as the explanation."""

SURE = 0.8
"""From this probability up, the second best level isn't mentioned."""

CLEAR = 0.5
"""Below this probability, no level is named as the one to practice."""


def drill_log_answer(
    file: DrillLogFile, analysis: LogAnalysis, *, seed: int, levels_given: bool = True
) -> Answer:
    """Return what a drill's log shows.

    Without `levels_given`, the number of levels is the highest in the log.
    """
    log = file.log
    best, off = analysis.practice_next, analysis.furthest_off_model
    tests = {name: getattr(analysis, name) for name in ("difference", "memory", "model_test")}
    return Answer(
        _heading(file, levels_given=levels_given),
        [
            _practice(analysis) + _untried(analysis),
            " ".join(_findings(analysis)),
            _table(analysis),
            _averages(analysis),
        ],
        details=[
            Quantities(spread(analysis.implied), "The level in the long run:"),
            *_tests(analysis),
            "A p-value (p) is how often chance alone gives a result at least this extreme. For "
            "each "
            f"test, {count_of(analysis.replicas, 'log')} with sessions like yours were simulated; "
            f"{_luck(analysis)}.",
            GAIN_WORDS,
        ],
        warnings=file.warnings,
        data={
            "practice_next": best and best.level,
            **{name: test and test._asdict() for name, test in tests.items()},
            "model": analysis.model and analysis.model._asdict(),
            "furthest_off_model": off and off.level,
            "attempts": len(log),
            "sessions": log.sessions,
            "against_the_rule": len(log.jumps),
            "replicas": analysis.replicas,
            "seed": seed,
        },
    )


def _luck(analysis: LogAnalysis) -> str:
    tests = (analysis.difference, analysis.memory, analysis.model_test)
    return luck_words((test.p_error for test in tests if test is not None), "p-value")


def _heading(file: DrillLogFile, *, levels_given: bool) -> str:
    log = file.log
    text = (
        f"{file.source}: {count_of(len(log), 'attempt')} in {count_of(log.sessions, 'session')}, "
        f"a drill of {count_of(len(log.attempts), 'level')}"
    )
    return text if levels_given else f"{text} (the highest in the log)"


def _table(analysis: LogAnalysis) -> Table:
    columns = columns_of(
        "level attempts successes p_success p_low p_high p_model visited expected_by_chance "
        "long_run gain lift lift_low lift_high p_best_level"
    )
    return Table(
        "drill_levels",
        columns,
        analysis.levels,
        "Your success rate at each level, with its 95% interval; the share of your attempts at "
        "that level, so far and in the long run; its lift: how much making five more in 100 "
        "there would raise your average level; and how likely it is to be the best level to "
        "practice:",
    )


def _averages(analysis: LogAnalysis) -> Quantities:
    low, high = analysis.mean_low, analysis.mean_high
    return Quantities(
        quantities_of(
            {
                "mean_so_far": analysis.visited.mean,
                "mean_in_long_run": analysis.implied.mean,
                "mean_low": low,
                "mean_high": high,
            },
            notes={"mean_in_long_run": f"(between {low:.2f} and {high:.2f})"},
        )
    )


def _practice(analysis: LogAnalysis) -> str:
    best = analysis.practice_next
    missed = [report for report in analysis.levels if report.attempts > report.successes]
    if best is None:
        return _nothing_to_practice(levels=len(analysis.levels), missed=bool(missed))
    others = [report for report in missed if report is not best]
    second = max(others, key=lambda report: report.p_best, default=best)
    if best.p_best < CLEAR:
        return (
            f"It is too early to tell which level to practice: the chance of "
            f"being the best is {_percent(best.p_best)} for level {best.level} and "
            f"{_percent(second.p_best)} for level {second.level}. A longer log would tell."
        )
    text = (
        f"Practice level {best.level} next: {better(best.p or 0.0)} there raises your average "
        f"level by {best.lift:.2f} (between {best.lift_low:.2f} and {best.lift_high:.2f}). "
    )
    if not others:
        return f"{text}It is the only level that you missed."
    text += f"The chance that no other level helps more is {_percent(best.p_best)}"
    if best.p_best >= SURE:
        return f"{text}."
    return (
        f"{text}; for level {second.level}, that chance is {_percent(second.p_best)}. A longer log "
        f"would show which of the two it is."
    )


def _nothing_to_practice(*, levels: int, missed: bool) -> str:
    if levels == 1:
        return (
            "With only one level there's nothing to climb. Give the number of levels in the drill."
        )
    if not missed:
        return (
            "You never missed, so the log can't show what to practice. Log more "
            "attempts, if possible at higher levels."
        )
    return "No level that you missed would raise your average level."


def _untried(analysis: LogAnalysis) -> str:
    """Return how the first untried level above one that was tried is counted."""
    for below, report in pairwise(analysis.levels):
        if below.attempts and not report.attempts:
            return (
                f" You have not tried level {report.level} yet; until you do, you are assumed "
                f"to miss there every time."
            )
    return ""


def _percent(p: float) -> str:
    """Return a probability in words that leave room for doubt.

    >>> [_percent(p) for p in (0.714, 0.9995, 0.001)]
    ['71%', 'more than 99%', 'less than 1%']
    """
    if p > 0.99:
        return "more than 99%"
    return "less than 1%" if p < 0.01 else f"{100 * p:.0f}%"


def _findings(analysis: LogAnalysis) -> Iterator[str]:
    """Yield what stands out in the log beyond chance, or that nothing does."""
    memory, model = analysis.memory, analysis.model_test
    found = []
    if analysis.difference.p_value < UNLIKELY:
        found.append(
            "Your sessions are not at the levels that your success rates would lead to; perhaps "
            "you stop when things go well."
        )
    if memory is not None and memory.p_value < UNLIKELY:
        worse = "miss" if memory.seen > memory.by_chance else "success"
        found.append(f"After a {worse} you do worse, and by more than chance would explain.")
    off = analysis.furthest_off_model
    if model is not None and model.p_value < UNLIKELY and off is not None:
        usual = off.attempts * (off.p_model or 0.0)
        found.append(
            f"Level {off.level} doesn't fit the rest: you made {off.successes} of {off.attempts}; "
            f"going by your other levels, {usual:.0f} would be normal."
        )
    if not found:
        yield "Nothing else in the log stands out beyond chance."
        return
    yield from found
    if memory is not None and memory.p_value >= UNLIKELY:
        yield "There is no sign that one attempt affects the next."


def _tests(analysis: LogAnalysis) -> Iterator[Part]:
    """Yield the log's tests, one paragraph each."""
    test = analysis.difference
    yield (
        f"Levels: if you went on forever with these success rates, {100 * test.seen:.0f} attempts "
        f"in 100 would be at different levels than so far; in simulated sessions like yours, "
        f"{100 * test.by_chance:.0f} in 100 are ({_p(test)})."
    )
    if analysis.memory is not None:
        test = analysis.memory
        yield (
            f"Memory: at the same level you succeed {_often(test.seen)} after a success "
            f"{'as' if not round(100 * test.seen) else 'than'} after a miss; by chance alone it "
            f"would be {_often(test.by_chance)} ({_p(test)})."
        )
    model, test_of_model = analysis.model, analysis.model_test
    if model is None:
        yield "Without attempts above level 1, nothing can be said about single shots."
        return
    text = (
        f"Single shots: if level i takes i - 1 good shots in a row, the chance of making a "
        f"shot is {model.p:.3f} (between {model.low:.3f} and {model.high:.3f})."
    )
    if test_of_model is not None:
        text += f" The fit to all levels has {_p(test_of_model)}."
    if model.level_1_misses:
        text += (
            f" Level 1 would then never be missed, so your {model.level_1_attempts} attempts "
            f"there, {model.level_1_misses} of them missed, are left out."
        )
    yield text


def _p(test: PlayedAgainTest) -> str:
    return f"p = {test.p_value:.2g}"


def _often(difference: float) -> str:
    """Return a difference between two success rates in words.

    >>> _often(0.024), _often(-0.3), _often(0.004)
    ('2 times in 100 more often', '30 times in 100 less often', 'as often')
    """
    hundredths = round(100 * difference)
    if not hundredths:
        return "as often"
    many = count_of(abs(hundredths), "time")
    return f"{many} in 100 {'more' if hundredths > 0 else 'less'} often"


NINE_BALL_LEVELS = 9

MOST_DRAWS = 20_000_000
"""The most attempts simulated for a test, so that a long log takes seconds."""


def drill(asked: DrillPlayed) -> Answer:
    """Return where a drill settles."""
    if asked.log is not None:
        return _drill_log(asked, asked.log)
    if asked.p is None:
        played = games.Drill(asked.success or ())
        description = "A drill with the given chance of success at each level"
    elif asked.game == "8-ball":
        played = games.Drill.eight_ball(asked.p, asked.levels or EIGHT_BALL_LEVELS)
        description = (
            "The progressive 8-ball drill: i balls of each group and the 8-ball at level i, which "
            f"takes i good shots, each with chance {asked.p:g}"
        )
    else:
        played = games.Drill.progressive(asked.p, asked.levels or NINE_BALL_LEVELS)
        description = (
            f"A drill in which level i takes i - 1 good shots, each with chance {asked.p:g}"
        )
    statistics = drill_statistics(played, via=asked.via)
    return replace(drill_answer(statistics, description, via=asked.via), drawn=statistics)


def _drill_log(asked: DrillPlayed, path: str) -> Answer:
    import numpy as np

    seed = 1 if asked.seed is None else asked.seed
    file = files.read_drill_log(path, levels=asked.levels, drill=asked.drill)
    replicas = min(1999, max(199, MOST_DRAWS // len(file.log)))
    analysis = practice.analyze_log(file.log, rng=np.random.default_rng(seed), replicas=replicas)
    answer = drill_log_answer(file, analysis, seed=seed, levels_given=asked.levels is not None)
    return replace(answer, drawn=analysis)
