"""How a command's answer is printed: text on a terminal, CSV into a pipe, JSON or HTML if asked."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import update_wrapper
from pathlib import PurePath
from typing import Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.interrupts import raise_if_interrupted
from evenbreak.cli.kit.league import without_form
from evenbreak.cli.kit.progress import Working
from evenbreak.cli.kit.said import said, terminal
from evenbreak.cli.kit.terminal import say, to_terminal, write, write_file

FACES = ("face", "page_file", "verbose")
"""The parameters of every command that choose the form of its answer."""

Function = Callable[..., "Answer"]


def faces(
    *, page: bool = True, always_text: bool = False, ask_face: bool = False, ask_page: bool = False
) -> Callable[[Function], Function]:
    """Return a decorator that prints the `Answer` of a command as its options ask.

    `page` adds `--html FILE`, unless the command has its own. With `always_text` a pipe gets text
    too, because the tables go to files. `ask_face` passes the format (text, csv or json) as `face`,
    because some hold less; `ask_page` passes the page's name as `page_file`, for a command that
    writes it.
    """

    def decorate(function: Function) -> Function:
        def run(
            *, face: str | None, verbose: bool, page_file: str | None = None, **options: Any
        ) -> None:
            chosen = face or ("text" if always_text or to_terminal() else "csv")
            if ask_face:
                options["face"] = chosen
            if ask_page:
                options["page_file"] = page_file
            with Working():
                answer = function(**options)
            if not verbose:
                answer = replace(answer, warnings=without_form(answer.warnings))
            print_answer(answer, chosen, verbose=verbose)
            if page_file is not None and not ask_page:
                from evenbreak.sheets.html_page import answer_page

                write_file(page_file, answer_page(answer))

        command: Any = update_wrapper(run, function)
        for add in reversed(_options(page=page)):
            command = add(command)
        return command  # type: ignore[no-any-return]

    return decorate


def _options(*, page: bool) -> list[Callable[[Any], Any]]:
    def face(name: str, text: str) -> Callable[[Any], Any]:
        return click.option(f"--{name}", "face", flag_value=name, help=text)

    options = [
        face("text", "Print text, even into a pipe."),
        face("csv", "Print CSV, even on a terminal."),
        face("json", "Print JSON, with numbers in full precision."),
    ]
    if page:
        options.append(
            click.option(
                "--html",
                "page_file",
                metavar="FILE",
                callback=page_name,
                help="Also write the answer to FILE as a web page.",
            )
        )
    more = click.option("-v", "--verbose", is_flag=True, help="Add the statistical details.")
    return [*options, more]


def page_name(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return the name of the page, or refuse a name that does not end in .html."""
    if value is not None and PurePath(value).suffix.lower() not in (".html", ".htm"):
        raise click.BadParameter(
            f"{value!r} isn't an HTML file. Choose a name that ends in .html.", ctx=ctx, param=param
        )
    return value


def without_folders(warnings: Iterable[str], *paths: str | None) -> list[str]:
    """Return warnings for a page that is handed out: the folders of files are private.

    >>> without_folders(["'Bo' is not in /home/ann/club.csv"], "/home/ann/club.csv", None)
    ["'Bo' is not in club.csv"]
    """
    public = [said(text) for text in warnings]
    for path in filter(None, paths):
        public = [text.replace(path, PurePath(path).name) for text in public]
    return public


def print_answer(answer: Answer, face: str, *, verbose: bool = False) -> None:
    """Print an answer as text, csv or json; its warnings go to stderr.

    With CSV on stdout, the sentences of the answer go to stderr too.
    """
    raise_if_interrupted()
    if face == "json":
        from evenbreak.answers.faces.to_json import to_json

        click.echo(to_json(answer).encode(), nl=False)
    elif face == "csv":
        from evenbreak.answers.faces.to_csv import to_csv

        for line in "\n".join(map(said, [answer.heading, *answer.sentences])).split("\n"):
            say(line)
        for line in to_csv(answer):
            click.echo(line.encode(), nl=False)
    else:
        from evenbreak.answers.faces.in_face import answer_in_face
        from evenbreak.answers.faces.to_text import to_text

        write(to_text(answer_in_face(answer, terminal()), verbose=verbose))
    for warning in answer.warnings:
        say(f"Warning: {said(warning)}")
