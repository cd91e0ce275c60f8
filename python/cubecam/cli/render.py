"""`cubecam render`: a picture, a turntable or an animation of a model, in the light of an environment."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click
from click.shell_completion import CompletionItem

from .. import Renderer
from .common import (
    FILE,
    NUMBER,
    SAMPLE_LIGHT,
    Curve,
    WholeNumber,
    choice,
    device_option,
    failures_reported,
    parse_device,
    sample_light,
    warnings_reported,
    words,
)
from .help import Command, argument, option
from .preview import preview, preview_option

if TYPE_CHECKING:
    from .. import CubeMap, Frame
    from ..staging.shoot import Shoot

T = TypeVar("T")

_MOVING = (".gif", ".webp", ".apng", ".mp4")
_LIGHT = (".exr", ".hdr", ".pic", ".pfm")  # files of light, not of a screen's numbers
_WITH_ALPHA = (".png", ".apng", ".webp", ".exr", ".tif", ".tiff", ".tga")
_BACKGROUNDS = ("blurred", "environment", "transparent")
_SECONDS, _LONGEST = 4.0, 100_000  # of a turntable; frames
_STILL, _FILM = (1200, 900), (640, 480)
_MOST = 16384  # pixels along a side


class _Angles(click.ParamType):
    """Two numbers with a comma between them."""

    name = "angles"

    def convert(self, value: Any, param: Any, ctx: Any) -> tuple[float, float]:
        parts = str(value).split(",")
        if len(parts) != 2:
            self.fail(f"expected two numbers as 30,15, got {str(value)!r}", param, ctx)
        azimuth, elevation = (NUMBER.convert(part, param, ctx) for part in parts)
        if not -89 <= elevation <= 89:
            self.fail(f"expected an elevation from -89 to 89, got {elevation:g}", param, ctx)
        return azimuth, elevation


class _Size(click.ParamType):
    """A width and a height, or a width alone."""

    name = "size"

    def convert(self, value: Any, param: Any, ctx: Any) -> tuple[int, int]:
        if isinstance(value, tuple):
            return cast("tuple[int, int]", value)
        sides = str(value).lower().split("x")
        if len(sides) > 2 or not all(side.isdecimal() and 0 < int(side) <= _MOST for side in sides):
            told = f"expected 1200x900 or 1200, sides from 1 to {_MOST}, got {str(value)!r}"
            self.fail(told, param, ctx)
        width = int(sides[0])
        return width, int(sides[1]) if len(sides) == 2 else max(1, round(width * 3 / 4))


def _environments(ctx: Any, param: Any, incomplete: str) -> list[CompletionItem]:
    """List the sample photographs, and let the shell complete the names of files."""
    from ..data import sample_data

    names = [Path(name).stem for name in sample_data() if name.endswith(".exr")]
    found = [CompletionItem(name) for name in names if name.startswith(incomplete)]
    return [*found, CompletionItem(incomplete, type="file")]


def _backgrounds(ctx: Any, param: Any, incomplete: str) -> list[CompletionItem]:
    return [CompletionItem(name) for name in _BACKGROUNDS if name.startswith(incomplete)]


@click.command(cls=Command)
@argument("model", type=FILE, metavar="MODEL", help="A GLB, glTF, OBJ, PLY, STL or OFF file.")
@option(
    "--output",
    "-o",
    type=FILE,
    metavar="FILE",
    help="The file to write: a picture (.png, .jpg, .tif), its light (.exr, .hdr), or a film (.gif, .webp, .mp4; .mp4 "
    "needs imageio-ffmpeg or the command ffmpeg).",
    note="the model's name with .png, in this folder",
)
@option(
    "--environment",
    "-e",
    metavar="FILE",
    shell_complete=_environments,
    help="The light from all around: a panorama or a cubemap, or the name of a sample photograph, such as studio.",
    note=f"the file's own lights and environment, or {Path(SAMPLE_LIGHT).stem} if it has none",
)
@option(
    "--variant", metavar="NAME", help="The variant of the materials.", note="the file's first look"
)
@option(
    "--size",
    "-s",
    type=_Size(),
    metavar="SIZE",
    help="Pixels: 1200x900, or 1200, which is as wide and 3/4 as high.",
    note="1200x900; 640x480 for a film",
)
@option("--samples", type=WholeNumber(1), metavar="COUNT", default=4, help="Samples of each pixel.")
@option(
    "--at",
    type=_Angles(),
    metavar="ANGLES",
    group="Camera",
    help="Azimuth and elevation of the camera, degrees: 0,0 looks from +Z, 90,0 from +X.",
    note="30,15",
)
@option(
    "--camera",
    metavar="NAME",
    group="Camera",
    help="A camera of the file, by its name or by its number from 0 on, in place of --at.",
)
@option(
    "--time",
    type=NUMBER,
    metavar="SECONDS",
    group="Time",
    help="The time of the animation.",
    note="no animation",
)
@option(
    "--animation",
    metavar="NAME",
    group="Time",
    help="An animation of the file, by its name or by its number from 0 on.",
    note="0",
)
@option(
    "--turns",
    type=NUMBER,
    metavar="NUMBER",
    group="Time",
    help="How often the camera of a film goes round the model.",
    note="1; 0 for a model that has an animation",
)
@option(
    "--seconds",
    type=NUMBER,
    metavar="SECONDS",
    group="Time",
    help="How long a film is.",
    note="that of the animation; 4 for a turntable",
)
@option(
    "--fps",
    type=NUMBER,
    metavar="NUMBER",
    default=25.0,
    group="Time",
    help="Frames a second of a film, up to 100.",
)
@option(
    "--background",
    metavar="NAME",
    shell_complete=_backgrounds,
    group="Look",
    help="blurred, environment, transparent, or a colour: a CSS name or #rrggbb.",
    note="blurred",
)
@option(
    "--ground",
    is_flag=True,
    group="Look",
    help="Lay a ground under the model, which shows its shadow.",
)
@option(
    "--exposure",
    type=NUMBER,
    metavar="STOPS",
    default=0.0,
    group="Look",
    help="Make the picture brighter (above 0) or darker than the light of the scene suggests. An .exr or .hdr "
    "holds the light itself, times two to this power.",
)
@option(
    "--tonemap",
    **choice(Curve),
    default="neutral",
    group="Look",
    help=f"The curve that brings light into 8 bits: {words(Curve)}, which clips.",
)
@preview_option
@device_option
def render(
    model: str,
    output: str | None,
    environment: str | None,
    variant: str | None,
    size: tuple[int, int] | None,
    samples: int,
    at: tuple[float, float] | None,
    camera: str | None,
    time: float | None,
    animation: str | None,
    turns: float | None,
    seconds: float | None,
    fps: float,
    background: str | None,
    ground: bool,
    exposure: float,
    tonemap: Curve,
    no_preview: bool,
    device: str | None,
) -> None:
    """Render a model: a picture, a turntable, or its animation.

    The camera sees all of the model. Examples: cubecam render bunny.obj; cubecam render car.glb -e studio --ground -o
    car.png; cubecam render car.glb -o turn.mp4; cubecam render fox.glb --animation Run -o fox.gif
    """
    path = output or f"{Path(model).stem}.png"
    ending = Path(path).suffix.lower()
    film = ending in _MOVING
    _check_options(path, film, background, at, camera, time, turns, seconds, fps)
    with failures_reported():
        if ending == ".mp4":
            from ..io.movie import find_ffmpeg

            find_ffmpeg(Path(path))  # a missing ffmpeg is an error before anything is drawn
        with warnings_reported(model):
            shoot = _stage(model, environment, variant)
        plan = _Plan.of(shoot, film, animation, time, turns, seconds, fps)
        pixels = size or (_FILM if film else _STILL)
        moves = film and plan.animation is not None
        moments = shoot.moments_of(plan.seconds) if moves else []
        if camera is not None:
            shoot.camera = _camera_of(shoot, camera)
            if plan.turns:
                raise ValueError(f"--turns: expected without --camera, got {plan.turns:g}")
        else:
            shoot.place_camera(
                at or (30.0, 15.0),
                pixels[0] / pixels[1],
                turns=plan.turns != 0,
                moments=moments,
                animation=plan.animation or 0,
            )
        with Renderer(device=parse_device(device)) as renderer:
            light = ending in _LIGHT
            stops = exposure if light else exposure + shoot.exposure(renderer)
            if ground:
                shoot.add_ground(
                    renderer, moving=moves, moments=moments, animation=plan.animation or 0
                )
            shoot.set_background(background)
            curve = None if tonemap == "none" else tonemap
            look: dict[str, Any] = {"samples": min(samples, renderer.info.limits.max_samples)}
            screen = _screen(shoot, background, stops, curve) if not light else None
            if light:
                look |= {"format": "rgba32f", "exposure": stops}
            elif screen is not None:
                look["format"] = "rgba32f"
            else:
                look |= {"encode": "srgb", "tonemap": curve, "exposure": stops}
            pixels_of = screen or (lambda frame: frame.color[..., :3])
            if film:
                shown = _save_film(path, shoot, renderer, pixels, plan, look, pixels_of)
            elif light:
                shown = _save_light(path, shoot, renderer, pixels, look)
            else:
                from .. import save_image

                shown = pixels_of(shoot.draw(renderer, pixels, **look))
                save_image(path, shown)
            drawn_by = str(renderer.info.renderer)
        click.echo(path)
        if not no_preview:
            preview(shown)
        triangles = sum(len(cast("Any", node.mesh).indices) for node in shoot.nodes)
        length = f", {plan.count} frames" if film else ""
        told = "" if light else f", exposure {stops:+.1f}"
        click.echo(
            f"{triangles:,} triangles, {pixels[0]} x {pixels[1]}{length}{told}, drawn by {drawn_by}"
        )
        if shoot.told:
            click.echo(f"by default: {'; '.join(shoot.told)}")


def _check_options(
    path: str,
    film: bool,
    background: str | None,
    at: object,
    camera: object,
    time: object,
    turns: float | None,
    seconds: float | None,
    fps: float,
) -> None:
    if at is not None and camera is not None:
        raise click.BadParameter("expected one of --at and --camera")
    moving = {"--turns": turns, "--seconds": seconds}
    for name, value in moving.items():
        if value is not None and not film:
            told = f"expected with a film only ({', '.join(_MOVING)}), got {path}"
            raise click.BadParameter(told, param_hint=name)
    if time is not None and film:
        raise click.BadParameter(
            f"expected with a still picture only, got {path}", param_hint="--time"
        )
    if seconds is not None and not 0 < seconds <= 3600:
        told = f"expected a number above 0 and up to 3600, got {seconds:g}"
        raise click.BadParameter(told, param_hint="--seconds")
    if not 0 < fps <= 100:
        told = f"expected a number above 0 and up to 100, got {fps:g}"
        raise click.BadParameter(told, param_hint="--fps")
    if background == "transparent" and Path(path).suffix.lower() not in _WITH_ALPHA:
        told = f"expected a file that holds alpha ({', '.join(_WITH_ALPHA)}) for transparent, got {path}"
        raise click.BadParameter(told, param_hint="--background")


def _stage(model: str, environment: str | None, variant: str | None) -> Shoot:
    from ..io.scenes import load_scene
    from ..staging.shoot import Shoot

    scene = load_scene(model)
    if variant is not None:
        scene.variant = scene.variants[_place_of(variant, scene.variants, "variant")]
    cube = None if environment is None else environment_of(environment)
    return Shoot(scene, cube, sample_light)


def environment_of(name: str) -> CubeMap:
    """Read an environment: a file, or a sample photograph by its name."""
    from ..data import find_sample
    from ..io.cubemaps import load_environment

    sample = None if Path(name).exists() else find_sample(name)
    if sample is not None and sample.suffix == ".exr":
        return load_environment(sample, size=512)
    return load_environment(name, srgb=True)


class _Plan:
    """What moves in a film, and for how long; for a still, the moment that it shows."""

    def __init__(self, animation: int | None, turns: float, seconds: float, count: int) -> None:
        self.animation, self.turns, self.seconds, self.count = animation, turns, seconds, count

    @staticmethod
    def of(
        shoot: Shoot,
        film: bool,
        animation: str | None,
        time: float | None,
        turns: float | None,
        seconds: float | None,
        fps: float,
    ) -> _Plan:
        known = shoot.scene.animations
        wanted: int | None = None
        if animation is not None or time is not None or (film and known and not turns):
            wanted = _place_of(animation or "0", [one.name for one in known], "animation")
        if not film:
            if wanted is not None:
                shoot.set_time(time or 0.0, wanted)
            return _Plan(wanted, 0.0, 0.0, 1)
        length = _SECONDS
        if wanted is not None:
            length = known[wanted].duration or _SECONDS
        lasts = seconds or length
        rounds = turns if turns is not None else 0.0 if wanted is not None else 1.0
        count = max(1, round(lasts * fps))
        if count > _LONGEST:
            raise ValueError(f"expected at most {_LONGEST} frames, got {count}")
        return _Plan(wanted, rounds, lasts, count)


def _place_of(text: str, names: Sequence[str], what: str) -> int:
    """Find the place of one of several things by its name, else by its number."""
    if text in names:
        return names.index(text)
    if text.isdecimal() and int(text) < len(names):
        return int(text)
    if not names:
        raise ValueError(
            f"--{what}: expected a file with a{'n' * (what[0] in 'aeiou')} {what}, got one without"
        )
    listed = ", ".join(f"{i} {name}".strip() for i, name in enumerate(names[:20]))
    raise ValueError(f"--{what}: expected one of {listed}, got {text}")


def _camera_of(shoot: Shoot, wanted: str) -> Any:
    from ..viewer.scene_camera import name_of

    cameras = shoot.scene.cameras
    return cameras[_place_of(wanted, [name_of(camera) for camera in cameras], "camera")]


def _screen(
    shoot: Shoot, background: str | None, stops: float, curve: Any
) -> Callable[[Frame], Any] | None:
    """Give the function from light to pixels for a background that is no light: none, or a colour of the screen."""
    from ..staging.backdrop import over_color, straight

    if background == "transparent":
        return lambda frame: straight(cast("Any", frame.color), exposure=stops, tonemap=curve)
    if background in (None, *_BACKGROUNDS):
        return None
    color = tuple(float(c) for c in cast("Any", shoot.scene.background)[:3])
    shoot.scene.background = (*(c / 2**stops for c in color), 0)
    return lambda frame: over_color(cast("Any", frame.color), color, exposure=stops, tonemap=curve)


def _save_light(
    path: str, shoot: Shoot, renderer: Renderer, size: tuple[int, int], look: dict[str, Any]
) -> Any:
    """Draw light into a file; return it as a screen shows it."""
    from .. import to_screen

    frame = shoot.draw(renderer, size, **look)
    with warnings_reported(path):
        frame.save(path)
    return to_screen(frame)


def _save_film(
    path: str,
    shoot: Shoot,
    renderer: Renderer,
    size: tuple[int, int],
    plan: _Plan,
    look: dict[str, Any],
    pixels_of: Callable[[Frame], Any],
) -> Any:
    """Draw a film into a file; return its first picture."""
    first: list[Any] = []

    def pictures() -> Iterator[Any]:
        frames = shoot.frames(
            renderer,
            size,
            plan.count,
            turns=plan.turns,
            seconds=plan.seconds,
            animation=plan.animation,
            **look,
        )
        for frame in _with_progress(frames, plan.count, path):
            pixels = pixels_of(frame)
            if not first:
                first.append(pixels)
            yield pixels

    fps = min(plan.count / plan.seconds, 100.0)
    if path.lower().endswith(".mp4"):
        from ..io.movie import save_mp4

        save_mp4(path, pictures(), fps)
    else:
        from .. import save_animation

        save_animation(path, pictures(), fps=fps)
    return first[0]


def _with_progress(items: Iterator[T], count: int, path: str) -> Iterable[T]:
    """Show a bar on a terminal while several frames are drawn."""
    if count == 1 or not sys.stdout.isatty():
        return items
    from rich.progress import track

    return track(items, total=count, description=path, transient=True)
