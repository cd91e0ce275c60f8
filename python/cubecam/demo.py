"""The demo: a bunny and a teapot circle a mirror ball on a photographed quay, drawn in every kind of picture.

The command line, a notebook and the tests use the scene that `build_scene` makes.
"""

from __future__ import annotations

import math
import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._calls import checked_call
from ._core import (
    CubeMap,
    Mesh,
    MirrorMaterial,
    Node,
    PerspectiveCamera,
    PhongMaterial,
    PointLight,
    Probe,
    Renderer,
    Scene,
    axis_angle,
)
from .data import sample_data
from .io.cubemaps import load_environment
from .io.files import PathLike, as_path
from .io.images import save_animation, save_image
from .io.meshes import load_mesh
from .io.screen import to_screen
from .pictures import cube_picture

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from rich.console import Console
    from rich.progress import Progress, TaskID

__all__ = ["DemoScene", "Step", "build_scene", "run"]

_START = 320.0  # degrees: where the bunny stands in still pictures
_ORBIT = 1.4  # world units from the ball's center to the bunny and the teapot


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
            node.position = (_ORBIT * math.cos(radians), -0.1, -_ORBIT * math.sin(radians))
            node.rotation = axis_angle((0, 1, 0), own)


@checked_call
def build_scene(*, environment: CubeMap | None = None, probe_size: int = 256) -> DemoScene:
    """Build the scene: a ground, a bunny, a teapot, and a mirror ball that follows both.

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
    >>> [round(float(x), 3) + 0 for x in demo.bunny.position]
    [0.0, -0.1, -1.4]
    """
    if environment is None:
        environment = load_environment(sample_data("sunset.exr"))
    scene = Scene(environment=environment)
    scene.add(PointLight(position=(3, 4, 3)))
    scene.add(Mesh.plane(10, 10), PhongMaterial(color=(0.4, 0.4, 1)), position=(0, -2, 0))
    bunny = scene.add(
        load_mesh(sample_data("bunny.obj"), size=1), PhongMaterial(color=(1, 0.4, 0.4))
    )
    teapot = scene.add(
        load_mesh(sample_data("teapot.obj"), size=1), PhongMaterial(color=(0.4, 1, 0.4))
    )
    gold = MirrorMaterial(color=(0.95, 0.85, 0.4), env_weight=0.78, color_weight=0.3)
    ball = scene.add(Mesh.sphere(0.5), gold)
    ball.environment = Probe(position=(0, 0, 0), size=probe_size)
    camera = PerspectiveCamera(fov=50, position=(0, 1.2, 4.2), target=(0, -0.1, 0))
    demo = DemoScene(scene, camera, ball, bunny, teapot)
    demo.turn(_START)
    return demo


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
    frames: int = 36,
    size: int = 512,
    device: str | int | None = None,
    console: Console | None = None,
) -> list[Step]:
    """Render the demo and write its pictures, with a progress bar.

    Parameters
    ----------
    out : path
        The folder to write to; it is made if it does not exist.
    frames : int
        Number of pictures of the animation, which shows one turn.
    size : int
        Width and height of the frame in pixels. The animation and the cubemap's faces have half of it.
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
            save_image(path, _frame(renderer, demo, size))
            steps.advance()
        with steps.step("capture of six faces"):
            cube = renderer.capture(demo.scene, position=(0, 0, 0), size=half, exclude=[demo.ball])
            steps.advance()
        with steps.step("cross, as captured", "cross.exr") as path:
            cube.save(path, layout="cross", convention="inside")
            steps.advance()
        with steps.step("cross, for the screen", "cross.png") as path:
            save_image(path, cube_picture(cube))
            steps.advance()
        with steps.step("panorama, as captured", "panorama.exr") as path:
            panorama = cube.to_equirect(width=4 * half)
            save_image(path, panorama)
            steps.advance()
        with steps.step("panorama, for the screen", "panorama.png") as path:
            save_image(path, to_screen(panorama))
            steps.advance()
        with steps.step("animation", "turn.png") as path:
            pictures = []
            for index in range(frames):
                demo.turn(_START + 360 * index / frames)
                pictures.append(_frame(renderer, demo, half))
                steps.advance()
            save_animation(path, pictures, fps=12)
        return f"{renderer.info.renderer}, OpenGL {renderer.info.version}"


def _frame(renderer: Renderer, demo: DemoScene, size: int) -> Any:
    """Render the camera's view, ready for the screen."""
    frame = renderer.render(
        demo.scene, demo.camera, size=(size, size), samples=4, tonemap="neutral", encode="srgb"
    )
    return frame.color


def _report(console: Console, steps: list[Step], drawn_by: str) -> None:
    for step in steps:
        line = f"{step.name:<26}{step.seconds:7.2f} s  {step.path or ''}".rstrip()
        console.print(line, highlight=False, markup=False, soft_wrap=True)
    console.print(f"drawn by {drawn_by}", highlight=False, markup=False, soft_wrap=True)
