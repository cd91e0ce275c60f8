"""
The compiled part of cubecam. Use `import cubecam`, which has all of it.
"""

from __future__ import annotations

import collections.abc
import enum
import os
import typing

import numpy
import numpy.typing

__all__: list[str] = [
    "AmbientLight",
    "BasicMaterial",
    "Blend",
    "Camera",
    "ContextError",
    "CubeMap",
    "Device",
    "DirectionalLight",
    "Error",
    "Face",
    "FileError",
    "Frame",
    "GlError",
    "GlassMaterial",
    "Image",
    "ImageEffect",
    "ImageError",
    "Light",
    "Material",
    "Mesh",
    "MeshError",
    "MirrorMaterial",
    "Node",
    "OrthographicCamera",
    "PerspectiveCamera",
    "PhongMaterial",
    "PointLight",
    "Probe",
    "RenderTexture",
    "Renderer",
    "Scene",
    "ShaderError",
    "ShaderMaterial",
    "Shadow",
    "SpotLight",
    "Stencil",
    "StereoCamera",
    "__version__",
    "axis_angle",
    "devices",
]

class Error(RuntimeError):
    """
    Base of cubecam's own exceptions; below it are those of the environment.
    """

class ContextError(Error):
    """
    No OpenGL context can be had, or it can no longer be used.

    The text tells every attempt, why it failed, and what to install.
    """

class ShaderError(Error):
    """
    A shader did not compile or link; the text has the log and the source lines.
    """

class GlError(Error):
    """
    OpenGL reported an error, such as too little memory.
    """

class FileError(Error):
    """
    A file's contents cannot be read, or not be written.
    """

class ImageError(FileError):
    """
    An image file's contents cannot be used.
    """

class MeshError(FileError):
    """
    A mesh file's contents cannot be used.
    """

