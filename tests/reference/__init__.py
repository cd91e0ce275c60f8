"""The oracle: numpy only, written from design.md section 2 and the papers it names, never from the C++.

Nothing here uses the core, so that an error in the product cannot hide in what judges it. The functions of shading are
those of `cubecam.truth.shading`, which keeps the same rule: they stand there once for the tests and for truth.
"""
