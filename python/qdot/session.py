"""Calls of the library: one at a time for each system, with Ctrl-C, and nothing freed under way.

A `Session` is a qdot_system with its lock. It lives as long as the `System` that made it or a motion
of it. What belongs to it is freed under the lock by a thread of its own: garbage collection may come at
any moment and in any thread, so all that it does is to put what is to be freed in a queue.

In the main thread a computation is carried out by a thread of its own while the main thread waits, for
Python handles Ctrl-C only between two instructions of the main thread.
"""

from __future__ import annotations

import atexit
import collections
import os
import queue
import sys
import threading
import time
import warnings
import weakref
from ctypes import byref, c_void_p
from typing import Any, Callable, Deque, Dict, Generic, List, Optional, Tuple, TypeVar

from .errors import Error, Notice, error_of
from .library import Library, ProgressHook, load

T = TypeVar("T")
Hook = Callable[[str, float, Optional[float]], object]

# --- a computation in a thread of its own -----------------------------------------------


# How often a waiting main thread hears signals that did not wake it. Seconds.
_LISTEN = 0.05


class _Job(Generic[T]):
    """One call: it is claimed once, by the worker or by who gives it up, then finished."""

    def __init__(self, body: Callable[[], T]) -> None:
        self.body: Optional[Callable[[], T]] = body
        self.value: Optional[T] = None
        self.error: Optional[BaseException] = None
        self.finished = False
        self.claim = threading.Lock()
        self.done = threading.Lock()
        self.done.acquire()

    def carry_out(self) -> None:
        body, self.body = self.body, None
        try:
            if body is not None:
                self.value = body()
        except BaseException as error:
            self.error = error
        del body

    def finish(self) -> None:
        self.finished = True
        self.done.release()

    def wait(self, timeout: float) -> None:
        if not self.finished:
            self.done.acquire(timeout=timeout)


class _Worker(threading.Thread):
    """A thread that carries out one job after the other; daemon: it keeps no interpreter alive."""

    def __init__(self) -> None:
        super().__init__(name="qdot", daemon=True)
        self.job: Optional[_Job[Any]] = None
        self.wake = threading.Lock()
        self.wake.acquire()

    def give(self, job: _Job[Any]) -> None:
        self.job = job
        self.wake.release()

    def run(self) -> None:
        while True:
            self.wake.acquire()
            job, self.job = self.job, None
            if job is None:
                continue
            mine = job.claim.acquire(blocking=False)
            if mine:
                job.carry_out()
            _idle.append(self)
            if mine:
                job.finish()
            del job


_idle: List[_Worker] = []
_closing = False


def _in_main_thread() -> bool:
    return threading.current_thread() is threading.main_thread()


def _carry_out(body: Callable[[], T], interrupt: Callable[[], None]) -> T:
    """Return what body() returns; in the main thread an exception of a signal handler stops it."""
    if _closing or not _in_main_thread():
        return body()
    job = _Job(body)
    try:
        if _idle:
            worker = _idle.pop()
        else:
            worker = _Worker()
            worker.start()
        worker.give(job)
        while not job.finished:  # a signal may come just before the wait, or to another thread
            job.wait(_LISTEN)
    except BaseException as stopped:
        if not job.claim.acquire(blocking=False):
            _stop(job, interrupt)
            for name in "motion", "answers":  # what there was of it is at the exception
                if isinstance(job.error, Error):
                    setattr(stopped, name, getattr(job.error, name))
        job.error = None
        raise
    try:
        if job.error is not None:
            raise job.error
        return job.value  # type: ignore[return-value]
    finally:
        job.error = None  # no circle of exception, frame and job


def _stop(job: _Job[Any], interrupt: Callable[[], None]) -> None:
    """Interrupt the job, which may just begin, until it ends, also if there are more signals."""
    while not job.finished:
        try:
            interrupt()
            job.wait(_LISTEN)
        except BaseException:  # the first one is raised, when the job has ended
            continue


# --- a system and its lock --------------------------------------------------------------

_sessions: weakref.WeakSet[Session] = weakref.WeakSet()


