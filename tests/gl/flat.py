"""Flat scenes whose picture is known texel by texel, and quads that show a texture."""

from typing import Any

import numpy as np

import cubecam as cc

CORNERS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)


def random_picture(seed, height=6, width=9):
    """Random RGB values in steps of 1/255, different in each pixel, so that every flip or swap is noticed."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3)) / 255


def tiles(picture):
    """A mesh with one square for each pixel, in x 0..W and y 0..H; row 0 of the picture is at the top."""
    height, width = picture.shape[:2]
    positions: list[Any] = []
    colors: list[Any] = []
    indices: list[Any] = []
    for row in range(height):
        for column in range(width):
            x, y, first = column, height - 1 - row, len(positions)
            positions += [(x, y, 0), (x + 1, y, 0), (x + 1, y + 1, 0), (x, y + 1, 0)]
            colors += [picture[row, column]] * 4
            indices += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return cc.Mesh(positions, indices, colors=np.array(colors))


def flat_camera(width, height):
    """A camera that sees x 0..W, y 0..H in a picture of that shape."""
    middle = (width / 2, height / 2)
    return cc.OrthographicCamera(height=height, position=(*middle, 5), target=(*middle, 0))


def flat_scene(picture):
    """(scene, node): the scene looks like `picture` through flat_camera."""
    scene = cc.Scene()
    node = scene.add(tiles(picture), cc.BasicMaterial(vertex_colors=True))
    return scene, node


def flat_texture(picture, **options):
    """A RenderTexture that holds `picture`."""
    height, width = picture.shape[:2]
    scene, _ = flat_scene(picture)
    return cc.RenderTexture(
        scene,
        flat_camera(width, height),
        **{"size": (width, height), "format": "rgba32f", **options},
    )


def quad(width=1.0, height=1.0, uvs=CORNERS):
    """A rectangle in x 0..W, y 0..H that faces +Z."""
    positions = [[0, 0, 0], [width, 0, 0], [width, height, 0], [0, height, 0]]
    return cc.Mesh(positions, [[0, 1, 2], [0, 2, 3]], uvs=uvs)


def screen_scene(texture, size=None):
    """(scene, node): through flat_camera, each pixel of the scene shows one texel of the texture."""
    width, height = size or texture.size
    scene = cc.Scene()
    node = scene.add(quad(width, height), cc.BasicMaterial(map=texture), name="screen")
    return scene, node


def look(renderer, scene, width=9, height=6, **options):
    """The frame of a flat scene."""
    camera = flat_camera(width, height)
    return renderer.render(scene, camera, (width, height), **{"format": "rgba32f", **options}).color