class Device:
    """
    A device that can render, as `devices` lists it.

    Attributes
    ----------
    index : int
        Its place in `devices()`, for ``Renderer(device=index)``; -1 for a context that no EGL device
        stands behind.
    name : str
        For example ``"NVIDIA GeForce RTX 4090"`` or ``"llvmpipe (LLVM 15.0.6, 256 bits)"``;
        ``"unknown"`` if the driver does not tell.
    vendor : str
        Who made the driver, or ``"unknown"``.
    driver : str
        The driver's name or version, for example ``"nvidia"`` or ``"Mesa 22.3.6"``; empty if it does
        not tell.
    software : bool
        Whether it renders on the CPU.
    uuid : str
        32 hexadecimal digits in groups of 8-4-4-4-12; empty if the driver does not tell.
    cuda_index : int or None
        CUDA's number of the same GPU, which need not be `index`.
    drm_node : str
        For example ``"/dev/dri/renderD128"``; empty if there is none.
    platform : str
        ``"device"``; for a renderer's own device also ``"surfaceless"`` or ``"default"``.
    problem : str
        Why it cannot be used; empty when it can.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Device) -> str: ...
    @property
    def cuda_index(self) -> int | None: ...
    @property
    def driver(self) -> str: ...
    @property
    def drm_node(self) -> str: ...
    @property
    def index(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def platform(self) -> str: ...
    @property
    def problem(self) -> str: ...
    @property
    def software(self) -> bool: ...
    @property
    def uuid(self) -> str: ...
    @property
    def vendor(self) -> str: ...

class Node:
    """
    A thing in a scene: a mesh with a material somewhere, or a group.

    Made by `Scene.add`. Attributes may be set at any time; the next picture shows it. Arrays that they
    give are read-only: set the whole, ``node.position = (1, 2, 3)``.

    A node pickles together with its scene, so that ``pickle.dumps((scene, ball))`` keeps ball inside
    scene; one that was removed pickles by itself, with the nodes above it.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> arm = scene.add(position=(0, 1, 0), rotation=cc.axis_angle((0, 0, 1), 90))
    >>> hand = scene.add(cc.Mesh.box(.1), position=(2, 0, 0), parent=arm)
    >>> hand.world_matrix[:3, 3].round(12).tolist()
    [0.0, 3.0, 0.0]
    """
    def __reduce__(self: Node) -> tuple: ...
    def __repr__(self: Node) -> str: ...
    def __setstate__(self: Node, state: tuple) -> None:
        """
        For unpickling.
        """
    @property
    def cast_shadow(self) -> bool:
        """
        bool: False casts no shadows, nor does anything below it. Translucent nodes never cast.
        """
    @cast_shadow.setter
    def cast_shadow(self, arg1: bool) -> None: ...
    @property
    def children(self) -> tuple[Node, ...]:
        """
        tuple of Node: in order of id.
        """
    @property
    def environment(self) -> CubeMap | Probe | None:
        """
        CubeMap, Probe or None: what mirrors and glass show; None is the scene's.
        """
    @environment.setter
    def environment(self, arg1: CubeMap | Probe | None) -> None: ...
    @property
    def id(self) -> int:
        """
        int: from 1 in order of add, never used again in the scene; 0 is the background in id pictures.
        """
    @property
    def in_captures(self) -> bool:
        """
        bool: False is absent from captures and probes, as is all below it; still drawn in frames, and still showing probes.
        """
    @in_captures.setter
    def in_captures(self, arg1: bool) -> None: ...
    @property
    def material(self) -> Material | None:
        """
        Material or None: None, with a mesh, becomes a new PhongMaterial.
        """
    @material.setter
    def material(self, arg1: Material | None) -> None: ...
    @property
    def matrix(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4, 4) float64: node to parent, read-only. Setting it replaces position, rotation and scale; it must not be singular, and its last row is (0, 0, 0, 1).
        """
    @matrix.setter
    def matrix(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def mesh(self) -> Mesh | None:
        """
        Mesh or None: what is drawn; None is a group.
        """
    @mesh.setter
    def mesh(self, arg1: Mesh | None) -> None: ...
    @property
    def name(self) -> str:
        """
        str: for people; need not be unique.
        """
    @name.setter
    def name(self, arg1: str) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: what it moves with. Setting it keeps the node's own position, rotation and scale; a cycle raises ValueError.
        """
    @parent.setter
    def parent(self, arg1: Node | None) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: relative to the parent, read-only.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def receive_shadow(self) -> bool:
        """
        bool: whether shadows show on its own surface.
        """
    @receive_shadow.setter
    def receive_shadow(self, arg1: bool) -> None: ...
    @property
    def render_order(self) -> int:
        """
        int: among opaque and among translucent nodes, lower is drawn first, before distance; 0. It is the node's own: what is below it has its own, too.
        """
    @render_order.setter
    def render_order(self, arg1: int) -> None: ...
    @property
    def rotation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4,) float64: unit quaternion (w, x, y, z), read-only; see `axis_angle`.
        """
    @rotation.setter
    def rotation(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def scale(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: along the node's own axes, read-only; one number sets all three.
        """
    @scale.setter
    def scale(self, arg1: float | numpy.typing.ArrayLike) -> None: ...
    @property
    def visible(self) -> bool:
        """
        bool: False is drawn nowhere, nor is anything below it.
        """
    @visible.setter
    def visible(self, arg1: bool) -> None: ...
    @property
    def world_matrix(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4, 4) float64: node to world, read-only.
        """

class Probe:
    """
    A cubemap that keeps itself true to the scene.

    It is only a description, and may serve any number of nodes: assign it to ``node.environment``, or
    to a `BasicMaterial`'s cubemap. Each renderer holds contents of its own
    (``renderer.read_probe(probe)``) and draws again only the faces that would come out different. Nodes
    that use a probe are left out of it.

    Parameters
    ----------
    position : array_like (3,)
        World space; with a parent, from the parent's position.
    size : int
        Texels along an edge of a face.
    near, far : float
        World units: 0 < near < far.
    format : {"rgba16f", "rgba8", "rgba32f", "rgb565"}
        What a texel is kept in. rgba8 and rgb565 clip light above 1.
    mipmaps : bool
        Whether lookups are trilinear.
    samples : int
        Samples of each texel, for smooth edges (MSAA); 1 is none.
    update : {"on_change", "once", "manual"} or int
        "on_change": always true to the scene. "once": drawn when it is first needed. "manual": only
        by ``renderer.update_probes``. n: on every n-th call that needs it.
    exclude : iterable of Node
        What it does not see, whole subtrees, beside the nodes that use it.
    parent : Node, optional
        It goes where this node goes; its axes stay the world's. The probe does not keep it alive.
    faces_per_frame : int
        At most so many faces are drawn in one call, from 1 to 6.
    depth_format : str or None
        Its depth and stencil buffer, see `Renderer.render`.

    Raises
    ------
    ValueError
        For a number out of its range, near >= far, or another format or update.
    TypeError
        For a parent or excluded things that are not nodes.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
    >>> ball.environment = cc.Probe(parent=ball, size=128)
    >>> ball.environment.update
    'on_change'
    """
    def __init__(
        self: Probe,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        *,
        size: typing.SupportsInt | typing.SupportsIndex = 256,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        format: str = "rgba16f",
        mipmaps: bool = False,
        samples: typing.SupportsInt | typing.SupportsIndex = 1,
        update: str | int = "on_change",
        exclude: collections.abc.Iterable[Node] = (),
        parent: Node | None = None,
        faces_per_frame: typing.SupportsInt | typing.SupportsIndex = 6,
        depth_format: str | None = "depth_component32f",
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Probe) -> str: ...
    def __setstate__(self: Probe, state: tuple) -> None:
        """
        For unpickling.
        """
    @property
    def depth_format(self) -> str | None:
        """
        str or None: its depth and stencil buffer, see `Renderer.render`.
        """
    @depth_format.setter
    def depth_format(self, arg1: str | None) -> None: ...
    @property
    def exclude(self) -> tuple[Node, ...]:
        """
        tuple of Node: what it does not see, whole subtrees, beside the nodes that use it.
        """
    @exclude.setter
    def exclude(self, arg1: collections.abc.Iterable[Node]) -> None: ...
    @property
    def faces_per_frame(self) -> int:
        """
        int: at most so many faces are drawn in one call.
        """
    @faces_per_frame.setter
    def faces_per_frame(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def far(self) -> float:
        """
        float: nothing farther is seen; world units.
        """
    @far.setter
    def far(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def format(self) -> str:
        """
        str: "rgba8", "rgba16f", "rgba32f" or "rgb565".
        """
    @format.setter
    def format(self, arg1: str) -> None: ...
    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """
    @mipmaps.setter
    def mipmaps(self, arg1: bool) -> None: ...
    @property
    def near(self) -> float:
        """
        float: nothing nearer is seen; world units.
        """
    @near.setter
    def near(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that it follows.
        """
    @parent.setter
    def parent(self, arg1: Node | None) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: world space, or from the parent's position; read-only.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def samples(self) -> int:
        """
        int: samples of each texel (MSAA); 1 is none.
        """
    @samples.setter
    def samples(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def size(self) -> int:
        """
        int: texels along an edge of a face.
        """
    @size.setter
    def size(self, arg1: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def update(self) -> str | int:
        """
        str or int: "on_change", "once", "manual", or every how many calls.
        """
    @update.setter
    def update(self, arg1: str | int) -> None: ...

class RenderTexture:
    """
    A picture that a scene is drawn into and that materials show in the same frame.

    It is only a description, and may serve any number of materials in any number of scenes: give it as
    the ``map`` of a `BasicMaterial` or `PhongMaterial`. Each renderer holds contents of its own
    (``renderer.read_texture(render_texture)``), brings them up to date before what shows them, and draws
    them again only if the picture would come out different.

    Parameters
    ----------
    scene : Scene
        What it shows; kept alive. It may show other render textures, and mirrors with probes.
    camera : Camera
        From where; the shape of the picture is that of `size`.
    size : (int, int)
        (width, height), texels.
    format : {"rgba8", "rgba16f", "rgba32f", "rgb565"}
        What a texel is kept in. rgba8 and rgb565 clip light above 1.
    samples : int
        Samples of each texel, for smooth edges (MSAA); 1 is none.
    mipmaps : bool
        Whether lookups are trilinear, for pictures that are seen small. False: bilinear.
    wrap : {"clamp", "repeat"}
        What a lookup outside 0..1 gives.
    exclude : iterable of Node
        Nodes of `scene` that it does not show, whole subtrees.
    name : str
        For people: messages use it.
    effects : sequence of ImageEffect
        Passes over the picture, one after the other, in linear float. With an empty scene they make the
        picture alone.
    depth_format : str or None
        The depth and stencil buffer, see `Renderer.render`; None paints nodes one over the other.

    Raises
    ------
    ValueError
        For a size or samples below 1, or another format or wrap.
    TypeError
        For a scene, a camera or excluded things of another type.

    Notes
    -----
    uv (0, 0) is the picture's bottom-left, as with an `Image`. Its alpha counts where the material's
    own opacity is below 1; it does not make a surface translucent by itself.

    A picture that shows itself, directly, by other render textures or by probes, has no end: drawing
    what shows it raises ValueError. A monitor in the room that it shows is left out by `exclude`. What
    is left out still casts: a shadow whose caster moves its vertices by the picture must not fall there.

    Examples
    --------
    >>> import cubecam as cc
    >>> clock = cc.Scene(background=(0, 0, .2))
    >>> hand = clock.add(cc.Mesh.box((.1, 1, .1)), cc.BasicMaterial(color=(1, 1, 0)))
    >>> face = cc.RenderTexture(clock, cc.OrthographicCamera(height=2, position=(0, 0, 5)),
    ...                         size=(64, 64), name="clock")
    >>> scene = cc.Scene()
    >>> cube = scene.add(cc.Mesh.box(), cc.BasicMaterial(map=face))
    >>> camera = cc.PerspectiveCamera(position=(1, 1, 2), target=(0, 0, 0))
    >>> with cc.Renderer() as renderer:
    ...     for degrees in (0, 6, 12):
    ...         hand.rotation = cc.axis_angle((0, 0, 1), -degrees)
    ...         frame = renderer.render(scene, camera, size=(64, 48))  # shows the hand as it is now
    ...     drawn = renderer.stats.textures_updated
    ...     picture = renderer.read_texture(face)
    >>> picture.shape, drawn
    ((64, 64, 4), 1)
    """
    def __init__(
        self: RenderTexture,
        scene: Scene,
        camera: Camera,
        *,
        size: tuple[int, int] = (512, 512),
        format: str = "rgba8",
        samples: int = 1,
        mipmaps: bool = False,
        wrap: str = "clamp",
        exclude: collections.abc.Iterable[Node] = (),
        name: str = "",
        effects: collections.abc.Iterable[ImageEffect] = (),
        depth_format: str | None = "depth_component32f",
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: RenderTexture) -> str: ...
    def __setstate__(self: RenderTexture, state: tuple) -> None:
        """
        For unpickling.
        """
    @property
    def camera(self) -> Camera:
        """
        Camera: from where it is seen.
        """
    @camera.setter
    def camera(self, arg1: Camera) -> None: ...
    @property
    def depth_format(self) -> str | None:
        """
        str or None: the depth and stencil buffer, see `Renderer.render`.
        """
    @depth_format.setter
    def depth_format(self, arg1: str | None) -> None: ...
    @property
    def effects(self) -> tuple[ImageEffect, ...]:
        """
        tuple of ImageEffect: passes over the picture, one after the other.
        """
    @effects.setter
    def effects(self, arg1: collections.abc.Iterable[ImageEffect]) -> None: ...
    @property
    def exclude(self) -> tuple[Node, ...]:
        """
        tuple of Node: nodes of `scene` that it does not show, whole subtrees.
        """
    @exclude.setter
    def exclude(self, arg1: collections.abc.Iterable[Node]) -> None: ...
    @property
    def format(self) -> str:
        """
        str: "rgba8", "rgba16f", "rgba32f" or "rgb565".
        """
    @format.setter
    def format(self, arg1: str) -> None: ...
    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """
    @mipmaps.setter
    def mipmaps(self, arg1: bool) -> None: ...
    @property
    def name(self) -> str:
        """
        str: for people; need not be unique.
        """
    @name.setter
    def name(self, arg1: str) -> None: ...
    @property
    def samples(self) -> int:
        """
        int: samples of each texel (MSAA); 1 is none.
        """
    @samples.setter
    def samples(self, arg1: int) -> None: ...
    @property
    def scene(self) -> Scene:
        """
        Scene: what it shows.
        """
    @scene.setter
    def scene(self, arg1: Scene) -> None: ...
    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height), texels.
        """
    @size.setter
    def size(self, arg1: tuple[int, int]) -> None: ...
    @property
    def wrap(self) -> str:
        """
        str: "repeat" or "clamp".
        """
    @wrap.setter
    def wrap(self, arg1: str) -> None: ...

class Scene:
    """
    Nodes, lights and what surrounds them.

    A scene knows nothing of who draws it; any number of renderers may, on any threads.

    Parameters
    ----------
    environment : CubeMap, optional
        What mirrors and glass show; see `load_environment`.
    background : array_like (3,) or (4,), str, or CubeMap, optional
        What is seen where nothing is: a colour, or a cubemap as skybox. Numbers are linear; a CSS name or
        "#rrggbb" says sRGB and is decoded. None: the environment if there is one, else transparent black.

    Raises
    ------
    TypeError
        For an environment or background of another type.
    ValueError
        For a colour that is not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(.4, .4, .4))
    >>> lamp = scene.add(cc.PointLight(position=(3, 4, 3)))
    >>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
    >>> scene
    Scene(1 node, 1 light)
    >>> ball.id, ball in scene
    (1, True)
    """
    @staticmethod
    def _loose(id: typing.SupportsInt | typing.SupportsIndex) -> Node:
        """
        For unpickling: an empty node that is in no scene.
        """
    def __contains__(self: Scene, thing: typing.Any) -> bool:
        """
        Whether a node or a light is in the scene.
        """
    def __init__(
        self: Scene,
        *,
        environment: CubeMap | None = None,
        background: numpy.typing.ArrayLike | CubeMap | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Scene) -> str: ...
    def __setstate__(self: Scene, state: dict) -> None:
        """
        For unpickling.
        """
    def _restore(self: Scene, id: typing.SupportsInt | typing.SupportsIndex) -> Node:
        """
        For unpickling: the node of an id.
        """
    @typing.overload
    def add(self: Scene, light: Light) -> Light:
        """
        Add a light.

        Parameters
        ----------
        light : Light
            It may be in other scenes as well.

        Returns
        -------
        Light
            The same light.

        Raises
        ------
        ValueError
            If it is in this scene already.
        """
    @typing.overload
    def add(
        self: Scene,
        mesh: Mesh | None = None,
        material: Material | None = None,
        *,
        position: numpy.typing.ArrayLike | None = None,
        rotation: numpy.typing.ArrayLike | None = None,
        scale: float | numpy.typing.ArrayLike | None = None,
        matrix: numpy.typing.ArrayLike | None = None,
        parent: Node | None = None,
        environment: CubeMap | Probe | None = None,
        visible: bool = True,
        in_captures: bool = True,
        name: str = "",
        render_order: int = 0,
        cast_shadow: bool = True,
        receive_shadow: bool = True,
    ) -> Node:
        """
        Add a mesh with a material, or a group.

        Parameters
        ----------
        mesh : Mesh, optional
            None: a group, to carry other nodes.
        material : Material, optional
            None: a new PhongMaterial.
        position : array_like (3,), optional
            Relative to the parent; (0, 0, 0).
        rotation : array_like (4,), optional
            Quaternion (w, x, y, z) of any length but 0, such as `axis_angle` gives; (1, 0, 0, 0).
        scale : float or array_like (3,), optional
            Along the node's own axes, never 0; 1. A negative number mirrors.
        matrix : array_like (4, 4), optional
            Node to parent, in place of position, rotation and scale: not singular, last row (0, 0, 0, 1).
        parent : Node, optional
            A node of this scene that the new one moves with.
        environment : CubeMap or Probe, optional
            What mirrors and glass show; None is the scene's.
        visible : bool
            False is drawn nowhere, nor is anything below it.
        in_captures : bool
            False is absent from captures and probes, as is all below it; still drawn in frames.
        name : str
            For people.
        render_order : int
            Among opaque and among translucent nodes, lower is drawn first, before distance; of 32 bits.
        cast_shadow : bool
            False casts no shadows, nor does anything below it; see `Shadow`. Translucent nodes never cast.
        receive_shadow : bool
            Whether shadows show on its own surface.

        Returns
        -------
        Node
            With the next id: 1 for the first.

        Raises
        ------
        TypeError
            For an argument of another type.
        ValueError
            For numbers that are not finite, a singular matrix or a scale of 0, a matrix together with
            parts, or a parent that is not in this scene.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> box = scene.add(cc.Mesh.box(), cc.PhongMaterial(color=(1, .4, .4)), scale=2,
        ...                 rotation=cc.axis_angle((0, 1, 0), 45), name="crate")
        >>> box.scale.tolist(), box.name
        ([2.0, 2.0, 2.0], 'crate')
        """
    def clear(self: Scene) -> None:
        """
        Take all nodes and lights out.
        """
    def remove(self: Scene, thing: Node | Light) -> None:
        """
        Take a node and all below it, or a light, out.

        They keep their values; ids are not used again.

        Parameters
        ----------
        thing : Node or Light
            What to remove.

        Raises
        ------
        ValueError
            If it is not in this scene.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> group = scene.add()
        >>> child = scene.add(cc.Mesh.box(), parent=group)
        >>> scene.remove(group)
        >>> scene.nodes, child.parent is group
        ((), True)
        """
    def set_matrices(
        self: Scene, nodes: collections.abc.Iterable[Node], matrices: numpy.typing.ArrayLike
    ) -> None:
        """
        Place many nodes at once, as `Node.matrix` does for each.

        Parameters
        ----------
        nodes : sequence of Node
            Nodes of this scene.
        matrices : array_like (len(nodes), 4, 4)
            Node to parent, for column vectors; the last row of each is (0, 0, 0, 1).

        Raises
        ------
        ValueError
            For another number of matrices than nodes, a matrix that is singular or not finite, or a node of another scene. No
            node is moved then.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> scene = cc.Scene()
        >>> nodes = [scene.add(cc.Mesh.box(0.1)) for _ in range(2)]
        >>> scene.set_matrices(nodes, [np.diag([2, 2, 2, 1]), np.eye(4)])
        >>> nodes[0].scale.tolist()
        [2.0, 2.0, 2.0]
        """
    def set_positions(
        self: Scene, nodes: collections.abc.Iterable[Node], positions: numpy.typing.ArrayLike
    ) -> None:
        """
        Place many nodes at once, as `Node.position` does for each, in a hundredth of the time.

        Parameters
        ----------
        nodes : sequence of Node
            Nodes of this scene.
        positions : array_like (len(nodes), 3)
            Relative to the parent of each, world units.

        Raises
        ------
        ValueError
            For another number of positions than nodes, numbers that are not finite, or a node of another scene. No node is
            moved then.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> scene = cc.Scene()
        >>> nodes = [scene.add(cc.Mesh.box(0.1)) for _ in range(3)]
        >>> scene.set_positions(nodes, np.eye(3))
        >>> nodes[1].position.tolist()
        [0.0, 1.0, 0.0]
        """
    @property
    def background(self) -> numpy.typing.NDArray[numpy.float32] | CubeMap | None:
        """
        ndarray (4,) float32, CubeMap or None: what is seen where nothing is. None: the environment if there is one, else transparent black.
        """
    @background.setter
    def background(self, arg1: numpy.typing.ArrayLike | CubeMap | None) -> None: ...
    @property
    def environment(self) -> CubeMap | None:
        """
        CubeMap or None: what mirrors and glass show that have no environment of their own.
        """
    @environment.setter
    def environment(self, arg1: CubeMap | None) -> None: ...
    @property
    def lights(self) -> tuple[Light, ...]:
        """
        tuple of Light: in order of add.
        """
    @property
    def nodes(self) -> tuple[Node, ...]:
        """
        tuple of Node: all of them, in order of id.
        """

class Face(enum.IntEnum):
    """
    The six faces of a cube, in the order of every array here.

    As integers, 0 to 5: ``cube.faces[cc.Face.POS_Y]``. Axes and orientation are OpenGL's (OpenGL 4.6,
    section 8.13), drawn in docs/conventions.md.
    """

    NEG_X = 1
    NEG_Y = 3
    NEG_Z = 5
    POS_X = 0
    POS_Y = 2
    POS_Z = 4

class CubeMap:
    """
    Six square pictures that surround a point.

    Memory is always laid out as OpenGL's cube maps are: ``faces[f, row, col]`` is the texel with
    ``s = (col + .5)/N`` and ``t = (row + .5)/N`` on face `f` of +X -X +Y -Y +Z -Z (OpenGL 4.6, section
    8.13; docs/conventions.md). Safe to share between threads; compared by contents.

    Parameters
    ----------
    faces : array_like (6, N, N, C), or six of (N, N, C)
        C is 1, 3 or 4. uint8 (which stands for value/255), float16 or float32 are kept; float64 becomes
        float32. Linear, raw numbers. NaN is refused; inf is kept, and lookups near it give inf or NaN, as
        on the GPU.
    convention : {"gl", "inside", "three"}, default "gl"
        How `faces` are given: "gl" as above; "inside" as one sees them from the middle (OpenEXR); "three"
        as three.js and D3D skybox files have them.
    mipmaps : bool, default False
        Lookups, here and on the GPU, are trilinear over box-filtered levels.

    Raises
    ------
    ValueError
        Faces that are not square or not alike, another number of channels, NaN, an unknown convention.
    TypeError
        bool, complex, text, or integers other than uint8.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cube = cc.CubeMap(np.full((6, 8, 8, 3), 0.5, np.float32))
    >>> cube
    CubeMap(size=8, channels=3, dtype=float32, mipmaps=False)
    >>> cube.sample([0, 1, 0])
    array([0.5, 0.5, 0.5], dtype=float32)
    """

    __hash__: typing.ClassVar[None] = None
    @staticmethod
    def from_equirect(
        image: typing.Any,
        *,
        size: typing.SupportsInt | typing.SupportsIndex | None = None,
        center: str = "-z",
        sampling: str = "centers",
        mipmaps: bool = False,
        dtype: numpy.typing.DTypeLike | None = None,
    ) -> CubeMap:
        """
        A cube from a panorama.

        Filtered over each texel's footprint: shrinking does not alias, round the poles whole rows are
        averaged; enlarging is bilinear, wraps round and goes on over the poles.

        Parameters
        ----------
        image : array_like (H, 2H, C)
            uint8 (value/255), float16, float32 or float64; unmirrored, row 0 at +Y. NaN is refused; inf
            counts as the largest other number in it, at least 65504.
        size : int, optional
            Of a face; by default the next power of two from W / pi, which loses nothing.
        center : {"-z", "+z", "+x", "-x"}, default "-z"
            The axis at the center column.
        sampling : {"centers", "borders"}, default "centers"
            Where the samples of `image` lie; with "borders" (OpenEXR) any shape from (2, 2) will do.
        mipmaps : bool, default False
            Of the new cube.
        dtype : dtype, optional
            "uint8", "float16" or "float32", as numpy takes it. None: that of `image`.

        Returns
        -------
        CubeMap
            In `dtype`, rounded as `to_equirect` does.

        Raises
        ------
        ValueError
            An image that is not twice as wide as high, NaN, a size below 1, an unknown center or sampling,
            another dtype.
        TypeError
            An image of bool, complex, text, or integers other than uint8.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_equirect(np.zeros((64, 128, 3), np.uint8))
        CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False)
        """
    @staticmethod
    def from_layout(
        image: typing.Any,
        *,
        layout: str | None = None,
        convention: str = "gl",
        size: typing.SupportsInt | typing.SupportsIndex | None = None,
        center: str = "-z",
        mipmaps: bool = False,
        dtype: numpy.typing.DTypeLike | None = None,
    ) -> CubeMap:
        """
        A cube from one picture of all faces, the inverse of `to_layout`.

        Parameters
        ----------
        image : array_like (H, W, C)
        layout : str, optional
            As in `to_layout`. By default what the shape says: width to height of 4:3 cross, 3:4
            vertical_cross, 6:1 row, 1:6 column, 2:1 equirect. Shape never tells the convention.
        convention : {"gl", "inside", "three"}, default "gl"
            Of the faces in `image`.
        size, center
            As in `from_equirect`, for "equirect" only.
        mipmaps : bool, default False
            Of the new cube.
        dtype : dtype, optional
            "uint8", "float16" or "float32", as numpy takes it. None: that of `image`.

        Returns
        -------
        CubeMap
            In `dtype`, rounded as `to_equirect` does.

        Raises
        ------
        ValueError
            A shape that is none of these, or not that of `layout`.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_layout(np.zeros((24, 32, 3), np.uint8))
        CubeMap(size=8, channels=3, dtype=uint8, mipmaps=False)
        """
    def __copy__(self: CubeMap) -> CubeMap: ...
    def __deepcopy__(self: CubeMap, memo: dict) -> CubeMap: ...
    def __eq__(self: CubeMap, other: CubeMap) -> bool:
        """
        Whether the contents are the same bit for bit, captured outputs included.
        """
    def __getstate__(self: CubeMap) -> tuple: ...
    def __init__(
        self: CubeMap, faces: typing.Any, *, convention: str = "gl", mipmaps: bool = False
    ) -> None: ...
    def __ne__(self: CubeMap, other: CubeMap) -> bool: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: CubeMap) -> str: ...
    def __setstate__(self: CubeMap, arg0: tuple) -> None: ...
    def _repr_png_(self) -> bytes:
        """
        Give the picture that Jupyter shows: a cross seen from within, tone-mapped if the numbers are floats.
        """
    def copy(self: CubeMap) -> CubeMap:
        """
        An independent cubemap with the same contents.
        """
    def resize(
        self: CubeMap,
        size: typing.SupportsInt | typing.SupportsIndex,
        *,
        dtype: numpy.typing.DTypeLike | None = None,
    ) -> CubeMap:
        """
        The same cube with faces of another size.

        Parameters
        ----------
        size : int
            Texels along an edge. Shrinking averages the area of each texel; enlarging is bilinear and
            seamless.
        dtype : dtype, optional
            "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

        Returns
        -------
        CubeMap
            In `dtype`, rounded as `to_equirect` does, with the same mipmaps, without captured outputs.

        Raises
        ------
        ValueError
            A size below 1, or another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).resize(2).faces.shape
        (6, 2, 2, 3)
        """
    def sample(self: CubeMap, directions: typing.Any, *, lod: typing.Any = 0.0) -> numpy.ndarray:
        """
        Look directions up, seamlessly and bilinearly.

        The same numbers as GLSL ``textureLod`` with GL_LINEAR and GL_TEXTURE_CUBE_MAP_SEAMLESS (OpenGL 4.6,
        section 8.14): texels beyond an edge are the neighbour's, the missing fourth of a corner is the average of
        the other three.

        Parameters
        ----------
        directions : array_like (..., 3)
            World axes, from the center of the cube outwards, of any length but 0.
        lod : float or array_like (...,), default 0
            Level of detail: 0 is `faces`, each further level has half the size. Other than 0 only with
            ``mipmaps=True``, trilinear, clamped to the levels there are.

        Returns
        -------
        ndarray (..., C) float32
            Yours to write. uint8 as value/255.

        Raises
        ------
        ValueError
            A direction that is not finite or has length 0; `lod` without mipmaps or of another shape.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> faces = np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1).repeat(4, 1).repeat(4, 2)
        >>> cube = cc.CubeMap(faces)
        >>> cube.sample([[1, 0, 0], [0, -1, 0], [1, 0, 1]]).ravel()
        array([0., 3., 2.], dtype=float32)
        """
    def save(
        self,
        path: str | os.PathLike[str] | collections.abc.Sequence[str | os.PathLike[str]],
        *,
        layout: str | None = None,
        convention: str | None = None,
        width: int | None = None,
        center: str = "-z",
        srgb: bool = False,
        half: bool = False,
    ) -> None:
        """
        Write a cubemap as one picture or six files. The method `CubeMap.save`.

        Parameters
        ----------
        path : path, sequence of six paths, or a name with {face}
            The extension names the kind of file, as in `save_image`. {face} becomes px nx py ny pz nz.
        layout : str, optional
            "cross", "vertical_cross", "row", "column", "equirect" or "openexr" for one picture ("cross" if None);
            "faces" or None for six files. "openexr" is OpenEXR's environment cube: a column of "inside" faces with
            samples on the borders and the `envmap` attribute, .exr only.
        convention : {"gl", "inside", "three"}, optional
            How the faces are stored; "gl" by default ("inside" for "openexr").
        width : int, optional
            Of an equirect, in pixels, even; 4 times the face size by default.
        center : {"-z", "+z", "+x", "-x"}
            The direction in the middle of an equirect.
        srgb, half : bool
            As in `save_image`.

        Raises
        ------
        OSError
            A folder is missing or may not be written, or the disk is full. The old files stay as they were.
        ValueError
            Unknown names, options that do not go together, numbers that the file cannot hold.

        Notes
        -----
        Cells of a cross that no face covers are 0. A cubemap of float16 goes to EXR as half.

        Examples
        --------
        >>> import cubecam as cc, tempfile, pathlib
        >>> folder = pathlib.Path(tempfile.mkdtemp())
        >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=32)
        >>> cube.save(folder / "probe.exr", layout="cross", convention="inside")
        >>> cc.load_cubemap(folder / "probe.exr", convention="inside") == cube
        True
        """
    def set_face(
        self: CubeMap, face: typing.Any, pixels: typing.Any, *, convention: str = "gl"
    ) -> None:
        """
        Replace one face.

        Only this face is uploaded again, and nothing when it is the same.

        Parameters
        ----------
        face : Face, int from 0 to 5, or str
            "+x", "px", "pos_x", ... as `convention` calls it.
        pixels : array_like (N, N, C)
            Of the cube's size, channels and dtype.
        convention : {"gl", "inside", "three"}, default "gl"
            How `pixels` and `face` are meant.

        Raises
        ------
        ValueError
            Another shape, NaN, an unknown face.
        TypeError
            Another dtype (float64 is taken for float32).
        IndexError
            A number outside 0 to 5.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cube = cc.CubeMap(np.zeros((6, 2, 2, 1), np.uint8))
        >>> cube.set_face("+y", np.full((2, 2, 1), 255, np.uint8))
        >>> cube.sample([0, 1, 0])
        array([1.], dtype=float32)
        """
    def to_convention(self: CubeMap, convention: str) -> numpy.ndarray:
        """
        The six faces in another convention.

        Parameters
        ----------
        convention : {"gl", "inside", "three"}

        Returns
        -------
        ndarray (6, N, N, C) in `dtype`
            A copy, yours to write. ``CubeMap(array, convention=convention)`` gives this cube
            back exactly.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cube = cc.CubeMap(np.random.default_rng(1).random((6, 4, 4, 3)).astype("float32"))
        >>> cc.CubeMap(cube.to_convention("three"), convention="three") == cube
        True
        """
    def to_equirect(
        self: CubeMap,
        *,
        width: typing.SupportsInt | typing.SupportsIndex | None = None,
        center: str = "-z",
        sampling: str = "centers",
        dtype: numpy.typing.DTypeLike | None = None,
    ) -> numpy.ndarray:
        """
        The panorama that this cube holds.

        Unmirrored, row 0 at +Y. Filtered over each texel's footprint, so that shrinking does not alias;
        enlarging is bilinear and seamless.

        Parameters
        ----------
        width : int, optional
            Even; 4 * size by default, which keeps the resolution.
        center : {"-z", "+z", "+x", "-x"}, default "-z"
            The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
        sampling : {"centers", "borders"}, default "centers"
            Where samples lie. "borders": the first and last row and column lie on the edges, as in
            OpenEXR's latitude-longitude maps.
        dtype : dtype, optional
            "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

        Returns
        -------
        ndarray (width / 2, width, C) in `dtype`
            Yours to write. Filtered in float32, with uint8 as value/255, then rounded to nearest; uint8 holds
            0 to 1, and what lies outside becomes 0 or 255; float16 holds up to 65504, and what is more
            becomes inf.

        Raises
        ------
        ValueError
            A width that is not even and positive, an unknown center or sampling, another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> panorama = cc.CubeMap(np.ones((6, 16, 16, 4), np.float16)).to_equirect(center="+z")
        >>> panorama.shape, panorama.dtype.name
        ((32, 64, 4), 'float16')
        """
    def to_layout(
        self: CubeMap,
        layout: str = "cross",
        *,
        convention: str = "gl",
        dtype: numpy.typing.DTypeLike | None = None,
    ) -> numpy.ndarray:
        """
        One picture of all faces.

        Parameters
        ----------
        layout : {"cross", "vertical_cross", "row", "column", "equirect", "openexr"}, default "cross"
            "cross" (or "horizontal_cross") is 4N x 3N with -X, the second cell, +X and the last from left to
            right, +Y above and -Y below the second; "vertical_cross" is 3N x 4N with the last one below -Y,
            turned by 180 degrees. "row" and "column" are in order of the faces. "equirect" is
            ``to_equirect()``. "openexr" is OpenEXR's cube: a column of "inside" faces whose samples lie on the
            borders, resampled.
        convention : {"gl", "inside", "three"}, default "gl"
            Of the faces in it; the second cell is +Z, for "inside" -Z. Not looked at for "equirect" and
            "openexr", which have their own.
        dtype : dtype, optional
            "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

        Returns
        -------
        ndarray (H, W, C) in `dtype`
            Yours to write; cells without a face are 0. In another dtype than the cube's, and where resampled,
            numbers are rounded as `to_equirect` does.

        Raises
        ------
        ValueError
            An unknown layout or convention, or another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).to_layout("cross", convention="inside").shape
        (24, 32, 3)
        """
    @property
    def channels(self) -> int:
        """
        C: 1, 3 or 4, int.
        """
    @property
    def depth(self) -> typing.Any:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: OpenGL's window-space z with the precision of ``depth_format``, 0 at the near plane, 1 at the far plane and in the background.
        """
    @property
    def distance(self) -> typing.Any:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: length of the ray, world units; +inf background. In an orthographic picture it counts from the near plane.
        """
    @property
    def dtype(self) -> numpy.dtype[typing.Any]:
        """
        numpy.dtype: uint8, float16 or float32.
        """
    @property
    def faces(self) -> numpy.ndarray:
        """
        Pixels, ndarray (6, N, N, C) in `dtype`, "gl" layout.

        A read-only view that outlives the cube, and keeps its values when the cube changes.
        """
    @property
    def id(self) -> typing.Any:
        """
        ndarray (6, N, N) int32, read-only, of a capture that requested it, or None: ``Node.id`` of the visible node; 0 background.
        """
    @property
    def mipmaps(self) -> bool:
        """
        Whether lookups are trilinear, bool.
        """
    @property
    def normal(self) -> typing.Any:
        """
        ndarray (6, N, N, 3) float32, read-only, of a capture that requested it, or None: world shading normal, unit length, towards the viewer; 0 background.
        """
    @property
    def outputs(self) -> dict[str, numpy.ndarray]:
        """
        dict of str to ndarray: what a capture holds besides `faces`, by name. Read-only arrays.

        Beside the attributes' arrays it holds those that a ``ShaderMaterial`` declares, `out vec4 heat;`,
        float32 (6, N, N, 4), with fewer channels for vec3 and vec2 and (6, N, N) for float; 0 where the node
        that is seen does not write them.
        """
    @property
    def position(self) -> typing.Any:
        """
        ndarray (6, N, N, 3) float32, read-only, of a capture that requested it, or None: world position; NaN background.
        """
    @property
    def size(self) -> int:
        """
        N, texels along an edge, int.
        """
    @property
    def stencil(self) -> typing.Any:
        """
        ndarray (6, N, N) uint8, read-only, of a capture that requested it, or None: the stencil buffer after all drawing; 0 background.
        """
    @property
    def z(self) -> typing.Any:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: distance along the camera's axis, or a face's, world units; +inf background.
        """

class Image:
    """
    A picture that a material shows. It never changes.

    Numbers are taken as they are: linear and raw (uint8 as value/255). Decode an 8-bit photograph with
    ``load_image(path, srgb=True)`` first.

    Parameters
    ----------
    pixels : array_like (H, W, C)
        1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
        becomes float32. uv (0, 0) is the bottom-left corner.
    mipmaps : bool
        Whether lookups are trilinear, for pictures that are seen small. False: bilinear.
    wrap : {"repeat", "clamp"}
        What a lookup outside 0..1 gives.

    Raises
    ------
    TypeError
        For pixels of another type.
    ValueError
        For another shape, an image without pixels, NaN, or another `wrap`.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> checks = np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.uint8(255)
    >>> image = cc.Image(checks.astype(np.uint8), wrap="clamp")
    >>> image.size, image.channels, image.dtype
    ((8, 8), 1, dtype('uint8'))
    """
    def __copy__(self) -> typing.Any: ...
    def __deepcopy__(self, memo: dict) -> typing.Any: ...
    def __init__(
        self: Image, pixels: numpy.typing.ArrayLike, *, mipmaps: bool = False, wrap: str = "repeat"
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Image) -> str: ...
    def _repr_png_(self) -> bytes:
        """
        Give the picture that Jupyter shows.
        """
    @property
    def channels(self) -> int:
        """
        int: 1, 3 or 4.
        """
    @property
    def dtype(self) -> numpy.dtype[typing.Any]:
        """
        numpy.dtype: uint8, float16 or float32.
        """
    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """
    @property
    def pixels(self) -> numpy.ndarray:
        """
        ndarray (H, W, C): a read-only view, row 0 on top.
        """
    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height).
        """
    @property
    def wrap(self) -> str:
        """
        str: "repeat" or "clamp".
        """

class Mesh:
    """
    Indexed triangles, which any number of nodes, scenes and renderers share.

    The vertices may be set anew: `update` sets several arrays at once. The number of vertices and the
    triangles stay.

    Parameters
    ----------
    positions : array_like (V, 3)
        Object-space positions, finite; kept as float32.
    indices : array_like (F, 3) of int
        The three corners of each triangle, counter-clockwise seen from outside, from 0 to V - 1.
    normals : array_like (V, 3), optional
        Outward normals of any length. Those of length 0 become smooth ones. None: all are computed
        smooth, as the sum of the triangles' normals weighted by the angle at the vertex (G. Thuermer
        and C. Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT 3(1), 1998).
    uvs : array_like (V, 2), optional
        Texture coordinates; (0, 0) is a picture's bottom-left corner, (1, 1) its top-right one.
    colors : array_like (V, 3) or (V, 4), optional
        Linear RGB or RGBA, alpha from 0 to 1; uint8 stands for value/255. Shown by
        materials with ``vertex_colors=True``.

    Raises
    ------
    TypeError
        For arrays of bool, complex, object or str, and for indices that are not integers.
    ValueError
        For other shapes, unequal lengths, NaN or infinity, or no triangle.
    IndexError
        For an index outside 0 to V - 1.

    Examples
    --------
    >>> import cubecam as cc
    >>> mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> mesh.normals[0].tolist()
    [0.0, 0.0, 1.0]
    >>> mesh.bounds.tolist()
    [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
    >>> cc.Mesh.box(2)
    Mesh(24 vertices, 12 triangles)
    """
    @staticmethod
    def box(size: float | numpy.typing.ArrayLike = 1.0) -> Mesh:
        """
        A centred box with flat faces, each with uv from 0 to 1.

        Pictures are upright seen from outside: +Y up on the sides, -Z on top (as on `plane`), +Z below.

        Parameters
        ----------
        size : float or array_like (3,)
            Extents along X, Y and Z, above 0; one number for all three.

        Returns
        -------
        Mesh
            24 vertices, 12 triangles.

        Raises
        ------
        ValueError
            For an extent that is not above 0.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.box((1, 2, 3)).bounds[1].tolist()
        [0.5, 1.0, 1.5]
        """
    @staticmethod
    def cone(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        height: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        segments: typing.SupportsInt | typing.SupportsIndex = 64,
    ) -> Mesh:
        """
        A centred, closed cone round the Y axis: base at -height/2, apex at +height/2.

        Parameters
        ----------
        radius, height : float
            Of the base, and from the base to the apex; above 0.
        segments : int
            Round the axis, at least 3.

        Returns
        -------
        Mesh
            2 * segments triangles.

        Raises
        ------
        ValueError
            For a length that is not above 0, or too few or too many segments.

        Examples
        --------
        >>> import cubecam as cc
        >>> len(cc.Mesh.cone(segments=16).indices)
        32
        """
    @staticmethod
    def cylinder(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        height: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        segments: typing.SupportsInt | typing.SupportsIndex = 64,
    ) -> Mesh:
        """
        A centred, closed cylinder round the Y axis.

        On its side u runs round as on `sphere` and v upwards; each cap shows the disc of a picture.

        Parameters
        ----------
        radius, height : float
            Above 0.
        segments : int
            Round the axis, at least 3.

        Returns
        -------
        Mesh
            4 * segments triangles.

        Raises
        ------
        ValueError
            For a length that is not above 0, or too few or too many segments.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.cylinder(1, 4).bounds[1].tolist()
        [1.0, 2.0, 1.0]
        """
    @staticmethod
    def icosphere(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        subdivisions: typing.SupportsInt | typing.SupportsIndex = 3,
    ) -> Mesh:
        """
        A centred sphere of triangles of nearly equal size: a subdivided icosahedron.

        Texture coordinates are those of `sphere`.

        Parameters
        ----------
        radius : float
            Above 0.
        subdivisions : int
            From 0 to 9; each splits every triangle into four.

        Returns
        -------
        Mesh
            20 * 4**subdivisions triangles.

        Raises
        ------
        ValueError
            For a radius that is not above 0 or another number of subdivisions.

        Examples
        --------
        >>> import cubecam as cc
        >>> len(cc.Mesh.icosphere(1, subdivisions=3).indices)
        1280
        """
    @staticmethod
    def plane(
        width: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        depth: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> Mesh:
        """
        A rectangle in the XZ plane, centred, normal +Y.

        Seen from +Y with -Z up, a picture on it is upright. Its back is culled unless the material is
        double-sided.

        Parameters
        ----------
        width, depth : float
            Extents along X and Z, above 0.

        Returns
        -------
        Mesh
            4 vertices, 2 triangles.

        Raises
        ------
        ValueError
            For an extent that is not above 0.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.plane(10, 4).bounds.tolist()
        [[-5.0, 0.0, -2.0], [5.0, 0.0, 2.0]]
        """
    @staticmethod
    def sphere(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        segments: typing.SupportsInt | typing.SupportsIndex = 64,
        rings: typing.SupportsInt | typing.SupportsIndex = 32,
    ) -> Mesh:
        """
        A centred sphere of rings and segments, as on a globe.

        u runs once round the Y axis and v from the south pole (-Y) to the north pole: an equirectangular
        picture on it reads unmirrored from outside, its center at +Z and its seam at -Z.

        Parameters
        ----------
        radius : float
            Above 0.
        segments : int
            Round the Y axis, at least 3.
        rings : int
            From pole to pole, at least 2.

        Returns
        -------
        Mesh
            2 * segments * (rings - 1) triangles.

        Raises
        ------
        ValueError
            For a radius that is not above 0, too few segments or rings, or more than 16,777,216 vertices.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.sphere(0.5)
        Mesh(2145 vertices, 3968 triangles)
        """
    @staticmethod
    def torus(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        tube: typing.SupportsFloat | typing.SupportsIndex = 0.25,
        segments: typing.SupportsInt | typing.SupportsIndex = 64,
        sides: typing.SupportsInt | typing.SupportsIndex = 32,
    ) -> Mesh:
        """
        A centred torus round the Y axis.

        Parameters
        ----------
        radius : float
            From the axis to the center of the tube.
        tube : float
            Radius of the tube: above 0, below `radius`.
        segments : int
            Round the axis, at least 3.
        sides : int
            Round the tube, at least 3.

        Returns
        -------
        Mesh
            2 * segments * sides triangles.

        Raises
        ------
        ValueError
            For such lengths or numbers, or more than 16,777,216 vertices.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.torus(1, .25).bounds[1].tolist()
        [1.25, 0.25, 1.25]
        """
    def __init__(
        self: Mesh,
        positions: numpy.typing.ArrayLike,
        indices: numpy.typing.ArrayLike,
        *,
        normals: numpy.typing.ArrayLike | None = None,
        uvs: numpy.typing.ArrayLike | None = None,
        colors: numpy.typing.ArrayLike | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Mesh) -> str: ...
    def resized(self: Mesh, size: typing.SupportsFloat | typing.SupportsIndex) -> Mesh:
        """
        The same mesh, centred at the origin and scaled evenly.

        Parameters
        ----------
        size : float
            The largest extent that the result has, in world units.

        Returns
        -------
        Mesh
            A new mesh; normals, uvs and colours are the same.

        Raises
        ------
        ValueError
            For a size that is not above 0, or a mesh whose vertices are all at one point.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.box((1, 2, 4)).resized(1).bounds[1].tolist()
        [0.125, 0.25, 0.5]
        """
    def update(
        self: Mesh,
        *,
        positions: numpy.typing.ArrayLike | None = None,
        normals: numpy.typing.ArrayLike | None = None,
        uvs: numpy.typing.ArrayLike | None = None,
        colors: numpy.typing.ArrayLike | None = None,
    ) -> None:
        """
        Set vertices anew: several arrays at once, which one picture shows together.

        All nodes of the mesh show the new values in the next picture; only what is given is uploaded to the
        GPU again. Any call with an array counts as a change, even if all numbers are the same: comparing
        them would cost more than it saves. Other threads may draw meanwhile: a picture shows the mesh
        before or after an update, never part of it. Arrays that the mesh handed out before keep their
        values.

        Parameters
        ----------
        positions : array_like (V, 3), optional
            Object-space positions, finite. None: they stay.
        normals : array_like (V, 3), optional
            Outward normals of any length. None: normals that were given stay, also those of primitives
            and of `load_mesh`; smooth ones that the mesh computed are computed anew with new positions.
            ``mesh.normals = None`` makes them smooth.
        uvs : array_like (V, 2), optional
            Texture coordinates. None: they stay.
        colors : array_like (V, 3) or (V, 4), optional
            Linear RGB or RGBA; uint8 stands for value/255. None: they stay.

        Raises
        ------
        TypeError
            For arrays of bool, complex, object or str.
        ValueError
            For another number of vertices, NaN, infinity or an alpha outside 0 to 1. The mesh then stays
            as it was.

        Examples
        --------
        A sheet that waves:

        >>> import cubecam as cc
        >>> import numpy as np
        >>> x, z = np.meshgrid(np.linspace(-1, 1, 20), np.linspace(-1, 1, 20))
        >>> i = np.arange(19 * 20).reshape(19, 20)[:, :-1].ravel()
        >>> triangles = np.concatenate([np.c_[i, i + 20, i + 21], np.c_[i, i + 21, i + 1]])
        >>> mesh = cc.Mesh(np.c_[x.ravel(), 0 * x.ravel(), z.ravel()], triangles)
        >>> scene = cc.Scene()
        >>> sheet = scene.add(mesh)
        >>> for time in np.linspace(0, 1, 3):
        ...     y = 0.2 * np.sin(3 * x + time)
        ...     mesh.update(positions=np.c_[x.ravel(), y.ravel(), z.ravel()])
        >>> mesh.bounds[1].round(2).tolist()
        [1.0, 0.2, 1.0]
        """
    @property
    def bounds(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (2, 3) float64: the least and the greatest x, y, z of the vertices.
        """
    @property
    def colors(self) -> numpy.typing.NDArray[numpy.float32] | None:
        """
        ndarray (V, 4) float32 or None: linear RGBA; a read-only view.

        May be set. None: no colours.
        """
    @colors.setter
    def colors(self, arg1: numpy.typing.ArrayLike | None) -> None: ...
    @property
    def indices(self) -> numpy.typing.NDArray[numpy.uint32]:
        """
        ndarray (F, 3) uint32: the corners of each triangle, counter-clockwise seen from outside; a read-only view.
        """
    @property
    def normals(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (V, 3) float32: unit vectors; a read-only view.

        May be set. None: smooth ones, computed now and whenever the positions are set without normals.
        """
    @normals.setter
    def normals(self, arg1: numpy.typing.ArrayLike | None) -> None: ...
    @property
    def positions(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (V, 3) float32: where the vertices are; a read-only view.

        May be set; the normals then behave as `update` says. An array handed out before keeps its values.
        """
    @positions.setter
    def positions(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def uvs(self) -> numpy.typing.NDArray[numpy.float32] | None:
        """
        ndarray (V, 2) float32 or None: (0, 0) is a picture's bottom-left; a read-only view.

        May be set. None: no texture coordinates.
        """
    @uvs.setter
    def uvs(self, arg1: numpy.typing.ArrayLike | None) -> None: ...

class Blend:
    """
    Blending by OpenGL's own factors, for any material as ``blend=``.

    With S what the surface gives and D what is there, the colour becomes src * S + dst * D, and the alpha
    src_alpha * S + dst_alpha * D. The colour of S is not multiplied by its alpha; its alpha is the product
    of opacity and the alphas of colour and map. Formats with limits clamp S, and the result, to 0..1. A
    surface with a `Blend` is drawn as every blended one is: after the background, far to near, and leaving
    no depth unless ``depth_write=True``. A Blend never changes; compared by its values.

    Parameters
    ----------
    src : str
        What multiplies S: "zero", "one", "src_color", "one_minus_src_color", "dst_color",
        "one_minus_dst_color", "src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha" or
        "src_alpha_saturate", which is min(alpha of S, 1 - alpha of D) for colours and 1 for alphas.
    dst : str
        What multiplies D.
    src_alpha, dst_alpha : str, optional
        The same for the alphas, where "src_color" is the alpha of S. None takes the colour's.
    equation : {"add", "subtract", "reverse_subtract", "min", "max"}
        "add" as above; "subtract": src * S - dst * D; "reverse_subtract": dst * D - src * S; "min" and
        "max" of S and D, channel by channel, whatever the factors.

    Raises
    ------
    ValueError
        For an unknown word.
    TypeError
        For what is no word.

    Notes
    -----
    OpenGL 4.5, section 17.3.6.

    Examples
    --------
    The plain pair of many tutorials, which blends the alpha as if it were a colour:

    >>> import cubecam as cc
    >>> pair = cc.Blend("src_alpha", "one_minus_src_alpha")
    >>> scene = cc.Scene(background=(0, 0, 1, 1))
    >>> pane = scene.add(cc.Mesh.box((9, 9, .1)), cc.BasicMaterial(color=(1, 0, 0), opacity=.5, blend=pair))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, cc.PerspectiveCamera(position=(0, 0, 3)), size=(8, 8),
    ...                             format="rgba32f")
    >>> frame.color[4, 4].tolist()
    [0.5, 0.0, 0.5, 0.75]
    """
    def __eq__(self: Blend, other: Blend) -> bool: ...
    def __hash__(self: Blend) -> int: ...
    def __init__(
        self: Blend,
        src: str,
        dst: str,
        *,
        src_alpha: str | None = None,
        dst_alpha: str | None = None,
        equation: str = "add",
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Blend) -> str: ...
    def __setstate__(self: Blend, state: tuple) -> None:
        """
        For unpickling.
        """
    @property
    def dst(self) -> str:
        """
        str: what multiplies the colour that is there.
        """
    @property
    def dst_alpha(self) -> str:
        """
        str: what multiplies the alpha that is there.
        """
    @property
    def equation(self) -> str:
        """
        str: what becomes of both products.
        """
    @property
    def src(self) -> str:
        """
        str: what multiplies the surface's colour.
        """
    @property
    def src_alpha(self) -> str:
        """
        str: what multiplies the surface's alpha.
        """

class Stencil:
    """
    A stencil test, and what drawing does to the stencil buffer.

    Give it to any material as ``stencil=``, and ask for a buffer by ``depth_format="depth24_stencil8"``,
    "depth32f_stencil8" or "stencil_index8"; without one it has no effect. The buffer holds 8 bits a
    pixel and starts a picture at 0. What masks must be drawn before what is masked: see
    ``Node.render_order``. It never changes; compared by its values.

    Parameters
    ----------
    func : {"always", "never", "less", "equal", "lequal", "greater", "notequal", "gequal"}
        A pixel is drawn where ``reference & read_mask`` compares so with ``stored & read_mask``: "less"
        where the reference is less than what is stored.
    reference : int
        From 0 to 255.
    read_mask : int
        The bits that are compared, from 0 to 255.
    write_mask : int
        The bits that may change, from 0 to 255.
    fail : {"keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert"}
        What becomes of the stored number where the test fails. "replace": the reference. "incr" stops
        at 255, "incr_wrap" goes on at 0; so, downwards, do "decr" and "decr_wrap".
    depth_fail : str
        The same where the test passes and the depth test fails.
    depth_pass : str
        The same where both pass, or there is no depth test.

    Raises
    ------
    ValueError
        For an unknown word, or a number out of its range.
    TypeError
        For an argument of another type.

    Notes
    -----
    OpenGL 4.6, section 17.3.3; front and back faces alike.

    Examples
    --------
    A disc as a window: invisible itself, it lets the red plane behind it show within its outline only.

    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> hole = cc.BasicMaterial(color_write=False, depth_write=False,
    ...                         stencil=cc.Stencil(reference=1, depth_pass="replace"))
    >>> disc = scene.add(cc.Mesh.sphere(.5), hole, scale=(1, 1, .01), position=(0, 0, 1), render_order=-1)
    >>> seen = cc.BasicMaterial(color=(1, 0, 0), stencil=cc.Stencil(func="equal", reference=1))
    >>> plane = scene.add(cc.Mesh.box((4, 4, .1)), seen)
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, cc.PerspectiveCamera(position=(0, 0, 3)), size=(32, 32),
    ...                             depth_format="depth24_stencil8", outputs=("stencil", "id"))
    >>> int(frame.id[16, 16]), int(frame.stencil[16, 16]), int(frame.id[0, 0])
    (2, 1, 0)
    """
    def __eq__(self: Stencil, other: Stencil) -> bool: ...
    def __hash__(self: Stencil) -> int: ...
    def __init__(
        self: Stencil,
        *,
        func: str = "always",
        reference: int = 0,
        read_mask: int = 255,
        write_mask: int = 255,
        fail: str = "keep",
        depth_fail: str = "keep",
        depth_pass: str = "keep",
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Stencil) -> str: ...
    @property
    def depth_fail(self) -> str:
        """
        str: where only the depth test fails.
        """
    @property
    def depth_pass(self) -> str:
        """
        str: where both pass.
        """
    @property
    def fail(self) -> str:
        """
        str: where the test fails.
        """
    @property
    def func(self) -> str:
        """
        str: the comparison.
        """
    @property
    def read_mask(self) -> int:
        """
        int: the bits that are compared.
        """
    @property
    def reference(self) -> int:
        """
        int: what is compared and written.
        """
    @property
    def write_mask(self) -> int:
        """
        int: the bits that may change.
        """

class Material:
    """
    Base of the materials: how a surface answers light.

    A material may be shared by any number of nodes; a change shows on all of them. Colours are 3 or 4
    numbers, linear, or the name of a CSS colour or "#rrggbb", which say sRGB; a fourth number, from 0 to
    1, multiplies `opacity`. What is not fully opaque is blended over what lies behind it.

    Every material takes these by keyword, and has them as attributes:

    ======================  =========================================================================
    opacity=1               from 0 to 1, times the alpha of the colours
    double_sided=False      True shows both sides; False culls back faces
    blend=None              how its colour S, of alpha a, joins what is there already, D:
                            "opaque": S, with alpha 1;
                            "alpha": a S + (1 - a) D, alpha a + (1 - a) D;
                            "alpha_keep": the same colour, alpha stays D's;
                            "additive": a S + D, alpha a + D;
                            "multiply": (1 - a + a S) D, alpha stays D's;
                            "premultiplied": S + (1 - a) D in all four channels, for maps whose colour
                            is multiplied by their alpha already; opacity and the colour's alpha
                            multiply both;
                            a `Blend`: as its factors say.
                            None: "alpha" where anything is translucent, else "opaque"
    depth_write=None        whether it hides what is drawn later and is farther; None: if its blend is
                            "opaque"
    depth_test=True         False is drawn over what is nearer as well
    color_write=True        which channels are written: one bool, or four (red, green, blue, alpha)
    stencil=None            a `Stencil`: how it tests and changes the stencil buffer, where
                            ``depth_format`` has one; None leaves it alone
    ======================  =========================================================================

    What is blended, or writes no depth, is drawn after the background, far to near; it writes colour
    and none of the other outputs. A mask that writes neither colour nor depth, but a stencil, is drawn
    among the opaque nodes.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self) -> str: ...
    def __setstate__(self: Material, state: dict) -> None:
        """
        For unpickling.
        """
    @property
    def blend(self) -> str | Blend | None:
        """
        str, Blend or None: how it joins what is drawn already: "opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied" or a `Blend`; see `Material`. None: "alpha" where anything is translucent, else "opaque".
        """
    @blend.setter
    def blend(self, arg1: str | Blend | None) -> None: ...
    @property
    def color_write(self) -> tuple[bool, bool, bool, bool]:
        """
        tuple of bool: which of red, green, blue, alpha are written; one bool sets all four. Depth and the other outputs are written all the same.
        """
    @color_write.setter
    def color_write(self, arg1: bool | tuple[bool, bool, bool, bool]) -> None: ...
    @property
    def depth_test(self) -> bool:
        """
        bool: False is drawn over what is nearer as well.
        """
    @depth_test.setter
    def depth_test(self, arg1: bool) -> None: ...
    @property
    def depth_write(self) -> bool | None:
        """
        bool or None: whether it hides what is drawn after it and is farther. None: if its blend is "opaque".
        """
    @depth_write.setter
    def depth_write(self, arg1: bool | None) -> None: ...
    @property
    def double_sided(self) -> bool:
        """
        bool: True shows both sides, its normal turned to the viewer; False culls back faces.
        """
    @double_sided.setter
    def double_sided(self, arg1: bool) -> None: ...
    @property
    def opacity(self) -> float:
        """
        float: from 0 to 1, times the alpha of the colours.
        """
    @opacity.setter
    def opacity(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stencil(self) -> Stencil | None:
        """
        Stencil or None: how it tests and changes the stencil buffer, where ``depth_format`` has one; None leaves it alone.
        """
    @stencil.setter
    def stencil(self, arg1: Stencil | None) -> None: ...

class BasicMaterial(Material):
    """
    Unlit: color * map * vertex colour * cubemap.

    Parameters
    ----------
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA; a CSS name or "#rrggbb" says sRGB.
    map : Image, array_like (H, W, C) or RenderTexture, optional
        A picture, placed by the mesh's uvs.
    cubemap : CubeMap or Probe, optional
        Looked up in the direction of the object-space position, so that a box or sphere shows the
        whole of it and turns with it. Its alpha does not count.
    vertex_colors : bool
        Whether the mesh's colours count.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
        As of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.
    TypeError
        For a map or cubemap of another type.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.BasicMaterial(color=(1, 0, 0, .5))
    BasicMaterial(color=(1, 0, 0, 0.5))
    """
    def __init__(
        self: BasicMaterial,
        *,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        map: Image | RenderTexture | numpy.typing.ArrayLike | None = None,
        cubemap: CubeMap | Probe | None = None,
        vertex_colors: bool = False,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: str | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
    ) -> None: ...
    @property
    def color(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """
    @color.setter
    def color(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def cubemap(self) -> CubeMap | Probe | None:
        """
        CubeMap, Probe or None: looked up by the object-space position.
        """
    @cubemap.setter
    def cubemap(self, arg1: CubeMap | Probe | None) -> None: ...
    @property
    def map(self) -> Image | RenderTexture | None:
        """
        Image, RenderTexture or None: times the colour, by the mesh's uvs. An array (H, W, C) becomes an Image.
        """
    @map.setter
    def map(self, arg1: Image | RenderTexture | numpy.typing.ArrayLike | None) -> None: ...
    @property
    def vertex_colors(self) -> bool:
        """
        bool: whether the colour is multiplied by the mesh's vertex colours.
        """
    @vertex_colors.setter
    def vertex_colors(self, arg1: bool) -> None: ...

class GlassMaterial(Material):
    """
    Glass: F * environment(R) + (1 - F) * tint * environment(T).

    R is the reflected direction, T the refracted one as GLSL's ``refract`` gives it, for one surface.
    F is Fresnel's reflectance of a dielectric for unpolarised light, the mean of both polarisations
    (M. Born and E. Wolf, "Principles of Optics", section 1.5.2); where there is no T all is reflected.

    Parameters
    ----------
    ior : float
        Index of refraction: the one inside divided by the one outside, above 0. 1.5 is glass in air, 1.33
        water in air, 1/1.33 a bubble of air in water. GLSL's ``refract`` takes its inverse, eta.
    fresnel : bool
        False: T alone.
    tint : array_like (3,) or (4,), or str
        Linear RGB or RGBA, times what is refracted; a CSS name or "#rrggbb" says sRGB.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
        As of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> water = cc.GlassMaterial(ior=1.33, tint=(.8, .9, 1))
    >>> water
    GlassMaterial(ior=1.33, tint=(0.8, 0.9, 1, 1))
    """
    def __init__(
        self: GlassMaterial,
        *,
        ior: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        fresnel: bool = True,
        tint: numpy.typing.ArrayLike = (1, 1, 1),
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: str | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
    ) -> None: ...
    @property
    def fresnel(self) -> bool:
        """
        bool: whether part of the light is reflected; False: all is refracted.
        """
    @fresnel.setter
    def fresnel(self, arg1: bool) -> None: ...
    @property
    def ior(self) -> float:
        """
        float: refractive index inside divided by the one outside.
        """
    @ior.setter
    def ior(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def tint(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (4,) float32: linear RGBA, times what is refracted.
        """
    @tint.setter
    def tint(self, arg1: numpy.typing.ArrayLike) -> None: ...

class MirrorMaterial(Material):
    """
    A mirror: env_weight * tint * environment(R) + color_weight * color.

    R = I - 2 (N.I) N with I from the eye to the surface, in world space. The environment is the node's:
    the scene's, a CubeMap or a Probe.

    Parameters
    ----------
    tint : array_like (3,) or (4,), or str
        Linear RGB or RGBA, times what is reflected; a CSS name or "#rrggbb" says sRGB.
    env_weight : float
        Weight of what is reflected, not negative.
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA that the surface adds; a CSS name or "#rrggbb" says sRGB.
    color_weight : float
        Its weight, not negative.
    f0 : float, optional
        The reflectance seen head-on, from 0 to 1: env_weight is multiplied by
        f0 + (1 - f0) (1 - N.V)**5 (C. Schlick, "An Inexpensive BRDF Model for Physically-based
        Rendering", 1994). None: it is not.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
        As of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> gold = cc.MirrorMaterial(color=(.95, .85, .4), env_weight=.78, color_weight=.3)
    >>> gold.env_weight, gold.f0
    (0.78, None)
    """
    def __init__(
        self: MirrorMaterial,
        *,
        tint: numpy.typing.ArrayLike = (1, 1, 1),
        env_weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        color: numpy.typing.ArrayLike = (0, 0, 0),
        color_weight: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        f0: typing.SupportsFloat | typing.SupportsIndex | None = None,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: str | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
    ) -> None: ...
    @property
    def color(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """
    @color.setter
    def color(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def color_weight(self) -> float:
        """
        float: weight of the mirror's own colour.
        """
    @color_weight.setter
    def color_weight(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def env_weight(self) -> float:
        """
        float: weight of what is reflected.
        """
    @env_weight.setter
    def env_weight(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def f0(self) -> float | None:
        """
        float or None: the reflectance seen head-on, from 0 to 1; None reflects evenly.
        """
    @f0.setter
    def f0(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def tint(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (4,) float32: linear RGBA, times what is reflected.
        """
    @tint.setter
    def tint(self, arg1: numpy.typing.ArrayLike) -> None: ...

class PhongMaterial(Material):
    """
    Phong's reflection model.

    ka * color, once, plus for every light: kd * color * max(N.L, 0), and ks * max(R.V, 0)**shininess
    in white where N.L > 0 (B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6),
    1975). An `AmbientLight` adds its light times ka * color.

    Parameters
    ----------
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA; a CSS name or "#rrggbb" says sRGB.
    ka, kd, ks : float
        Ambient, diffuse and specular weights, not negative.
    shininess : float
        Above 0; greater is a smaller highlight.
    map : Image, array_like (H, W, C) or RenderTexture, optional
        A picture that multiplies color, placed by the mesh's uvs.
    vertex_colors : bool
        Whether the mesh's colours multiply color.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
        As of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.
    TypeError
        For a map of another type.

    Examples
    --------
    >>> import cubecam as cc
    >>> red = cc.PhongMaterial(color=(1, .4, .4))
    >>> red.ka, red.kd, red.ks, red.shininess
    (0.2, 0.7, 1.0, 10.0)
    >>> red.kd = .5
    >>> red
    PhongMaterial(color=(1, 0.4, 0.4, 1), kd=0.5)
    """
    def __init__(
        self: PhongMaterial,
        *,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        ka: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        kd: typing.SupportsFloat | typing.SupportsIndex = 0.7,
        ks: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        shininess: typing.SupportsFloat | typing.SupportsIndex = 10.0,
        map: Image | RenderTexture | numpy.typing.ArrayLike | None = None,
        vertex_colors: bool = False,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: str | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
    ) -> None: ...
    @property
    def color(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """
    @color.setter
    def color(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def ka(self) -> float:
        """
        float: ambient weight.
        """
    @ka.setter
    def ka(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def kd(self) -> float:
        """
        float: diffuse weight.
        """
    @kd.setter
    def kd(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def ks(self) -> float:
        """
        float: specular weight; highlights are white.
        """
    @ks.setter
    def ks(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def map(self) -> Image | RenderTexture | None:
        """
        Image, RenderTexture or None: times the colour, by the mesh's uvs. An array (H, W, C) becomes an Image.
        """
    @map.setter
    def map(self, arg1: Image | RenderTexture | numpy.typing.ArrayLike | None) -> None: ...
    @property
    def shininess(self) -> float:
        """
        float: Phong's exponent.
        """
    @shininess.setter
    def shininess(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vertex_colors(self) -> bool:
        """
        bool: whether the colour is multiplied by the mesh's vertex colours.
        """
    @vertex_colors.setter
    def vertex_colors(self, arg1: bool) -> None: ...

class ShaderMaterial(Material):
    """
    A material of one's own, in GLSL (4.50 core) with the scene at hand.

    Parameters
    ----------
    fragment : str or path
        GLSL with a function ``vec3 shade(Surface surface)``: the linear colour of a fragment; ``vec4`` to
        give an alpha as well, which counts where `blend` is not "opaque". A str is the source itself, a
        path (``pathlib.Path``) a file that holds it.
    vertex : str or path, optional
        GLSL with a function ``void vertex(inout Vertex vertex)``, which moves vertices in the mesh's own
        space.
    uniforms : dict of str, optional
        Values of the uniforms that the source declares: numbers, bools, vectors (2,) to (4,), matrices
        (2, 2) to (4, 4) in reading order, or arrays of these with the number of elements ahead. A
        uniform without a value has what its declaration says, else 0.
    textures : dict of str, optional
        For each ``uniform sampler2D`` an Image or an array (H, W, C); for each
        ``uniform samplerCube`` a CubeMap or a Probe, from which the node is then left out.
    displacement : float, optional
        How far `vertex` moves a vertex at most, in the mesh's units. None: unknown; such a node is never
        culled, and its picture is redrawn whole.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
        As of every `Material`.

    Attributes
    ----------
    uniforms, textures : mutable mapping
        ``material.uniforms["time"] = 2`` shows in the next picture.

    Raises
    ------
    ValueError
        For a source without its function, or a name or value that no uniform can have. When it is
        drawn: for a name that the source does not declare, or a value of another shape.
    TypeError
        For values of another type.
    OSError
        For a path that cannot be read.
    ShaderError
        When it is drawn, for a source that does not compile; the message has the user's own
        lines and their numbers.

    Notes
    -----
    Outputs of one's own: ``out vec4 heat;`` in `fragment`, of float, vec2, vec3 or vec4 and without a
    layout, is a buffer that ``outputs=("heat",)`` requests and ``frame.outputs["heat"]`` and
    ``cube.outputs["heat"]`` hold: float32, 0 where the node that is seen does not write it. Only opaque nodes
    that leave depth write them, and colour and these outputs together are limited by the driver's draw
    buffers (8 as a rule). Without a request it is a variable.

    What the source has at hand; names that begin with ``u_``, ``v_``, ``a_``, ``o_`` or ``gl_`` are taken.

    In both stages: ``mat4 model_matrix()`` (mesh to world), ``mat3 normal_matrix()`` (its inverse
    transpose, to any length), ``vec3 eye_position()`` (world; of perspective views).
    What a vertex hands on is declared in both, as ``out vec3 x;`` and ``in vec3 x;``.

    ``struct Vertex { vec3 position; vec3 normal; vec2 uv; vec4 color; }``, in the mesh's space.

    ``struct Surface``: ``position`` (world), ``normal`` (world, unit, towards the viewer on
    double-sided surfaces), ``incident`` (world, unit, from the eye to the surface), ``position_object``,
    ``normal_object``, ``uv``, ``color`` (the vertices', white if there is none).

    ``vec3 environment(vec3 direction)``: what the node's environment shows in a world direction, seamless;
    ``environment_lod(direction, level)`` at a level of its mipmaps; ``int environment_levels()``: how many levels it has,
    1 without mipmaps and 0 where there is none; ``bool environment_is_local()``: whether a probe captured it;
    ``vec3 environment_position()``: where in the world it did.
    ``int light_count()``, ``LightSample sample_light(int index, Surface surface)`` with ``direction`` (unit, to
    the light) and ``radiance``; ``vec3 ambient_light()``, the sum of the
    ambient lights.
    ``vec3 phong(Surface surface, vec3 color, float ka, float kd, float ks, float shininess)``, as `PhongMaterial`.
    ``float schlick(Surface surface, float f0)``: Schlick's Fresnel term.

    Examples
    --------
    The mirror of document 000 in GLSL, on a ball that follows the scene:

    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(.4, .4, .4))
    >>> box = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, 3))
    >>> gold = cc.ShaderMaterial('''
    ...     uniform vec3 color;
    ...     uniform float share = 0.78;
    ...     vec3 shade(Surface surface) {
    ...         vec3 reflected = reflect(surface.incident, surface.normal);
    ...         return share * environment(reflected) + 0.3 * color;
    ...     }
    ... ''', uniforms={"color": (.95, .85, .4)})
    >>> ball = scene.add(cc.Mesh.sphere(.5), gold, environment=cc.Probe(size=64))
    >>> camera = cc.PerspectiveCamera(fov=30, position=(0, 0, 5), target=(0, 0, 0))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, camera, size=(9, 9), format="rgba32f")
    >>> gold.uniforms["share"] = .5
    >>> sorted(gold.uniforms)
    ['color', 'share']

    An output of its own, how far above the floor a surface lies:

    >>> marked = cc.ShaderMaterial('''
    ...     out float height;
    ...     vec3 shade(Surface surface) { height = surface.position.y; return surface.color.rgb; }
    ... ''')
    >>> scene = cc.Scene()
    >>> box = scene.add(cc.Mesh.box(2), marked, position=(0, 3, 0))
    >>> with cc.Renderer() as renderer:
    ...     cube = renderer.capture(scene, size=4, outputs=("height",))
    >>> cube.outputs["height"].shape, float(cube.outputs["height"].max())
    ((6, 4, 4), 2.0)
    """
    def __init__(
        self: ShaderMaterial,
        fragment: str | typing.Any | None,
        *,
        vertex: str | typing.Any | None = None,
        uniforms: dict[str, typing.Any] | None = None,
        textures: dict[str, typing.Any] | None = None,
        displacement: typing.SupportsFloat | typing.SupportsIndex | None = None,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: str | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: ShaderMaterial) -> str: ...
    def __setstate__(self: ShaderMaterial, state: tuple) -> None:
        """
        For unpickling.
        """
    def _remove_texture(self: ShaderMaterial, name: str) -> None: ...
    def _remove_uniform(self: ShaderMaterial, name: str) -> None: ...
    def _set_inputs(
        self: ShaderMaterial, uniforms: typing.Any = None, textures: typing.Any = None
    ) -> None:
        """
        Replace all uniforms, all textures, or both.
        """
    def _set_texture(self: ShaderMaterial, name: str, value: typing.Any) -> None: ...
    def _set_uniform(self: ShaderMaterial, name: str, value: typing.Any) -> None: ...
    def _textures(self: ShaderMaterial) -> dict: ...
    def _uniforms(self: ShaderMaterial) -> dict: ...
    def reload(self: ShaderMaterial) -> bool:
        """
        Read the source again from its file.

        A source that does not compile raises when it is drawn next; mended and reloaded, it works again.

        Returns
        -------
        bool
            Whether it changed.

        Raises
        ------
        ValueError
            If no part of the source came from a file, or what is in the file lacks its function.
        OSError
            If the file cannot be read; the old source stays.
        """
    @property
    def displacement(self) -> float | None:
        """
        float or None: how far `vertex` moves a vertex at most, in the mesh's units; None: unknown, so the node is never culled.
        """
    @displacement.setter
    def displacement(self, arg1: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def fragment(self) -> str | None:
        """
        str: GLSL of every fragment. Setting it, to text or a path, shows in the next picture.
        """
    @fragment.setter
    def fragment(self, arg1: str | typing.Any | None) -> None: ...
    @property
    def textures(self) -> collections.abc.MutableMapping[str, typing.Any]:
        """
        Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture.
        """
    @textures.setter
    def textures(self, values: typing.Any) -> None:
        """
        Replace all textures.
        """
    @property
    def uniforms(self) -> collections.abc.MutableMapping[str, typing.Any]:
        """
        Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture.
        """
    @uniforms.setter
    def uniforms(self, values: typing.Any) -> None:
        """
        Replace all uniforms.
        """
    @property
    def vertex(self) -> str | None:
        """
        str or None: GLSL of every vertex.
        """
    @vertex.setter
    def vertex(self, arg1: str | typing.Any | None) -> None: ...

class ImageEffect:
    """
    A pass over a finished picture, in GLSL (4.50 core): ``renderer.render(..., effects=[effect])``.

    Effects run one after the other, each over all pixels, in linear float32: after multisamples are resolved, before
    tone mapping and encoding.

    Parameters
    ----------
    fragment : str or path
        GLSL with a function ``vec4 effect(vec2 uv)``: a pixel's new value, uv (0, 0) being the picture's
        bottom-left corner and (1, 1) its top-right; ``vec3`` to keep the alpha. A str is the source itself, a
        path (``pathlib.Path``) a file that holds it.
    uniforms, textures : dict of str, optional
        As of `ShaderMaterial`; no probes.

    Attributes
    ----------
    uniforms, textures : mutable mapping
        ``effect.uniforms["strength"] = 2`` shows in the next picture.

    Raises
    ------
    ValueError, TypeError, OSError, ShaderError
        As of `ShaderMaterial`.

    Notes
    -----
    The source has at hand ``vec4 frame(vec2 uv)`` (the picture so far, bilinear), ``vec4 frame_pixel(ivec2 pixel)`` (one
    pixel as it is, (0, 0) the bottom-left one), both repeating the border beyond it, and ``ivec2 frame_size()``.

    Examples
    --------
    A box filter of nine taps:

    >>> import cubecam as cc
    >>> blur = cc.ImageEffect('''
    ...     vec4 effect(vec2 uv) {
    ...         ivec2 here = ivec2(gl_FragCoord.xy);
    ...         vec4 sum = vec4(0.0);
    ...         for (int y = -1; y <= 1; ++y)
    ...             for (int x = -1; x <= 1; ++x) sum += frame_pixel(here + ivec2(x, y));
    ...         return sum / 9.0;
    ...     }
    ... ''')
    >>> scene = cc.Scene(background=(1, .5, 0))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, cc.PerspectiveCamera(), size=(4, 4), effects=[blur])
    >>> frame.color[0, 0].tolist()
    [255, 128, 0, 255]
    """
    def __init__(
        self: ImageEffect,
        fragment: str | typing.Any | None,
        *,
        uniforms: dict[str, typing.Any] | None = None,
        textures: dict[str, typing.Any] | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: ImageEffect) -> str: ...
    def __setstate__(self: ImageEffect, state: tuple) -> None:
        """
        For unpickling.
        """
    def _remove_texture(self: ImageEffect, name: str) -> None: ...
    def _remove_uniform(self: ImageEffect, name: str) -> None: ...
    def _set_inputs(
        self: ImageEffect, uniforms: typing.Any = None, textures: typing.Any = None
    ) -> None:
        """
        Replace all uniforms, all textures, or both.
        """
    def _set_texture(self: ImageEffect, name: str, value: typing.Any) -> None: ...
    def _set_uniform(self: ImageEffect, name: str, value: typing.Any) -> None: ...
    def _textures(self: ImageEffect) -> dict: ...
    def _uniforms(self: ImageEffect) -> dict: ...
    def reload(self: ImageEffect) -> bool:
        """
        Read the source again from its file.

        A source that does not compile raises when it is drawn next; mended and reloaded, it works again.

        Returns
        -------
        bool
            Whether it changed.

        Raises
        ------
        ValueError
            If no part of the source came from a file, or what is in the file lacks its function.
        OSError
            If the file cannot be read; the old source stays.
        """
    @property
    def fragment(self) -> str:
        """
        str: GLSL of every pixel. Setting it, to text or a path, shows in the next picture.
        """
    @fragment.setter
    def fragment(self, arg1: str | typing.Any | None) -> None: ...
    @property
    def textures(self) -> collections.abc.MutableMapping[str, typing.Any]:
        """
        Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture.
        """
    @textures.setter
    def textures(self, values: typing.Any) -> None:
        """
        Replace all textures.
        """
    @property
    def uniforms(self) -> collections.abc.MutableMapping[str, typing.Any]:
        """
        Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture.
        """
    @uniforms.setter
    def uniforms(self, values: typing.Any) -> None:
        """
        Replace all uniforms.
        """

class Shadow:
    """
    How a light's shadow is made: a depth map as the light sees it, and how that is looked up.

    A value that does not change: give a light another one. All visible opaque nodes cast shadows whose
    ``cast_shadow`` is True, in or out of a picture's view, from either side of their surface. They
    fall on every node with a `PhongMaterial` whose ``receive_shadow`` is True. A map is drawn again
    only when what it sees changes.

    A directional light's map covers all that casts, so a wide floor makes its texels wide: set the
    floor's ``cast_shadow`` to False, or an ``extent``.

    The edge of a shadow is about ``2 * radius + 1`` texels wide. A surface does not shadow itself, since
    each texel is compared with the depth of the surface's own plane there, and no distance has to be
    tuned for that.

    Parameters
    ----------
    size : int
        Texels a side of the map; a point light has six. From 8, and more for a larger radius, to
        ``info.limits.max_texture_size``.
    radius : float
        Of the percentage-closer filter (Reeves, Salesin and Cook, 1987), texels, from 0 to 16: a box of
        ``2 * radius + 1`` texels. 0 is as hard as a map can be.
    bias : float
        World units, not negative: what is nearer to a surface casts no shadow on it. It comes on top of
        a fraction of a texel.
    near : float
        Point and spot lights: what is nearer to the light casts no shadow. World units, above 0.
    far : float or None
        Point and spot lights: what is farther from the light casts no shadow. World units, above near;
        None: all that there is casts.
    extent : float or None
        Directional lights: width and height of what the map covers (but for its outermost texels,
        which stay empty), world units, around the middle of the bounds of all that casts; beyond, all
        is lit. None: as much as all that casts.

    Raises
    ------
    ValueError
        For a number out of its range.

    Examples
    --------
    >>> import cubecam as cc
    >>> lamp = cc.PointLight(position=(0, 3, 0), shadow=cc.Shadow(size=512, radius=2))
    >>> lamp.shadow
    Shadow(size=512, radius=2, bias=0, near=0.05, far=None, extent=None)
    >>> lamp.shadow == cc.Shadow(size=512, radius=2)
    True
    """
    def __eq__(self: Shadow, other: typing.Any) -> typing.Any: ...
    def __hash__(self: Shadow) -> int: ...
    def __init__(
        self: Shadow,
        *,
        size: typing.SupportsInt | typing.SupportsIndex = 1024,
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        bias: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex | None = None,
        extent: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Shadow) -> str: ...
    @property
    def bias(self) -> float:
        """
        float: world units.
        """
    @property
    def extent(self) -> float | None:
        """
        float or None: what the map covers, world units; directional lights.
        """
    @property
    def far(self) -> float | None:
        """
        float or None: nothing farther casts; point and spot lights.
        """
    @property
    def near(self) -> float:
        """
        float: nothing nearer casts; point and spot lights.
        """
    @property
    def radius(self) -> float:
        """
        float: of the filter, texels.
        """
    @property
    def size(self) -> int:
        """
        int: texels a side of the map.
        """

class Light:
    """
    Base of the lights.

    A light may be in several scenes; a change shows in all of them.
    """
    def __reduce__(self) -> tuple: ...
    @property
    def color(self) -> numpy.typing.NDArray[numpy.float32]:
        """
        ndarray (3,) float32: linear RGB, read-only.
        """
    @color.setter
    def color(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def intensity(self) -> float:
        """
        float: times color.
        """
    @intensity.setter
    def intensity(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PointLight(Light):
    """
    Light from one point, the same in all directions.

    Parameters
    ----------
    position : array_like (3,)
        World space.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which say sRGB (IEC 61966-2-1) and are
        decoded to linear. Light has no alpha: "transparent" raises ValueError.
    intensity : float
        Times color, not negative.
    decay : float
        The light falls with distance**-decay: 0 not at all, 2 as physics has it. Not negative.
    shadow : Shadow, bool or None
        None: it shines through everything. True: ``Shadow()``.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> lamp = cc.PointLight(position=(3, 4, 3))
    >>> lamp.intensity = 2
    >>> lamp
    PointLight(position=(3, 4, 3), color=(1, 1, 1), intensity=2, decay=0)
    """
    def __init__(
        self: PointLight,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        *,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        decay: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shadow: Shadow | bool | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: PointLight) -> str: ...
    @property
    def decay(self) -> float:
        """
        float: the light falls with distance**-decay.
        """
    @decay.setter
    def decay(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: world space, read-only.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None shines through everything; True sets ``Shadow()``.
        """
    @shadow.setter
    def shadow(self, arg1: Shadow | bool | None) -> None: ...

class SpotLight(Light):
    """
    Light from one point into a cone, as three.js and glTF have it.

    Parameters
    ----------
    position : array_like (3,)
        World space.
    direction : array_like (3,)
        Of the cone's axis, the way the light travels, in world space, of any length but 0; kept
        normalised. Straight down by default.
    angle : float
        From the axis to the cone's edge, degrees: above 0, below 90. Beyond it there is no light.
    penumbra : float
        Share of the angle, from the edge inwards, over which the light fades: 0 is a sharp edge, at 1
        it fades from the axis on. Between the cosines of the two angles it is smoothstep.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which say sRGB (IEC 61966-2-1) and are
        decoded to linear. Light has no alpha: "transparent" raises ValueError.
    intensity : float
        Times color, not negative.
    decay : float
        The light falls with distance**-decay: 0 not at all, 2 as physics has it. Not negative.
    shadow : Shadow, bool or None
        None: it shines through everything. True: ``Shadow()``.

    Raises
    ------
    ValueError
        For a direction of no length, or a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.SpotLight(position=(0, 3, 0), angle=20, penumbra=.5)
    SpotLight(position=(0, 3, 0), direction=(0, -1, 0), angle=20, penumbra=0.5, color=(1, 1, 1), intensity=1, decay=0)
    """
    def __init__(
        self: SpotLight,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        direction: numpy.typing.ArrayLike = (0, -1, 0),
        *,
        angle: typing.SupportsFloat | typing.SupportsIndex = 30.0,
        penumbra: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        decay: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        shadow: Shadow | bool | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: SpotLight) -> str: ...
    @property
    def angle(self) -> float:
        """
        float: from the axis to the cone's edge, degrees.
        """
    @angle.setter
    def angle(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def decay(self) -> float:
        """
        float: the light falls with distance**-decay.
        """
    @decay.setter
    def decay(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def direction(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: the way the light travels, unit length, read-only.
        """
    @direction.setter
    def direction(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def penumbra(self) -> float:
        """
        float: share of the angle over which the light fades.
        """
    @penumbra.setter
    def penumbra(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: world space, read-only.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None shines through everything; True sets ``Shadow()``.
        """
    @shadow.setter
    def shadow(self, arg1: Shadow | bool | None) -> None: ...

class DirectionalLight(Light):
    """
    Light from far away, such as the sun's.

    Parameters
    ----------
    direction : array_like (3,)
        The way the light travels, in world space, of any length but 0; kept normalised. Straight down
        by default.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which say sRGB (IEC 61966-2-1) and are
        decoded to linear. Light has no alpha: "transparent" raises ValueError.
    intensity : float
        Times color, not negative.
    shadow : Shadow, bool or None
        None: it shines through everything. True: ``Shadow()``.

    Raises
    ------
    ValueError
        For a direction of no length, or a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.DirectionalLight(direction=(0, 0, -2)).direction.tolist()
    [0.0, 0.0, -1.0]
    """
    def __init__(
        self: DirectionalLight,
        direction: numpy.typing.ArrayLike = (0, -1, 0),
        *,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        shadow: Shadow | bool | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: DirectionalLight) -> str: ...
    @property
    def direction(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: the way the light travels, unit length, read-only.
        """
    @direction.setter
    def direction(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None shines through everything; True sets ``Shadow()``.
        """
    @shadow.setter
    def shadow(self, arg1: Shadow | bool | None) -> None: ...

class AmbientLight(Light):
    """
    Light that comes from everywhere alike.

    Parameters
    ----------
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which say sRGB (IEC 61966-2-1) and are
        decoded to linear. Light has no alpha: "transparent" raises ValueError.
    intensity : float
        Times color, not negative.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.AmbientLight(intensity=.5)
    AmbientLight(color=(1, 1, 1), intensity=0.5)
    """
    def __init__(
        self: AmbientLight,
        *,
        color: numpy.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: AmbientLight) -> str: ...

class Camera:
    """
    A camera given by its matrices.

    Matrices act on column vectors and are written in reading order, so that ``view @ point`` works.
    World and camera are right-handed, +Y up, the camera looking along -Z; clip space is OpenGL's, from
    -1 to 1 in x, y and z.

    Parameters
    ----------
    view : array_like (4, 4)
        World to camera; last row (0, 0, 0, 1).
    projection : array_like (4, 4)
        Camera to clip space, for the shape of picture that is asked for.

    Raises
    ------
    ValueError
        For a matrix that is singular or not finite, or another shape.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> lens = cc.PerspectiveCamera(fov=90).projection(aspect=2)
    >>> camera = cc.Camera(view=np.eye(4), projection=lens)
    >>> float(camera.projection()[0, 0])
    0.5
    """
    def __init__(
        self: Camera, *, view: numpy.typing.ArrayLike, projection: numpy.typing.ArrayLike
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Camera) -> str: ...
    def projection(
        self: Camera, aspect: typing.SupportsFloat | typing.SupportsIndex = 1.0
    ) -> numpy.typing.NDArray[numpy.float64]:
        """
        Camera to clip space.

        Parameters
        ----------
        aspect : float
            Width of the picture divided by its height. A camera given by its matrices ignores it.

        Returns
        -------
        ndarray (4, 4) float64
            Read-only.

        Raises
        ------
        ValueError
            For an aspect that is not above 0.
        """
    @property
    def view(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """
    @view.setter
    def view(self, arg1: numpy.typing.ArrayLike) -> None: ...

class PerspectiveCamera(Camera):
    """
    A camera with a vanishing point.

    Parameters
    ----------
    fov : float
        Vertical field of view in degrees, above 0 and below 180.
    position : array_like (3,)
        World space.
    target : array_like (3,), optional
        A point it looks at. None: straight ahead along -Z, wherever it stands.
    up : array_like (3,)
        What is up in the picture; not along the line of sight.
    near, far : float
        Depths in world units between which things are seen: 0 < near < far.
    shift : array_like (2,)
        How far the window that it looks through lies right of and above its axis, in heights of the
        picture: an off-axis frustum. With (0, .5) the horizon is at the lower edge, and verticals stay
        vertical, as with an architect's lens.

    Raises
    ------
    ValueError
        For a target that is the position, an up along the line of sight, near >= far, or a number out
        of its range or not finite.

    Notes
    -----
    The matrices are those of gluLookAt and gluPerspective.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(fov=70, position=(0, 1, 5), target=(0, 0, 0))
    >>> camera.position = (0, 1, 8)
    >>> camera.target.tolist()
    [0.0, 0.0, 0.0]
    """
    def __init__(
        self: PerspectiveCamera,
        *,
        fov: typing.SupportsFloat | typing.SupportsIndex = 60.0,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        target: numpy.typing.ArrayLike | None = None,
        up: numpy.typing.ArrayLike = (0, 1, 0),
        near: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        shift: numpy.typing.ArrayLike = (0, 0),
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: PerspectiveCamera) -> str: ...
    def look(self, direction: numpy.typing.ArrayLike) -> None:
        """
        Turn the view along a direction of the world.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        direction : array_like (3,)
            World space, of any length but 0, not along `up`.

        Raises
        ------
        ValueError
            For a direction that is not three finite numbers, has no length, or lies along `up`.
        TypeError
            For a camera given by its matrices, or something that is no vector.

        Notes
        -----
        The target goes to the position plus the direction, at the distance it had; at 1 if there was none.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(1, 0, 0))
        >>> camera.look((0, 0, 2))
        >>> camera.target.tolist()
        [1.0, 0.0, 1.0]
        """
    def orbit(self, *, yaw: float = 0.0, pitch: float = 0.0) -> None:
        """
        Move round the target, as if the scene were turned in the hand.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            One that has a target.
        yaw : float
            Degrees round `up`. Positive turns what is seen to the right, as a drag to the right does: the camera goes to
            its left.
        pitch : float
            Degrees of elevation. Positive tips what is seen towards the viewer, as a drag downwards does: the camera
            rises. It stops 1 degree (`POLE_MARGIN`) before straight above and straight below the target.

        Raises
        ------
        ValueError
            For a camera without a target, or a number that is not finite.
        TypeError
            As `yaw`.

        Notes
        -----
        Target and distance stay.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
        >>> camera.orbit(yaw=30)
        >>> camera.position.round(3).tolist()
        [-2.0, 0.0, 3.464]
        """
    def pitch(self, degrees: float) -> None:
        """
        Turn the view up, round the camera's right.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        degrees : float
            Positive looks up. The view stops 1 degree (`POLE_MARGIN`) before straight up and straight down; one that
            is nearer already goes no further.

        Raises
        ------
        ValueError, TypeError
            As `yaw`.

        Notes
        -----
        The position stays, and so does the target's distance; without a target one is set at distance 1.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 1, 0))
        >>> camera.pitch(30)
        >>> camera.target.round(3).tolist()
        [0.0, 1.5, -0.866]
        """
    def strafe(self, distance: float) -> None:
        """
        Move to the right, target and all.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        distance : float
            World units; negative moves left.

        Raises
        ------
        ValueError, TypeError
            As `walk`.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera()
        >>> camera.strafe(.5)
        >>> camera.position.tolist()
        [0.5, 0.0, 0.0]
        """
    def walk(self, distance: float) -> None:
        """
        Move along the view direction, target and all.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        distance : float
            World units; negative walks backwards.

        Raises
        ------
        ValueError
            For a number that is not finite, or a step so long that position and target cannot be told apart.
        TypeError
            As `yaw`.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 0, 5), target=(0, 0, 0))
        >>> camera.walk(2)
        >>> camera.position.tolist(), camera.target.tolist()
        ([0.0, 0.0, 3.0], [0.0, 0.0, -2.0])
        """
    def yaw(self, degrees: float) -> None:
        """
        Turn the view to the left, round the camera's `up` through its position.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        degrees : float
            Positive turns left: counter-clockwise seen from above.

        Raises
        ------
        ValueError
            For a number that is not finite.
        TypeError
            For a camera given by its matrices, or something that is no number.

        Notes
        -----
        The position stays, and so does the target's distance; without a target one is set at distance 1.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 1, 0), target=(0, 1, -2))
        >>> camera.yaw(30)
        >>> camera.target.round(3).tolist()
        [-1.0, 1.0, -1.732]
        """
    @property
    def far(self) -> float:
        """
        float: nothing farther is seen; world units.
        """
    @far.setter
    def far(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fov(self) -> float:
        """
        float: vertical, in degrees.
        """
    @fov.setter
    def fov(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def near(self) -> float:
        """
        float: nothing nearer is seen; world units.
        """
    @near.setter
    def near(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: world space, read-only. Setting it leaves the target.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def shift(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (2,) float64: of the window right of and above the axis, in heights of the picture, read-only.
        """
    @shift.setter
    def shift(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        ndarray (3,) float64 or None: a point it looks at, read-only; None is along -Z.
        """
    @target.setter
    def target(self, arg1: numpy.typing.ArrayLike | None) -> None: ...
    @property
    def up(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: what is up in the picture, read-only.
        """
    @up.setter
    def up(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def view(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """

class OrthographicCamera(Camera):
    """
    A camera of parallel rays.

    The incident direction of mirrors and highlights is the view direction; `distance` counts from the
    near plane.

    Parameters
    ----------
    height : float
        World units from the bottom to the top of the picture, above 0.
    position : array_like (3,)
        World space.
    target : array_like (3,), optional
        A point it looks at. None: straight ahead along -Z, wherever it stands.
    up : array_like (3,)
        What is up in the picture; not along the line of sight.
    near, far : float
        Depths in world units between which things are seen: near < far.

    Raises
    ------
    ValueError
        For a target that is the position, an up along the line of sight, near >= far, or a number out
        of its range or not finite.

    Notes
    -----
    The matrices are those of gluLookAt and glOrtho.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.OrthographicCamera(height=4).projection(aspect=2)[:2, :2].tolist()
    [[0.25, 0.0], [0.0, 0.5]]
    """
    def __init__(
        self: OrthographicCamera,
        *,
        height: typing.SupportsFloat | typing.SupportsIndex = 2.0,
        position: numpy.typing.ArrayLike = (0, 0, 0),
        target: numpy.typing.ArrayLike | None = None,
        up: numpy.typing.ArrayLike = (0, 1, 0),
        near: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: OrthographicCamera) -> str: ...
    def look(self, direction: numpy.typing.ArrayLike) -> None:
        """
        Turn the view along a direction of the world.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        direction : array_like (3,)
            World space, of any length but 0, not along `up`.

        Raises
        ------
        ValueError
            For a direction that is not three finite numbers, has no length, or lies along `up`.
        TypeError
            For a camera given by its matrices, or something that is no vector.

        Notes
        -----
        The target goes to the position plus the direction, at the distance it had; at 1 if there was none.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(1, 0, 0))
        >>> camera.look((0, 0, 2))
        >>> camera.target.tolist()
        [1.0, 0.0, 1.0]
        """
    def orbit(self, *, yaw: float = 0.0, pitch: float = 0.0) -> None:
        """
        Move round the target, as if the scene were turned in the hand.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            One that has a target.
        yaw : float
            Degrees round `up`. Positive turns what is seen to the right, as a drag to the right does: the camera goes to
            its left.
        pitch : float
            Degrees of elevation. Positive tips what is seen towards the viewer, as a drag downwards does: the camera
            rises. It stops 1 degree (`POLE_MARGIN`) before straight above and straight below the target.

        Raises
        ------
        ValueError
            For a camera without a target, or a number that is not finite.
        TypeError
            As `yaw`.

        Notes
        -----
        Target and distance stay.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
        >>> camera.orbit(yaw=30)
        >>> camera.position.round(3).tolist()
        [-2.0, 0.0, 3.464]
        """
    def pitch(self, degrees: float) -> None:
        """
        Turn the view up, round the camera's right.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        degrees : float
            Positive looks up. The view stops 1 degree (`POLE_MARGIN`) before straight up and straight down; one that
            is nearer already goes no further.

        Raises
        ------
        ValueError, TypeError
            As `yaw`.

        Notes
        -----
        The position stays, and so does the target's distance; without a target one is set at distance 1.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 1, 0))
        >>> camera.pitch(30)
        >>> camera.target.round(3).tolist()
        [0.0, 1.5, -0.866]
        """
    def strafe(self, distance: float) -> None:
        """
        Move to the right, target and all.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        distance : float
            World units; negative moves left.

        Raises
        ------
        ValueError, TypeError
            As `walk`.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera()
        >>> camera.strafe(.5)
        >>> camera.position.tolist()
        [0.5, 0.0, 0.0]
        """
    def walk(self, distance: float) -> None:
        """
        Move along the view direction, target and all.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        distance : float
            World units; negative walks backwards.

        Raises
        ------
        ValueError
            For a number that is not finite, or a step so long that position and target cannot be told apart.
        TypeError
            As `yaw`.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 0, 5), target=(0, 0, 0))
        >>> camera.walk(2)
        >>> camera.position.tolist(), camera.target.tolist()
        ([0.0, 0.0, 3.0], [0.0, 0.0, -2.0])
        """
    def yaw(self, degrees: float) -> None:
        """
        Turn the view to the left, round the camera's `up` through its position.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
        degrees : float
            Positive turns left: counter-clockwise seen from above.

        Raises
        ------
        ValueError
            For a number that is not finite.
        TypeError
            For a camera given by its matrices, or something that is no number.

        Notes
        -----
        The position stays, and so does the target's distance; without a target one is set at distance 1.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 1, 0), target=(0, 1, -2))
        >>> camera.yaw(30)
        >>> camera.target.round(3).tolist()
        [-1.0, 1.0, -1.732]
        """
    @property
    def far(self) -> float:
        """
        float: nothing farther is seen; world units.
        """
    @far.setter
    def far(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def height(self) -> float:
        """
        float: world units from the bottom to the top of the picture.
        """
    @height.setter
    def height(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def near(self) -> float:
        """
        float: nothing nearer is seen; world units.
        """
    @near.setter
    def near(self, arg1: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: world space, read-only. Setting it leaves the target.
        """
    @position.setter
    def position(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def target(self) -> numpy.typing.NDArray[numpy.float64] | None:
        """
        ndarray (3,) float64 or None: a point it looks at, read-only; None is along -Z.
        """
    @target.setter
    def target(self, arg1: numpy.typing.ArrayLike | None) -> None: ...
    @property
    def up(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (3,) float64: what is up in the picture, read-only.
        """
    @up.setter
    def up(self, arg1: numpy.typing.ArrayLike) -> None: ...
    @property
    def view(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """

class StereoCamera:
    """
    Two eyes, whose pictures are drawn in one call and combined.

    ``renderer.render(scene, stereo_camera, size)`` gives one Frame of that size. Each eye's picture is, bit
    for bit, the one that its camera gives alone, with the aspect of its part; tone mapping and encoding come
    before they are combined. Only the eyes whose picture changed are drawn again.

    Parameters
    ----------
    left, right : Camera
        Any two; changed at any time, they show it in the next picture.
    layout : {"anaglyph", "side_by_side", "top_bottom"}
        "anaglyph", for red-cyan glasses: red from the left eye, green and blue from the right, alpha the
        greater; there are no outputs. "side_by_side": the left eye in the left half, of an even width;
        "top_bottom": the left eye in the upper half, of an even height; outputs are combined alike.

    Raises
    ------
    TypeError
        For what is no Camera.
    ValueError
        For another layout.

    Examples
    --------
    >>> import cubecam as cc
    >>> camera = cc.PerspectiveCamera(fov=60, position=(0, 1, 5), target=(0, 0, 0))
    >>> eyes = cc.StereoCamera.off_axis(camera, separation=.1, convergence=5, layout="side_by_side")
    >>> eyes.left.position.round(9).tolist(), eyes.right.position.round(9).tolist()
    ([-0.05, 1.0, 5.0], [0.05, 1.0, 5.0])
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(cc.Scene(background=(1, 1, 1)), eyes, size=(8, 4))
    >>> frame.size
    (8, 4)
    """
    @staticmethod
    def off_axis(
        camera: Camera,
        *,
        separation: typing.SupportsFloat | typing.SupportsIndex = 0.065,
        convergence: typing.SupportsFloat | typing.SupportsIndex | None = None,
        layout: str = "anaglyph",
    ) -> StereoCamera:
        """
        Eyes beside a camera, with parallel axes.

        They stand half of `separation` to the left and right of it, along its own right axis, and look the same
        way. Without `convergence` what is infinitely far has no parallax, and all else stands before the screen.

        Parameters
        ----------
        camera : Camera
            The middle of the two; it is copied.
        separation : float
            Distance of the eyes, world units, not negative. 0.065 is a person's, in metres.
        convergence : float, optional
            Distance along the camera's axis, world units, at which points have the same place in both pictures:
            farther ones lie behind the screen, nearer ones before it. The frusta are sheared for that, and not
            turned, so that no vertical parallax arises. Not for cameras of parallel rays.
        layout : {"anaglyph", "side_by_side", "top_bottom"}
            See the class.

        Returns
        -------
        StereoCamera

        Raises
        ------
        ValueError
            For a number out of its range or not finite, or a convergence of parallel rays.

        Notes
        -----
        P. Bourke, "Calculating Stereo Pairs", 1999. At depth z a point's places differ by
        ``separation * (1 / convergence - 1 / z) * f / 2`` widths of the picture to the right for the right eye, f
        being ``camera.projection(aspect)[0, 0]``.
        """
    @staticmethod
    def toe_in(
        camera: Camera,
        *,
        degrees: typing.SupportsFloat | typing.SupportsIndex = 4.0,
        layout: str = "anaglyph",
    ) -> StereoCamera:
        """
        Eyes on a circle round a camera's target, both looking at it.

        The view is turned by half of `degrees` to the left and to the right, about the axis through the target
        that is up in the camera's picture. Simple, and with vertical parallax towards the corners; `off_axis` has
        none.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            The middle of the two, with a target; it is copied.
        degrees : float
            Angle between the two eyes as seen from the target: from 0 to below 180.
        layout : {"anaglyph", "side_by_side", "top_bottom"}
            See the class.

        Returns
        -------
        StereoCamera

        Raises
        ------
        ValueError
            For a camera without a target, or an angle out of its range.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 0, 2), target=(0, 0, 0))
        >>> cc.StereoCamera.toe_in(camera, degrees=90).right.position.round(3).tolist()
        [1.414, 0.0, 1.414]
        """
    def __init__(
        self: StereoCamera, left: Camera, right: Camera, *, layout: str = "anaglyph"
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: StereoCamera) -> str: ...
    @property
    def layout(self) -> str:
        """
        str: "anaglyph", "side_by_side" or "top_bottom".
        """
    @layout.setter
    def layout(self, arg1: str) -> None: ...
    @property
    def left(self) -> Camera:
        """
        Camera: of the left eye.
        """
    @left.setter
    def left(self, arg1: Camera) -> None: ...
    @property
    def right(self) -> Camera:
        """
        Camera: of the right eye.
        """
    @right.setter
    def right(self, arg1: Camera) -> None: ...

class Stats:
    """
    What a renderer's last call drew, skipped and took.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Stats) -> str: ...
    @property
    def draw_calls(self) -> int:
        """
        int
        """
    @property
    def milliseconds(self) -> float:
        """
        float: the whole call, reading back included.
        """
    @property
    def pictures_not_kept(self) -> int:
        """
        int: frames and captures whose buffers take more than the renderer's ``cache_bytes``, so that the next call must draw them again.
        """
    @property
    def probes_updated(self) -> int:
        """
        int: probes of which at least one face was drawn.
        """
    @property
    def shadow_views_drawn(self) -> int:
        """
        int: layers of shadow maps drawn: one for each directional and spot light, six for a point light.
        """
    @property
    def textures_updated(self) -> int:
        """
        int: render textures that were drawn.
        """
    @property
    def triangles(self) -> int:
        """
        int: sent to the GPU, each view counted.
        """
    @property
    def views_drawn(self) -> int:
        """
        int: pictures drawn: frames, faces of captures, faces of probes, textures.
        """
    @property
    def views_skipped(self) -> int:
        """
        int: pictures that were still true and not drawn again.
        """

class Limits:
    """
    What the driver allows at most.
    """
    def __reduce__(self) -> tuple: ...
    @property
    def max_array_texture_layers(self) -> int:
        """
        int
        """
    @property
    def max_color_attachments(self) -> int:
        """
        int
        """
    @property
    def max_cube_map_texture_size(self) -> int:
        """
        int: pixels along an edge of a face.
        """
    @property
    def max_samples(self) -> int:
        """
        int: of multisampling.
        """
    @property
    def max_texture_size(self) -> int:
        """
        int: pixels along a side of a frame.
        """

class RendererInfo:
    """
    What a renderer runs on.
    """
    def __reduce__(self) -> tuple: ...
    def __repr__(self: RendererInfo) -> str: ...
    @property
    def device(self) -> Device:
        """
        Device: the one that was chosen.
        """
    @property
    def egl_version(self) -> str:
        """
        str: EGL_VERSION.
        """
    @property
    def glsl_version(self) -> str:
        """
        str: GL_SHADING_LANGUAGE_VERSION.
        """
    @property
    def layered(self) -> bool:
        """
        bool: whether one draw call serves all faces of a cube.
        """
    @property
    def limits(self) -> Limits:
        """
        Limits
        """
    @property
    def platform(self) -> str:
        """
        str: "device", "surfaceless" or "default".
        """
    @property
    def renderer(self) -> str:
        """
        str: GL_RENDERER.
        """
    @property
    def software(self) -> bool:
        """
        bool: whether the CPU draws.
        """
    @property
    def vendor(self) -> str:
        """
        str: GL_VENDOR.
        """
    @property
    def version(self) -> str:
        """
        str: GL_VERSION.
        """

class Frame:
    """
    A rendered picture: arrays with row 0 on top, each the caller's own.

    What was not requested by ``outputs=`` is None. Only opaque nodes write the outputs; `depth` and
    `stencil` are what those buffers hold in the end.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 0, 0))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, cc.PerspectiveCamera(), size=(4, 2))
    >>> frame.color.shape, frame.color[0, 0].tolist()
    ((2, 4, 4), [255, 0, 0, 255])
    """
    def __reduce__(self: Frame) -> tuple: ...
    def __repr__(self: Frame) -> str: ...
    def _repr_png_(self) -> bytes | None:
        """
        Give the picture that Jupyter shows: the colour, opaque, tone-mapped if the numbers are floats; None without.
        """
    @property
    def color(self) -> typing.Any:
        """
        ndarray (H, W, 4): uint8, float16 or float32 as ``format`` said; linear unless encoded. None with ``format=None``.
        """
    @property
    def depth(self) -> typing.Any:
        """
        ndarray (H, W) float32: OpenGL's window-space z with the precision of ``depth_format``, 0 at the near plane, 1 at the far plane and in the background.
        """
    @property
    def distance(self) -> typing.Any:
        """
        ndarray (H, W) float32: length of the ray, world units; +inf background. In an orthographic picture it counts from the near plane.
        """
    @property
    def id(self) -> typing.Any:
        """
        ndarray (H, W) int32: ``Node.id`` of the visible node; 0 background.
        """
    @property
    def normal(self) -> typing.Any:
        """
        ndarray (H, W, 3) float32: world shading normal, unit length, towards the viewer; 0 background.
        """
    @property
    def outputs(self) -> dict[str, numpy.ndarray]:
        """
        dict of str to ndarray: the outputs that were requested, by name.

        Beside the attributes' arrays it holds those that a ``ShaderMaterial`` declares, `out vec4 heat;`,
        float32 (H, W, 4), with fewer channels for vec3 and vec2 and (H, W) for float; 0 where the node that
        is seen does not write them.
        """
    @property
    def position(self) -> typing.Any:
        """
        ndarray (H, W, 3) float32: world position; NaN background.
        """
    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height), pixels.
        """
    @property
    def stencil(self) -> typing.Any:
        """
        ndarray (H, W) uint8: the stencil buffer after all drawing; 0 background.
        """
    @property
    def z(self) -> typing.Any:
        """
        ndarray (H, W) float32: distance along the camera's axis, or a face's, world units; +inf background.
        """

class Renderer:
    """
    Draws scenes without a screen: frames, cubemaps and the probes that mirrors need.

    A renderer owns an OpenGL 4.5 context on EGL: a GPU if there is one, else Mesa's software rasteriser. Any thread may
    use it; calls on one renderer follow each other, several renderers work in parallel. Use it in a ``with`` block, or
    call :meth:`close`.

    Parameters
    ----------
    device : str, int, Device or None
        "auto" (the environment variable CUBECAM_DEVICE if set, else a GPU, else software), "gpu", "software", an index
        into :func:`devices`, one of them, part of a device's name, or a UUID. None means "auto".
    layered : bool or None
        Draw all views of a mesh in one call (True), one view after another (False), or as is faster here (None). Both give
        the same bytes on llvmpipe.
    cache_bytes : int
        GPU memory kept for targets of frames and captures, so that an unchanged picture is not drawn again. At most as
        much main memory is kept of results that were let go, for the next ones of their size; what eight calls found no
        use for is freed, and all of it by :meth:`close`. Default 256 MiB; ``stats.pictures_not_kept`` tells whether a
        picture is larger than that.
    debug : bool
        Ask for a debug context, whose errors tell more.

    Raises
    ------
    ContextError
        No context can be had. The message tells each device that was tried, why it failed, and what to install.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(0.1, 0.2, 0.3))
    >>> ball = scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color=(1, 1, 0)))
    >>> camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 3), target=(0, 0, 0))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, camera, size=(64, 48), outputs=("distance",))
    ...     cube = renderer.capture(scene, position=(0, 0, 2), size=32)
    >>> frame.color.shape, round(float(frame.distance.min()), 1)
    ((48, 64, 4), 2.5)
    >>> cube.faces.shape
    (6, 32, 32, 4)
    """
    def __enter__(self: Renderer) -> Renderer: ...
    def __exit__(self: Renderer, *args) -> None: ...
    def __init__(
        self: Renderer,
        *,
        device: typing.Any = "auto",
        layered: typing.Any = None,
        cache_bytes: typing.SupportsInt | typing.SupportsIndex = 268435456,
        debug: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple: ...
    def __repr__(self: Renderer) -> str: ...
    def capture(
        self: Renderer,
        scene: Scene,
        position: typing.Any = (0.0, 0.0, 0.0),
        size: typing.Any = 256,
        *,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        exclude: typing.Any = (),
        outputs: typing.Any = (),
        format: str | None = "rgba32f",
        samples: typing.Any = 1,
        eye: typing.Any = None,
        depth_format: str | None = "depth_component32f",
        depth_order: str = "nearest",
    ) -> CubeMap:
        """
        Draw what surrounds a point into a cubemap.

        Parameters
        ----------
        scene : Scene
        position : array_like (3,)
            World position. The six views look along the world's axes, 90 degrees each.
        size : int
            Pixels along an edge of a face.
        near, far : float
            Clip distances along each face's axis, world units, 0 < near < far.
        exclude : sequence of Node
            Left out, with all below them.
        outputs : sequence of str
            Besides ``faces``: any of "distance", "z", "normal", "position", "id", "depth", "stencil", and of the outputs that
            the GLSL of a :class:`ShaderMaterial` of a visible node declares.
        format : str
            "rgba32f" (float32), "rgba16f" (float16), "rgba8" (uint8, clamped) or "rgb565" (uint8).
        samples : int
            Multisampling of colour, see :meth:`render`.
        eye : array_like (3,) or None
            From where highlights and mirrors are seen; None: from ``position``.
        depth_format : str or None
            The depth and stencil buffer, see :meth:`render`.
        depth_order : str
            "nearest", or "farthest": colour and outputs are those of the farthest opaque surface along each ray between
            ``near`` and ``far``, the background where there is none. Single-sided materials show their front faces alone, so
            the far side of a body counts with ``double_sided=True``. Of translucent nodes shows what is farther still. It
            wants a depth buffer.

        Returns
        -------
        CubeMap
            ``faces`` (6, size, size, 4) in the order +X -X +Y -Y +Z -Z, laid out as OpenGL does (section 8.13 of the 4.6
            specification): ``texture(cube, world_direction)`` needs no flip.

        Raises
        ------
        ValueError, TypeError, ContextError
            As :meth:`render`; also for nodes of another scene.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> floor = scene.add(cc.Mesh.plane(10, 10), cc.BasicMaterial(color=(1, 0, 0)), position=(0, -1, 0))
        >>> with cc.Renderer() as renderer:
        ...     cube = renderer.capture(scene, size=16, outputs=("distance", "id"))
        >>> cube.sample((0, -1, 0)).tolist(), int(cube.id[3, 8, 8])
        ([1.0, 0.0, 0.0, 1.0], 1)
        """
    def close(self: Renderer) -> None:
        """
        Free the context and all it holds. Calls after that raise ContextError; closing twice does nothing.
        """
    def read_probe(self: Renderer, probe: Probe) -> CubeMap:
        """
        What a probe holds now, in the probe's format.

        Parameters
        ----------
        probe : Probe
            One that a picture of this renderer has shown, or that :meth:`update_probes` has drawn.

        Returns
        -------
        CubeMap
            A copy; uint8, float16 or float32, faces (6, size, size, 4).

        Raises
        ------
        ValueError
            If this renderer has not drawn it yet.
        ContextError
            After :meth:`close`, or in a forked process.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene(background="teal")
        >>> ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial())
        >>> ball.environment = cc.Probe(size=8)
        >>> with cc.Renderer() as renderer:
        ...     renderer.update_probes(scene)
        ...     held = renderer.read_probe(ball.environment)
        >>> held.faces.shape, held.dtype.name
        ((6, 8, 8, 4), 'float16')
        """
    def read_texture(self: Renderer, render_texture: RenderTexture) -> numpy.ndarray:
        """
        What a render texture holds now, in its format.

        Parameters
        ----------
        render_texture : RenderTexture
            One that a picture of this renderer has shown.

        Returns
        -------
        ndarray (H, W, 4)
            uint8, float16 or float32, row 0 on top; the caller's own.

        Raises
        ------
        ValueError
            If this renderer has not drawn it yet.
        """
    def render(
        self: Renderer,
        scene: Scene,
        camera: Camera | StereoCamera,
        size: typing.Any,
        *,
        outputs: typing.Any = (),
        format: str | None = "rgba8",
        samples: typing.Any = 1,
        tonemap: str | None = None,
        encode: str | None = None,
        effects: typing.Any = (),
        depth_format: str | None = "depth_component32f",
    ) -> Frame:
        """
        Draw a picture, with every probe its mirrors need brought up to date first.

        A picture that would come out as the last one of this size and format did is not drawn again.

        Parameters
        ----------
        scene : Scene
        camera : Camera or StereoCamera
        size : (int, int)
            (width, height), pixels.
        outputs : sequence of str
            Besides colour: any of "distance", "z", "normal", "position", "id", of the outputs that the GLSL of a
            :class:`ShaderMaterial` of a visible node declares, and of "depth" and "stencil", what those
            buffers hold in the end.
        format : str or None
            "rgba8" (uint8, clamped to 0..1), "rgba16f" (float16), "rgba32f" (float32) or "rgb565" (5, 6 and 5 bits, read as
            uint8 of 255; alpha 255). None: no colour buffer, only the outputs are drawn.
        samples : int
            Multisampling of colour: 1 for none, at most ``info.limits.max_samples``. The outputs are those of samples=1.
        tonemap : str or None
            "reinhard" (Reinhard et al. 2002), "aces" (Narkowicz's fit, 2015) or "neutral" (Khronos PBR Neutral, 2024),
            after resolving. None: values stay as they are.
        encode : str or None
            "srgb" (IEC 61966-2-1) or None: linear.
        effects : sequence of ImageEffect
            Passes over the colour, one after the other, after resolving and before the tone curve.
        depth_format : str or None
            The depth and stencil buffer, by OpenGL's names: "depth_component32f", "depth_component24", "depth_component16",
            "depth24_stencil8", "depth32f_stencil8", "stencil_index8" (no depth) or None (neither). Without depth nothing is
            hidden: nodes are painted one over the other, in order of ``render_order``, then id, and there are no outputs but
            "stencil".

        Returns
        -------
        Frame
            Arrays of shape (height, width, ...), row 0 on top.

        Raises
        ------
        ValueError
            For an unknown name, a size or sample count beyond the driver's limits, formats that the driver cannot draw into,
            outputs that ``depth_format`` does not allow, tone mapping or effects of no colour, or an impossible camera.
        ContextError
            After :meth:`close`, or in a forked process.

        Examples
        --------
        >>> import cubecam as cc
        >>> with cc.Renderer() as renderer:
        ...     frame = renderer.render(cc.Scene(background=(2, 0, 0)), cc.PerspectiveCamera(), size=(1, 1), format="rgba16f")
        >>> frame.color.tolist()
        [[[2.0, 0.0, 0.0, 1.0]]]
        """
    def shadow_map(self: Renderer, scene: Scene, light: Light) -> numpy.ndarray:
        """
        What a light sees of what casts shadows, to look at. It is drawn if it is not up to date.

        Parameters
        ----------
        scene : Scene
        light : Light
            One of the scene's, with a shadow.

        Returns
        -------
        ndarray (L, size, size) float32
            Distances in world units along the axis of each view, +inf where nothing casts. A spot light has one view, from the
            light along its direction. A point light has six, +X -X +Y -Y +Z -Z, laid out as the faces of a capture; they, and
            a spot light's, are a little wider than 90 degrees or the cone: the filter reaches into ``ceil(radius) + 2``
            texels more on each side. A directional light has one view of parallel rays, and distances count from the plane at
            which the bounds of all that casts begin; its outermost texels stay empty. Row 0 of a single view is on top: +Y is
            up there, -Z for light from straight above or below.

        Raises
        ------
        ValueError
            For a light that is not in the scene or has no shadow, or a size beyond the driver's limits.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> sun = scene.add(cc.DirectionalLight(direction=(0, -1, 0), shadow=cc.Shadow(size=32)))
        >>> box = scene.add(cc.Mesh.box(1), position=(0, 3, 0))
        >>> floor = scene.add(cc.Mesh.plane(4, 4))
        >>> with cc.Renderer() as renderer:
        ...     depth = renderer.shadow_map(scene, sun)
        >>> depth.shape, depth[0, 16, 16].round(3).item(), depth[0, 16, 4].round(3).item()
        ((1, 32, 32), 0.0, 3.5)
        """
    def update_probes(self: Renderer, scene: Scene, *, probes: typing.Any = None) -> None:
        """
        Draw probes now, whatever their ``update`` says.

        Parameters
        ----------
        scene : Scene
        probes : Probe, sequence of Probe, or None
            None: all that visible nodes of the scene use.

        Raises
        ------
        ValueError
            For a probe that no visible node uses.
        ContextError
            After :meth:`close`, or in a forked process.
        """
    @property
    def closed(self) -> bool:
        """
        bool
        """
    @property
    def info(self) -> RendererInfo:
        """
        RendererInfo: what was chosen; it stays after close().
        """
    @property
    def stats(self) -> Stats:
        """
        Stats: of the last call.
        """

def _check_pickle(format: typing.Any) -> None:
    """
    For unpickling: raises TypeError for a format that is not this version's.
    """

def _restore_frame(state: tuple) -> Frame:
    """
    For unpickling.
    """

def _shaded_outputs() -> list[str]:
    """
    Names of the outputs that shaders write, for the command line.
    """

def axis_angle(
    axis: numpy.typing.ArrayLike, degrees: typing.SupportsFloat | typing.SupportsIndex
) -> numpy.typing.NDArray[numpy.float64]:
    """
    The quaternion of a turn round an axis.

    Parameters
    ----------
    axis : array_like (3,)
        Of any length but 0. Seen with the axis pointing at the viewer, the turn is counter-clockwise.
    degrees : float
        The angle.

    Returns
    -------
    ndarray (4,) float64
        (w, x, y, z), unit length: cos(degrees / 2), then sin(degrees / 2) times the axis.

    Raises
    ------
    ValueError
        For an axis of no length, or numbers that are not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.axis_angle((0, 2, 0), 180).round(12).tolist()
    [0.0, 0.0, 1.0, 0.0]
    """

def devices() -> list[Device]:
    """
    The devices that can render.

    Nothing is chosen or kept. The first call may start drivers to learn their names. A device whose
    driver does not start is listed too, with the reason in its `problem`.

    Returns
    -------
    list of Device
        In the order that ``Renderer(device=index)`` counts them. Empty if EGL cannot list devices; a
        `Renderer` may still find the surfaceless or the default display.

    Raises
    ------
    ContextError
        If there is no EGL library, or in a process forked after EGL was opened.
    """

__version__: str = "0.2.0"
