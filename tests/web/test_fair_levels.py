"""The fair race of two skill levels on the page: the same numbers and words as the command's."""

import re
from pathlib import Path

from click.testing import CliRunner

from evenbreak.cli.program import program
from web.phones import Phone, answering


def test_the_page_says_of_levels_what_the_command_says(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        phone = Phone(site)
        for chart, needs in (("apa_8ball", "4:2"), ("apa_9ball", "38:25")):
            page = phone.open("/fair", a="5", b="3", scale=chart, race="5").words
            command = ["odds", "5", "3", "--chart", chart, "--text"]
            said = CliRunner().invoke(program, command).output
            assert needs in page
            chance = re.search(r"wins the match (\d+%) of the time", said)
            assert chance
            assert f"{chance[1]} of the time" in page
        for words, refusal in (
            ({"a": "5", "b": "9"}, "'9' isn't a skill level of APA 8-ball"),
            ({"a": "Ann", "b": "3"}, "'Ann' isn't a skill level"),
        ):
            refused = phone.open("/fair", scale="apa_8ball", race="5", **words)
            assert refused.status == 400
            assert refusal in refused.words
        assert 'value="apa_9ball"' in phone.open("/fair").text
