"""The name by which phones find the page, where the computer's own address is not it."""

from pathlib import Path
from unittest.mock import patch

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from rows import each_of


def asked(path: Path, *words: str) -> tuple[int, str]:
    with patch("evenbreak.web.command._taken", return_value=""), patch("uvicorn.Server.run"):
        result = CliRunner().invoke(program, ["serve", str(path / "tonight.db"), *words])
    return result.exit_code, result.output


@pytest.mark.parametrize(
    ("host", "address", "name"),
    [
        ("192.168.1.20", "http://192.168.1.20:8000", "192.168.1.20"),
        ("Pool.Example:80", "http://pool.example:80", "pool.example"),
    ],
)
def test_the_page_is_printed_and_answered_under_the_name(
    tmp_path: Path, host: str, address: str, name: str
) -> None:
    with patch("evenbreak.web.command.Site", wraps=None) as site:
        site.return_value.pin = "123456"
        with patch("evenbreak.web.command.server_of"):
            code, shown = asked(tmp_path, "--lan", "--host", host)
    assert code == 0, shown
    assert f"The page: {address}\n" in shown
    _, hosts, at = site.call_args.args[:3]
    assert name in hosts
    assert at == address


@each_of(
    "words, refusal",
    [
        (["--host", "pool.example"], "--host is for phones; give --lan too"),
        (["--lan", "--host", "a b"], "give a name or an address"),
        (["--lan", "--host", "http://x"], "give a name or an address"),
    ],
)
def test_what_is_no_name_is_refused(tmp_path: Path, words: list[str], refusal: str) -> None:
    code, shown = asked(tmp_path, *words)
    assert code == 2
    assert refusal in " ".join(shown.split())
