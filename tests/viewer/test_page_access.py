"""What a page refuses: nothing is served without the token, to a foreign host or site, or from the disk."""

import socket
import time
from urllib.parse import urlencode, urlsplit

import pytest
from websockets.exceptions import InvalidHandshake, InvalidStatus

from cubecam.viewer.page.access import Access
from cubecam.viewer.page.resources import resources
from cubecam.viewer.page.server import PageServer
from tests.viewer.pages import TinyView, get, open_socket, receive, resize

NAMES = ["", "page.js", "panel.js", "page.css", "icon.svg", "renderview.js"]


@pytest.fixture(scope="module")
def page():
    """The address of one page, which all tests of this module share."""
    with PageServer() as server:
        yield server.add(TinyView())


def token_of(url):
    return urlsplit(url).path.split("/")[1]


def with_token(url, token):
    return urlsplit(url).path.replace(token_of(url), token)


@pytest.mark.parametrize("name", NAMES)
def test_with_the_token_each_part_is_served(page, name):
    status, headers, body = get(page + name)
    assert status == 200
    assert body == resources()[name.encode()].body
    assert len(body) > 100
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["cache-control"] == "no-store"
    assert headers["x-frame-options"] == "DENY"
    policy = headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "frame-ancestors 'none'" in policy
    assert "unsafe" not in policy


def test_a_token_is_long_and_new_for_each_server(page):
    assert len(token_of(page)) >= 32
    with PageServer() as other:
        assert token_of(other.address) != token_of(page)


def wrong_tokens(token):
    other = "A" if token[0] != "A" else "B"
    return {
        "none": "",
        "another first letter": other + token[1:],
        "another last letter": token[:-1] + ("A" if token[-1] != "A" else "B"),
        "shorter": token[:-1],
        "longer": token + "A",
        "upper case": token.swapcase(),
        "encoded": f"%{ord(token[0]):02X}{token[1:]}",
        "not ASCII, encoded": "%C3%A9" * 10,
        "not UTF-8": "%FF%FE",
    }


@pytest.mark.parametrize("kind", list(wrong_tokens("xyz")))
@pytest.mark.parametrize("name", NAMES)
def test_without_the_right_token_nothing_is_served(page, name, kind):
    path = with_token(page, wrong_tokens(token_of(page))[kind]) + name
    status, headers, body = get(page, path)
    assert status == 403
    assert body == b"403 Forbidden\n"
    assert headers["content-security-policy"] == "default-src 'none'"


@pytest.mark.parametrize("path", ["/", "/page.js", "/favicon.ico", "/index.html", "//", "*"])
def test_addresses_without_a_token(page, path):
    assert get(page, path)[0] in (400, 403)


@pytest.mark.parametrize(
    "text", ["é", "\x80", "a\u2028b"], ids=["latin-1", "a control character", "UTF-8"]
)
def test_bytes_that_are_not_ascii_are_refused_and_the_server_lives(page, text):
    """http.client sends ASCII alone, so the request is written by hand."""
    parts = urlsplit(page)
    encoded = text.encode("utf-8")
    for head in (
        b"GET /" + encoded + b"/x/ HTTP/1.1\r\nHost: " + parts.netloc.encode(),
        b"GET " + parts.path.encode() + b" HTTP/1.1\r\nHost: " + encoded,
        b"GET "
        + parts.path.encode()
        + b" HTTP/1.1\r\nHost: "
        + parts.netloc.encode()
        + b"\r\nOrigin: "
        + encoded,
        b"GET /"
        + encoded
        + b"/x/ HTTP/1.1\r\nHost: "
        + parts.netloc.encode()
        + b"\r\nOrigin: http://"
        + parts.netloc.encode()
        + b"\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13"
        b"\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
    ):
        with socket.create_connection((parts.hostname, parts.port), timeout=10) as raw:
            raw.sendall(head + b"\r\n\r\n")
            first = raw.recv(4096).split(b"\r\n")[0]
        assert first.split(b" ")[1] in (b"400", b"403"), first
    assert get(page)[0] == 200


FOREIGN_HOSTS = ["evil.example", "evil.example:{port}", "127.0.0.1", "127.0.0.1:1", "127.0.0.2:{port}",
                 "127.0.0.1:{port}.evil.example", "localhost.evil.example:{port}", ""]  # fmt: skip


@pytest.mark.parametrize("host", FOREIGN_HOSTS)
@pytest.mark.parametrize("name", ["", "page.js"])
def test_a_foreign_host_is_refused(page, host, name):
    written = host.format(port=urlsplit(page).port)
    assert get(page + name, headers={"Host": written})[0] == 403


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "LOCALHOST", "[::1]"])
def test_the_own_names_are_allowed(page, host):
    assert get(page, headers={"Host": f"{host}:{urlsplit(page).port}"})[0] == 200


