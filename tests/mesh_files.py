"""Mesh files that are written by hand, and broken ones."""

import numpy as np

import cubecam as cc


def load(folder, name, data):
    path = folder / name
    path.write_bytes(data if isinstance(data, bytes) else data.encode())
    return cc.load_mesh(path)


def triangles(mesh):
    """The positions of the corners (T, 3, 3)."""
    return np.asarray(mesh.positions, dtype=float)[mesh.indices]


def corner_values(mesh, values):
    return np.asarray(values, dtype=float)[mesh.indices]


def close(got, wanted, atol=1e-7):
    assert got is not None
    np.testing.assert_allclose(np.asarray(got), np.asarray(wanted), rtol=1e-7, atol=atol)


def mutated(data, rng):
    """A file with some bytes changed, cut out, put twice, or replaced by numbers that are too large."""
    result = bytearray(data)
    for _ in range(rng.integers(1, 3)):
        place, length = int(rng.integers(len(result) + 1)), int(rng.integers(1, 12))
        kind = rng.integers(5)
        if kind == 0:
            result[place : place + length] = rng.integers(0, 256, length, np.uint8).tobytes()
        elif kind == 1:
            del result[place : place + length]
        elif kind == 2:
            result[place:place] = result[place : place + length]
        elif kind == 3:
            numbers = (b"4294967295", b"-1", b"0", b"nan", b"1e308", b"99999999", b"\xff" * 4)
            result[place : place + length] = numbers[rng.integers(len(numbers))]
        else:
            del result[place:]
    return bytes(result)


def survives(folder, name, data, seed, count=250):
    """Load broken variants of a file: each gives a mesh or a MeshError. Return how many were read."""
    rng = np.random.default_rng(seed)
    read = 0
    for _ in range(count):
        try:
            read += len(load(folder, name, mutated(data, rng)).indices) > 0
        except cc.MeshError:
            continue
    return read
