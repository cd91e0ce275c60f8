"""Checks of paths, and safe writing of files, for all loaders and savers."""

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
    """Turn a str or path object into a `Path`; raise TypeError for any other type."""
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
        As `open` raises them; without this check a library would report an "unknown format". If a sample has the name
        of a missing file, the error says where the sample is.
    """
    found = as_path(path)
    try:
        with found.open("rb"):
            return found
    except FileNotFoundError as error:
        from ..data import find_sample

        sample = find_sample(found.name)
        if sample is None:
            raise
        told = f"{error.strerror}; the sample file of this name is {str(sample)!r}"
        raise FileNotFoundError(error.errno, told, str(found)) from None


@contextlib.contextmanager
def replacing(paths: Sequence[Path]) -> Iterator[list[Path]]:
    """Give temporary names to write to; the files get the names `paths` when the block ends without an error.

    Each temporary file is made at once, beside its target and with the same extension, so that a
    missing folder or a read-only one is an OSError before any work is done. On any exception,
    KeyboardInterrupt included, the temporary files are removed and the old files stay as they were.
    """
    # If a path is a link, the file that it points to is replaced and not the link, as with `open`.
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
                # O_EXCL never opens a file that exists. The umask limits the mode.
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
    """Write whole files: all of them, or none if an error occurs before the files are renamed."""
    with replacing(list(contents)) as temporaries:
        for temporary, data in zip(temporaries, contents.values(), strict=True):
            temporary.write_bytes(data)
