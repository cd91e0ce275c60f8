"""Paths in, files out: the checks and the safe write that every loader and saver shares."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TypeAlias

PathLike: TypeAlias = str | os.PathLike[str]


def as_path(path: object) -> Path:
    """Turn a str or path object into a `Path`; anything else is a TypeError that says so."""
    if isinstance(path, (str, os.PathLike)):
        name = os.fspath(path)
        if isinstance(name, str):
            if not name:
                raise ValueError("expected a path, got an empty string")
            if "\0" in name:
                raise ValueError(f"expected a path, got a name with a zero byte: {name!r}")
            return Path(os.path.expanduser(name))  # noqa: PTH111 - pathlib raises for ~nobody
    raise TypeError(f"expected a path as str or os.PathLike, got {type(path).__name__}")


def existing_file(path: object) -> Path:
    """Check that a file is there and can be read.

    Raises
    ------
    FileNotFoundError, IsADirectoryError, PermissionError
        As `open` would, before a library gets the name and reports it as "unknown format".
    """
    found = as_path(path)
    with found.open("rb"):
        return found


@contextlib.contextmanager
def replacing(paths: Sequence[Path]) -> Iterator[list[Path]]:
    """Give temporary names to write to, which become `paths` together when the block ends well.

    Each temporary file is made at once, beside its target and with the same extension, so that a
    missing folder or a read-only one is an OSError before any work is done. On any exception,
    KeyboardInterrupt included, they are removed and the old files stay as they were.
    """
    # A link is written through, as `open` would: its target is replaced, not the link.
    targets = [Path(os.path.realpath(path)) for path in paths]
    temporaries: list[Path] = []
    try:
        for target in targets:
            if target.is_dir():
                raise IsADirectoryError(
                    errno.EISDIR, "expected a file to write, got a folder", str(target)
                )
            if not target.parent.is_dir():
                raise FileNotFoundError(
                    errno.ENOENT, "cannot write here, there is no such folder", str(target.parent)
                )
            temporary = target.with_name(
                f".{target.stem[:80]}-{secrets.token_hex(6)}{target.suffix}"
            )
            try:
                # O_EXCL: never somebody else's file. The mode leaves the rest to the umask.
                os.close(os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o666))
            except OSError as error:
                raise type(error)(
                    error.errno, f"cannot write: {error.strerror}", str(target)
                ) from None
            temporaries.append(temporary)
        yield list(temporaries)
        for temporary, target in zip(temporaries, targets, strict=True):
            os.replace(temporary, target)
    except BaseException:
        for temporary in temporaries:
            with contextlib.suppress(OSError):
                temporary.unlink()
        raise


def write_files(contents: dict[Path, bytes]) -> None:
    """Write whole files, all or (up to the instant of renaming) none."""
    with replacing(list(contents)) as temporaries:
        for temporary, data in zip(temporaries, contents.values(), strict=True):
            temporary.write_bytes(data)
