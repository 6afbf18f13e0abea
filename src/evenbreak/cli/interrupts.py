"""Ctrl-C, which ends the program whatever it is doing.

Python raises KeyboardInterrupt wherever the program is. Some places swallow it, most of them in
imports, where modules written in C forget the errors of what they try; the program would go on.
So an interrupt waits while a module is imported, and whatever has swallowed one, the program ends
before it prints or writes anything.

This module is imported at the start of every run, so it imports next to nothing.
"""

import signal
from types import FrameType

_PAUSE = 0.01
"""Seconds until an interrupt that has to wait tries again."""

_asked = False


def listen() -> None:
    """Answer Ctrl-C from now on as above, unless the program was started to ignore it."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return
    signal.signal(signal.SIGINT, _interrupt)
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))


def stop_listening() -> None:
    """Ignore Ctrl-C from now on: the program is ending."""
    if signal.getsignal(signal.SIGINT) is _interrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def raise_if_interrupted() -> None:
    """Raise KeyboardInterrupt if there was an interrupt that something has swallowed."""
    if _asked:
        raise KeyboardInterrupt


def _interrupt(_: int, frame: FrameType | None) -> None:
    global _asked
    _asked = True
    if not _importing(frame):
        raise KeyboardInterrupt
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, _PAUSE)


def _importing(frame: FrameType | None) -> bool:
    while frame is not None:
        if frame.f_code.co_filename.startswith("<frozen importlib"):
            return True
        frame = frame.f_back
    return False
