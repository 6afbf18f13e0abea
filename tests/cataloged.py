"""The sentences that a page can show, collected from the sources as `make catalogs` does."""

import re
from functools import cache

from babel.messages.catalog import Catalog
from babel.messages.extract import extract_from_dir
from babel.messages.frontend import parse_keywords, parse_mapping_cfg

from places import ROOT


@cache
def collected() -> Catalog:
    """Return what `make catalogs` collects."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8").replace("\\\n", " ")
    keywords = parse_keywords(re.search(r"^SAID = (.*)$", makefile, re.MULTILINE)[1].split())
    with (ROOT / "babel.cfg").open(encoding="utf-8") as file:
        methods, options = parse_mapping_cfg(file)
    catalog = Catalog()
    for path, line, said, _, meaning in extract_from_dir(ROOT, methods, options, keywords):
        catalog.add(said, locations=[(path, line)], context=meaning)
    return catalog


def said_on_pages() -> set[str]:
    """Return every template of a sentence that a page can show."""
    templates = (message.id for message in collected() if message.id)
    return {text for one in templates for text in ((one,) if isinstance(one, str) else one)}
