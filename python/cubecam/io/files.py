"""Checks of paths, and reading of regular files, for all loaders and savers."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path
from typing import BinaryIO, TypeAlias

from .._checks import text_of
from .._core import FileError

PathLike: TypeAlias = str | os.PathLike[str]


def as_path(path: object) -> Path:
    """Turn a str or path object into a `Path`; raise TypeError for any other type."""
    if isinstance(path, (str, os.PathLike)):
        name = os.fspath(path)
        if isinstance(name, str):
            if not name:
                raise ValueError("expected a path, got an empty string")
            if "\0" in name:
                raise ValueError(f"expected a path, got a name with a zero byte: {text_of(name)}")
            return Path(os.path.expanduser(name))  # noqa: PTH111 - pathlib raises for ~nobody
    raise TypeError(f"expected a path as str or os.PathLike, got {type(path).__name__}")


def existing_file(path: object, error: type[FileError]) -> Path:
    """Check that a file is there, can be read, and is a regular file.

    Raises
    ------
    FileNotFoundError, IsADirectoryError, PermissionError
        As `open` raises them; without this check a library would report an "unknown format". If a sample has the name
        of a missing file, the error says where the sample is.
    FileError
        The class `error`, if there is something else than a regular file, for example a FIFO, which would be read
        without an end.
    """
    found = as_path(path)
    open_file(found, error).close()
    return found


def read_file(path: object, error: type[FileError]) -> bytes:
    """Read a whole file, with the checks of `existing_file`."""
    with open_file(as_path(path), error) as file:
        return file.read()


def open_file(found: Path, error: type[FileError]) -> BinaryIO:
    """Open a file to read, with the checks of `existing_file`."""
    return os.fdopen(_open_regular(found, error), "rb")


def _open_regular(found: Path, error: type[FileError]) -> int:
    # Without O_NONBLOCK, to open a FIFO waits until somebody writes to it. On a regular file it has no effect.
    try:
        number = os.open(found, os.O_RDONLY | os.O_CLOEXEC | os.O_NONBLOCK)
    except FileNotFoundError as missing:
        from ..data import find_sample

        sample = find_sample(found.name)
        if sample is None:
            raise
        told = f"{missing.strerror}; the sample file of this name is {str(sample)!r}"
        raise FileNotFoundError(missing.errno, told, str(found)) from None
    mode = os.fstat(number).st_mode
    if stat.S_ISREG(mode):
        return number
    os.close(number)
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(found))
    raise error(f"{found}: expected a regular file, got {kind_of_file(mode)}")


def kind_of_file(mode: int) -> str:
    """Name the kind of file that `st_mode` says, for messages."""
    kinds = {
        stat.S_IFDIR: "a folder",
        stat.S_IFIFO: "a FIFO",
        stat.S_IFCHR: "a character device",
        stat.S_IFBLK: "a block device",
        stat.S_IFSOCK: "a socket",
    }
    return kinds.get(stat.S_IFMT(mode), "something else")
