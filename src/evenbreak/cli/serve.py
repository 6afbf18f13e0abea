"""`evenbreak serve`: the page on the director's phone and the venue's screen."""

from importlib import import_module

from evenbreak.cli.kit.asked import command_of
from evenbreak.questions.start import Serve


@command_of(Serve, "serve", answers=False)
def command(asked: Serve) -> None:
    """Open tonight's tournament or team night as a page."""
    # By its name, because the terminal and the page know nothing of each other.
    import_module("evenbreak.web.command").serve(asked)
