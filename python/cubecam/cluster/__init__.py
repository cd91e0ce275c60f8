"""Captures by many machines: as arrays of Dask, and into Zarr stores that go on after a kill.

>>> import cubecam as cc
>>> from cubecam import cluster
>>> scene = cc.Scene(background=(0, 0, 1))
>>> places = [(x, 0, 0) for x in range(10)]
>>> batch = cluster.capture_to_zarr(scene, places, "blue.zarr", size=8, chunk=4)
>>> batch[9].faces[0, 0, 0].tolist()
[0.0, 0.0, 1.0, 1.0]

The functions need the packages of the extra: ``pip install "cubecam[cluster]"``, with Python 3.11 or newer.
"""

from __future__ import annotations

from .arrays import capture_array, capture_dataset
from .stores import capture_to_zarr

__all__ = ["capture_array", "capture_dataset", "capture_to_zarr"]
