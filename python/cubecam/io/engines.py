"""Write a cubemap as the light of a scene in an engine: the method `CubeMap.save_for`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import get_args

import numpy as np

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap
from ..typing import Center, Engine
from .babylon_env import encode_env, light_of
from .cubemap_save import save_cubemap
from .files import PathLike, as_path
from .sh_file import encode_sh
from .writing import write_files

ENGINES: tuple[Engine, ...] = get_args(Engine)

_THREE = """\
three.js: light and background of a scene (tried with three 0.187).
environment.exr is a panorama with +X in the middle; three.js filters it by roughness itself.
import {{ EXRLoader }} from "three/addons/loaders/EXRLoader.js";
const sky = await new EXRLoader().loadAsync("environment.exr"); // or HDRCubeTextureLoader of px.hdr ... nz.hdr
sky.mapping = THREE.EquirectangularReflectionMapping; scene.environment = scene.background = sky;
"""
_BABYLON = """\
Babylon.js: filtered light of {size} texels an edge and its irradiance, for PBR materials and the skybox.
Models are to be loaded as glTF files into a scene with Babylon's own left-handed axes, which is the default.
const sky = BABYLON.CubeTexture.CreateFromPrefilteredData("environment.env", scene);
scene.environmentTexture = sky;
scene.createDefaultSkybox(sky, true, 1000);
"""
_UNITY = """\
Unity (not tried in it): put environment.exr into Assets; a panorama with the scene's -X, Unity's +X, in its middle.
Import settings: Texture Shape "Cube", Mapping "Latitude-Longitude Layout", Convolution "Specular".
Make a material with the shader "Skybox/Cubemap", give it the texture, and set it in Window > Rendering > Lighting.
Models of glTF files (glTFast) have x mirrored, as the panorama expects.
In code: RenderSettings.skybox = material; DynamicGI.UpdateEnvironment();
"""
_GODOT = """\
Godot 4 (not tried in it): put environment.exr into the project; it is a panorama with +Z in the middle.
var sky = Sky.new(); sky.sky_material = PanoramaSkyMaterial.new()
sky.sky_material.panorama = load("res://environment.exr")
var world = Environment.new(); world.background_mode = Environment.BG_SKY; world.sky = sky
$WorldEnvironment.environment = world
"""
_BLENDER = """\
Blender: environment.exr is a panorama with +X in the middle, for models imported from glTF (y up becomes z up).
import bpy; world = bpy.context.scene.world; world.use_nodes = True; tree = world.node_tree
node = tree.nodes.new("ShaderNodeTexEnvironment"); node.image = bpy.data.images.load("//environment.exr")
tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
By hand: World > Surface > Color > Environment Texture, Projection "Equirectangular".
"""
_FILAMENT = """\
Filament: environment.hdr is a panorama with +Z in the middle, as cmgen expects; sh.json has nine numbers.
cmgen --format=ktx --size={size} --deploy=out environment.hdr
gltf_viewer --ibl=environment.hdr model.glb
In Python, with filly: scene.environment = renderer.load_environment("environment.hdr")
scene.environment_visible = True
"""


@checked_call
def save_for(cube: CubeMap, engine: Engine, folder: PathLike) -> list[Path]:
    """Write light for an engine: files that it loads, the right way round. The method `CubeMap.save_for`.

    Parameters
    ----------
    engine : {"three", "babylon", "unity", "godot", "blender", "filament"}
        three.js, Babylon.js, Unity, Godot 4, Blender or Filament.
    folder : path
        Where the files are written; made if it does not exist.

    Returns
    -------
    list of Path
        The files; the last one is README.txt, whose five lines say how the engine loads the others.

    Raises
    ------
    ValueError
        For an unknown engine, or, for Babylon.js, a size that is no power of two.
    OSError
        If the folder cannot be made or written.

    Notes
    -----
    ===========  ==============================================================================
    engine       files
    ===========  ==============================================================================
    three        environment.exr, a panorama with +X in the middle; px.hdr ... nz.hdr, six faces
    babylon      environment.env: levels by roughness in Babylon's steps, and the irradiance
    unity        environment.exr, a panorama with -X in the middle (Unity's +X)
    godot        environment.exr, a panorama with +Z in the middle
    blender      environment.exr, a panorama with +X in the middle
    filament     environment.hdr, a panorama with +Z in the middle; sh.json
    ===========  ==============================================================================

    All engines but Babylon.js filter the light themselves and get level 0 alone. A cube without filtered levels is
    filtered for Babylon.js. Numbers are light: what is "srgb" is decoded. Panoramas are four times as wide as a face;
    EXR holds half floats, light above 65504 is clipped.

    Examples
    --------
    >>> import cubecam as cc, tempfile
    >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=32)
    >>> [path.name for path in cube.save_for("godot", tempfile.mkdtemp())]
    ['environment.exr', 'README.txt']
    """
    if engine not in ENGINES:
        raise ValueError(f"engine: expected one of {', '.join(ENGINES)}, got {text_of(engine)}")
    target = as_path(folder)
    target.mkdir(parents=True, exist_ok=True)
    write, readme = _WRITERS[engine]
    files = write(light_of(cube), target)
    told = target / "README.txt"
    write_files({told: readme.format(size=cube.size).encode()})
    return [*files, told]


def _half(cube: CubeMap) -> CubeMap:
    return CubeMap(np.clip(cube.faces, 0, 65504).astype(np.float16), encoding="linear")


def _panorama(center: Center) -> Callable[[CubeMap, Path], list[Path]]:
    def write(cube: CubeMap, folder: Path) -> list[Path]:
        path = folder / "environment.exr"
        save_cubemap(_half(cube), path, layout="equirect", center=center)
        return [path]

    return write


def _three(cube: CubeMap, folder: Path) -> list[Path]:
    save_cubemap(cube, folder / "{face}.hdr", convention="three")
    six = [folder / f"{face}.hdr" for face in ("px", "nx", "py", "ny", "pz", "nz")]
    return [*_panorama("+x")(cube, folder), *six]


def _babylon(cube: CubeMap, folder: Path) -> list[Path]:
    path = folder / "environment.env"
    write_files({path: encode_env(cube)})
    return [path]


def _filament(cube: CubeMap, folder: Path) -> list[Path]:
    paths = [folder / "environment.hdr", folder / "sh.json"]
    save_cubemap(cube, paths[0], layout="equirect", center="+z")
    write_files({paths[1]: encode_sh(cube)})
    return paths


_WRITERS: dict[Engine, tuple[Callable[[CubeMap, Path], list[Path]], str]] = {
    "three": (_three, _THREE),
    "babylon": (_babylon, _BABYLON),
    "unity": (_panorama("-x"), _UNITY),
    "godot": (_panorama("+z"), _GODOT),
    "blender": (_panorama("+x"), _BLENDER),
    "filament": (_filament, _FILAMENT),
}
