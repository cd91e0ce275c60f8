"""The oracle: numpy only, written from design.md section 2 and the papers it names, never from the C++.

Nothing here imports cubecam, so that an error in the product cannot hide in what judges it.
"""
