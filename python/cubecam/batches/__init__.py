"""Many captures and frames in one call: `Renderer.capture_many`, `iter_captures`, `render_many`, and `capture_scenes`.

`captures.py` draws cubemaps, `renders.py` frames; `cubemaps.py` and `frames.py` have the classes of the results, and
`labelled.py` gives them to xarray.
"""
