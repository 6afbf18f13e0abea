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
    ("host", "name"),
    [("192.168.1.20", "192.168.1.20:8000"), ("Pool.Example:80", "pool.example:80")],
)
def test_the_page_is_printed_and_answered_under_the_name(
    tmp_path: Path, host: str, name: str
) -> None:
    with (
        patch("evenbreak.web.command.addresses", return_value=["172.17.0.2"]),
        patch("evenbreak.web.command.server_of") as server,
    ):
        code, shown = asked(tmp_path, "--lan", "--host", host)
    assert code == 0, shown
    assert f"The page: http://{name}\n" in shown
    assert server.call_args.kwargs["name"] == host.lower()  # test_room says what that does


@each_of(
    "words, refusal",
    [
        (["--host", "pool.example"], "--host is for phones. Give --lan too"),
        (["--lan", "--host", "a b"], "be a name or an address"),
        (["--lan", "--host", "http://x"], "be a name or an address"),
    ],
)
def test_what_is_no_name_is_refused(tmp_path: Path, words: list[str], refusal: str) -> None:
    code, shown = asked(tmp_path, *words)
    assert code == 2
    assert refusal in " ".join(shown.split())
