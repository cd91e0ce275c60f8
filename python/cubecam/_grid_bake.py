"""Captures at the nodes of a `ProbeGrid`: its light, its distances, and which nodes lie in bodies."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._checks import text_of, whole_number
from ._core import BasicMaterial, Mesh, Node, ProbeGrid, Renderer, Scene
from ._drawn_meshes import deformed_mesh

__all__ = ["bake"]

Array = npt.NDArray[np.float64]

#: The largest number of rounds.
MOST_BOUNCES = 16

#: The cosine's power by which distances are weighted round a direction: "depth sharpness" of Majercik et al. 2019.
_SHARPNESS = 50
#: Distances count up to so many diagonals of a cell: what is farther away hides nothing in it.
_REACH = 1.5
#: A node lies in a body if it sees backs of surfaces in more than this share of all directions.
_BACKS = 0.25


@checked_call
def bake(
    self: ProbeGrid,
    renderer: Renderer,
    scene: Scene,
    *,
    bounces: int = 1,
    exclude: Iterable[Node] = (),
    near: float = 0.01,
    far: float = 1000.0,
    progress: Callable[[int, int], object] | None = None,
) -> None:
    """Capture a scene at all nodes of the grid, and keep what they see.

    With one bounce a node sees lamps, sky and emission, and surfaces as lights alone light them. With more, surfaces
    of later rounds have the light of the round before as well, and so paths of one more reflection. In the first round
    the grid is black: the irradiance of the scene's environment, which does not know of walls, counts nowhere in the
    box.

    Nodes that lie in bodies are not `ProbeGrid.active`: those that see the backs of single-sided surfaces in more than
    a quarter of all directions. They get the mean light of the active nodes beside them.

    Parameters
    ----------
    renderer : Renderer
        What captures.
    scene : Scene
        What is captured; its `Scene.probe_grid` is this one meanwhile, and afterwards what it was.
    bounces : int
        How many reflections by surfaces paths have at most, from 1 to 16.
    exclude : iterable of Node
        Nodes that are left out with all nodes below them, for example those that move.
    near, far : float
        Clip distances of the captures, world units, 0 < near < far.
    progress : callable, optional
        Called after each capture with how many are done and how many there are. If it raises, the grid stays as it was.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture` raises, and for bounces out of their range.

    Examples
    --------
    A white sky lights a matt surface alike from all around:

    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 1, 1))
    >>> grid = cc.ProbeGrid(((-1, 0, -1), (1, 2, 1)), (2, 2, 2), size=8)
    >>> with cc.Renderer() as renderer:
    ...     grid.bake(renderer, scene)
    >>> (grid.coefficients[0, 0, 0, 0] / (4 * 3.14159265) ** 0.5).round(4).tolist()
    [1.0, 1.0, 1.0]
    """
    whole_number(bounces, "bounces", 1, MOST_BOUNCES)
    for value, kind in ((renderer, Renderer), (scene, Scene)):
        if not isinstance(value, kind):
            word = kind.__name__
            raise TypeError(f"{word.lower()}: expected a {word}, got {text_of(value)}")
    if progress is not None and not callable(progress):
        raise TypeError(f"progress: expected a callable or None, got {text_of(progress)}")
    left_out = _nodes_of(exclude)
    nx, ny, nz = self.counts
    places = _places(self).reshape(-1, 3)
    total = len(places) * (bounces + 1)
    old = self.coefficients, self.distances, self.active
    shown = scene.probe_grid

    def capture(of: Scene, place: Array, **options: Any) -> Any:
        return renderer.capture(of, place, self.size, near=near, far=far, **options)

    done = 0

    def step() -> None:
        nonlocal done
        done += 1
        if progress is not None:
            progress(done, total)

    directions, shares = _texels(self.size)
    lobes = _lobes(_octahedral_directions(self.resolution), directions, shares)
    reach = _REACH * float(
        np.linalg.norm((self.box[1] - self.box[0]) / (np.array(self.counts) - 1))
    )
    try:
        scene.probe_grid = self
        self.coefficients = np.zeros_like(old[0])
        backs = _scene_of_backs(scene, left_out)
        active = np.empty(len(places), bool)
        for i, place in enumerate(places):
            seen = capture(backs, place, format="rgba8").faces[..., 0].reshape(-1) > 127
            active[i] = shares[seen].sum() <= _BACKS
            step()
        self.active = active.reshape(nz, ny, nx)
        distances = np.empty((len(places), self.resolution**2, 2), np.float32)
        for bounce in range(bounces):
            light = np.empty((len(places), 9, 3))
            for i, place in enumerate(places):
                outputs = ("distance",) if bounce == 0 else ()
                cube = capture(scene, place, exclude=left_out, outputs=outputs)
                light[i] = cube.sh(2)[:, :3]
                if bounce == 0:
                    far_off = np.minimum(cube.outputs["distance"].reshape(-1), reach)
                    distances[i] = lobes @ np.stack([far_off, far_off**2], axis=-1)
                step()
            if bounce == 0:
                self.distances = distances.reshape(old[1].shape)
            self.coefficients = _spread(light.reshape(old[0].shape), self.active)
    except BaseException:
        self.coefficients, self.distances, self.active = old
        raise
    finally:
        scene.probe_grid = shown


def _nodes_of(exclude: Iterable[Node]) -> list[Node]:
    if isinstance(exclude, (Node, str, bytes)) or not isinstance(exclude, Iterable):
        raise TypeError(f"exclude: expected a sequence of Nodes, got {text_of(exclude)}")
    found = list(exclude)
    for node in found:
        if not isinstance(node, Node):
            raise TypeError(f"exclude: expected Nodes, got {text_of(node)}")
    return found


def _places(grid: ProbeGrid) -> Array:
    """The nodes' positions, (nz, ny, nx, 3)."""
    low, high = grid.box
    axes = [np.linspace(low[i], high[i], grid.counts[i]) for i in range(3)]
    z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
    return np.stack([x, y, z], axis=-1)


def _texels(size: int) -> tuple[Array, Array]:
    """Directions of a cubemap's texels (6 N^2, 3), and the share of the sphere that each covers (6 N^2,)."""
    ticks = (np.arange(size) + 0.5) / size * 2 - 1
    t, s = np.meshgrid(ticks, ticks, indexing="ij")
    one = np.ones_like(s)
    # docs/conventions.md: +X -X +Y -Y +Z -Z in the layout of OpenGL.
    faces = [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one)]
    directions = np.stack([np.stack(face, axis=-1) for face in faces]).reshape(-1, 3)
    squares = (directions**2).sum(axis=-1)
    shares = squares**-1.5
    return directions / np.sqrt(squares)[:, None], shares / shares.sum()


def _octahedral_directions(resolution: int) -> Array:
    """Directions of an octahedral map's texels, (R^2, 3), as shaders/include/probe_grid.glsl looks them up."""
    ticks = (np.arange(resolution) + 0.5) / resolution * 2 - 1
    v, u = np.meshgrid(ticks, ticks, indexing="ij")
    z = 1 - np.abs(u) - np.abs(v)
    fold = np.maximum(-z, 0)
    found = np.stack([u - np.sign(u) * fold, v - np.sign(v) * fold, z], axis=-1).reshape(-1, 3)
    unit: Array = found / np.linalg.norm(found, axis=-1, keepdims=True)
    return unit


def _lobes(centers: Array, directions: Array, shares: Array) -> Array:
    """Weights of texels in the means round centers: rows sum to 1."""
    weights = np.maximum(centers @ directions.T, 0) ** _SHARPNESS * shares
    # A lobe narrower than a texel sees the nearest one.
    nearest = (centers @ directions.T).argmax(axis=-1)
    weights[np.arange(len(centers)), nearest] += 1e-12
    means: Array = weights / weights.sum(axis=-1, keepdims=True)
    return means


def _scene_of_backs(scene: Scene, exclude: list[Node]) -> Scene:
    """The same surfaces, their backs white and all else black; surfaces with two sides have no back."""
    made = Scene(background=(0, 0, 0))
    ids = frozenset(node.id for node in scene.nodes)
    for node in scene.nodes:
        if node.mesh is None or not _is_captured(node, exclude):
            continue
        material = node.material
        assert material is not None  # nodes with a mesh have one
        if material.blend not in (None, "opaque") or material.opacity < 1:
            continue
        drawn = deformed_mesh(node, ids)
        two = material.double_sided
        made.add(drawn.mesh, _flat(0, double_sided=two), matrix=drawn.matrix)
        if not two:
            turned = Mesh(drawn.mesh.positions, drawn.mesh.indices[:, ::-1])
            made.add(turned, _flat(1), matrix=drawn.matrix)
    return made


def _flat(level: float, double_sided: bool = False) -> BasicMaterial:
    return BasicMaterial(color=(level,) * 3, double_sided=double_sided)


def _is_captured(node: Node, exclude: list[Node]) -> bool:
    at: Node | None = node
    while at is not None:
        if not (at.visible and at.in_captures) or at in exclude:
            return False
        at = at.parent
    return True


def _spread(light: Array, active: npt.NDArray[np.bool_]) -> npt.NDArray[np.float32]:
    """Give each node that is not active the mean of those beside it that have light, until all have."""
    light, known = light.copy(), active.copy()
    while not known.all() and known.any():
        total, count = np.zeros_like(light), np.zeros(known.shape)
        for axis in range(3):
            for way in (1, -1):
                beside = np.roll(known, way, axis)
                moved = np.roll(light, way, axis)
                edge = [slice(None)] * 3
                edge[axis] = slice(0, 1) if way == 1 else slice(-1, None)
                beside[tuple(edge)] = False  # no way round the box
                total += np.where(beside[..., None, None], moved, 0)
                count += beside
        new = ~known & (count > 0)
        light[new] = total[new] / count[new][:, None, None]
        known |= new
    return light.astype(np.float32)
