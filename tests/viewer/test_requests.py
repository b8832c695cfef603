"""What a page may ask for: the requests of the protocol, and nothing else."""

import pytest

from shoal.viewer.requests import LONGEST, Change, RequestError, Step, parse_request


class TestParseRequest:
    def test_run_and_steps_may_be_left_out(self):
        assert parse_request('{"do": "step"}') == Step(do="step", steps=1)
        change = parse_request('{"do": "change", "changes": {"neighbors": 5}}')
        assert change == Change(do="change", run=0, changes={"neighbors": 5})

    @pytest.mark.parametrize(
        "text",
        [
            "nonsense",
            "[]",
            "null",
            '"play"',
            "{}",
            '{"do": "quit"}',
            '{"do": "play", "file": "/etc/passwd"}',
            '{"do": "speed"}',
            '{"do": "speed", "value": 1001}',
            '{"do": "speed", "value": 0.01}',
            '{"do": "speed", "value": NaN}',
            '{"do": "speed", "value": "10"}',
            '{"do": "seek", "step": -1}',
            '{"do": "seek", "step": 1.5}',
            '{"do": "step", "steps": 1000000000}',
            '{"do": "restart", "seed": -1}',
            '{"do": "change", "changes": {}}',
            '{"do": "change", "changes": {"strategy": {"file": "x.py"}}}',
            '{"do": "change", "changes": {"neighbors": [1]}}',
            '{"do": "kill", "agent": true}',
            '{"do": "drag", "x": Infinity, "y": 0}',
            b"\xff\xfe",
        ],
    )
    def test_anything_else_is_refused_in_one_sentence(self, text):
        with pytest.raises(RequestError, match=r"^request.*\n  fix: see"):
            parse_request(text)

    def test_it_is_refused_unread_when_it_is_long(self):
        padded = '{"do": "play"}' + " " * LONGEST
        with pytest.raises(RequestError, match="longer than 4096 bytes"):
            parse_request(padded)
        assert parse_request(padded[:LONGEST]).do == "play"

    def test_letters_count_by_their_bytes(self):
        with pytest.raises(RequestError, match="longer"):
            parse_request('{"do": "' + "é" * 3000 + '"}')
