"""What `cubecam view` shows: a model, a cubemap, a panorama, or what a Python script makes."""

from __future__ import annotations

import sys
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import CubeMap, Error, OrthographicCamera, PerspectiveCamera, Scene
from ..io.cubemap_names import spellings
from .common import sample_light, warnings_reported

if TYPE_CHECKING:
    from ..viewer.live import LiveView

__all__ = ["FAILURES", "Shown", "read", "run_script", "stamp"]

_PICTURES = (
    ".exr", ".hdr", ".pic", ".rgbe", ".xyze", ".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".bmp", ".tga", ".gif",
    ".pfm", ".dds",
)  # fmt: skip


@dataclass
class Shown:
    """What a file holds: a scene with a camera and how it is shown, a cubemap, or a view that a script made."""

    scene: Scene | None = None
    camera: PerspectiveCamera | OrthographicCamera | None = None
    options: dict[str, Any] = field(default_factory=dict)
    cube: CubeMap | None = None
    view: LiveView | None = None
    placed: str = ""  # where a script puts the camera, before a person moves it
    playing: bool = False  # whether an animation runs from the beginning
    told: str = ""  # what is shown, for the line below the picture
    files: tuple[Path, ...] = ()  # what is watched besides the file itself

    def as_view(self, title: str) -> LiveView:
        """Make the view."""
        from ..viewer.cube_view import CubeView
        from ..viewer.viewer import Viewer

        if self.view is not None:
            return self.view
        if self.cube is not None:
            view = CubeView(self.cube, title=title, **self.options)
            view.text = self.told
            return view
        assert self.scene is not None
        viewer = Viewer(self.scene, self.camera, **self.options)
        viewer.title, viewer.text = title, self.told
        viewer.playing = self.playing
        return viewer


def stamp(path: str, shown: Shown | None = None) -> tuple[object, ...]:
    """Say in which state the files are: another answer means that one of them was written again."""
    faces = [face for row in spellings() for face in row] if "{face}" in path else [""]
    names = [Path(path.replace("{face}", face)) for face in faces]
    found: list[object] = []
    for name in (*names, *(shown.files if shown else ())):
        try:
            state = name.stat()
            found.append((state.st_mtime_ns, state.st_size, state.st_ino))
        except OSError:
            found.append(None)  # an editor that writes a new file leaves none for a moment
    return tuple(found)


def read(path: str) -> Shown:
    """Read a file by its extension.

    Raises
    ------
    OSError, Error, ValueError
        As the functions that read it; ValueError also for an extension that is not known, and for a script that fails
        or makes no scene.
    """
    from ..io.scenes import ENDINGS

    kind = Path(path).suffix.lower()
    if kind == ".py":
        return _script(path)
    if kind in ENDINGS:
        return _model(path)
    if kind in _PICTURES:
        return _picture(path)
    if not Path(path).exists():
        raise FileNotFoundError(2, "No such file or directory", path)
    raise ValueError(
        f"expected a model ({', '.join(ENDINGS)}), a cubemap or panorama (.exr, .hdr, .png, .jpg, ...) "
        f"or a Python script (.py), got {path}"
    )


def _model(path: str) -> Shown:
    """Show a file's scene in its own light, or else in that of a sample photograph, with what it has of animations."""
    from .. import Renderer
    from ..io.scenes import load_scene
    from ..staging.shoot import Shoot

    with warnings_reported(path):
        scene = load_scene(path)
    shoot = Shoot(scene, None, sample_light)
    shoot.place_camera((30.0, 15.0), 4 / 3, turns=False, moments=[], animation=0)
    shoot.set_background(None)
    if shoot.measures:
        with Renderer() as renderer:
            exposure = shoot.exposure(renderer)
    else:
        exposure = shoot.exposure(None)
    meshes = [node.mesh for node in shoot.nodes if node.mesh is not None]
    parts = {
        "nodes": len(scene.nodes),
        "vertices": sum(len(mesh.positions) for mesh in meshes),
        "triangles": sum(len(mesh.indices) for mesh in meshes),
        "animations": len(scene.animations),
    }
    told = ", ".join(f"{n:,} {name[:-1] if n == 1 else name}" for name, n in parts.items() if n)
    told = told.replace("vertice,", "vertex,")
    options = {"tonemap": "neutral", "exposure": round(exposure, 2)}
    camera: Any = shoot.camera
    return Shown(scene, camera, options, told=told, playing=bool(scene.animations))


def _picture(path: str) -> Shown:
    """Show a cubemap as `CubeMap.show` does, and a panorama as a person sees it who stands in it."""
    from ..io.cubemaps import _load_shown

    cube, panorama = _load_shown(path)
    told = f"six faces of {cube.size} x {cube.size} texels, {cube.faces.dtype}"
    mode = "look" if panorama else "cross"
    return Shown(cube=cube, options={"mode": mode, "names": not panorama}, told=told)


def _script(path: str) -> Shown:
    """Run a script and take its `view` or `viewer`, or its `scene` and `camera`."""
    names, files = run_script(path)
    from ..viewer.live import LiveView

    for name in ("view", "viewer"):
        if isinstance(names.get(name), LiveView):
            return Shown(view=names[name], files=files)
    scene, camera = names.get("scene"), names.get("camera")
    if not isinstance(scene, Scene):
        made = "" if scene is None else f", got {type(scene).__name__}"
        raise ValueError(
            f"{path}: expected a script that makes `scene`, a cc.Scene, or `view`, a live view{made}"
        )
    if not isinstance(camera, (PerspectiveCamera, OrthographicCamera)):
        camera = None
    options = {key: names[key] for key in ("controls",) if isinstance(names.get(key), str)}
    return Shown(scene, camera, options, placed=repr(camera) if camera else "", files=files)


def run_script(path: str) -> tuple[dict[str, Any], tuple[Path, ...]]:
    """Run a script as Python does, except that its __name__ is not "__main__"; give its names and its own modules.

    Raises
    ------
    ValueError
        With the line of the script, for what it raises.
    """
    file = Path(path)
    source = file.read_bytes()
    names: dict[str, Any] = {"__name__": "__cubecam_view__", "__file__": str(file)}
    folder = str(file.resolve().parent)
    before, arguments = set(sys.modules), sys.argv
    sys.path.insert(0, folder)
    sys.argv = [str(file)]
    try:
        exec(compile(source, str(file), "exec"), names)
    except SyntaxError as error:
        raise ValueError(f"{error.filename}:{error.lineno}: {error.msg}") from error
    except (Exception, SystemExit) as error:
        raise ValueError(_told(error, path)) from error
    finally:
        sys.argv = arguments
        sys.path.remove(folder)
        # Modules beside the script are part of it: they are read again with it, and watched.
        own = {name: module for name in set(sys.modules) - before if (module := sys.modules[name])}
        beside = {
            name: Path(place)
            for name, module in own.items()
            if (place := getattr(module, "__file__", None)) and str(place).startswith(folder)
        }
        for name in beside:
            del sys.modules[name]
    return names, tuple(beside.values())


def _told(error: BaseException, path: str) -> str:
    """Name the line of the script in which an error happened."""
    lines = [at for at in traceback.extract_tb(error.__traceback__) if at.filename == path]
    place = f"{path}:{lines[-1].lineno}" if lines else path
    text = str(error)
    return (
        f"{place}: {type(error).__name__}: {text}" if text else f"{place}: {type(error).__name__}"
    )


#: What reading a file may raise.
FAILURES: tuple[type[Exception], ...] = (Error, OSError, ValueError, TypeError, MemoryError)
