"""A chart plotter for tests: takes what comes over TCP, and decodes it with pyais."""

import socket
import time
from threading import Thread


class Plotter(Thread):
    """Connects as soon as somebody serves at a port of this machine, and listens until the end."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.port, self.heard = port, b""
        self.start()

    def run(self):
        deadline = time.monotonic() + 60
        while True:
            try:
                stream = socket.create_connection(("127.0.0.1", self.port))
                break
            except OSError:
                if time.monotonic() > deadline:
                    return
                time.sleep(0.02)
        with stream:
            while data := stream.recv(65536):
                self.heard += data

    def lines(self):
        """What it heard, once the other side has closed."""
        self.join(60)
        return self.heard.split(b"\r\n")[:-1]

    def messages(self):
        """The messages in it."""
        return decoded(self.lines())


def decoded(lines):
    """Messages of complete sentences, those of several put together."""
    import pyais

    parts = []
    for line in lines:
        parts.append(line)
        if line.split(b",")[1] == line.split(b",")[2]:
            yield pyais.decode(*parts)
            parts = []


def free_port():
    with socket.socket() as trial:
        trial.bind(("127.0.0.1", 0))
        return trial.getsockname()[1]
