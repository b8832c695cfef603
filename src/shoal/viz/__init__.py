"""Viz: records as figures, drawn without windows and without matplotlib's global state (extra: plots).

`summary.summary_figure` makes the page, `files.save_figure` writes it. To draw parts into axes of your own, call
`snapshot.draw_snapshot`, `histogram.draw_phi_histogram` and `curves.draw_batches` inside `style.style()`.
"""
