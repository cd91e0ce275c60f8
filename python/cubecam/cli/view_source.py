"""What `cubecam view` shows: a mesh, a cubemap, a panorama, or what a Python script makes."""

from __future__ import annotations

import sys
import traceback
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import (
    AmbientLight,
    CubeMap,
    DirectionalLight,
    Error,
    OrthographicCamera,
    PerspectiveCamera,
    PhongMaterial,
    Scene,
)
from ..io.cubemap_names import spellings

if TYPE_CHECKING:
    from ..viewer.live import LiveView

__all__ = ["FAILURES", "Shown", "read", "stamp"]

_MESHES = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off")
_PICTURES = (
    ".exr", ".hdr", ".pic", ".rgbe", ".xyze", ".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".bmp", ".tga", ".gif",
    ".pfm", ".dds",
)  # fmt: skip
_SAMPLE = "studio.exr"  # what a mirror shows beside a mesh
_BACK = (0.055, 0.06, 0.07)  # the colour behind a mesh, linear
_GREY = (0.62, 0.62, 0.62)
#: Light of three lamps that every side of a mesh gets something of: direction and strength.
_LAMPS = (((-0.5, -1.0, -0.8), 1.0), ((1.0, -0.3, -0.4), 0.45), ((0.2, 0.4, 1.0), 0.35))


@dataclass
class Shown:
    """What a file holds: a scene with a camera and how it is shown, a cubemap, or a view that a script made."""

    scene: Scene | None = None
    camera: PerspectiveCamera | OrthographicCamera | None = None
    options: dict[str, Any] = field(default_factory=dict)
    cube: CubeMap | None = None
    view: LiveView | None = None
    placed: str = ""  # where a script puts the camera, before a person moves it
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
    kind = Path(path).suffix.lower()
    if kind == ".py":
        return _script(path)
    if kind in _MESHES:
        return _mesh(path)
    if kind in _PICTURES:
        return _picture(path)
    if not Path(path).exists():
        raise FileNotFoundError(2, "No such file or directory", path)
    raise ValueError(
        f"expected a mesh ({', '.join(_MESHES)}), a cubemap or panorama (.exr, .hdr, .png, .jpg, ...) "
        f"or a Python script (.py), got {path}"
    )


def _mesh(path: str) -> Shown:
    from ..data import sample_data
    from ..io.cubemaps import load_environment
    from ..io.meshes.load import load_mesh

    mesh = load_mesh(path)
    scene = Scene(environment=load_environment(sample_data(_SAMPLE), size=256), background=_BACK)
    colored = mesh.colors is not None
    color = (1, 1, 1) if colored else _GREY
    material = PhongMaterial(
        color=color, ka=0.25, ks=0.12, shininess=24, vertex_colors=colored, double_sided=True
    )
    scene.add(mesh, material, name=Path(path).stem)
    scene.add(AmbientLight(intensity=0.35))
    for direction, strength in _LAMPS:
        scene.add(DirectionalLight(direction, intensity=strength))
    camera = PerspectiveCamera(position=(1.0, 0.7, 2.2), target=(0, 0, 0), fov=40)
    camera.fit(scene, margin=0.06)
    told = f"{len(mesh.positions):,} vertices, {len(mesh.indices):,} triangles"
    return Shown(scene, camera, {"tonemap": "neutral"}, told=told)


def _picture(path: str) -> Shown:
    """Show a cubemap as `CubeMap.show` does, and a panorama as a person sees it who stands in it."""
    from ..io.cubemaps import _load_shown

    cube, panorama = _load_shown(path)
    told = f"six faces of {cube.size} x {cube.size} texels, {cube.faces.dtype}"
    mode = "look" if panorama else "cross"
    return Shown(cube=cube, options={"mode": mode, "names": not panorama}, told=told)


def _script(path: str) -> Shown:
    """Run a script and take its `view` or `viewer`, or its `scene` and `camera`."""
    names, files = _run(path)
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


def _run(path: str) -> tuple[dict[str, Any], tuple[Path, ...]]:
    """Run a script as Python does, except that its __name__ is not "__main__"; give its names and its own modules."""
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
