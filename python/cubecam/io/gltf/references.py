"""What a glTF file refers to: data URIs, and files that lie below its own folder."""

from __future__ import annotations

import base64
import os
import re
from pathlib import Path
from urllib.parse import unquote_to_bytes

from ..._core import MeshError
from ..files import read_file
from .entries import shown

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.\-]*:")


def read_uri(uri: str, folder: Path) -> bytes:
    """Return the bytes that a URI stands for (section 2.8); errors do not name the entry that has the URI."""
    if uri[:5].lower() == "data:":
        return _data(uri)
    if _SCHEME.match(uri) or uri.startswith(("/", "\\")):
        raise MeshError(
            f"expected a data URI or a file below the folder of the glTF file, got {shown(uri)}"
        )
    try:
        decoded = os.fsdecode(unquote_to_bytes(uri))
    except UnicodeEncodeError:
        raise MeshError(f"expected a URI of characters, got {shown(uri)}") from None
    # Some programs write a name with a percent sign as it is, folders as Windows does, or what a server wants to know.
    path = os.fsdecode(unquote_to_bytes(re.split("[?#]", uri, maxsplit=1)[0]))
    choices = dict.fromkeys((decoded, uri, path, path.replace("\\", "/")))
    names = [name for name in choices if name and "\0" not in name]
    for name in names:
        found = _below(folder, name, uri)
        try:
            return read_file(found, MeshError)
        except FileNotFoundError:
            continue
        except OSError as error:
            raise MeshError(
                f"expected a file that can be read, got {shown(uri)}: {error.strerror}"
            ) from None
    raise MeshError(f"expected a file, got {shown(uri)}, which is not there")


def _below(folder: Path, name: str, uri: str) -> Path:
    """Find a file whose real path lies below the real path of the folder: links may not lead out."""
    root = os.path.realpath(folder)
    found = os.path.realpath(os.path.join(root, name))  # noqa: PTH118 - keeps what pathlib tidies
    if os.path.commonpath([root, found]) != root:
        raise MeshError(
            f"expected a file below the folder of the glTF file, got {shown(uri)}, which leads out"
        )
    return Path(found)


def _data(uri: str) -> bytes:
    """Read a data URI (RFC 2397)."""
    head, comma, body = uri[5:].partition(",")
    if not comma:
        raise MeshError(f"expected a data URI with a comma, got {shown(uri)}")
    try:
        data = unquote_to_bytes(body)
        if head.lower().rstrip().endswith(";base64"):
            data = b"".join(data.split())
            return base64.b64decode(data + b"=" * (-len(data) % 4), validate=True)
    except ValueError as error:
        raise MeshError(f"expected base64 in a data URI, got {shown(uri)}: {error}") from None
    return data
