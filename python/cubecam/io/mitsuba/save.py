"""The method `Scene.to_mitsuba`."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._calls import checked_call
from ..._checks import pair, text_of, whole_number
from ..._core import Camera, OrthographicCamera, PerspectiveCamera, Scene
from ..files import PathLike, as_path
from ..left_out import LeftOut
from ..writing import write_files
from .scene import document_of
from .xml import scene_xml

#: Folders of scenes without a path: they last as long as the process.
_FOLDERS: list[tempfile.TemporaryDirectory[str]] = []
#: A film of Mitsuba is kept in memory as a whole.
_LARGEST = 1 << 16


@checked_call
def to_mitsuba(
    scene: Scene,
    camera: PerspectiveCamera | OrthographicCamera | None = None,
    size: tuple[int, int] = (512, 512),
    *,
    path: PathLike | None = None,
    transform: Callable[[npt.NDArray[np.float64]], Any] | None = None,
    samples: int = 64,
    max_depth: int | None = None,
) -> dict[str, Any]:
    """Describe the scene for Mitsuba 3: a dict for ``mitsuba.load_dict``, and a file. The method `Scene.to_mitsuba`.

    Mitsuba (W. Jakob et al., "Mitsuba 3 renderer", 2022) traces paths by the laws of physics; pictures of cubecam can
    be compared with its pictures. It need not be installed here.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera, optional
        The view. None: the first camera of the scene, or one that sees the whole scene.
    size : (int, int)
        Width and height of the picture in pixels.
    path : path, optional
        A name that ends in .xml: the scene is written there, for ``mitsuba.load_file``, and beside it meshes as
        ``NAME-0.ply``, ... and pictures as ``NAME-0.exr``, ``NAME-0.png``, ... None: only the meshes and pictures are
        written, to a folder of temporary files that lasts as long as this process.
    transform : callable, optional
        What makes a transform of an array (4, 4): ``mitsuba.ScalarTransform4f``. ``load_dict`` takes no other
        ``to_world``, which cameras and spot lights have. None: the arrays themselves are in the dict.
    samples : int
        Paths for each pixel, at least 1.
    max_depth : int, optional
        The longest path, counted in its parts: 1 shows what emits light; 2 adds light that comes straight from lamps
        and the environment, as in pictures of cubecam, and the environment in a mirror. None: paths have no end.

    Returns
    -------
    dict
        The scene. Its meshes and pictures are files, which it names by their full paths.

    Raises
    ------
    OSError
        If the folder does not exist or may not be written, or the disk is full. The old files stay as they were.
    ValueError
        For another extension, a number out of its range, and, without a camera, a scene without a visible mesh.
    TypeError
        For a camera of another kind.

    Warns
    -----
    SceneWarning
        For what Mitsuba cannot say: one warning for each reason, with the names of nodes.

    Notes
    -----
    Tried with Mitsuba 3.9. Meshes are in world space, as skins and morph targets bend them now; equal files are one.

    *The same in Mitsuba:* `BasicMaterial`, as an area light on a surface that reflects nothing; `MirrorMaterial`
    without `f0` (``conductor``); smooth `GlassMaterial` (``dielectric``), whose tint counts at each surface that a ray
    crosses; `StandardMaterial` of metal (``principled``; ``roughconductor`` has no Schlick's Fresnel and was up to 56 %
    too dark) and one that only scatters (``diffuse``); `DirectionalLight`, and `PointLight` and `SpotLight` with
    ``decay=2``, whose fade is a picture that the light throws; the environment.

    *Close:* A dielectric `StandardMaterial` is ``principled``, whose diffuse base is not multiplied by 1 - F: under an
    even sky it reflects up to 9 % more at a roughness of .2 and .5, up to 21 % more at roughness 1. (``roughplastic``
    was off by up to 77 %.) Mitsuba has no `multiple_scattering`. `f0` of a mirror is that of a metal whose Fresnel is
    fitted to Schlick's, within .03.

    *PhongMaterial* is ``diffuse``, its share `kd`. It counts a light as radiance: in a scene with PhongMaterial and
    no `StandardMaterial`, all lights are pi times as strong in Mitsuba. Beside a StandardMaterial its reflectance is pi
    times as high.

    The environment is written the way ``envmap`` reads it: +Y up, +Z in the middle, the poles in the first and the last
    row; its rotation is part of the picture. Where `Scene.background` is not the environment, ``hide_emitters`` leaves
    the background of Mitsuba's picture empty, with alpha 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> paper = cc.StandardMaterial(metallic=0, specular_weight=0, double_sided=True)
    >>> floor = scene.add(cc.Mesh.plane(), paper)
    >>> lamp = scene.add(cc.PointLight(position=(0, 2, 0), intensity=20, decay=2, shadow=True))
    >>> made = scene.to_mitsuba(cc.PerspectiveCamera(position=(0, 1, 2), target=(0, 0, 0)), (64, 48))
    >>> made["light-0"]
    {'type': 'point', 'position': [0.0, 2.0, 0.0], 'intensity': {'type': 'rgb', 'value': [20.0, 20.0, 20.0]}}
    >>> made["material-0"]["type"], made["node-1"]["type"], made["sensor"]["film"]["width"]
    ('twosided', 'ply', 64)

    In a program that has Mitsuba:

    >>> import mitsuba as mi  # doctest: +SKIP
    >>> mi.set_variant("scalar_rgb")  # doctest: +SKIP
    >>> picture = mi.render(mi.load_dict(scene.to_mitsuba(transform=mi.ScalarTransform4f)))  # doctest: +SKIP
    """
    width, height = pair(size, "size")
    for length in (width, height):
        whole_number(length, "size", 1, _LARGEST)
    whole_number(samples, "samples", 1, 1 << 30)
    if max_depth is not None:
        whole_number(max_depth, "max_depth", 1, 1 << 30)
    if transform is not None and not callable(transform):
        raise TypeError(f"transform: expected a callable or None, got {type(transform).__name__}")
    target = None if path is None else as_path(path).absolute()
    if target is not None and target.suffix.lower() != ".xml":
        raise ValueError(f"expected a file name that ends in .xml; got {text_of(target.name)}")
    view = _camera_of(scene, camera, width / height)
    left_out = LeftOut()
    name = target if target is not None else _folder() / "scene.xml"
    made = document_of(scene, view, (width, height), samples, max_depth, name, left_out)
    files = dict(made.files)
    if target is not None:
        files[target] = scene_xml(made.scene, target.parent)
    write_files(files)
    left_out.warn("Scene.to_mitsuba")
    done: dict[str, Any] = _plain(made.scene, transform)
    return done


def _camera_of(
    scene: Scene, camera: PerspectiveCamera | OrthographicCamera | None, aspect: float
) -> Camera:
    if camera is not None:
        if not isinstance(camera, (PerspectiveCamera, OrthographicCamera)):
            raise TypeError(
                f"camera: expected a PerspectiveCamera, an OrthographicCamera or None, got {type(camera).__name__}"
            )
        return camera
    for own in scene.cameras:
        if isinstance(own, (PerspectiveCamera, OrthographicCamera)):
            return own
    if not np.isfinite(scene.bounds).all():
        raise ValueError("camera: expected a camera, got None for a scene without a visible mesh")
    made = PerspectiveCamera()
    made.fit(scene, aspect=aspect)
    return made


def _folder() -> Path:
    folder = tempfile.TemporaryDirectory(prefix="cubecam-mitsuba-")
    _FOLDERS.append(folder)
    return Path(folder.name)


def _plain(value: Any, transform: Callable[[Any], Any] | None) -> Any:
    """Copy a scene with the transforms that the caller wants; nothing in the copy is shared."""
    if isinstance(value, dict):
        return {name: _plain(part, transform) for name, part in value.items()}
    if isinstance(value, np.ndarray) and transform is not None:
        return transform(value)
    return list(value) if isinstance(value, list) else value
