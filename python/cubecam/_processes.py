"""Other Python processes that work for this one: how they start, how they get messages, and how they end.

They are plain processes that read from a socket, not those of `multiprocessing`: these would run the user's script
again in each of them, unless it is written for that. They end when the socket does, however this process ends.
"""

from __future__ import annotations

import array
import fcntl
import importlib
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterable, Mapping
from contextlib import suppress

__all__ = ["Channel", "Process", "ending_of", "interpreter", "leave_signals_to_others", "run"]

_SIZE = struct.Struct("<Q")
_MOST_DESCRIPTORS = 4

#: Signals that a thread needs, since they tell what it did itself.
_OWN_SIGNALS = {signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGABRT}

_START = (
    "import sys; sys.path[:] = {path!r}; "
    "from cubecam._processes import run; run({function!r}, {number})"
)


def interpreter() -> str | None:
    """Find the program that runs Python: None in a frozen program or where `sys.executable` is empty."""
    return None if getattr(sys, "frozen", False) else sys.executable or None


class Channel:
    """Messages of bytes to and from another process, with file descriptors."""

    def __init__(self, end: socket.socket) -> None:
        self._end = end

    def send(self, message: bytes | memoryview, descriptors: Iterable[int] = ()) -> None:
        """Send a message; nothing if the other process has ended, which `receive` notices."""
        head = _SIZE.pack(len(message))
        numbers = array.array("i", descriptors)
        rights = [(socket.SOL_SOCKET, socket.SCM_RIGHTS, numbers)] if numbers else []
        with suppress(BrokenPipeError, ConnectionResetError):
            sent = self._end.sendmsg([head], rights)  # a descriptor travels with the first byte
            self._end.sendall(head[sent:])
            self._end.sendall(message)

    def receive(self) -> tuple[bytearray, list[int]] | None:
        """Wait for a message and its descriptors; None if the other process has ended."""
        numbers: list[int] = []
        try:
            head = self._read(_SIZE.size, numbers)
            message = None if head is None else self._read(_SIZE.unpack(head)[0], None)
        except OSError:  # reset, or closed by another thread
            message = None
        if message is None:
            for number in numbers:
                os.close(number)
            return None
        return message, numbers

    def _read(self, size: int, numbers: list[int] | None) -> bytearray | None:
        data = bytearray(size)
        rest = memoryview(data)
        room = socket.CMSG_LEN(_MOST_DESCRIPTORS * 4)
        while rest:
            if numbers is None:
                got = self._end.recv_into(rest)
            else:
                got, rights, _, _ = self._end.recvmsg_into(
                    [rest], room, getattr(socket, "MSG_CMSG_CLOEXEC", 0)
                )
                for _, kind, given in rights:
                    if kind == socket.SCM_RIGHTS:
                        whole = array.array("i")
                        whole.frombytes(given[: len(given) - len(given) % whole.itemsize])
                        numbers.extend(whole)
            if not got:
                return None
            rest = rest[got:]
        return data

    def close(self) -> None:
        """Let the other process end."""
        with suppress(OSError):
            self._end.close()


class Process:
    """A Python process that runs a function of cubecam with a `Channel` to this one.

    Parameters
    ----------
    function : str
        "cubecam.module:function".
    environment : mapping of str to str
        Variables of the environment, besides those of this process.
    owner, instead : str
        What an error names first, and what it says at its end.

    Raises
    ------
    RuntimeError
        If this program has no interpreter that could be started.
    """

    def __init__(
        self, function: str, environment: Mapping[str, str], *, owner: str, instead: str
    ) -> None:
        program = interpreter()
        if program is None:
            raise RuntimeError(
                f"{owner}: expected sys.executable to name the Python of other processes, got "
                f"{sys.executable!r} in {'a frozen' if hasattr(sys, 'frozen') else 'this'} program; "
                f"{instead}"
            )
        path = [each for each in sys.path if isinstance(each, str)]  # Python ignores all else
        here, there = (_beyond_streams(end) for end in socket.socketpair())
        with there:
            try:
                number = there.fileno()
                self._process = subprocess.Popen(
                    [program, "-c", _START.format(path=path, function=function, number=number)],
                    stdin=subprocess.DEVNULL,
                    pass_fds=[number],
                    start_new_session=True,  # Ctrl-C is for this process alone
                    env={**os.environ, **environment},
                )
            except BaseException:
                here.close()
                raise
        self.channel = Channel(here)

    @property
    def lives(self) -> bool:
        """bool: whether the process has not ended."""
        return self._process.poll() is None

    @property
    def pid(self) -> int:
        """int: the process's number."""
        return self._process.pid

    def kill(self) -> None:
        """End the process; who waits for its message gets None."""
        self._process.kill()

    def end(self) -> int:
        """End the process, and give its status; negative: the signal that ended it."""
        self._process.kill()
        self.channel.close()
        return self._process.wait()

    def status(self) -> int:
        """Wait for the end of a process whose channel has ended, and give its status."""
        try:
            return self._process.wait(5)
        except subprocess.TimeoutExpired:  # it has closed its end, and lives
            return self.end()

    def abandon(self) -> None:
        """In a forked process: the process belongs to the parent."""
        self.channel.close()
        self._process.returncode = 0  # nothing here may wait for it


def ending_of(status: int) -> str:
    """Say how a process ended: "SIGKILL" or "the status 1"."""
    if status >= 0:
        return f"the status {status}"
    try:
        return signal.Signals(-status).name
    except ValueError:
        return f"the signal {-status}"


def leave_signals_to_others() -> None:
    """Block signals in this thread: one that the system gives to it would end no wait of the main thread."""
    signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals() - _OWN_SIGNALS)


def run(function: str, number: int) -> None:
    """Be the other process: call a function with the channel."""
    signal.pthread_sigmask(signal.SIG_SETMASK, [])  # not those of the thread that started it
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end = socket.socket(fileno=number)
    end.set_inheritable(False)
    module, _, name = function.partition(":")
    getattr(importlib.import_module(module), name)(Channel(end))


def _beyond_streams(end: socket.socket) -> socket.socket:
    """Give a socket a number above those of the streams, which a program may have closed."""
    if end.fileno() > 2:
        return end
    with end:
        return socket.socket(fileno=fcntl.fcntl(end.fileno(), fcntl.F_DUPFD_CLOEXEC, 3))
