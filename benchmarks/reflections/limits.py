"""What no cubemap of facing balls shows: python -m benchmarks.reflections.limits

A ball's cubemap has the other ball as its own middle sees it: what that ball reflects is right for rays from there
alone. The picture here is the exact one, but for the pixels whose ray goes from ball to ball: these look up exact faces
of 1,024 texels at the exact place that the ray meets. No march through a cubemap can do better; only a second search,
from the other ball on, could.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc

from . import measure
from .methods import METHODS
from .reflectors import World

Array = npt.NDArray[Any]
EXACT_FACES = 1024
SIZE = 256


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.reflections.limits", description=__doc__
    )
    parser.add_argument("--bounces", type=int, default=2)
    parser.add_argument(
        "--apart",
        type=float,
        nargs="+",
        default=[2.3, 3.0, 3.6, 4.4],
        help="in radii, between the middles",
    )
    options = parser.parse_args()
    print(
        "| apart, radii | truth with 1 bounce | plain | layers 35 | exact cubemap |\n|---|---|---|---|---|"
    )
    with cc.Renderer() as renderer:
        for apart in options.apart:
            figures = " | ".join(f"{x:.4f}" for x in _errors(renderer, apart, options.bounces))
            print(f"| {apart:g} | {figures} |", flush=True)


def _world(apart: float) -> World:
    world = World("room_a", "facing balls")
    for node, side in zip(world.nodes, (-0.5, 0.5), strict=True):
        node.position = np.add(world.middle, (side * apart * _radius(node), 0, 0))
    return world


def _radius(node: cc.Node) -> float:
    assert node.mesh is not None
    return float(np.abs(node.mesh.positions).max())


def _errors(renderer: cc.Renderer, apart: float, bounces: int) -> list[float]:
    """RMSE over the balls' pixels against `bounces` bounces: exact rays with one, plain, layers, the exact cubemap."""
    world = _world(apart)
    exact = _exact(world, bounces)
    balls = [exact.outputs["id"] == node.id for node in world.nodes]
    truth = measure.shown(exact.color, linear=world.place.linear)
    pictures: list[Array] = [_exact(world, 1).color]
    for name in ("plain", "layers 35"):
        drawn = _world(apart)
        METHODS[name].prepare(drawn, size=256, bounces=bounces)
        frame = renderer.render(drawn.scene, drawn.camera, (SIZE, SIZE), format="rgba32f")
        pictures.append(np.asarray(frame.color))
    pictures.append(_by_exact_cubes(apart, exact, balls, bounces))
    shown = (measure.shown(picture, linear=world.place.linear) for picture in pictures)
    return [measure.compare(one, truth, balls[0] | balls[1]).rmse for one in shown]


def _exact(world: World, bounces: int) -> cc.truth.TruthFrame:
    return cc.truth.render(
        world.scene,
        world.camera,
        (SIZE, SIZE),
        bounces=bounces,
        samples=1,
        self_hits=False,
        outputs=("id", "position", "normal"),
        progress=False,
    )


def _by_exact_cubes(
    apart: float, exact: cc.truth.TruthFrame, balls: list[Array], bounces: int
) -> Array:
    """The exact picture, with what each ball shows of the other one from a cubemap at the ball's middle."""
    color = np.array(exact.color, float)
    position, normal = (np.asarray(exact.outputs[key], float) for key in ("position", "normal"))
    for own in (0, 1):
        world = _world(apart)
        ball, other = world.nodes[own], world.nodes[1 - own]
        way = position - world.camera.position
        way /= np.linalg.norm(way, axis=-1, keepdims=True)
        ray = way - 2 * (way * normal).sum(axis=-1, keepdims=True) * normal
        # Where the ray meets the other ball.
        start = position - other.position
        along = -(start * ray).sum(axis=-1)
        root = along**2 - (start**2).sum(axis=-1) + _radius(other) ** 2
        length = along - np.sqrt(np.maximum(root, 0))
        seen = balls[own] & (root > 0) & (length > 0)
        met = (position + length[..., None] * ray)[seen]
        cube = cc.truth.capture(
            world.scene,
            tuple(ball.position),
            EXACT_FACES,
            bounces=bounces - 1,
            samples=1,
            exclude=[ball],
            self_hits=False,
            progress=False,
        )
        color[seen, :3] = np.asarray(cube.sample(met - ball.position))[:, :3]
    return color


if __name__ == "__main__":
    main()