def test_a_request_without_a_host_is_refused(page):
    assert get(page, headers={"Host": None})[0] in (400, 403)


FOREIGN_ORIGINS = ["http://evil.example", "https://127.0.0.1:{port}", "http://127.0.0.1", "http://127.0.0.1:1", "null",
                   "http://127.0.0.1:{port}.evil.example", "127.0.0.1:{port}", ""]  # fmt: skip


@pytest.mark.parametrize("origin", FOREIGN_ORIGINS)
@pytest.mark.parametrize("name", ["", "renderview.js"])
def test_a_foreign_origin_is_refused(page, origin, name):
    written = origin.format(port=urlsplit(page).port)
    assert get(page + name, headers={"Origin": written})[0] == 403


def test_the_own_origin_is_allowed(page):
    assert get(page, headers={"Origin": f"http://{urlsplit(page).netloc}"})[0] == 200


OUTSIDE = [
    "../", "../../etc/passwd", "..%2f..%2fetc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..\\..\\etc\\passwd",
    "....//....//etc/passwd", "/etc/passwd", "//etc/passwd", "page.js/", "./page.js", "page.js%00", "page%2Ejs",
    "%2570age.js", "index.html", "server.py", "access.py", "login.html", "..", "page.js/../page.css", "~", "C:/x",
]  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_nothing_of_the_disk_is_served(page, name):
    status, _, body = get(page, urlsplit(page).path + name)
    assert status == 404
    assert body == b"404 Not Found\n"


@pytest.mark.parametrize(
    "path",
    ["/../{token}/", "/./{token}/", "//{token}/", "/{token}/../../etc/passwd", "/{token}/x/"],
)
def test_paths_round_the_token(page, path):
    assert get(page, path.format(token=token_of(page)))[0] in (403, 404)


def test_a_query_and_a_fragment_change_nothing(page):
    assert (
        get(page, urlsplit(page).path + "page.js?../../etc/passwd")[2]
        == resources()[b"page.js"].body
    )


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "PATCH"])
def test_other_methods_are_refused(page, method):
    assert get(page, method=method, body=b"")[0] == 405


def test_head_has_no_body(page):
    status, headers, body = get(page, method="HEAD")
    assert (status, body) == (200, b"")
    assert int(headers["content-length"]) == len(resources()[b""].body)


def test_an_address_without_its_last_slash_leads_on(page):
    status, headers, _ = get(page.rstrip("/"))
    assert (status, headers["location"]) == (308, urlsplit(page).path)


class TestWebsocket:
    def test_with_token_and_origin_it_opens(self, page):
        with open_socket(page) as opened:
            resize(opened, 40, 30)
            assert receive(opened, "framebufferdata")[0]["mimetype"] == "image/png"

    @pytest.mark.parametrize("kind", list(wrong_tokens("xyz")))
    def test_tokens(self, page, kind):
        wrong = page.replace(token_of(page), wrong_tokens(token_of(page))[kind])
        self.refused(wrong)

    @pytest.mark.parametrize("origin", [*FOREIGN_ORIGINS, None])
    def test_origins(self, page, origin):
        written = origin.format(port=urlsplit(page).port) if origin else origin
        self.refused(page, origin=written)

    @pytest.mark.parametrize("name", ["page.js", "../", "x/y", "%2e%2e/"])
    def test_paths(self, page, name):
        self.refused(page + name)

    @pytest.mark.parametrize("host", FOREIGN_HOSTS[:-1])
    def test_hosts(self, page, host):
        """The client of websockets writes its own Host, so that the request is written by hand."""
        parts = urlsplit(page)
        lines = [
            f"GET {parts.path} HTTP/1.1",
            f"Host: {host.format(port=parts.port)}",
            f"Origin: http://{parts.netloc}",
            "Upgrade: websocket",
            "Connection: Upgrade",
            "Sec-WebSocket-Version: 13",
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        ]
        with socket.create_connection((parts.hostname, parts.port), timeout=10) as raw:
            raw.sendall("\r\n".join([*lines, "", ""]).encode())
            assert raw.recv(4096).split(b"\r\n")[0].split(b" ")[1] == b"403"

    @staticmethod
    def refused(url, **more):
        with pytest.raises(InvalidHandshake) as caught:
            open_socket(url, **more)
        assert isinstance(caught.value, InvalidStatus)
        assert caught.value.response.status_code == 403


