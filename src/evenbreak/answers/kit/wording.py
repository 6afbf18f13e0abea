"""Numbers and lists as shown to people: chances, decimals, counts, times, names."""

from collections.abc import Sequence

from evenbreak.answers.kit.parts import Show
from evenbreak.words import Figure, joined, say


def chance(p: float) -> str:
    """Return a probability with four decimals, or two digits if it is small.

    >>> chance(0.65263), chance(0.00101), chance(1.234e-9), chance(1 - 1e-9)
    ('0.6526', '0.0010', '1.2e-09', '1.0000')
    """
    return Figure(p, ".2g" if 0.0 < p < 5e-5 else ".4f")


def percent(p: float, left: float = 0.0) -> str:
    """Return a probability for a sentence, in percent; never 0 or 100 unless exactly so.

    If the chance of anything else, `left`, is 1e-18, a chance is 1 in every digit and still not
    certain.

    >>> percent(0.653), percent(0.0042), percent(0.99999), percent(1.0), percent(3e-9)
    ('65%', '0.4%', 'more than 99.9%', '100%', 'less than 0.1%')
    >>> percent(1.0, 1e-18)
    'more than 99.9%'
    >>> percent(0.01), percent(0.0103)  # a round value, as it was given, and a calculated one
    ('1%', '1.0%')
    """
    if p == 1.0 and left > 0.0:
        return say("more than {p:.1%}", p=0.999)
    if p == round(p, 2):
        return Figure(p, ".0%")
    if p < 0.001:
        return say("less than {p:.1%}", p=0.001)
    if p > 0.999:
        return say("more than {p:.1%}", p=0.999)
    return Figure(p, ".1%" if p < 0.0995 or p >= 0.995 else ".0%")


def share(p: float) -> str:
    """Return a probability for a table, in percent to one decimal.

    >>> share(0.90701), share(0.08), share(3e-5), share(0.9999), share(0.0), share(1.0)
    ('90.7%', '8.0%', '<0.1%', '>99.9%', '0%', '100%')
    """
    if p == 0.0 or p > 1.0 - 1e-12:
        return Figure(p, ".0%")
    if p < 0.0005:
        return Figure(0.001, ".1%", sign="<")
    return Figure(0.999, ".1%", sign=">") if p > 0.9995 else Figure(p, ".1%")


def share_at_a_glance(p: float) -> str:
    """Return a probability in percent for tight spaces, with two digits at most.

    >>> share_at_a_glance(0.90701), share_at_a_glance(0.0757), share_at_a_glance(3e-5)
    ('91%', '7.6%', '<0.1%')
    """
    return Figure(p, ".0%") if 0.0995 <= p < 0.995 else share(p)


def decimals(places: int) -> Show:
    """Return a number with this many decimals; a number that rounds to 0 has no sign.

    >>> decimals(2)(1.005), decimals(1)(-0.04), decimals(0)(1234.5)
    ('1.00', '0.0', '1,234')
    """

    def show(value: float) -> str:
        return Figure(value, f"z,.{places}f")

    return show


def signed(places: int) -> Show:
    """Return a difference with its sign; one that rounds to 0 is never negative.

    >>> signed(4)(0.0521), signed(1)(-3.26), signed(1)(-0.04)
    ('+0.0521', '-3.3', '+0.0')
    """
    return lambda value: Figure(value, f"+z.{places}f")


def games(value: float) -> str:
    """Return a number of games, racks or matches, with two decimals if it isn't whole.

    >>> games(13), games(10.2743), games(3.2e11)
    ('13', '10.27', '3.2e+11')
    """
    if value >= 1e9:
        return Figure(value, ".3g")
    return Figure(value, ".2f" if isinstance(value, float) else ",")


def yes_or_no(truth: bool) -> str:
    """Return a truth value as a word.

    >>> yes_or_no(True), yes_or_no(False)
    ('yes', 'no')
    """
    return say("yes") if truth else say("no")


def range_words(first: int, last: int | None) -> str:
    """Return a range of whole numbers, possibly open-ended.

    >>> range_words(7, 18), range_words(7, 7), range_words(49, None)
    ('7 to 18', '7', '49 and up')
    """
    if last is None:
        return say("{first} and up", first=first)
    return say("{first} to {last}", first=first, last=last) if last > first else str(first)


def count_of(number: int, one: str, many: str = "") -> str:
    """Return a number with the noun it counts; `many` defaults to `one` plus an s.

    >>> count_of(1, "game"), count_of(2599, "game"), count_of(2, "match", "matches")
    ('1 game', '2,599 games', '2 matches')
    """
    return f"{number:,} {one if number == 1 else many or one + 's'}"


def some_of(words: Sequence[str], most: int = 8) -> str:
    """Return the first few names, and how many more there are.

    >>> some_of(["Ann", "Bo", "Cy"], most=2)
    'Ann, Bo and 1 more'
    """
    more = len(words) - most
    names = joined(words[:most], ", ")
    return say("{names} and {n:,} more", names=names, n=more) if more > 0 else names


def clock(minutes: float) -> str:
    """Return minutes as hours and minutes.

    >>> clock(52.4), clock(119.7), clock(185.0)
    ('52 min', '2 h 00', '3 h 05')
    """
    whole = round(minutes)
    if whole < 60:
        return say("{n} min", n=whole)
    return say("{hours} h {minutes:02d}", hours=whole // 60, minutes=whole % 60)


def how_often(p: float) -> str:
    """Return how often something with probability p happens.

    >>> how_often(0.012), how_often(0.3), how_often(1.0)
    ('about 1 time in 83', 'about 30 times in 100', 'nearly always')
    """
    if p > 0.99:
        return say("nearly always")
    if p < 0.001:
        return say("less than 1 time in 1000")
    if p < 0.1:
        return say("about 1 time in {n:.0f}", n=1 / p)
    return say("about {n:.0f} times in 100", n=100 * p)


def luck_words(p: float) -> str:
    """Return whether something is luck, given the probability p that luck alone causes it.

    >>> luck_words(0.3), luck_words(0.02)
    ('this may well be luck', 'this is probably not luck')
    """
    if p >= 0.1:
        return say("this may well be luck")
    if p >= 0.05:
        return say("this could be luck")
    return say("this is probably not luck") if p >= 0.01 else say("this is not luck")
