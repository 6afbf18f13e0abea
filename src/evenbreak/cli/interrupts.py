"""Ctrl-C, which ends the program whatever it is doing.

Python raises KeyboardInterrupt wherever the program is. Some places swallow it, most of them in
imports, where modules written in C forget the errors of what they try; the program would go on.
So an interrupt waits while a module is imported, and whatever has swallowed one, the program ends
before it prints or writes anything. And Python raises nothing before a call into C returns, such
as the factorization of a large matrix; there a thread that waits for interrupts ends the program.

This module is imported at the start of every run, so it imports next to nothing.
"""

import _thread
import os
import signal
import time
from types import FrameType

_PAUSE = 0.01
"""Seconds until an interrupt that has to wait tries again."""

_PATIENCE = 0.2
"""Seconds that the program has to answer an interrupt before the thread ends it."""

INTERRUPTED = 130
"""The exit code."""

_SHOW_CURSOR = b"" if os.environ.get("TERM") == "dumb" else b"\x1b[?25h"
"""What a terminal needs whose progress bar has hidden the cursor."""

_asked = False


def listen() -> None:
    """Answer Ctrl-C from now on as above, unless the program was started to ignore it."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return
    signal.signal(signal.SIGINT, _interrupt)
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    if os.name == "posix":
        heard, tell = os.pipe()
        os.set_blocking(tell, False)
        signal.set_wakeup_fd(tell, warn_on_full_buffer=False)
        os.register_at_fork(after_in_child=lambda: signal.set_wakeup_fd(-1))
        _thread.start_new_thread(_watch, (heard,))


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


def _watch(heard: int) -> None:
    """End the program after an interrupt that it cannot answer, because it is in C.

    Python writes the number of each signal into `heard` at once, wherever the program is.
    """
    while signals := os.read(heard, 1):
        if signals[0] != signal.SIGINT:
            continue
        time.sleep(_PATIENCE)
        # Whoever answers interrupts in another way, such as a server, does so in its own time.
        if not _asked and signal.getsignal(signal.SIGINT) is _interrupt:
            os.write(2, _SHOW_CURSOR + b"\nInterrupted.\n" if os.isatty(2) else b"Interrupted.\n")
            os._exit(INTERRUPTED)
