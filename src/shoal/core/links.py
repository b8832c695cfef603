"""Who hears whom as bits, as frames keep it: bit j % 8 of byte j // 8 of row i is set where agent i hears agent j."""

from typing import Any

import numpy as np
import numpy.typing as npt

MOST_LINKED = 512  # agents of a swarm whose links are kept: 32 KiB a frame


def link_bytes(agents: int) -> int:
    """Bytes that hold whom one of N agents hears; 0 where there are so many that links are not kept."""
    return -(-agents // 8) if agents <= MOST_LINKED else 0


def unpacked(bits: npt.NDArray[Any]) -> npt.NDArray[np.bool_]:
    """Who hears whom, (N, N): row i is true where agent i hears agent j. `bits` are one frame's, (N, link_bytes(N))."""
    return np.unpackbits(np.asarray(bits, np.uint8), axis=1, count=len(bits), bitorder="little").astype(bool)
