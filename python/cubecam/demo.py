"""The demo: a bunny and a teapot circle a mirror ball at the sea, drawn in every kind of picture.

The command line, a notebook and the tests use the scene that `build_scene` makes.
"""

from __future__ import annotations

import math
import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._calls import checked_call
from ._checks import text_of
from ._core import (
    CubeMap,
    DirectionalLight,
    Frame,
    Image,
    Mesh,
    MirrorMaterial,
    Node,
    PerspectiveCamera,
    PhongMaterial,
    Probe,
    Renderer,
    Scene,
    Shadow,
    axis_angle,
)
from .data import sample_data
from .io.cubemaps import load_environment
from .io.files import PathLike, as_path
from .io.images import save_animation, save_image
from .io.meshes.load import load_mesh
from .io.screen import to_screen
from .pictures import cube_picture

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    import numpy.typing as npt
    from rich.console import Console
    from rich.progress import Progress, TaskID

__all__ = ["DemoScene", "Step", "build_scene", "named_cross", "run"]

_START = 350.0  # degrees: where the bunny stands in still pictures
_ORBIT = 1.45  # world units from the ball's center to the bunny and the teapot
_FLOOR = -0.75  # world units: the height of the terrace, on which the ball rests


@dataclass(slots=True)
class DemoScene:
    """The scene with the objects that a program moves or looks at."""

    scene: Scene
    camera: PerspectiveCamera
    ball: Node
    bunny: Node
    teapot: Node

    @checked_call
    def turn(self, angle: float) -> None:
        """Place bunny and teapot on opposite sides of their circle round the ball, turned with it.

        Parameters
        ----------
        angle : float, degrees
            The angle of the bunny, counter-clockwise seen from above; 0 is +X, 90 is -Z (away from the camera).
        """
        for node, own in ((self.bunny, angle), (self.teapot, angle + 180)):
            radians = math.radians(own)
            lowest = node.mesh.bounds[0][1] if node.mesh else 0.0
            node.position = (
                _ORBIT * math.cos(radians),
                _FLOOR - lowest,
                -_ORBIT * math.sin(radians),
            )
            node.rotation = axis_angle((0, 1, 0), own)


@checked_call
def build_scene(*, environment: CubeMap | None = None, probe_size: int = 256) -> DemoScene:
    """Build the scene: a bunny, a teapot, and a mirror ball that follows both, on a terrace at the sea.

    Parameters
    ----------
    environment : CubeMap, optional
        The surroundings of the scene. None: the sample photograph of a quay at sunset.
    probe_size : int
        Texels along a face of the cubemap that the ball shows.

    Returns
    -------
    DemoScene

    Examples
    --------
    >>> from cubecam.demo import build_scene
    >>> demo = build_scene(probe_size=64)
    >>> demo.turn(90)
    >>> [round(float(x), 2) + 0 for x in demo.bunny.position]
    [0.0, -0.19, -1.45]
    """
    if environment is None:
        environment = load_environment(sample_data("sunset.exr"))
    scene = Scene(environment=environment)
    sharp, soft = Shadow(size=2048, radius=4), Shadow(size=128, radius=5)
    scene.add(DirectionalLight((-1, -0.75, 0.5), color="#ffd2a0", intensity=1.3, shadow=sharp))
    scene.add(DirectionalLight((0.3, -1, -0.6), color="#c8d4ff", intensity=0.6, shadow=soft))
    stone = PhongMaterial(color="#d8b8a8", kd=0.8, ks=0, map=_tiles())
    scene.add(Mesh.cylinder(3.6, 0.3, 128), stone, name="ground", position=(0, _FLOOR - 0.15, 0))
    clay = PhongMaterial(color="#f08070", kd=0.8, ks=0.3, shininess=30)
    bunny = scene.add(load_mesh(sample_data("bunny.obj"), size=1.15), clay, name="bunny")
    glaze = PhongMaterial(color="#4fb3aa", kd=0.8, ks=0.5, shininess=40)
    teapot = scene.add(load_mesh(sample_data("teapot.obj"), size=1.1), glaze, name="teapot")
    ball = scene.add(Mesh.sphere(-_FLOOR), MirrorMaterial(tint="#ffe9c4"), name="ball")
    ball.environment = Probe(position=(0, 0, 0), size=probe_size)
    camera = PerspectiveCamera(fov=32, position=(2.7, 0.6, 5.8), target=(0, -0.08, 0))
    demo = DemoScene(scene, camera, ball, bunny, teapot)
    demo.turn(_START)
    return demo


def _tiles() -> Image:
    """A chessboard of 16 x 16 tiles in two shades of grey."""
    board = np.indices((16, 16)).sum(axis=0) % 2
    return Image(0.75 + 0.25 * np.kron(board, np.ones((32, 32)))[..., None], mipmaps=True)


