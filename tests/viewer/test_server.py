"""The server, over the network: who is let in, what is served, and that it goes away."""

import http.client
import json
import socket
import threading

import pytest

from frames import decode
from shoal.core.errors import MissingExtraError, ShoalError
from shoal.scenario.load import read_table
from shoal.viewer import server
from shoal.viewer.address import Guard, is_local, names_of, reachable
from shoal.viewer.server import page_app, serving, serving_session
from shoal.viewer.session import Session


@pytest.fixture
def address(small_page):
    with serving_session(Session([read_table("oceans2020")])) as where:
        yield where


def port_of(where):
    return int(where.rstrip("/").rpartition(":")[2])


def get(where, path="/", method="GET", **headers):
    """Status, headers and body of an answer; headers such as Host=... as they are given."""
    connection = http.client.HTTPConnection("127.0.0.1", port_of(where), timeout=30)
    connection.putrequest(method, path, skip_host="Host" in headers, skip_accept_encoding=True)
    for name, value in headers.items():
        connection.putheader(name, value)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, answer.headers, body


def knock(where, host=None, origin=None, path="/live"):
    """Status of a WebSocket's handshake."""
    lines = [
        f"GET {path} HTTP/1.1",
        f"Host: {host or f'127.0.0.1:{port_of(where)}'}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
        "Sec-WebSocket-Version: 13",
        *([f"Origin: {origin}"] if origin else []),
    ]
    with socket.create_connection(("127.0.0.1", port_of(where)), timeout=30) as wire:
        wire.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        return int(wire.recv(4096).split()[1])


class Page:
    """A page of the protocol, without a browser."""

    def __init__(self, where):
        from websockets.sync.client import connect

        self._connection = connect(f"ws://127.0.0.1:{port_of(where)}/live", origin=where.rstrip("/"))

    def __enter__(self):
        self._socket = self._connection.__enter__()
        return self

    def __exit__(self, *reason):
        self._connection.__exit__(*reason)

    def say(self, text):
        self._socket.send(text)

    def ask(self, do, **what):
        self.say(json.dumps({"do": do, **what}))

    def next(self, kind):
        """The next message of a type, or frame."""
        while True:
            message = self._socket.recv(timeout=60)
            if isinstance(message, bytes):
                if kind == "frame":
                    return decode(message)
            elif (told := json.loads(message))["type"] == kind:
                return told

    def until(self, condition, kind="status"):
        while not condition(told := self.next(kind)):
            pass
        return told


class TestFiles:
    def test_exactly_three_are_served(self, address, small_page):
        for path, name, kind in (
            ("/", "index.html", "text/html"),
            ("/app.js", "app.js", "text/javascript"),
            ("/app.css", "app.css", "text/css"),
        ):
            status, headers, body = get(address, path)
            assert (status, body.decode()) == (200, small_page[name])
            assert headers["Content-Type"].startswith(kind)
            assert headers["X-Content-Type-Options"] == "nosniff"

    @pytest.mark.parametrize(
        "path",
        [
            "/index.html",
            "/../server.py",
            "/static/app.js",
            "/app.js/../../server.py",
            "/%2e%2e/%2e%2e/etc/passwd",
            "/..%2f..%2fetc%2fpasswd",
            "//etc/passwd",
            "/app.js%00.css",
            "/live",
        ],
    )
    def test_nothing_else_is(self, address, path):
        assert get(address, path)[0] == 404

    @pytest.mark.parametrize("method", ["POST", "PUT", "DELETE"])
    def test_they_are_only_read(self, address, method):
        assert get(address, "/", method)[0] == 405

    def test_the_page_may_load_from_here_only(self, address):
        policy = get(address)[1]["Content-Security-Policy"]
        assert "default-src 'none'" in policy
        assert "script-src 'self'" in policy
        assert "unsafe" not in policy


class TestGuard:
    """Only addresses that we serve on: else a page of anybody's could reach the engine through a name of its own."""

    @pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "127.0.0.1.evil.example", "10.0.0.1", ""])
    def test_another_host_is_refused(self, address, host):
        assert get(address, Host=host)[0] == 403
        if host:
            assert knock(address, host=host) == 403

    @pytest.mark.parametrize(
        "host", ["127.0.0.1:80@evil.example", "127.0.0.1:80, evil.example", "127.0.0.1:evil", "[[localhost", "::1"]
    )
    def test_what_is_no_name_and_port_is_refused(self, address, host):
        assert get(address, Host=host)[0] == 403
        assert knock(address, host=host) == 403

    @pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "LOCALHOST:1234", "[::1]:9", "[::1]"])
    def test_this_machine_may_be_called_by_its_names(self, address, host):
        assert get(address, Host=host)[0] == 200

    @pytest.mark.parametrize(
        "origin", ["http://evil.example", "null", "https://127.0.0.1:{port}", "http://127.0.0.1:1", "http://localhost:{port}"]
    )  # fmt: skip
    def test_a_page_from_elsewhere_is_refused(self, address, origin):
        assert knock(address, origin=origin.format(port=port_of(address))) == 403

    def test_our_own_page_is_let_in(self, address):
        assert knock(address, origin=address.rstrip("/")) == 101
        assert knock(address, host="localhost:8080", origin="http://localhost:8080") == 101  # a forwarded port

    def test_a_socket_is_only_at_live(self, address):
        assert knock(address, path="/") in (403, 404)

    def test_served_everywhere_it_is_reached_by_any_number_and_no_foreign_name(self):
        guard = Guard(None, names_of("0.0.0.0"))
        assert guard._knows("192.168.1.7:8000")
        assert guard._knows("[fe80::1]:8000")
        assert guard._knows("localhost:8000")
        assert not guard._knows("evil.example:8000")

    def test_served_at_one_address_it_is_reached_by_that(self):
        guard = Guard(None, names_of("192.168.1.7"))
        assert guard._knows("192.168.1.7:8000")
        assert not guard._knows("localhost:8000")

    def test_which_addresses_are_local(self):
        assert is_local("127.0.0.1")
        assert is_local("::1")
        assert is_local("localhost")
        assert not is_local("0.0.0.0")
        assert not is_local("192.168.1.7")
        assert not is_local("boat")
        assert reachable("0.0.0.0") == "127.0.0.1"
        assert reachable("::1") == "[::1]"


