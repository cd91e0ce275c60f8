"""The method `Scene.save`."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import quote

from ...._calls import checked_call
from ...._checks import text_of
from ...._core import Scene
from ...files import PathLike, as_path
from ...writing import write_files
from .scene import document_of


@checked_call
def save_scene(scene: Scene, path: PathLike) -> None:
    """Write a scene to a file of glTF 2.0, which other programs read. The method `Scene.save`.

    `load_scene` of the file gives an equal scene. Nodes, meshes, skins, morph targets, textures, `StandardMaterial`,
    lights, cameras, animations, variants and visibility are written as glTF and its KHR extensions have them. What
    glTF has no words for stands in `extras` under the key "cubecam", which other programs skip: they show a similar
    glTF material in place of the other kinds of materials, and no environment.

    Parameters
    ----------
    path : path
        A name that ends in .glb, one file with everything in it, or in .gltf: then the numbers are in
        ``NAME.bin`` and the pictures in ``NAME-0.png``, ``NAME-1.png``, ... beside it.

    Raises
    ------
    OSError
        If the folder does not exist or may not be written, or the disk is full. The old files stay as they were.
    ValueError
        For another extension, for a scene whose render textures show another scene, for a skin with joints or a light,
        camera or probe with a parent that are not in the scene, and for more than 4 GiB in a .glb file. Nothing is
        written then.

    Warns
    -----
    SceneWarning
        For an animation none of whose nodes is in the scene: it is left out.

    Notes
    -----
    Numbers of glTF arrays are float32; those of nodes, lights and cameras keep all their digits. Texture coordinates
    are exact to 2**-24, because glTF counts v from the top. 8-bit images become PNG files; images of floats are
    stored in full in `extras`, beside an 8-bit PNG for other programs. A light or camera that does not lie at the
    origin of its parent along -Z gets a node of its own in the file. See docs/howto/save_scene.md.

    Examples
    --------
    >>> import cubecam as cc, tempfile, pathlib
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(), cc.StandardMaterial(color="gold", roughness=.3), name="ball")
    >>> lamp = scene.add(cc.PointLight(position=(2, 3, 4), intensity=20, decay=2))
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "ball.glb"
    >>> scene.save(path)
    >>> again = cc.load_scene(path)
    >>> again.nodes[0].name, again.lights[0]
    ('ball', PointLight(position=(2, 3, 4), color=(1, 1, 1), intensity=20, decay=2))
    """
    target = as_path(path)
    kind = target.suffix.lower()
    if kind not in (".glb", ".gltf"):
        raise ValueError(
            f"expected a file name that ends in .glb or .gltf; got {text_of(target.name)}"
        )
    document = document_of(scene)
    if kind == ".glb":
        write_files({target: document.glb()})
        return
    buffer = target.with_suffix(".bin")
    pictures = [beside(target, index) for index in range(len(document.pictures))]
    text, binary = document.files(quote(buffer.name), [quote(p.name) for p in pictures])
    files = dict(zip(pictures, document.pictures, strict=True))
    if binary:
        files[buffer] = binary
    write_files({**files, target: text})


def beside(target: Path, index: int) -> Path:
    """Return the path of a picture of a .gltf file."""
    return target.with_name(f"{target.stem}-{index}.png")
