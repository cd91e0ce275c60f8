"""Safe writing of files: whole or not at all, with the mode and the owner of the file that was there."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

from .files import kind_of_file

# How long a writer waits for a reader of a FIFO, in seconds.
_PATIENCE = 2.0
# What a file system answers that has no files without a name.
_NO_UNNAMED = (errno.EOPNOTSUPP, errno.EISDIR, errno.EINVAL, errno.ENOENT)


@contextlib.contextmanager
def replacing(paths: Sequence[Path]) -> Iterator[list[Path]]:
    """Give names to write to; the files `paths` get the contents when the block ends without an error.

    On any exception, KeyboardInterrupt included, the old files stay as they were. On Linux the contents have no name in
    the folder until they are whole, so that a process that is killed leaves nothing behind.

    - A file that exists keeps its mode, its owner and its extended attributes. If the process may not give a new file
      that owner, or may not make files in that folder, the contents are written into the old file at the end.
    - If a path is a link, the file that it points to is replaced and not the link, as with `open`.
    - A character device or a FIFO gets the contents at the end. Any other thing that is no regular file is refused.

    Raises
    ------
    OSError
        Before any work is done if a folder does not exist or may not be written, or if a file is write-protected.
    """
    with contextlib.ExitStack() as stack:
        drafts = [stack.enter_context(_Draft(path)) for path in paths]
        yield [draft.name for draft in drafts]
        for draft in drafts:
            draft.deliver()


def write_files(contents: dict[Path, bytes]) -> None:
    """Write whole files: all of them, or none if an error occurs before the files get their names."""
    with replacing(list(contents)) as drafts:
        for draft, data in zip(drafts, contents.values(), strict=True):
            draft.write_bytes(data)


class _Draft:
    """Contents on their way to one target; `name` is the name to write to."""

    def __init__(self, path: Path) -> None:
        self._given = path
        # The file that is there, also behind /dev/stdout, whose real path is no path.
        try:
            self._old: os.stat_result | None = path.stat()
        except FileNotFoundError:
            self._old = None
        except OSError as error:
            raise _cannot_write(error, path) from None
        self._target = Path(os.path.realpath(path))
        self._named = False
        self._in_folder = False
        self._number = self._begin()
        if not self._named:
            self.name = Path(f"/proc/{os.getpid()}/fd/{self._number}")

    def __enter__(self) -> _Draft:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.close(self._number)
        if self._named:
            with contextlib.suppress(OSError):
                self.name.unlink()

    def _begin(self) -> int:
        """Open the draft: in the folder of the target, or, for what is written into at the end, elsewhere."""
        old, folder = self._old, self._target.parent
        if old is not None and not stat.S_ISREG(old.st_mode):
            if stat.S_ISFIFO(old.st_mode) or stat.S_ISCHR(old.st_mode):
                return self._elsewhere()
            error = IsADirectoryError if stat.S_ISDIR(old.st_mode) else OSError
            number = errno.EISDIR if stat.S_ISDIR(old.st_mode) else errno.EINVAL
            told = f"expected a file to write, got {kind_of_file(old.st_mode)}"
            raise error(number, told, str(self._target))
        if not folder.is_dir():
            raise FileNotFoundError(
                errno.ENOENT, "cannot write here, there is no such folder", str(folder)
            )
        if old is not None and not os.access(self._target, os.W_OK):
            raise _cannot_write(
                PermissionError(errno.EACCES, "the file is protected"), self._target
            )
        try:
            number = self._new_file(folder)
        except OSError as error:
            if old is not None and error.errno in (errno.EACCES, errno.EPERM):
                return self._elsewhere()
            raise _cannot_write(error, self._target) from None
        self._in_folder = True
        if old is not None and not _takes_after(number, self._target, old):
            self._in_folder = False
        return number

    def _new_file(self, folder: Path, mode: int = 0o666) -> int:
        # The umask limits the mode.
        if hasattr(os, "O_TMPFILE") and Path("/proc/self/fd").exists():
            try:
                return os.open(folder, os.O_TMPFILE | os.O_RDWR | os.O_CLOEXEC, mode)
            except OSError as error:
                if error.errno not in _NO_UNNAMED:
                    raise
        # O_EXCL never opens a file that exists.
        name = self._hidden_name(folder)
        number = os.open(name, os.O_CREAT | os.O_EXCL | os.O_RDWR | os.O_CLOEXEC, mode)
        self.name, self._named = name, True
        return number

    def _elsewhere(self) -> int:
        # Others may read the folder of temporary files.
        return self._new_file(Path(tempfile.gettempdir()), 0o600)

    def _hidden_name(self, folder: Path) -> Path:
        target = self._target
        return folder / f".{target.stem[:80]}-{secrets.token_hex(6)}{target.suffix}"

    def deliver(self) -> None:
        """Give the contents to the target."""
        if self._old is not None and not stat.S_ISREG(self._old.st_mode):
            with open(self._number, "rb", closefd=False) as draft, _opened(self._given) as device:
                draft.seek(0)
                shutil.copyfileobj(draft, device)
        elif not self._in_folder:
            with open(self._number, "rb", closefd=False) as draft:
                draft.seek(0)
                _overwrite(self._target, draft.read())
        else:
            if not self._named:
                self._give_name()
            os.replace(self.name, self._target)
            self._named = False

    def _give_name(self) -> None:
        # A link cannot take the place of a file, so the draft has a name of its own until `os.replace`.
        contents, name = self.name, self._hidden_name(self._target.parent)
        folder = os.open(name.parent, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        # Before there is a link: Ctrl-C right after os.link would leave it in the folder.
        self.name, self._named = name, True
        try:
            # With `src_dir_fd` Python calls linkat with AT_SYMLINK_FOLLOW: it links the file, not the name in /proc.
            os.link(contents, name, src_dir_fd=folder)
        finally:
            os.close(folder)


def _takes_after(number: int, target: Path, old: os.stat_result) -> bool:
    """Give an open file the owner, the attributes and the mode of another one; False if the owner is refused."""
    new = os.fstat(number)
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.fchown(number, old.st_uid, old.st_gid)
        except OSError:
            return False
    if hasattr(os, "listxattr"):
        # Not every file system has attributes, and some attributes belong to the system.
        with contextlib.suppress(OSError):
            for attribute in os.listxattr(target):
                with contextlib.suppress(OSError):
                    os.setxattr(number, attribute, os.getxattr(target, attribute))
    os.fchmod(number, stat.S_IMODE(old.st_mode))
    return True


def _overwrite(target: Path, data: bytes) -> None:
    """Write into a file; if that fails, for example on a full disk, the file gets its old contents back."""
    with target.open("r+b", buffering=0) as file:
        before = file.read()
        try:
            _put(file, data)
        except BaseException:
            _put(file, before)
            raise


def _put(file: BinaryIO, data: bytes) -> None:
    file.seek(0)
    left = memoryview(data)
    while left:
        left = left[file.write(left) :]
    file.truncate()


def _opened(path: Path) -> BinaryIO:
    """Open a device or a FIFO to write to; wait a while for the FIFO's reader."""
    end = time.monotonic() + _PATIENCE
    while True:
        try:
            number = os.open(path, os.O_WRONLY | os.O_CLOEXEC | os.O_NONBLOCK)
        except OSError as error:
            if error.errno != errno.ENXIO:
                raise _cannot_write(error, path) from None
            if time.monotonic() > end:
                told = f"cannot write: expected a reader of this FIFO within {_PATIENCE:g} s"
                raise OSError(error.errno, told, str(path)) from None
            time.sleep(0.01)
        else:
            os.set_blocking(number, True)
            return os.fdopen(number, "wb")


def _cannot_write(error: OSError, path: Path) -> OSError:
    return type(error)(error.errno, f"cannot write: {error.strerror}", str(path))