class TestLive:
    def test_a_page_sees_the_run_go_on(self, address):
        with Page(address) as page:
            assert page.next("hello")["runs"] == 1
            assert page.next("scene")["scene"]["name"] == "oceans2020"
            first = page.next("frame")
            assert page.next("frame").step > first.step

    def test_two_pages_are_in_step_and_both_may_steer(self, address):
        with Page(address) as one, Page(address) as other:
            one.ask("pause")
            step = one.until(lambda told: not told["playing"])["step"]
            assert other.until(lambda told: not told["playing"])["step"] == step
            other.ask("change", changes={"neighbors": 5})
            assert one.until(lambda told: told["scene"]["epoch"] == 1, "scene")["scene"]["neighbors"] == 5
            assert one.next("frame").x == other.until(lambda frame: frame.epoch == 1, "frame").x

    def test_closing_the_page_ends_nothing(self, address):
        with Page(address) as page:
            page.ask("speed", value=1000)
            page.until(lambda told: told["speed"] == 1000)
            step = page.next("frame").step
        with Page(address) as page:
            assert page.next("frame").step >= step
            assert page.next("status")["playing"]

    def test_a_refused_request_is_answered_and_the_page_stays(self, address):
        with Page(address) as page:
            page.ask("change", changes={"neighbors": 99})
            assert "at most 49" in page.next("error")["message"]
            page.say("nonsense")
            assert page.next("error")["message"].startswith("request")
            page.ask("pause")
            page.until(lambda told: not told["playing"])

    def test_a_message_that_is_too_long_ends_the_connection(self, address):
        from websockets.exceptions import ConnectionClosed

        with Page(address) as page:
            page.say('{"do": "play"}' + " " * 5000)
            with pytest.raises(ConnectionClosed) as closed:
                page.until(lambda told: False)
        assert closed.value.rcvd.code == 1009

    def test_nonsense_without_end_ends_the_connection(self, address):
        from websockets.exceptions import ConnectionClosed

        def talk(page):
            for _ in range(100):
                page.say("nonsense")
            page.until(lambda told: False)

        with Page(address) as page, pytest.raises(ConnectionClosed):
            talk(page)
        with Page(address) as page:  # and nothing else
            page.next("frame")

    def test_a_page_that_never_reads_holds_up_nobody(self, address):
        with socket.create_connection(("127.0.0.1", port_of(address))) as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1024)
            lines = f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port_of(address)}\r\nUpgrade: websocket\r\n"
            lines += "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            deaf.sendall((lines + "Sec-WebSocket-Version: 13\r\n\r\n").encode())
            with Page(address) as page:
                page.ask("speed", value=1000)
                page.until(lambda told: told["step"] > 3000)


class TestServing:
    def test_nothing_is_left_when_it_ends(self, small_page):
        before = set(threading.enumerate())
        with serving_session(Session([read_table("oceans2020")])) as where, Page(where) as page:
            page.next("frame")
        assert set(threading.enumerate()) <= before
        with pytest.raises(OSError, match=r"refused"):
            socket.create_connection(("127.0.0.1", port_of(where)), timeout=5)

    def test_a_port_in_use_is_one_sentence(self, small_page, address):
        with pytest.raises(ShoalError, match=r"--port \d+: is in use\n  fix: name another"):
            serving(page_app(""), port=port_of(address)).__enter__()

    @pytest.mark.parametrize("host", ["192.0.2.1", "no.such.name.invalid"])
    def test_an_address_that_is_not_ours_is_one_sentence(self, host):
        with pytest.raises(ShoalError, match=r"--host: .* is not an address of this machine"):
            serving(page_app(""), host=host).__enter__()

    def test_an_impossible_port_is_one_sentence(self):
        with pytest.raises(ShoalError, match=r"from 0 .* to 65535"):
            serving(page_app(""), port=70_000).__enter__()

    def test_without_the_extra_it_says_what_to_install(self, monkeypatch):
        monkeypatch.setattr(server, "find_spec", lambda name: None if name == "uvicorn" else object())
        with pytest.raises(MissingExtraError, match=r"uvicorn: is not installed.*\n  fix: pip install '\.\[viewer\]'"):
            page_app("")

    def test_one_page_is_served_by_itself(self):
        with serving(page_app("<!doctype html>told")) as where:
            assert get(where)[2] == b"<!doctype html>told"
            assert get(where, "/app.js")[0] == 404
            assert knock(where) in (403, 404)
