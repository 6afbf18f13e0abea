"""The tables of keys in the reference of league.toml, made from the declaration that reads them.

The build of the pages puts them where a mark stands: `<!-- keys: team -->`; `<!-- keys: top -->`
has those above all tables.
"""

from __future__ import annotations

import re
from collections import defaultdict

from option_tables import commands_asking

from evenbreak.cli.kit.asked import spelled
from evenbreak.fields.question import declared
from evenbreak.files.league.league_file import SECTIONS, LeagueFile, Source
from evenbreak.files.league.new_file import EXAMPLES
from evenbreak.questions.of_league import key_of

MARK = re.compile(r"^<!-- keys: (\w+) -->$", re.MULTILINE)


def options_of_keys() -> dict[str, list[str]]:
    """Return the options and arguments whose default each key is."""
    options: defaultdict[str, set[str]] = defaultdict(set)
    for question in commands_asking():
        for one in declared(question):
            for key in key_of(question, one.name).split(" or "):
                options[key].add(spelled(question, one.name))
    return {key: sorted(names) for key, names in options.items()}


def table_of(name: str) -> str:
    """Return the table of the keys of a part of the file."""
    of = {"top": LeagueFile, "results": Source}.get(name) or SECTIONS[name]
    section = "" if name == "top" else f"{name}."
    options = options_of_keys()
    lines = ["| key | meaning | such as | default of |", "|---|---|---|---|"]
    for one in declared(of):
        key = section + one.name
        named = ", ".join(f"`{option}`" for option in options.get(key, []))
        such = EXAMPLES.get(key, '"dmy"' if one.name == "dates" else '"autumn.csv"')
        lines.append(f"| `{one.name}` | {one.field.help} | `{such}` | {named} |")
    return "\n".join([*lines, ""])


def with_tables(text: str) -> str:
    """Return a page with its tables."""
    return MARK.sub(lambda found: table_of(found[1]), text)