@checked_call
def named_cross(cube: CubeMap) -> npt.NDArray[np.uint8]:
    """Draw a cubemap as a cross seen from inside, with the name of each face in its upper left corner.

    Parameters
    ----------
    cube : CubeMap
        N texels along an edge of a face.

    Returns
    -------
    ndarray (3N, 4N, 4) uint8
        Cells without a face are transparent.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.demo import named_cross
    >>> named_cross(cc.load_environment(cc.sample_data("forest.exr"), size=64)).shape
    (192, 256, 4)
    """
    from PIL import Image as Picture
    from PIL import ImageDraw, ImageFont

    from .plot._faces import cells

    picture = Picture.fromarray(cube_picture(cube))
    draw = ImageDraw.Draw(picture)
    size = cube.size
    font = ImageFont.load_default(max(1, size // 9))
    stroke = max(1, size // 128)
    for cell in cells("inside"):
        corner = (cell.column * size + size // 18, cell.row * size + size // 24)
        draw.text(corner, cell.name, "white", font, stroke_width=stroke, stroke_fill="#303848")
    return np.asarray(picture)


@dataclass(frozen=True)
class Step:
    """One step of the demo: its name, the file that it wrote or None, and its time in seconds."""

    name: str
    path: Path | None
    seconds: float


@checked_call
def run(
    out: PathLike = "out",
    *,
    frames: int = 100,
    size: int = 1024,
    device: str | int | None = None,
    console: Console | None = None,
) -> list[Step]:
    """Render the demo and write its pictures, with a progress bar.

    Parameters
    ----------
    out : path
        The folder to write to; it is made if it does not exist.
    frames : int
        Number of pictures of the animation, which shows one turn; 25 are shown in a second.
    size : int
        Width of the frame in pixels; its height is 3/4 of that. The animation and the cubemap's faces have half
        the width.
    device : str or int, optional
        The device of the `Renderer`.
    console : rich.console.Console, optional
        The console for reports; standard output by default.

    Returns
    -------
    list of Step
        The steps in their order.
    """
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    for name, number in (("frames", frames), ("size", size)):
        if number < 1:
            raise ValueError(f"{name}: expected at least 1, got {number}")
    if console is not None and not isinstance(console, Console):
        raise TypeError(f"console: expected a rich Console or None, got {text_of(console)}")
    console = console or Console()
    folder = as_path(out)
    folder.mkdir(parents=True, exist_ok=True)
    columns = (
        TextColumn("{task.description:<26}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console) as progress:
        task = progress.add_task("starting", total=_STEPS + frames)
        steps = _Steps(folder, progress, task)
        drawn_by = _draw(steps, frames, size, device)
        progress.update(task, description="done")
    _report(console, steps.done, drawn_by)
    return steps.done


_STEPS = 8  # besides the frames of the animation


class _Steps:
    """Names each step on the progress bar and times it."""

    def __init__(self, folder: Path, progress: Progress, task: TaskID) -> None:
        self.folder, self.done = folder, list[Step]()
        self._progress, self._task = progress, task

    def advance(self) -> None:
        self._progress.advance(self._task)

    @contextmanager
    def step(self, name: str, file: str = "") -> Iterator[Path]:
        self._progress.update(self._task, description=name)
        start = time.perf_counter()
        path = self.folder / file
        yield path
        self.done.append(Step(name, path if file else None, time.perf_counter() - start))


def _draw(steps: _Steps, frames: int, size: int, device: str | int | None) -> str:
    """Run all steps and return the name of the device."""
    half = max(1, size // 2)
    with steps.step("photograph and meshes"):
        demo = build_scene(probe_size=half)
        steps.advance()
    with steps.step("context"):
        renderer = Renderer(device=device)
        steps.advance()
    with renderer:
        with steps.step("frame", "frame.png") as path:
            _frame(renderer, demo, size).save(path)
            steps.advance()
        with steps.step("capture of six faces"):
            cube = renderer.capture(demo.scene, size=half, exclude=[demo.ball], samples=4)
            steps.advance()
        with steps.step("cross, as captured", "cross.exr") as path:
            cube.save(path, layout="cross", convention="inside")
            steps.advance()
        with steps.step("cross, for the screen", "cross.png") as path:
            save_image(path, named_cross(cube))
            steps.advance()
        with steps.step("panorama, as captured", "panorama.exr") as path:
            cube.save(path, layout="equirect")
            steps.advance()
        with steps.step("panorama, for the screen", "panorama.png") as path:
            cube.save(path, layout="equirect")
            steps.advance()
        with steps.step("animation", "turn.png") as path:
            demo = build_scene(probe_size=max(1, half // 2))
            pictures = []
            for index in range(frames):
                demo.turn(_START + 360 * index / frames)
                pictures.append(to_screen(_frame(renderer, demo, half)))
                steps.advance()
            save_animation(path, pictures, fps=25)
        return f"{renderer.info.renderer}, OpenGL {renderer.info.version}"


def _frame(renderer: Renderer, demo: DemoScene, size: int) -> Frame:
    """Render the camera's view, `size` pixels wide."""
    shape = (size, max(1, size * 3 // 4))
    return renderer.render(demo.scene, demo.camera, size=shape, samples=4, format="rgba16f")


def _report(console: Console, steps: list[Step], drawn_by: str) -> None:
    for step in steps:
        line = f"{step.name:<26}{step.seconds:7.2f} s  {step.path or ''}".rstrip()
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    console.print(f"drawn by {drawn_by}", highlight=False, markup=False, soft_wrap=True)
