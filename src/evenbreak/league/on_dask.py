"""A dask cluster as an executor: it does the work of a lost worker again.

What all pieces share goes to the cluster once, as the result of a task: the scheduler keeps how it
is made, so that it is made anew where the worker that held it is gone. (What is scattered is lost
with its worker.)
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from itertools import count
from threading import Thread
from typing import TYPE_CHECKING, Any, TypeVar

from evenbreak.errors import InputError, WorkerError

if TYPE_CHECKING:
    import distributed

Value = TypeVar("Value")

_PATIENCE = 8.0
"""Seconds within which a scheduler answers, and within which it has a worker."""

_ABSENCE = 60.0
"""Seconds that a cluster may be without a worker, or out of reach, in the middle of the work."""

_RETRIES = 3
"""How often a piece that raised is tried again. (That of a lost worker is given out again.)"""

_LOGGERS = ("distributed", "distributed.client", "distributed.core", "tornado.application")


class DaskExecutor(Executor):
    """The workers of a dask cluster, as a `concurrent.futures.Executor`.

    Parameters
    ----------
    cluster
        the scheduler's address, such as ``tcp://10.0.0.5:8786``; or a `distributed.Client`, which
        stays open when the executor is shut down.

    Attributes
    ----------
    workers
        number of pieces that the cluster does at once, as it was when we connected.

    Raises
    ------
    InputError
        if dask is not installed.
    WorkerError
        if nothing answers at the address within some seconds, or the scheduler has no worker.

    Notes
    -----
    The workers need the same versions of this package and of numpy as this process. The log of
    `distributed` in this process is silenced: its lines are no answer, and what is lost is raised.

    >>> DaskExecutor("nowhere")  # doctest: +SKIP
    Traceback (most recent call last):
    ...
    evenbreak.errors.WorkerError: no dask scheduler answers at 'nowhere'; ...
    """

    def __init__(self, cluster: str | distributed.Client) -> None:
        self._own = isinstance(cluster, str)
        client: Any = _connected(cluster) if isinstance(cluster, str) else cluster
        self._client = client
        self._name = f"the dask cluster at {client.scheduler.address}"
        try:
            self._client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            self.shutdown()
            raise WorkerError(
                f"{self._name} has no worker; start one or more with `dask worker ADDRESS`"
            ) from None
        self._inner: Executor = self._client.get_executor(pure=False, retries=_RETRIES)
        self._given = count()
        self._seen = time.monotonic()
        self.workers = sum(self._client.nthreads().values())

    def submit(self, fn: Callable[..., Value], /, *args: Any, **kwargs: Any) -> Future[Value]:
        """Give out a call; what `share` returned may be among its arguments."""
        # What is given out first is done first: left to itself, dask takes any of the last ones.
        return self._inner.submit(fn, *args, priority=-next(self._given), **kwargs)

    def share(self, value: Value) -> Value:
        """Send a value to the cluster once, and return what stands for it in `submit`."""
        import dask

        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 PiB"}):
            held: Value = self._client.submit(_same, value, pure=False)
        return held

    def look(self) -> None:
        """Raise `WorkerError` if the cluster has been without workers, or away, for too long."""
        try:
            there = self._client.status == "running" and bool(self._client.nthreads())
        except (OSError, TimeoutError):
            there = False
        now = time.monotonic()
        if there:
            self._seen = now
        elif now - self._seen > _ABSENCE:
            raise WorkerError(
                f"{self._name} has had no worker in reach for {_ABSENCE:.0f} s; start workers, and "
                "ask again"
            )

    @contextmanager
    def losses_told(self) -> Iterator[None]:
        """Raise `WorkerError` for what dask raises where workers or their scheduler are lost."""
        from distributed import KilledWorker

        try:
            yield
        except KilledWorker as error:
            raise WorkerError(
                f"one piece of work ended several workers of {self._name}; give the workers more "
                "memory, or ask for smaller seasons"
            ) from error
        except (CancelledError, OSError) as error:
            raise WorkerError(
                f"{self._name} is gone; start it anew, and ask again ({type(error).__name__})"
            ) from error
        except Exception as error:
            if not _tells_of_import(error):
                raise
            raise WorkerError(
                f"{self._name} cannot load what it is to do; install the same version of evenbreak "
                f"for the scheduler and each worker ({error})"
            ) from error

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:  # noqa: ARG002
        """Disconnect, if it was we who connected: the cluster drops what was given out.

        Whatever is asked, nothing is waited for: a remote worker ends its piece by itself.
        """
        if self._own:
            self._client.close()


def _connected(address: str) -> Any:
    try:
        import distributed
    except ImportError:
        raise InputError(
            "a dask cluster needs distributed, which is not installed; install it with: "
            "pip install distributed (the extra evenbreak[dask]), or ask for jobs"
        ) from None
    for name in _LOGGERS:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    connect: Any = distributed.Client
    answer: Future[Any] = Future()

    def ask() -> None:
        try:
            answer.set_result(connect(address, timeout=_PATIENCE, set_as_default=False))
        except BaseException as error:
            answer.set_exception(error)

    # The client's own timeout does not end its wait for one that accepts and says nothing.
    Thread(target=ask, daemon=True).start()
    try:
        return answer.result(timeout=_PATIENCE + 1)
    except Exception:  # whatever it is, we are not connected
        raise WorkerError(
            f"no dask scheduler answers at {address!r}; give the address that `dask scheduler` "
            f"prints, such as tcp://10.0.0.5:8786"
        ) from None


def _tells_of_import(error: BaseException | None) -> bool:
    """Tell if an error comes of a module or a name that the cluster does not have."""
    while error is not None:
        if isinstance(error, ImportError) or "deserializ" in str(error):
            return True
        error = error.__cause__ or error.__context__
    return False


def _same(value: Value) -> Value:
    return value
