"""`render` and `capture`: a scene by exact rays, piece by piece, until it is good enough."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .. import _core
from .._calls import checked_call
from .._checks import pair, real_number, whole_number
from .._processes import interpreter
from .._progress import bar
from .arguments import Quality, matrix_of, nodes_of, of_class, output_names, quality_of, vector
from .eyes import CameraEye, CubeEye, Eye
from .outputs import outputs_of
from .pictures import TruthCube, TruthFrame, cube_of, frame_of
from .scene.snapshot import read
from .sums import Sums
from .surfaces.trees import embree
from .work import PATHS, Job, pieces
from .workers import Workers

if TYPE_CHECKING:
    from .._core import Camera, Node, RenderTexture, Scene
    from .paths.tracer import Tracer

#: Samples of a pixel that are drawn before the picture is judged again.
_PASS = 16
#: Paths of a pass of a small picture, which takes more samples at once.
_PASS_PATHS = PATHS
#: Paths below which a piece costs more for each path.
_FEWEST = PATHS // 16
#: Paths that one process draws in less time than others take to start.
_FEW = 8 * PATHS


@checked_call
def render(
    scene: Scene,
    camera: Camera,
    size: tuple[int, int],
    *,
    bounces: int = 4,
    samples: int = 64,
    seed: int = 0,
    target_error: float | None = None,
    deadline: float | None = None,
    processes: int | None = None,
    outputs: Iterable[str] = (),
    exclude: Iterable[Node] = (),
    self_hits: bool = True,
    progress: bool | None = None,
) -> TruthFrame:
    """Render a scene by exact rays instead of cubemaps and shadow maps.

    Materials and lights are those of the renderer, and so are their formulas. What the renderer approximates is exact:
    mirrors and glass show what their rays meet, other mirrors included; light passes through both sides of a glass
    body; rough surfaces gather light from all around, by random samples; shadows have sharp edges.

    Parameters
    ----------
    scene : Scene
    camera : PerspectiveCamera or OrthographicCamera
    size : (int, int)
        (width, height), pixels.
    bounces : int
        How often a path may leave a mirror, a surface of glass or a `StandardMaterial`, at least 0. A glass ball takes
        two. After that, a surface sees its environment as if nothing stood in the way, or black without one.
    samples : int
        Paths of each pixel, from 1 to 65536. 1: through the middle of the pixel. More are spread over the pixel, so
        edges are smooth.
    seed : int
        Of the random numbers, from 0 to 2**32 - 1. A picture is the same for the same seed, whatever `processes` is.
    target_error : float, optional
        Stop as soon as the noise of the picture (`TruthFrame.noise`) is at most this, judged every 16 samples: 0.01 is
        1 %. `samples` is then the most that is drawn. None: draw all samples.
    deadline : float, optional
        Seconds of wall time, above 0, after which the picture is given as it is.
    processes : int, optional
        Processes that draw, at least 1. None: one for each processor that this process may use, but 1 for a small
        picture.
    outputs : sequence of str
        Any of "distance", "z", "normal", "position", "id" and "label": what the first opaque surface along the ray
        through the middle of each pixel is, as `Renderer.render` gives it.
    exclude : sequence of Node
        Nodes of the scene that the picture leaves out, with all nodes below them; mirrors still show them.
    self_hits : bool
        Whether a node's reflection shows the node itself, as that of a teapot shows its spout. A probe leaves its own
        node out: False compares with that.
    progress : bool, optional
        Whether a bar shows the progress. None: if the standard error stream is a terminal.

    Returns
    -------
    TruthFrame
        Float32 colour, linear, with the outputs and with the noise of each pixel. Ctrl-C gives what is done; `complete`
        is then False.

    Raises
    ------
    ValueError
        For a number out of its range, an unknown output, or what rays cannot follow: a `ShaderMaterial`, effects of a
        render texture, a probe as `BasicMaterial.cubemap`, a stencil, ``depth_test=False``, channels that are not
        written, an opaque surface that writes no depth, a `Blend` that is not a sum, or a product with the colour
        behind ("multiply") on a mirror, glass or a `StandardMaterial`. The message names the node. Also for a picture
        that no memory holds, and for a node of another scene in `exclude`.
    TypeError
        For an argument of another type, such as a `StereoCamera`.
    ImportError
        Without embreex, the extra `truth`.

    Notes
    -----
    A path is followed from the eye (J. Kajiya, "The Rendering Equation", SIGGRAPH 1986); `StandardMaterial` chooses the
    next direction by its own lobes and by the brightness of its environment, weighted by the balance heuristic
    (E. Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997). A `PhongMaterial` ends a path: the
    model has no light from other surfaces. Textures are looked up without mipmaps, and occlusion maps are left out,
    since rays find what they stand for. A camera inside a body of glass sees as if the body were not there, since its
    surfaces show no backs; rays from a surface in the body meet its sides.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(.2, .3, .4))
    >>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial())
    >>> floor = scene.add(cc.Mesh.plane(4, 4), cc.BasicMaterial(color=(1, 0, 0)), position=(0, -.6, 0))
    >>> camera = cc.PerspectiveCamera(position=(0, 0, 3))
    >>> exact = cc.truth.render(scene, camera, (32, 32), samples=4, outputs=("id",))
    >>> exact.color.dtype.name, int(exact.id[16, 16]), bool(exact.color[20, 16, 0] > .9)
    ('float32', 1, True)
    """
    of_class(scene, _core.Scene, "scene")
    of_class(camera, _core.Camera, "camera")
    width, height = pair(size, "size")
    whole_number(width, "size", 1)
    whole_number(height, "size", 1)
    quality = quality_of(
        bounces, samples, seed, target_error, deadline, processes, self_hits, progress
    )
    names = output_names(outputs)
    eye = CameraEye.of(camera, (width, height))
    made = _draw(scene, eye, names, nodes_of(exclude, scene), quality, of_capture=False)
    return TruthFrame(frame_of(made.color, made.outputs), **made.rest)


@checked_call
def capture(
    scene: Scene,
    position: npt.ArrayLike = (0.0, 0.0, 0.0),
    size: int = 256,
    *,
    bounces: int = 4,
    samples: int = 64,
    seed: int = 0,
    target_error: float | None = None,
    deadline: float | None = None,
    processes: int | None = None,
    outputs: Iterable[str] = (),
    exclude: Iterable[Node] = (),
    near: float = 0.05,
    far: float = 1000.0,
    rotation: npt.ArrayLike | None = None,
    self_hits: bool = True,
    progress: bool | None = None,
) -> TruthCube:
    """Capture the surroundings of a point into a cubemap, by exact rays.

    Parameters
    ----------
    scene : Scene
    position : array_like (3,)
        World position.
    size : int
        Texels along an edge of a face, at least 1.
    bounces, samples, seed, target_error, deadline, processes, outputs, exclude, self_hits, progress
        As for `render`.
    near, far : float
        Clip distances along each face's axis, world units, 0 < near < far.
    rotation : array_like (4,), optional
        Quaternion (w, x, y, z) that turns the cube's axes, as for `Renderer.capture`. None: the axes are the world's.

    Returns
    -------
    TruthCube
        Float32 faces in the layout of docs/conventions.md, with the outputs and with the noise of each texel.

    Raises
    ------
    ValueError, TypeError, ImportError
        As `render`; ValueError, too, for a position, distances or a rotation that are not finite, or a rotation of
        length 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 1, 1))
    >>> floor = scene.add(cc.Mesh.plane(4, 4), cc.BasicMaterial(color=(1, 0, 0)), position=(0, -1, 0))
    >>> exact = cc.truth.capture(scene, (0, 0, 0), 8, samples=1, outputs=("distance",))
    >>> exact.sample((0, -1, 0)).tolist(), round(float(exact.distance.min()), 2)
    ([1.0, 0.0, 0.0, 1.0], 1.02)
    """
    of_class(scene, _core.Scene, "scene")
    texels = whole_number(size, "size", 1)
    quality = quality_of(
        bounces, samples, seed, target_error, deadline, processes, self_hits, progress
    )
    near, far = real_number(near, "near"), real_number(far, "far")
    if not 0 < near < far or not math.isfinite(far):
        raise ValueError(f"near, far: expected 0 < near < far, finite, got {near} and {far}")
    names = output_names(outputs)
    eye = CubeEye(vector(position, 3, "position"), matrix_of(rotation), near, far, texels)
    made = _draw(scene, eye, names, nodes_of(exclude, scene), quality, of_capture=True)
    return TruthCube(cube_of(made.color, made.outputs), **made.rest)


@dataclass
class _Made:
    color: npt.NDArray[np.float32]
    outputs: dict[str, npt.NDArray[Any]]
    rest: dict[str, Any]


def _draw(
    scene: Scene,
    eye: Eye,
    names: tuple[str, ...],
    exclude: tuple[Node, ...],
    quality: Quality,
    *,
    of_capture: bool,
    shown: tuple[object, ...] = (),
    started: float | None = None,
) -> _Made:
    started = time.monotonic() if started is None else started
    count = math.prod(eye.shape)
    if count > 1 << 60:  # a float need not hold it
        raise ValueError(
            "size: expected a picture that fits into memory, got more than 2**60 pixels"
        )
    _core._check_memory(100.0 * count, f"pixels of shape {eye.shape}")
    textures = _Textures(quality, shown, started)
    snapshot = read(scene, exclude=exclude, textures=textures)
    job = Job(
        snapshot,
        eye,
        quality.bounces,
        quality.samples,
        quality.seed,
        quality.self_hits,
        of_capture,
    )
    embree()  # an error here says more than one in another process
    tracer = job.tracer() if names else None
    found = {} if tracer is None else outputs_of(tracer, eye, names)
    sums = Sums(np.zeros((count, 6)))
    done = _fill(job, tracer, sums, quality, started, inner=bool(shown))
    with np.errstate(invalid="ignore"):
        color = np.where(sums.samples[:, None] > 0, sums.color / sums.samples[:, None], 0.0)
    rest = {
        "samples": sums.samples.reshape(eye.shape),
        "deviation": sums.deviation().astype(np.float32).reshape(eye.shape),
        "noise": sums.noise(),
        "seconds": time.monotonic() - started,
        "complete": done and textures.complete,
    }
    return _Made(color.astype(np.float32).reshape(*eye.shape, 4), found, rest)


def _fill(
    job: Job, tracer: Tracer | None, sums: Sums, quality: Quality, started: float, *, inner: bool
) -> bool:
    """Draw pass after pass into the sums; False if it was ended before the end.

    Ctrl-C in the picture of a texture, an `inner` one, is passed on, since nothing of the outer picture is done.
    """
    count = len(sums.table)
    # Passes of few pixels are longer, unless the picture may end after each of them.
    length = _PASS if quality.target_error is not None else max(_PASS, _PASS_PATHS // count)
    passes = [
        (first, min(first + length, quality.samples)) for first in range(0, quality.samples, length)
    ]
    processes = _processes(quality, count)
    # All processes have something to do in each pass, and a part is large enough for numpy.
    paths = max(count * length // (2 * processes), _FEWEST) if processes > 1 else PATHS
    parts = [pieces(count, each, paths) for each in passes]
    end = math.inf if quality.deadline is None else started + quality.deadline
    try:
        with (
            bar("exact rays", sum(map(len, parts)), quality.progress) as advance,
            Workers(job, processes, tracer) as workers,
        ):
            for part in parts:
                for piece, (color, squares) in workers.draw(part):
                    sums.add(piece, color, squares)
                    advance()
                    if time.monotonic() > end:
                        return bool((sums.samples == quality.samples).all())
                if quality.target_error is not None and sums.noise() <= quality.target_error:
                    return True
    except KeyboardInterrupt:
        if inner:
            raise
        return False
    return quality.target_error is None or sums.noise() <= quality.target_error


def _processes(quality: Quality, pixels: int) -> int:
    if quality.processes is not None:
        return quality.processes
    if pixels * quality.samples <= _FEW or interpreter() is None:
        return 1
    return max(len(os.sched_getaffinity(0)), 1)


class _Textures:
    """Makes the pictures of render textures: by exact rays, too, which see other textures in turn."""

    def __init__(self, quality: Quality, shown: tuple[object, ...], started: float) -> None:
        self._quality, self._shown, self._started = quality, shown, started
        self._made: dict[int, npt.NDArray[np.float32]] = {}
        self.complete = True

    def __call__(self, source: RenderTexture) -> npt.NDArray[np.float32]:
        if any(source is other for other in self._shown):
            raise ValueError(
                f"render texture {source.name!r}: expected a picture that does not show itself"
            )
        if id(source) not in self._made:
            picture = _draw(
                source.scene,
                CameraEye.of(source.camera, source.size),
                (),
                source.exclude,
                self._quality,
                of_capture=False,
                shown=(*self._shown, source),
                started=self._started,
            )
            self.complete &= bool(picture.rest["complete"])
            clipped = source.format in ("rgba8", "rgb565")
            self._made[id(source)] = np.clip(picture.color, 0, 1) if clipped else picture.color
        return self._made[id(source)]