class Session:
    """A qdot_system that is called by one thread at a time.

    Parameters of `call` and `look` are functions without arguments, which call the library and return
    what is wanted of it.
    """

    def __init__(self) -> None:
        self.library: Library = load()
        self.process = os.getpid()
        self.handle = c_void_p()
        result = self.library.qdot_system_new(byref(self.handle))
        if result != 0:
            raise error_of(result, self.library.qdot_result_text(result).decode())
        self.changes = 0  # how many calls may have changed the scene
        self._told: Optional[Hook] = None
        self._hook: Any = None  # the library calls it: it must live as long as it may
        self._hook_failures: List[BaseException] = []
        self._lock = threading.Lock()
        self._garbage: Deque[_Belonging] = collections.deque()  # to be freed when the lock is
        self._callers: Tuple[int, ...] = ()  # the threads of the call under way
        self.keep(self, self.library.qdot_system_free, self.handle)
        _sessions.add(self)

    def call(self, body: Callable[[], T], noted: bool = True) -> T:
        """Compute: Ctrl-C stops it; notices become warnings if `noted`."""

        def computed() -> Tuple[T, str]:
            self._hook_failures.clear()
            self._callers += (threading.get_ident(),)
            value = body()
            return value, self.library.qdot_system_notices(self.handle).decode()

        try:
            value, notices = self._alone(lambda: _carry_out(computed, self.interrupt))
        except (Error, NotImplementedError) as error:
            error.__traceback__ = None  # what the user called, not what was called in here
            raise (self._hook_failures or [error])[0]
        if self._hook_failures:
            raise self._hook_failures[0]
        for notice in notices.splitlines() if noted else ():
            warn(notice)
        return value

    def look(self, body: Callable[[], T]) -> T:
        """Read what is there already: no computation."""
        return self._alone(body)

    def check(self, result: int) -> None:
        """Raise what the last call on the system did wrong."""
        self.library.check(result, self.handle)

    def interrupt(self) -> None:
        """Stop the call under way, if there is one."""
        if self._callers and self.process == os.getpid():
            self.library.qdot_system_interrupt(self.handle)

    def hook_set(self, hook: Optional[Hook]) -> Optional[Hook]:
        """Set the progress hook, None: none; return the one that there was."""
        before, self._told = self._told, hook
        if hook is None:
            self.check(self.library.qdot_system_progress(self.handle, ProgressHook(0), None))
            self._hook = None
            return before
        call, system = hook, self.handle  # not the session: it would hold itself

        def told(_: Any, what: bytes, done: float, left: float) -> None:
            try:
                call(what.decode(), done, None if left != left else left)
            except BaseException as error:
                failures.append(error)
                interrupt(system)

        interrupt = self.library.qdot_system_interrupt
        failures: List[BaseException] = self._hook_failures
        made = ProgressHook(told)
        self.check(self.library.qdot_system_progress(self.handle, made, None))
        self._hook = made
        return before

    def keep(self, owner: object, free: Callable[[c_void_p], None], handle: c_void_p) -> None:
        """Have what belongs to the system freed when `owner`, which holds this session, is collected."""
        belonging = _Belonging(owner, _gone.put)
        belonging.free, belonging.handle = free, handle
        belonging.lock, belonging.garbage = self._lock, self._garbage
        _belongings[id(belonging)] = belonging
        _reaper_start()

    def _alone(self, body: Callable[[], T]) -> T:
        if self.process != os.getpid():
            raise RuntimeError(
                "this system belongs to the process from which this one was forked: start processes "
                "by multiprocessing.get_context('spawn') and make the system there"
            )
        me = threading.get_ident()
        if me in self._callers and self._lock.locked():
            raise RuntimeError("the system is computing: a signal handler or hook cannot ask it")
        _park_if_closing()
        try:
            with self._lock:
                self._callers = (me,)
                try:
                    value = body()
                finally:
                    self._callers = ()
                    _free(self._garbage)
            _try_to_free(self._lock, self._garbage)
        finally:
            _park_if_closing()
        return value


def warn(notice: str) -> None:
    """Warn at the line outside of this package that made the call."""
    level, frame = 1, sys._getframe()
    package = __name__.partition(".")[0]
    while frame.f_back is not None and frame.f_globals.get("__package__") == package:
        frame = frame.f_back
        level += 1
    prefix = "notice: "
    text = notice[len(prefix):] if notice.startswith(prefix) else notice
    warnings.warn(text, Notice, stacklevel=level)


# --- what is collected ------------------------------------------------------------------


class _Belonging(weakref.ref[object]):
    """A reference to an owner of something of the library's, with how that is freed."""

    __slots__ = "free", "handle", "lock", "garbage"
    free: Callable[[c_void_p], None]
    handle: c_void_p
    lock: threading.Lock
    garbage: Deque[_Belonging]


_belongings: Dict[int, _Belonging] = {}
# its put() is no Python: nothing can come between, neither Ctrl-C nor another collection
_gone: queue.SimpleQueue[Any] = queue.SimpleQueue()
_freeing = threading.Lock()
_reaper: Optional[threading.Thread] = None


def _reap() -> None:
    while True:
        belonging = _gone.get()
        _belongings.pop(id(belonging), None)
        lock, garbage = belonging.lock, belonging.garbage
        garbage.append(belonging)
        del belonging
        _try_to_free(lock, garbage)


def _free(garbage: Deque[_Belonging]) -> None:
    """Free what is in the queue of a system whose lock the caller has."""
    while garbage:
        belonging = garbage.popleft()
        belonging.free(belonging.handle)


def _try_to_free(lock: threading.Lock, garbage: Deque[_Belonging]) -> None:
    """Free it, unless a call is under way, which does so at its end, or the process ends."""
    while garbage and not _closing:
        with _freeing:
            if not lock.acquire(blocking=False):
                return
            try:
                _free(garbage)
            finally:
                lock.release()


def _reaper_start() -> None:
    """Start the thread that frees; where it lags behind, wait for it."""
    global _reaper
    if _reaper is None:
        _reaper = threading.Thread(target=_reap, name="qdot garbage", daemon=True)
        _reaper.start()
    for _ in range(100):
        if _gone.qsize() < 8:
            break
        time.sleep(0.001)


# --- the end of the process -------------------------------------------------------------


def _park_if_closing() -> None:
    """Let a daemon thread stay here while the interpreter ends, and the thread with it."""
    while _closing and not _in_main_thread():
        time.sleep(3600)


@atexit.register
def _close() -> None:
    """Stop what daemon threads compute, so that the library is not at work while the process ends."""
    global _closing
    _closing = True
    limit = time.monotonic() + 5
    for session in list(_sessions):
        if session.process != os.getpid():
            continue
        while not session._lock.acquire(blocking=False):
            session.interrupt()
            if time.monotonic() > limit:
                return
            time.sleep(0.01)
        session._lock.release()
    _freeing.acquire(timeout=5)  # for ever: nothing is freed by other threads any more


def _forked() -> None:
    """In a child after fork(): threads of the parent are not here, and nothing is to be freed."""
    global _freeing
    _idle.clear()
    _freeing = threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forked)
