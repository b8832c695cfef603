"""Records as figures, drawn without windows and without matplotlib's global state (extra: plots).

`shoal.plot` is its public face. It holds the parts: functions that draw into axes, inside `style.style()`; the page of
`summary`; an `arena_drawing` that moves from frame to frame, and the `film` of it.
"""
