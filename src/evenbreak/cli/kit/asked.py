"""A question as a command: its options, its help, and what is asked read from what is typed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from inspect import cleandoc
from pathlib import Path
from typing import Any, TypeVar

import click
from click.core import ParameterSource

from evenbreak.answers.asked import answer_to, question_of
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.patience import told
from evenbreak.cli.kit import completion
from evenbreak.cli.kit.faces import FACES, faces
from evenbreak.cli.kit.league import (
    LEAGUE,
    LeagueArgument,
    LeagueOption,
    defaults,
    league_option,
    point_at,
    show_taken,
)
from evenbreak.cli.kit.said import said
from evenbreak.cli.kit.terminal import say, write_plot
from evenbreak.errors import EvenbreakError, InputError
from evenbreak.fields.kinds import NUMBER, Choice, Flag, Kind
from evenbreak.fields.question import AskedError, Declared, declaration, declared, worded
from evenbreak.questions.of_league import takes_any

Asked = TypeVar("Asked")

ALL_HELP = "--help-all"


class Typed(click.ParamType):  # type: ignore[type-arg]
    """The click type of a kind: it reads what is typed, and shows what a shell may offer."""

    def __init__(self, kind: Kind) -> None:
        self.kind, self.name = kind, type(kind).__name__.lower()

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the value of a text."""
        try:
            return self.kind.read(value)
        except InputError as error:
            self.fail(str(error), param, ctx)

    def get_missing_message(
        self,
        param: click.Parameter,  # noqa: ARG002
        ctx: click.Context | None,  # noqa: ARG002
    ) -> str | None:
        """Return what to write where the option is missing."""
        needed: str = getattr(self.kind, "needed", "")
        return f"{needed.capitalize()}." if needed else None

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[click.shell_completion.CompletionItem]:
        """Return what a shell may offer here."""
        if isinstance(self.kind, Choice):
            return completion.offered(self.kind.of, incomplete)
        offers = completion.offers(self.kind)
        return offers(ctx, param, incomplete) if offers else []


def spelled(question: type, name: str) -> str:
    """Return how the terminal spells a parameter of a question."""
    every = {one.name: one.option for one in declared(question)}
    return every.get(name, "--" + name.replace("_", "-"))


def params_of(question: type) -> list[click.Parameter]:
    """Return the arguments and options of a question."""
    words = [one for one in declared(question) if one.field.argument and one.field.many]
    params = [_param(one, question) for one in declared(question) if one not in words[1:]]
    if len(words) > 1:  # they are told apart by `Question.split`
        joint = next(param for param in params if param.name == words[0].name)
        joint.metavar = " ".join(one.metavar for one in words)
    if getattr(question, "old_words", ()):
        params.append(click.Argument([_OLD_WORDS], nargs=-1, metavar="", expose_value=True))
    return params


_OLD_WORDS = "old_words"


def _param(one: Declared, question: type) -> click.Parameter:
    field = one.field
    if field.argument:
        return LeagueArgument(
            [one.name],
            question=question,
            type=Typed(one.kind),
            nargs=-1 if field.many else 1,
            required=one.required,
            metavar=one.metavar,
        )
    words = [one.name, one.option, *([one.short] if one.short else [])]
    more: dict[str, Any] = {"help": help_of(one, question), "required": one.required}
    if isinstance(one.kind, Flag):
        return click.Option(words, is_flag=True, show_default=False, **more)
    return LeagueOption(
        words,
        question=question,
        type=Typed(one.kind),
        multiple=field.many,
        nargs=field.words,
        metavar=one.metavar,
        show_default=False,
        **more,
    )


def help_of(one: Declared, question: type) -> str:
    """Return the help of an option: what it is, its limits, and what applies without it."""
    notes = [one.kind.limits] if one.kind.limits else []
    if one.usual and not one.required:  # click itself says that an option is required
        notes.append(f"default: {one.usual}")
    if one.field.many:
        notes.append("can be repeated")
    text = one.field.help + (f"  [{'; '.join(notes)}]" if notes else "")
    return _worded(text, question)


def _worded(text: str, question: type) -> str:
    return said(worded(text), _spelling(question))


def _spelling(question: type) -> Callable[[str], str]:
    return lambda parameter: spelled(question, parameter)


