"""Radios by name: how long a message is on the air, and how much of the time one may transmit.

lora-sf7, lora-sf9, lora-sf12 : LoRa, 125 kHz, coding rate 4/5, preamble of 8 symbols, explicit header, checksum; time
    on air by Semtech, "SX1272/3/6/7/8: LoRa modem designer's guide", AN1200.13, 2013, section 4; 255 bytes at most in
    a frame. Europe's band of 868.0 to 868.6 MHz allows 1 % (ETSI EN 300 220-2).
wifi-mesh : a broadcast of IEEE 802.11 OFDM at the basic rate of 6 Mbit/s (IEEE 802.11-2020, clause 17): 20 us of
    preamble, symbols of 4 us and 24 bits; 64 bytes of headers (MAC 28, LLC 8, IP and UDP 28). No limit of its own.
vdes : the channels for application specific messages of the VHF data exchange system (ITU-R M.2092): 19.2 kbit/s, whole
    slots of 1/2250 min. What ramps, training and checksums take of a slot is assumed to be a third of its 512 bits.
"""

import math
from collections.abc import Callable
from typing import NamedTuple


class Radio(NamedTuple):
    """What is known of a kind of radio.

    time_on_air : bytes of a message -> how long it takes [s]
    duty : the largest share of the time that one may transmit by law, 1 where there is none
    law : what says so
    listens : whether it waits for a free channel, or has slots; without, what is sent at the same time collides
    """

    time_on_air: Callable[[int], float]
    duty: float = 1.0
    law: str = ""
    listens: bool = True


_LARGEST = 255  # bytes of a LoRa frame


def lora(spreading: int) -> Callable[[int], float]:
    """Time on air [s] of a message of so many bytes at a spreading factor, in as few frames as it takes."""

    def time_on_air(size: int) -> float:
        whole, rest = divmod(size, _LARGEST)
        return whole * lora_frame(spreading, _LARGEST) + (lora_frame(spreading, rest) if rest else 0.0)

    return time_on_air


def lora_frame(spreading: int, size: int) -> float:
    """Time on air [s] of one frame of so many bytes.

    T = 2^SF / B (n_preamble + 4.25 + 8 + max(ceil((8 PL - 4 SF + 28 + 16) / (4 (SF - 2 DE))) (CR + 4), 0))
    with the optimization for low rates, DE = 1, where a symbol takes 16 ms or more.
    """
    symbol = (1 << spreading) / 125e3
    slow = 1 if symbol >= 16e-3 else 0
    blocks = math.ceil((8 * size - 4 * spreading + 28 + 16) / (4 * (spreading - 2 * slow)))
    return symbol * (8 + 4.25 + 8 + max(blocks * 5, 0))


def wifi(size: int) -> float:
    """Time on air [s] of a broadcast of so many bytes: service and tail are 22 bits."""
    return 20e-6 + 4e-6 * math.ceil((22 + 8 * (size + 64)) / 24)


def vdes(size: int) -> float:
    """Time on air [s] of a message of so many bytes, in whole slots."""
    return math.ceil(8 * size / (512 * 2 // 3)) * 60 / 2250


_EUROPE = "ETSI EN 300 220-2, 868.0 to 868.6 MHz"
RADIOS: dict[str, Radio] = {
    "lora-sf7": Radio(lora(7), 0.01, _EUROPE, listens=False),
    "lora-sf9": Radio(lora(9), 0.01, _EUROPE, listens=False),
    "lora-sf12": Radio(lora(12), 0.01, _EUROPE, listens=False),
    "wifi-mesh": Radio(wifi),
    "vdes": Radio(vdes),
}
