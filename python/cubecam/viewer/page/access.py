"""Who may see a page: an ASGI application that lets a request through only with the token, and from the page itself.

A page reaches into the program of the person who started it, so a stranger's request must reach nothing. Three kinds of
strangers are kept out: other users of the machine and other machines (they lack the token), web sites that the browser
shows elsewhere (their `Origin` differs), and web sites whose name was made to lead to this machine (their `Host`
differs).
"""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from http import HTTPStatus
from typing import Any, TypeAlias
from urllib.parse import parse_qs

from .resources import login_page

Scope: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send: TypeAlias = Callable[[MutableMapping[str, Any]], Awaitable[None]]
Application: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]

__all__ = ["Access", "Application", "Receive", "Scope", "Send", "answer", "refuse"]

_LONGEST_FORM = 4096  # bytes; a password and the name of its field
_WRONG_PASSWORD_WAIT = 1.0  # seconds; wrong passwords are answered one after the other

#: Sent with every answer. The page is shown in no frame, is kept in no cache, and tells its address to nobody.
_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"cache-control", b"no-store"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)
# "self" stands for a websocket of the same host in new browsers only, hence the second source of connect-src.
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; "
    "connect-src 'self' ws://{host}; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
)


async def answer(
    scope: Scope,
    send: Send,
    status: int,
    body: bytes = b"",
    content_type: str = "text/plain; charset=utf-8",
    headers: Iterable[tuple[bytes, bytes]] = (),
    referrer: bytes = b"no-referrer",
) -> None:
    """Send a whole answer over HTTP, with the headers that every answer has."""
    host = _only(scope, b"host") or b""
    policy = _POLICY.format(host=host.decode("latin-1")) if scope.get("cubecam.host") else ""
    sent = [
        (b"content-type", content_type.encode()),
        (b"content-length", str(len(body)).encode()),
        (b"content-security-policy", policy.encode() or b"default-src 'none'"),
        (b"referrer-policy", referrer),
        *_HEADERS,
        *headers,
    ]
    await send({"type": "http.response.start", "status": status, "headers": sent})
    await send(
        {"type": "http.response.body", "body": b"" if scope.get("method") == "HEAD" else body}
    )


async def refuse(scope: Scope, receive: Receive, send: Send, status: int = 403) -> None:
    """Answer with an error that says nothing of what there is; a websocket is closed before it opens."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008})
    elif scope["type"] == "http":
        await answer(scope, send, status, f"{status} {HTTPStatus(status).phrase}\n".encode())


class Access:
    """Let a request through to `application` if its token, Host, Origin and, where one is set, its password are right.

    The address of a request is ``/TOKEN/ID/NAME``. The application gets the last two as ``scope["cubecam.path"]``,
    bytes as they were sent: nothing is decoded, so that no encoded form means anything.

    Parameters
    ----------
    application : callable
        An ASGI application.
    token : str
        The secret in each address.
    hosts : iterable of str
        The names under which the server is reached, each with its port: "127.0.0.1:8000".
    password : str, optional
        Also wanted, by a form, before anything else is shown.
    """

    def __init__(
        self,
        application: Application,
        token: str,
        hosts: Iterable[str],
        password: str | None = None,
    ) -> None:
        self._application = application
        self._token = token.encode()
        self._hosts = frozenset(host.lower().encode() for host in hosts)
        self._origins = frozenset(b"http://" + host for host in self._hosts)
        self._password = None if password is None else password.encode()
        self._session = secrets.token_urlsafe(32).encode()
        port = next(iter(self._hosts)).rpartition(b":")[2]
        self._cookie = b"cubecam-" + port  # cookies know no port, so that the name has it
        self._one_at_a_time = asyncio.Lock()

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request, or refuse it."""
        if scope["type"] not in ("http", "websocket"):
            return
        path = self._allowed_path(scope)
        if path is None:
            await refuse(scope, receive, send)
        elif self._password is not None and not self._has_session(scope):
            await self._log_in(scope, receive, send, path)
        elif scope["type"] == "http" and scope["method"] not in ("GET", "HEAD"):
            await refuse(scope, receive, send, 405)
        else:
            scope["cubecam.path"] = path
            await self._application(scope, receive, send)

    def _allowed_path(self, scope: Scope) -> list[bytes] | None:
        """Return the parts of the path after the token; None for a request that has no business here."""
        raw = scope.get("raw_path")
        _, token, *rest = (raw if isinstance(raw, bytes) else b"").split(b"/") + [b""] * 2
        # Every rule is checked, whatever the others found, so that the time says nothing either.
        known = secrets.compare_digest(token, self._token)
        host, origin = _only(scope, b"host"), _only(scope, b"origin")
        named = host is not None and host.lower() in self._hosts
        same = origin is not None and origin.lower() in self._origins
        if scope["type"] == "http" and _count(scope, b"origin") == 0:
            same = True  # a browser sends no Origin when a person opens an address
        if not (known and named and same):
            return None
        scope["cubecam.host"] = host
        return rest[:-2]

    def _has_session(self, scope: Scope) -> bool:
        found = False
        for name, value in scope["headers"]:
            if name == b"cookie":
                for pair in value.split(b";"):
                    key, _, text = pair.strip().partition(b"=")
                    if key == self._cookie:
                        found |= secrets.compare_digest(text, self._session)
        return found

    async def _log_in(self, scope: Scope, receive: Receive, send: Send, path: list[bytes]) -> None:
        """Show the form, or read what was written into it."""
        page = scope["type"] == "http" and scope["raw_path"].endswith(b"/")
        if scope["type"] == "http" and path[1:] in ([b"page.css"], [b"icon.svg"]):
            scope["cubecam.path"] = path  # what the form looks like
            await self._application(scope, receive, send)
            return
        if not page or scope["method"] not in ("GET", "HEAD", "POST"):
            await refuse(scope, receive, send)
            return
        wrong = False
        if scope["method"] == "POST":
            async with self._one_at_a_time:
                if await self._is_password(receive):
                    place = b"/" + self._token + b"/"
                    cookie = self._cookie + b"=" + self._session
                    rules = b"; HttpOnly; SameSite=Strict; Path=" + place
                    headers = ((b"set-cookie", cookie + rules), (b"location", scope["raw_path"]))
                    await answer(scope, send, 303, headers=headers)
                    return
                await asyncio.sleep(_WRONG_PASSWORD_WAIT)
            wrong = True
        # With "no-referrer" a browser sends a form with the Origin "null".
        await answer(
            scope,
            send,
            401 if wrong else 200,
            login_page(wrong),
            "text/html; charset=utf-8",
            referrer=b"same-origin",
        )

    async def _is_password(self, receive: Receive) -> bool:
        body = b""
        while len(body) <= _LONGEST_FORM:
            message = await receive()
            if message["type"] != "http.request":
                return False
            body += message.get("body", b"")
            if not message.get("more_body"):
                break
        fields = parse_qs(body[:_LONGEST_FORM].decode("utf-8", "replace"), keep_blank_values=True)
        written = fields.get("password", [""])[0].encode("utf-8", "replace")
        return secrets.compare_digest(written, self._password or b"") and bool(self._password)


def _count(scope: Scope, name: bytes) -> int:
    return sum(key == name for key, _ in scope["headers"])


def _only(scope: Scope, name: bytes) -> bytes | None:
    """Return the value of a header that must be there once; None if it is missing or repeated."""
    values = [value for key, value in scope["headers"] if key == name]
    return values[0] if len(values) == 1 else None