def test_tokens_are_compared_in_constant_time(page, monkeypatch):
    """Each request compares the whole token by `secrets.compare_digest`, whichever other rule it breaks."""
    compared = []
    real = Access.__init__.__globals__["secrets"].compare_digest

    def spy(a, b):
        compared.append((a, b))
        return real(a, b)

    monkeypatch.setattr("cubecam.viewer.page.access.secrets.compare_digest", spy)
    get(page, headers={"Host": "evil.example"})
    get(page, with_token(page, "x"))
    assert compared == [
        (token_of(page).encode(), token_of(page).encode()),
        (b"x", token_of(page).encode()),
    ]


WORD = "Grüße & more"


@pytest.fixture(scope="module")
def locked():
    """The address of a page behind a password."""
    with PageServer(password=WORD) as server:
        yield server.add(TinyView())


class TestPassword:
    def log_in(self, url, word):
        headers = {"Content-Type": "application/x-www-form-urlencoded"}
        return get(url, method="POST", headers=headers, body=urlencode({"password": word}).encode())

    def cookie(self, url):
        status, headers, _ = self.log_in(url, WORD)
        assert (status, headers["location"]) == (303, urlsplit(url).path)
        text, *rules = headers["set-cookie"].split("; ")
        assert {"HttpOnly", "SameSite=Strict"} <= set(rules)
        assert WORD not in headers["set-cookie"]
        return text

    def test_a_form_stands_before_the_page(self, locked):
        status, _, body = get(locked)
        assert status == 200
        assert b'type="password"' in body
        assert b"picture" not in body
        for name in ("page.js", "panel.js", "renderview.js"):
            assert get(locked + name)[0] == 403
        assert get(locked + "page.css")[0] == 200
        TestWebsocket.refused(locked)

    def test_the_password_opens_the_page(self, locked):
        cookie = self.cookie(locked)
        for name in NAMES:
            assert (
                get(locked + name, headers={"Cookie": cookie})[2] == resources()[name.encode()].body
            )
        with open_socket(locked, headers={"Cookie": cookie}) as opened:
            resize(opened, 40, 30)
            receive(opened, "framebufferdata")

    @pytest.mark.parametrize("word", ["", "grüße & more", "Grüße", "x" * 5000])
    def test_a_wrong_password_is_slow_and_opens_nothing(self, locked, word):
        start = time.monotonic()
        status, headers, body = self.log_in(locked, word)
        assert time.monotonic() - start > 0.9
        assert status == 401
        assert "set-cookie" not in headers
        assert b"The password is wrong." in body

    def test_wrong_cookies(self, locked):
        name = self.cookie(locked).partition("=")[0]
        for cookie in (f"{name}=", f"{name}=x", "other=1", "é", f"{name}=é"):
            assert get(locked + "page.js", headers={"Cookie": cookie})[0] == 403

    def test_the_token_is_wanted_as_well(self, locked):
        cookie = self.cookie(locked)
        assert get(locked, with_token(locked, "x"), headers={"Cookie": cookie})[0] == 403
        assert self.log_in(locked.replace(token_of(locked), "x"), WORD)[0] == 403


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.0.1", "example.org"])
def test_other_hosts_need_a_password(host):
    with pytest.raises(ValueError, match=r"expected 127\.0\.0\.1, or a password for"):
        PageServer(host)
    with pytest.raises(ValueError, match="or a password"):
        PageServer(host, password="")


def test_all_addresses_with_a_password():
    with PageServer("0.0.0.0", password="x") as server:
        url = server.add(TinyView())
        assert "0.0.0.0" not in url
        port = urlsplit(url).port
        local = f"http://127.0.0.1:{port}{urlsplit(url).path}"
        assert get(local)[0] == 200
        assert get(local, headers={"Host": socket.gethostname() + f":{port}"})[0] == 200
        assert get(local, headers={"Host": f"evil.example:{port}"})[0] == 403
        assert get(local, headers={"Host": f"0.0.0.0:{port}"})[0] == 403


def test_ports_and_addresses_that_cannot_be_used():
    with (
        PageServer() as server,
        pytest.raises(OSError, match=f"cannot listen on 127.0.0.1, port {server.port}"),
    ):
        PageServer(port=server.port)
    with pytest.raises(OSError, match="expected an address of this machine, got 'no such name"):
        PageServer("no such name.invalid", password="x")


def test_nothing_is_logged_and_nothing_printed(capfd, caplog):
    """Addresses hold the token: a log would give it away."""
    with PageServer() as server, caplog.at_level(0):
        url = server.add(TinyView())
        get(url)
        get(url + "nope")
        get(url, with_token(url, "x"))
        with open_socket(url) as opened:
            resize(opened, 40, 30)
            receive(opened, "framebufferdata")
    out, err = capfd.readouterr()
    told = (
        out + err + "".join(r.getMessage() for r in caplog.records if r.name.startswith("uvicorn"))
    )
    assert token_of(url) not in told
    assert (out, err) == ("", "")
