"""How long radios take for a message, beside what their makers and calculators say."""

import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.core.messages import Report
from shoal.scenario.assumptions import airtime, assumptions, report_size
from shoal.scenario.radios import RADIOS, lora_frame

REPORT = Report(1, 0.0, 0.0, 0.0, 0.0, False, ())


class TestLora:
    """Semtech AN1200.13; the published figures of LoRaWAN frames of 13 bytes of header and 51 of payload."""

    @pytest.mark.parametrize(("spreading", "size", "seconds"), [(7, 64, 0.1180), (9, 64, 0.3901), (12, 64, 2.7935)])
    def test_is_that_of_the_calculators(self, spreading, size, seconds):
        assert lora_frame(spreading, size) == pytest.approx(seconds, abs=1e-4)

    def test_of_a_report_is_97_ms_with_its_envelope(self):
        """37 bytes are what a report says, 82 ms; version, time and checksum make 50 of them."""
        assert len(REPORT.to_bytes()) == 50
        assert RADIOS["lora-sf7"].time_on_air(37) == pytest.approx(82.2e-3, abs=1e-4)
        assert RADIOS["lora-sf7"].time_on_air(50) == pytest.approx(97.5e-3, abs=1e-4)

    def test_a_message_beyond_the_largest_frame_takes_several(self):
        time = RADIOS["lora-sf7"].time_on_air
        assert time(510) == 2 * time(255)
        assert time(256) == time(255) + time(1)


@pytest.mark.parametrize("name", RADIOS)
def test_more_bytes_never_take_less_time(name):
    times = [RADIOS[name].time_on_air(size) for size in range(1, 600)]
    assert times[0] > 0
    assert times == sorted(times)


class TestDuty:
    """One report in ten seconds, where the paper assumes ten a second."""

    def said(self, **changes):
        return assumptions(scenario("oceans2020", {"network.radio": "lora-sf7", **changes}))

    def test_ten_a_second_break_the_law(self):
        (sentence,) = self.said()
        assert "97.5 % of the time" in sentence
        assert "1 % are allowed (ETSI EN 300 220-2" in sentence
        assert "an interval of 9.76 s keeps to it" in sentence

    def test_the_interval_that_is_proposed_keeps_to_it(self):
        assert self.said(**{"network.interval": 9.76, "time_step": 0.01}) == []
        assert self.said(**{"network.interval": 9.75, "time_step": 0.01}) != []

    def test_a_report_that_takes_longer_than_the_interval_cannot_be_sent(self):
        (sentence,) = self.said(**{"network.radio": "lora-sf12"})
        assert "cannot be sent" in sentence
        assert "takes lora-sf12 2,300 ms" in sentence

    def test_no_law_no_sentence(self):
        assert self.said(**{"network.radio": "wifi-mesh"}) == []

    def test_what_a_strategy_tells_takes_time_too(self):
        plain, telling = (
            scenario("oceans2020", {"network.radio": "lora-sf7", "strategy": name})
            for name in ("lattice", "shared-sighting")
        )
        assert report_size(telling) > report_size(plain)
        assert airtime(telling) > airtime(plain)

    def test_an_unknown_radio_is_answered_with_those_that_are(self):
        with pytest.raises(ScenarioError, match="there are: lora-sf7, lora-sf9"):
            scenario("oceans2020", {"network.radio": "lora-sf8"})


class TestInterval:
    """A time, rounded to whole steps."""

    @pytest.mark.parametrize(
        ("interval", "steps"), [(None, 1), (0.1, 1), (0.3, 3), ("10 s", 100), (0.34, 3), (1e12, 10**13)]
    )
    def test_in_steps(self, interval, steps):
        changes = {} if interval is None else {"network.interval": interval}
        assert scenario("oceans2020", changes).report_steps == steps

    def test_what_is_rounded_is_said(self):
        (sentence,) = assumptions(scenario("oceans2020", {"network.interval": 0.34}))
        assert sentence.endswith("agents report every 0.3 s")
        assert assumptions(scenario("oceans2020", {"network.interval": 0.3})) == []

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"max_age": 2, "interval": 0.3}, ["2 steps, but reports come every 3: no older one is gone by"]),
            ({"max_age": 3, "interval": 0.3}, []),
            ({"hops": 4}, ["all hear each other directly: give network.range"]),
            ({"hops": 4, "loss": 0.1}, []),
            ({"hops": 4, "range": 5.0, "radio": "wifi-mesh"}, ["without what it relays"]),
        ],
    )
    def test_what_is_kept_or_relayed_in_vain_is_said(self, changes, words):
        said = assumptions(scenario("oceans2020", {f"network.{name}": value for name, value in changes.items()}))
        assert [each[-len(word) :] for each, word in zip(said, words, strict=True)] == words

    def test_below_a_step_is_refused(self):
        with pytest.raises(ScenarioError, match=r"network\.interval: network\.interval is 0\.05 s") as caught:
            scenario("oceans2020", {"network.interval": 0.05})
        assert caught.value.args[2] == "raise it, or lower time_step"

    def test_off_it_is_not_in_the_hash(self):
        assert scenario("oceans2020", {"network.interval": 0.5}).hash != scenario("oceans2020").hash
