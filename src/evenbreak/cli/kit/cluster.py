"""A dask cluster that does the work of a command."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from threading import Thread
from typing import TYPE_CHECKING, Any

from evenbreak.errors import EvenbreakError, InputError, WorkerError

if TYPE_CHECKING:
    import distributed

_PATIENCE = 8.0
"""Seconds within which a scheduler must answer, and within which it must have a worker."""


@contextmanager
def cluster_at(address: str | None) -> Iterator[distributed.Client | None]:
    """Connect to a dask cluster; None where there is no address.

    An InputError if dask is not installed; a WorkerError if no scheduler answers, or it has no
    worker, and in the block, for whatever dask raises.
    """
    if address is None:
        yield None
        return
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "a dask cluster needs distributed, which isn't installed. Install it with: "
            "pip install distributed (the extra evenbreak[dask]), or use --jobs."
        ) from None
    # What goes wrong is raised; its log would only repeat it.
    for name in ("distributed", "tornado.application"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    answered: Future[distributed.Client] = Future()
    start: Any = Client

    def connect() -> None:
        try:
            answered.set_result(start(address, timeout=_PATIENCE, set_as_default=False))
        except Exception as error:
            answered.set_exception(error)

    # The client's own timeout does not end its wait for a port that accepts and never answers.
    Thread(target=connect, daemon=True).start()
    try:
        client = answered.result(_PATIENCE + 1.0)
    except Exception:
        raise WorkerError(
            f"no dask scheduler answers at {address!r}. Give the address that `dask "
            "scheduler` prints, such as tcp://10.0.0.5:8786."
        ) from None
    with client:
        try:
            client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            raise WorkerError(
                f"the dask cluster at {address} has no worker. Start one or more with "
                "`dask worker ADDRESS`."
            ) from None
        try:
            yield client
        except EvenbreakError:
            raise
        except Exception as error:
            raise WorkerError(
                f"the dask cluster at {address} didn't finish the work: {error} "
                f"({type(error).__name__}); it needs the same versions of evenbreak and "
                "numpy as this computer, and enough memory"
            ) from error
