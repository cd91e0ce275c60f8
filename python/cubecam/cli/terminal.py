"""Standard output and standard error of the command: a closed pipe and a full disk end it without a traceback."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from typing import NoReturn, TextIO, TypeVar

__all__ = ["guard_streams"]

#: What a shell reports for a program that SIGPIPE ended: 128 and the signal's number.
CLOSED_PIPE = 141

Stream = TypeVar("Stream", bound=io.TextIOWrapper)


def guard_streams() -> Callable[[], None]:
    """Replace `sys.stdout` and `sys.stderr`; return the function to call at the end, which writes what is left."""
    output, messages = _replaced(sys.stdout, _Output), _replaced(sys.stderr, _Messages)
    # The old streams have lost their buffers; a view in the terminal writes to `sys.__stdout__`.
    if sys.__stdout__ is sys.stdout:
        sys.__stdout__ = output  # type: ignore[misc, assignment]
    if sys.__stderr__ is sys.stderr:
        sys.__stderr__ = messages  # type: ignore[misc, assignment]
    sys.stdout, sys.stderr = output, messages

    def finish() -> None:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()

    return finish


class _Output(io.TextIOWrapper):
    """Standard output: the command ends when it cannot be written."""

    def write(self, text: str) -> int:
        try:
            return super().write(text)
        except OSError as error:
            _end(self, error)

    def flush(self) -> None:
        try:
            super().flush()
        except OSError as error:
            _end(self, error)


class _Messages(io.TextIOWrapper):
    """Standard error: messages that nobody can read do not change the exit code."""

    def write(self, text: str) -> int:
        try:
            return super().write(text)
        except OSError:
            _discard(self)
            return len(text)

    def flush(self) -> None:
        try:
            super().flush()
        except OSError:
            _discard(self)


def _end(stream: io.TextIOWrapper, error: OSError) -> NoReturn:
    _discard(stream)
    if isinstance(error, BrokenPipeError):
        raise SystemExit(CLOSED_PIPE) from None
    print(f"error: standard output: {error.strerror}", file=sys.stderr)
    raise SystemExit(1) from None


def _discard(stream: io.TextIOWrapper) -> None:
    """Send what is left in the buffers to nowhere: the interpreter writes it again at its end."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def _replaced(stream: TextIO, kind: type[Stream]) -> TextIO:
    """Make a stream of another kind on the same buffer; None (a closed descriptor) and streams of tests stay."""
    if not isinstance(stream, io.TextIOWrapper):
        return stream
    options = {
        "encoding": stream.encoding,
        "errors": stream.errors,
        "line_buffering": stream.line_buffering,
        "write_through": stream.write_through,
    }
    return kind(stream.detach(), **options)  # type: ignore[arg-type]