class AskedCommand(click.Command):
    """A command that asks a question.

    It reads -20 as a number, where click alone sees an unknown option; it takes old spellings with
    a note; and its help fits a screen: options that are rarely needed come with --help-all.
    """

    def __init__(self, *args: Any, question: type, **options: Any) -> None:
        super().__init__(*args, **options)
        self.question = question
        self._old = {
            f"--{name}": one.option for one in declared(question) for name in one.field.old
        }
        names = {one.name for one in declared(question)}
        of_league = takes_any(question) or getattr(question, "of_league", False)
        if of_league and "league" not in names:
            self.params.append(league_option())
        self.params.append(
            click.Option(
                [ALL_HELP],
                is_flag=True,
                is_eager=True,
                expose_value=False,
                callback=_show_all,
                help="Show all options and exit.",
            )
        )

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, and refuse words that only start like a number."""
        args = list(self._as_now(args))
        ctx.ignore_unknown_options = any(
            word.startswith("-") and NUMBER.fullmatch(word) for word in args
        )
        if not ctx.resilient_parsing:
            self._refuse_twice(ctx, args)
        try:
            rest = super().parse_args(ctx, args)
        except click.UsageError as error:
            example, *_ = (*str(getattr(self.question, "examples", "")).strip().splitlines(), "")
            if example and error.message.startswith("Got unexpected extra argument"):
                said = f"{error.message}. Write it like this: {example}"
                raise click.UsageError(said, ctx) from None
            raise
        if ctx.ignore_unknown_options and not ctx.resilient_parsing:
            for param in self.params:
                if isinstance(param, click.Argument) and param.nargs == -1:
                    self._refuse_options(ctx, ctx.params.get(param.name or "") or ())
        return rest

    def _refuse_twice(self, ctx: click.Context, args: list[str]) -> None:
        """Refuse an option with two values, of which click would take the last without a word."""
        *_, order = self.make_parser(ctx).parse_args(list(args))
        for param in order:
            once = isinstance(param, click.Option) and not (param.is_flag or param.multiple)
            if once and order.count(param) > 1:
                name = max(param.opts, key=len)
                raise click.UsageError(
                    f"{name} is given twice. Give it once: {name} {param.make_metavar(ctx)}",
                    ctx=ctx,
                )

    def _refuse_options(self, ctx: click.Context, words: Any) -> None:
        for word in words:
            if isinstance(word, str) and word[:1] == "-" != word and not NUMBER.fullmatch(word):
                options = [name for param in self.params for name in param.opts]
                raise click.NoSuchOption(word.split("=")[0], possibilities=options, ctx=ctx)

    def _as_now(self, args: list[str]) -> Iterator[str]:
        """Yield the words with old spellings of options as they are spelled now."""
        words = iter(args)
        for word in words:
            if word == "--":
                yield from (word, *words)
                return
            name, sign, value = word.partition("=")
            if name in self._old:
                say(f"Note: {name} is now called {self._old[name]}.")
                name = self._old[name]
            yield name + sign + value

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what the command does: the first paragraph alone unless all is asked for."""
        text = self.help or ""
        with formatter.indentation():
            formatter.write_paragraph()
            formatter.write_text(text if self._explains_all(ctx) else text.partition("\n\n")[0])

    def _explains_all(self, ctx: click.Context) -> bool:
        """Return whether the help explains all options: if that is asked for, or they are few."""
        options = [one for one in declared(self.question) if not one.field.argument]
        return bool(ctx.meta.get(ALL_HELP)) or len(options) <= _FEW

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options by sections; unless all is asked for, those of sections by name only.

        So the help fits a screen, with what is needed most.
        """
        every, all_asked = self._explains_all(ctx), bool(ctx.meta.get(ALL_HELP))
        sections: dict[str, list[click.Parameter]] = {"": []}
        fields = {one.name: one.field for one in declared(self.question)}
        for param in self.get_params(ctx):
            field = fields.get(param.name or "")
            if field is None:
                continue
            if every or field.section or not field.rare:
                sections.setdefault(field.section, []).append(param)
        if all_asked:
            sections[_ANSWER] = [one for one in self.get_params(ctx) if one.name not in fields]
        folded = []
        for section, params in sections.items():
            records = [one.get_help_record(ctx) for one in params]
            rows = [row for row in records if row is not None and row[1]]
            if not rows:
                continue
            if every or not section:
                with formatter.section(section or "Options"):
                    formatter.write_dl(rows, col_max=_WIDEST)
            else:
                names = (option for name, _ in rows for option in name.split()[:1])
                folded.append((section, ", ".join(names)))
        if forms := ", ".join(_faces(self.params)):
            folded.append((_ANSWER, forms))
        if folded and not all_asked:
            with formatter.section(f"More, explained by {ALL_HELP}"):
                formatter.write_dl(folded)


_FEW = 8
"""So many options are explained by --help even if they are in sections."""
_WIDEST = 24
"""The columns of a help text that options have; those of wider ones begin a line below."""
_ANSWER = "The answer"


def _faces(params: Iterable[click.Parameter]) -> Iterator[str]:
    """Yield the options that choose the form of the answer."""
    for param in params:
        if param.name in FACES:
            short, option = min(param.opts, key=len), max(param.opts, key=len)
            value = f" {param.metavar}" if param.metavar else ""
            yield f"{option}{value}" + (f" ({short})" if short != option else "")


def _show_all(ctx: click.Context, param: click.Parameter, value: bool) -> None:  # noqa: ARG001
    if value and not ctx.resilient_parsing:
        ctx.meta[ALL_HELP] = True
        click.echo(ctx.get_help())
        ctx.exit()


def command_of(
    question: type[Asked], name: str | None = None, *, answers: bool = True, **options: Any
) -> Callable[[Callable[..., Answer | None]], click.Command]:
    """Return a decorator that makes a command of the function that answers a question.

    The question's docstring is the command's help, followed by its `examples`. Without `answers`
    there is nothing to print; options are those of `faces`.
    """

    def decorate(answer: Callable[..., Answer | None]) -> click.Command:
        def run(**values: Any) -> Any:
            asks = {name: values.pop(name) for name in ("face", "page_file") if name in values}
            ctx = click.get_current_context()
            try:
                return answer(asked_of(question, values, ctx), **asks)
            except AskedError as error:
                show_taken(ctx)
                message = said(error.sentence, _spelling(question))
                raise click.UsageError(message, ctx=ctx) from None
            except (EvenbreakError, click.ClickException):
                show_taken(ctx)  # what is wrong may come from there
                raise

        lines = getattr(question, "examples", "")
        shown: Any = faces(**options)(run) if answers else run
        own = getattr(shown, "__click_params__", [])
        return AskedCommand(
            name,
            question=question,
            callback=shown,
            params=[*params_of(question), *reversed(own)],
            help=_worded(cleandoc(question.__doc__ or ""), question),
            epilog=f"\b\nExamples:\n{lines}" if lines else None,
        )

    return decorate


def answered(name: str) -> click.Command:
    """Return the command, by its words, that is only a question and its answer."""

    def run(asked: Any) -> Answer:
        with told(lambda why: say(said(why))):
            answer = answer_to(name, asked)
        if getattr(asked, "plot", None) is not None:
            from evenbreak.plots.asked import picture_of

            write_plot(picture_of(name, asked, answer), asked.plot)
        return answer

    return command_of(question_of(name), name.rpartition(" ")[2])(run)


def asked_of(question: type[Asked], values: dict[str, Any], ctx: click.Context) -> Asked:
    """Return the question with the values that were typed; the others have their defaults."""
    typed = {
        name: value
        for name, value in values.items()
        if ctx.get_parameter_source(name) is not ParameterSource.DEFAULT and value is not None
    }
    words = typed.pop(_OLD_WORDS, ())
    if words:
        _read_old_words(question, words, typed)
    typed = question.split(typed)  # type: ignore[attr-defined]
    return question(**_with_league(question, typed, ctx) | typed)


def _with_league(question: type, typed: dict[str, Any], ctx: click.Context) -> dict[str, Any]:
    """Return what the league's file gives; one that {league} itself names is read here."""
    place = typed.get("league")  # of a question that draws opponents from a league
    if place is not None and (Path(place).is_dir() or place.endswith(".toml")):
        league = point_at(ctx, place)
        if league.files.roster is None:
            raise click.BadParameter(f"{league.path} names no roster", param_hint=LEAGUE)
        typed["league"] = league.place(league.files.roster)
    return defaults(question, typed, ctx)


def _read_old_words(question: Any, words: tuple[str, ...], typed: dict[str, Any]) -> None:
    """Read words as the options that they were the values of, with a note."""
    fields = [declaration(question, name) for name in question.old_words]
    texts = words if len(fields) > 1 else (":".join(words),)
    if len(texts) != len(fields) or any(one.name in typed for one in fields if not one.field.many):
        raise click.UsageError(f"Got unexpected extra argument ({words[-1]})")
    now = " ".join(f"{one.option} {text}" for one, text in zip(fields, texts, strict=True))
    say(f"Note: write {now} in place of {' '.join(words)}.")
    for one, text in zip(fields, texts, strict=True):
        try:
            value = one.kind.read(text)
        except InputError as error:
            raise click.BadParameter(str(error), param_hint=repr(one.option)) from None
        typed[one.name] = (value, *typed.get(one.name, ())) if one.field.many else value
