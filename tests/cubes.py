"""Cubemaps and directions that several tests of light share."""

import numpy as np

import cubecam as cc


def photograph(name, size):
    """A photograph of the package as a cube of float32."""
    cube = cc.load_environment(cc.sample_data(f"{name}.exr"), size=size)
    return cc.CubeMap(cube.faces.astype(np.float32))


def random_directions(count, seed=1):
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=-1, keepdims=True)


def noise(size, channels, dtype="float32", seed=0):
    values = np.random.default_rng(seed).random((6, size, size, channels))
    return cc.CubeMap((values * 255).astype("uint8") if dtype == "uint8" else values.astype(dtype))


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))
