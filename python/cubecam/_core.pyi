"""
The compiled part of cubecam. Use `import cubecam`, which exports it.
"""

from __future__ import annotations

import collections.abc
import enum
import os
import pathlib
import typing

import numpy as np
import numpy.typing

import cubecam._futures
import cubecam._shader_inputs
import cubecam.viewer.controls
import cubecam.viewer.cube_view
from cubecam.typing import (
    AlphaMode,
    AnimationPath,
    BlendEquation,
    BlendFactor,
    BlendMode,
    Center,
    Compression,
    ControlsName,
    Convention,
    CubeMode,
    DepthFormat,
    DepthOrder,
    Encode,
    Encoding,
    Engine,
    FaceName,
    Fetches,
    FileLayout,
    FisheyeModel,
    Format,
    InfluenceShape,
    Interpolation,
    Layout,
    MagFilter,
    MinFilter,
    Output,
    Parallax,
    Pixels,
    Place,
    ProbeUpdate,
    Sampling,
    SpecularMode,
    StencilFunc,
    StencilOp,
    StereoLayout,
    Theme,
    Tonemap,
    Wrap,
)

__all__: list[str] = [
    "AmbientLight",
    "Animation",
    "AnimationChannel",
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
    "MorphTarget",
    "Node",
    "OrthographicCamera",
    "PerspectiveCamera",
    "PhongMaterial",
    "PlanarMirror",
    "PointLight",
    "Probe",
    "ProbeBlend",
    "ProbeGrid",
    "RenderTexture",
    "Renderer",
    "Scene",
    "ShaderError",
    "ShaderMaterial",
    "Shadow",
    "Skin",
    "SpotLight",
    "StandardMaterial",
    "Stencil",
    "StereoCamera",
    "Texture",
    "__version__",
    "axis_angle",
    "devices",
    "equirect_to_faces",
    "faces_to_equirect",
]

class Error(RuntimeError):
    """
    Base of cubecam's own exceptions, which report problems of the machine or of files.
    """

class ContextError(Error):
    """
    No OpenGL context can be made, or the context can no longer be used.

    The message names each attempt, why it failed, and what to install.
    """

class ShaderError(Error):
    """
    A shader did not compile or link; the message has the log and the source lines.
    """

class GlError(Error):
    """
    OpenGL reported an error, for example too little memory.
    """

class FileError(Error):
    """
    The contents of a file cannot be read or written.
    """

class ImageError(FileError):
    """
    The contents of an image file cannot be used.
    """

class MeshError(FileError):
    """
    The contents of a mesh file cannot be used.
    """

class Device:
    """
    A device that can render, as `devices` lists it.

    Attributes
    ----------
    index : int
        The place of the device in `devices()`, for ``Renderer(device=index)``; -1 for a context without an EGL
        device.
    name : str
        For example ``"NVIDIA GeForce RTX 4090"`` or ``"llvmpipe (LLVM 15.0.6, 256 bits)"``;
        ``"unknown"`` if the driver does not report it.
    vendor : str
        The maker of the driver, or ``"unknown"``.
    driver : str
        The driver's name or version, for example ``"nvidia"`` or ``"Mesa 22.3.6"``; empty if the driver does
        not report it.
    software : bool
        Whether the device renders on the CPU.
    uuid : str
        32 hexadecimal digits in groups of 8-4-4-4-12; empty if the driver does not report it.
    cuda_index : int or None
        CUDA's number of the same GPU, which may differ from `index`.
    drm_node : str
        For example ``"/dev/dri/renderD128"``; empty if there is none.
    platform : str
        ``"device"``; for a renderer's own device also ``"surfaceless"`` or ``"default"``.
    problem : str
        Why the device cannot be used; empty if it can.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Device) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

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
    An object in a scene: a mesh with a material at some place, or a group of nodes.

    `Scene.add` makes nodes. Attributes may be set at any time; the next picture shows the change. The arrays
    that attributes return are read-only: set the whole array, ``node.position = (1, 2, 3)``.

    The pickle of a node holds its scene, so that ``pickle.dumps((scene, ball))`` keeps ball inside scene. The
    pickle of a removed node holds only the node and the nodes above it.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> arm = scene.add(position=(0, 1, 0), rotation=cc.axis_angle((0, 0, 1), 90))
    >>> hand = scene.add(cc.Mesh.box(.1), position=(2, 0, 0), parent=arm)
    >>> hand.world_matrix[:3, 3].round(12).tolist()
    [0.0, 3.0, 0.0]
    """

    def __reduce__(self: Node) -> tuple[object, ...]: ...
    def __repr__(self: Node) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Node, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def look_at(
        self: Node, target: Node | np.typing.ArrayLike, *, up: np.typing.ArrayLike = (0, 1, 0)
    ) -> None:
        """
        Turn the node round its own position, so that its +Z axis points at a point of the world.

        As in three.js and glTF, an object's front is +Z (and the front of a camera is -Z). The parents may have
        any transforms. Position and scale stay.

        Parameters
        ----------
        target : array_like (3,) or Node
            World space, of a node its origin.
        up : array_like (3,)
            World space: +Y of the node lies in the plane of `up` and the direction, on the side of `up`. An
            `up` along the direction is replaced: by +Y or, if the direction is vertical, by -Z for a target
            above the node and +Z for one below it.

        Raises
        ------
        ValueError
            For a target at the node's position, an `up` of length 0, numbers that are not finite, or a `matrix`
            with a shear.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> head = scene.add(cc.Mesh.box(), position=(0, 1, 0))
        >>> head.look_at((4, 1, 0))
        >>> head.world_matrix[:3, 2].round(12).tolist()
        [1.0, 0.0, 0.0]
        """

    @property
    def cast_shadow(self) -> bool:
        """
        bool: False: neither the node nor any node below it casts shadows. Translucent nodes never do.
        """

    @cast_shadow.setter
    def cast_shadow(self, value: bool) -> None: ...
    @property
    def children(self) -> tuple[Node, ...]:
        """
        tuple of Node: in order of id.
        """

    @property
    def environment(self) -> CubeMap | Probe | ProbeBlend | PlanarMirror | None:
        """
        CubeMap, Probe, ProbeBlend, PlanarMirror or None: what mirrors and glass show. None: the scene's environment.
        """

    @environment.setter
    def environment(self, value: CubeMap | Probe | ProbeBlend | PlanarMirror | None) -> None: ...
    @property
    def id(self) -> int:
        """
        int: from 1 in order of add, never used again in the scene; the output id is 0 where the background is.
        """

    @property
    def in_captures(self) -> bool:
        """
        bool: False: captures, probes and planar mirrors show neither the node nor any node below it. Frames do, and the node still shows its own probe there.
        """

    @in_captures.setter
    def in_captures(self, value: bool) -> None: ...
    @property
    def label(self) -> int:
        """
        int: a number of your own, such as a class or an instance, that the output label shows: any of 32 bits, 0 by default (as the background). Nodes may share a label; nodes below this one have labels of their own.
        """

    @label.setter
    def label(self, value: typing.SupportsIndex) -> None: ...
    @property
    def material(self) -> Material | None:
        """
        Material or None: the surface; on a node with a mesh, None becomes a new PhongMaterial. A material that is set becomes the node's own, also while the scene shows a variant.
        """

    @material.setter
    def material(self, value: Material | None) -> None: ...
    @property
    def matrix(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: node to parent, read-only. Setting it replaces position, rotation and scale; it must not be singular, and its last row is (0, 0, 0, 1).
        """

    @matrix.setter
    def matrix(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def mesh(self) -> Mesh | None:
        """
        Mesh or None: the shape; a node without a mesh is a group.
        """

    @mesh.setter
    def mesh(self, value: Mesh | None) -> None: ...
    @property
    def name(self) -> str:
        """
        str: a name for people; need not be unique.
        """

    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def own_material(self) -> Material | None:
        """
        Material or None: the `material` that the node has while the scene shows no variant.
        """

    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that this one moves with. Setting it keeps position, rotation and scale, which are relative to the parent; a cycle raises ValueError.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: relative to the parent, read-only.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def receive_shadow(self) -> bool:
        """
        bool: whether shadows show on the node's own surface.
        """

    @receive_shadow.setter
    def receive_shadow(self, value: bool) -> None: ...
    @property
    def render_order(self) -> int:
        """
        int: nodes of lower order are drawn first, before any distance counts, among opaque and among translucent nodes; 0 by default. Nodes below this one have an order of their own.
        """

    @render_order.setter
    def render_order(self, value: typing.SupportsIndex) -> None: ...
    @property
    def rotation(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4,) float64: unit quaternion (w, x, y, z), read-only; see `axis_angle`.
        """

    @rotation.setter
    def rotation(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def scale(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: along the node's own axes, read-only; one number sets all three.
        """

    @scale.setter
    def scale(self, value: float | np.typing.ArrayLike) -> None: ...
    @property
    def skin(self) -> Skin | None:
        """
        Skin or None: the joints that move the vertices of the node's mesh.

        The mesh needs `Mesh.joints` and `Mesh.joint_weights`. A picture then shows the mesh where its joints are:
        the place of the node itself, its `matrix` and its parents, has no effect on the mesh, as in glTF (2.0, section
        3.7.3), but has on the nodes below it. While a joint is not in the scene of the node, for example because
        it was removed, or if the mesh has lost its joints, the node is drawn as if it had no skin.

        ValueError is raised for a mesh without joints, for a joint of another scene, and if the mesh names a joint that
        the skin does not have.
        """

    @skin.setter
    def skin(self, value: Skin | None) -> None: ...
    @property
    def variants(self) -> dict[str, Material]:
        """
        dict of str to Material: what `material` becomes while the scene shows a variant of that name.

        The dict is a copy: set it as a whole. A name that is none of `Scene.variants` has no effect.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> scene.variants = ["day", "night"]
        >>> shoe = scene.add(cc.Mesh.box(), cc.PhongMaterial(name="white"))
        >>> shoe.variants = {"night": cc.PhongMaterial(color="navy", name="blue")}
        >>> scene.variant = "night"
        >>> shoe.material.name, shoe.own_material.name
        ('blue', 'white')
        >>> scene.variant = None
        >>> shoe.material.name
        'white'
        """

    @variants.setter
    def variants(self, value: dict[str, Material]) -> None: ...
    @property
    def visible(self) -> bool:
        """
        bool: False: no picture shows the node or any node below it.
        """

    @visible.setter
    def visible(self, value: bool) -> None: ...
    @property
    def weights(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (T,) float32: how much of each of the mesh's `morph_targets` is added; read-only.

        Any numbers are possible; 0 by default. Another mesh with another number of targets makes all 0. ValueError is
        raised for another number of weights than the mesh has targets.
        """

    @weights.setter
    def weights(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def world_bounds(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2, 3) float64: the lowest and the highest corner of the node and all nodes below it, read-only.

        The numbers are world units and exact for the vertices, as `Scene.bounds`. Hidden nodes below the node do
        not count; whether the node itself is visible does not matter. Without a mesh the bounds are those of
        nothing, ``[[inf, inf, inf], [-inf, -inf, -inf]]``.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> cart = scene.add(position=(0, 5, 0))
        >>> box = scene.add(cc.Mesh.box(2), parent=cart, rotation=cc.axis_angle((0, 1, 0), 45))
        >>> cart.world_bounds.round(3).tolist()
        [[-1.414, 4.0, -1.414], [1.414, 6.0, 1.414]]
        """

    @property
    def world_matrix(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: node to world, read-only.
        """

class Probe:
    """
    A cubemap of the scene that renderers keep up to date.

    A probe is only a description, and any number of nodes may use it: assign it to ``node.environment``, or
    to the cubemap of a `BasicMaterial`. Each renderer holds its own contents of the probe
    (``renderer.read_probe(probe)``) and draws a face again only if the face would change. The probe leaves out
    the nodes that use it.

    Parameters
    ----------
    position : array_like (3,)
        World space; with a parent, relative to the parent's position.
    size : int
        Texels along an edge of a face.
    near, far : float
        Clip distances along each face's axis, world units: 0 < near < far.
    format : {"rgba16f", "rgba8", "rgba32f", "rgb565"}
        The format of a texel. rgba8 and rgb565 clip light above 1.
    mipmaps : bool
        True: lookups are trilinear. False: lookups are bilinear.
    samples : int
        Samples of each texel, for smooth edges (MSAA); 1 is none.
    update : {"on_change", "once", "manual"} or int
        "on_change": the probe is drawn whenever its picture would change. "once": it is drawn when a picture
        first needs it. "manual": only ``renderer.update_probes`` draws it. n: it is drawn on every n-th call
        that needs it.
    exclude : iterable of Node
        Nodes that the probe leaves out with all nodes below them, besides the nodes that use it.
    parent : Node, optional
        A node that the probe moves with; the axes of the probe stay those of the world. The probe does not
        keep the node alive.
    faces_per_frame : int
        The greatest number of faces that one call draws, from 1 to 6; of each bounce, if there are several.
    depth_format : str or None
        The format of the depth and stencil buffer, see `Renderer.render`.
    prefilter : bool, optional
        Whether the probe is filtered by roughness, as rough surfaces see it (`CubeMap.prefilter`), whenever a
        face was drawn. None: only if a drawn surface looks it up by roughness. True: always, so that
        ``environment_lod`` in a `ShaderMaterial` finds these levels, too. False: never; rough surfaces then see
        the probe's mipmaps, or the probe as it is.
    parallax : {"none", "box", "sphere", "distance", "layers"}
        How a surface finds what its reflected ray meets, in a cube that was captured elsewhere. "none": as if
        the scene were infinitely far away. "box": the scene lies on the inside of `box`. "sphere": on the inside
        of the ellipsoid that `box` encloses, a sphere if its edges are equal. A ray from outside that misses the proxy sees
        the cube as with "none". "distance": the ray is followed through the distances of what the probe captured. "layers":
        the probe captures the farthest surfaces, too, and the ray finds what the nearest ones hide; such a probe
        costs twice as much to draw.
    box : array_like (2, 3), optional
        The low and the high corner of the proxy, world units; in the space of `proxy_matrix` if there is one. It does not
        move with the parent.
    proxy_matrix : array_like (4, 4), optional
        From the space of `box` to the world, for a room that is turned; its last row is (0, 0, 0, 1). None: the world.
    fetches : {14, 6, 35}
        About how many lookups of distance a ray makes with "distance" and "layers". More find thinner things; the cost of
        a pixel grows with them.
    bounces : int
        How many mirrors of a circle a path meets, from 1 to 16; beyond that it sees the scene's environment, or
        black without one. Probes whose pictures may show each other's users, in view or not, form a circle. With
        1, the other mirrors of the circle show the environment in this one. All probes of a circle have the
        largest ``bounces`` among them, so none is preferred. Time and memory grow with it;
        ``renderer.stats.bounce_changes`` says how much each bounce changed. Without a circle it has no effect.
    influence : array_like (2, 3), optional
        Where the probe counts fully in a `ProbeBlend`: the low and the high corner, world units; in the space of
        `proxy_matrix` if there is one. It does not move with the parent. None: everywhere. It matters to no other use of the probe.
    influence_shape : {"box", "sphere"}
        "sphere": the ellipsoid that `influence` encloses, a sphere if its edges are equal.
    blend_distance : float
        How far outside of `influence` the probe ceases to count, world units, above 0. Over this distance its weight falls from
        1 to 0.

    Notes
    -----
    With a parallax, rough surfaces look the cube up by the roughness whose lobe, seen from the probe, is as wide as the
    surface's own lobe where it meets the scene. Irradiance is that of the probe's place. Surfaces that are blended are in the
    colours, but not in the distances, as in other outputs.

    "box": S. Lagarde and A. Zanuttini, "Local Image-based Lighting with Parallax-corrected Cubemaps", SIGGRAPH 2012. "distance" and
    "layers": after L. Szirmay-Kalos et al., "Approximate Ray-Tracing on the GPU with Distance Impostors", Eurographics 2005; 1 / z is
    interpolated, which is exact on planes.

    Raises
    ------
    ValueError
        For a number out of its range, near >= far, another format, update, parallax or shape, a proxy without a box, a box or
        influence whose low corner is not below its high one, a singular matrix, or a march without depths of 32 bits.
    TypeError
        For a parent or an excluded object that is not a node.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
    >>> ball.environment = cc.Probe(parent=ball, size=128)
    >>> ball.environment.update
    'on_change'

    The walls of a room that reaches from (-5, 0, -4) to (5, 3, 4) are then in their places:

    >>> ball.environment.box = (-5, 0, -4), (5, 3, 4)
    >>> ball.environment.parallax = "box"

    Two mirrors that face each other, with two reflections of each:

    >>> other = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(1.2, 1, 0))
    >>> other.environment = cc.Probe(parent=other, size=128, bounces=2)
    >>> other.environment.bounces
    2
    """

    def __init__(
        self: Probe,
        position: np.typing.ArrayLike = (0, 0, 0),
        *,
        size: typing.SupportsIndex = 256,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        format: Format = "rgba16f",
        mipmaps: bool = False,
        samples: typing.SupportsIndex = 1,
        update: ProbeUpdate | typing.SupportsIndex = "on_change",
        exclude: collections.abc.Iterable[Node] = (),
        parent: Node | None = None,
        faces_per_frame: typing.SupportsIndex = 6,
        depth_format: DepthFormat | None = "depth_component32f",
        prefilter: bool | None = None,
        parallax: Parallax = "none",
        box: np.typing.ArrayLike | None = None,
        proxy_matrix: np.typing.ArrayLike | None = None,
        fetches: Fetches = 14,
        bounces: typing.SupportsIndex = 1,
        influence: np.typing.ArrayLike | None = None,
        influence_shape: InfluenceShape = "box",
        blend_distance: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Probe) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Probe, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def blend_distance(self) -> float:
        """
        float: how far outside of `influence` the probe ceases to count, world units.
        """

    @blend_distance.setter
    def blend_distance(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def bounces(self) -> int:
        """
        int: how many mirrors of a circle of probes that see each other a path meets, from 1 to 16.
        """

    @bounces.setter
    def bounces(self, value: typing.SupportsIndex) -> None: ...
    @property
    def box(self) -> np.typing.NDArray[np.float64] | None:
        """
        ndarray (2, 3) float64 or None: the low and the high corner of the proxy, in the world or in the space of `proxy_matrix`; read-only.
        """

    @box.setter
    def box(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def depth_format(self) -> DepthFormat | None:
        """
        str or None: the format of the depth and stencil buffer, see `Renderer.render`.
        """

    @depth_format.setter
    def depth_format(self, value: DepthFormat | None) -> None: ...
    @property
    def exclude(self) -> tuple[Node, ...]:
        """
        tuple of Node: nodes that the probe leaves out with all nodes below them, besides the nodes that use it.
        """

    @exclude.setter
    def exclude(self, value: collections.abc.Iterable[Node]) -> None: ...
    @property
    def faces_per_frame(self) -> int:
        """
        int: the greatest number of faces that one call draws, from 1 to 6.
        """

    @faces_per_frame.setter
    def faces_per_frame(self, value: typing.SupportsIndex) -> None: ...
    @property
    def far(self) -> float:
        """
        float: the far clip distance, world units.
        """

    @far.setter
    def far(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fetches(self) -> Fetches:
        """
        int: 6, 14 or 35 lookups of distance for a ray, at most.
        """

    @fetches.setter
    def fetches(self, value: Fetches) -> None: ...
    @property
    def format(self) -> Format:
        """
        str: "rgba8", "rgba16f", "rgba32f" or "rgb565".
        """

    @format.setter
    def format(self, value: Format) -> None: ...
    @property
    def influence(self) -> np.typing.NDArray[np.float64] | None:
        """
        ndarray (2, 3) float64 or None: where the probe counts fully in a `ProbeBlend`, the low and the high corner, in the world or in the space of `proxy_matrix`; None: everywhere; read-only.
        """

    @influence.setter
    def influence(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def influence_shape(self) -> InfluenceShape:
        """
        str: "box", or "sphere": the ellipsoid that `influence` encloses.
        """

    @influence_shape.setter
    def influence_shape(self, value: InfluenceShape) -> None: ...
    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """

    @mipmaps.setter
    def mipmaps(self, value: bool) -> None: ...
    @property
    def near(self) -> float:
        """
        float: the near clip distance, world units.
        """

    @near.setter
    def near(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parallax(self) -> Parallax:
        """
        str: "none", "box", "sphere", "distance" or "layers".
        """

    @parallax.setter
    def parallax(self, value: Parallax) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the probe moves with.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: world space, or relative to the parent's position; read-only.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def prefilter(self) -> bool | None:
        """
        bool or None: whether the probe is filtered by roughness; None: if a drawn surface needs it.
        """

    @prefilter.setter
    def prefilter(self, value: bool | None) -> None: ...
    @property
    def proxy_matrix(self) -> np.typing.NDArray[np.float64] | None:
        """
        ndarray (4, 4) float64 or None: from the space of `box` to the world; read-only.
        """

    @proxy_matrix.setter
    def proxy_matrix(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def samples(self) -> int:
        """
        int: samples of each texel (MSAA); 1 is none.
        """

    @samples.setter
    def samples(self, value: typing.SupportsIndex) -> None: ...
    @property
    def size(self) -> int:
        """
        int: texels along an edge of a face.
        """

    @size.setter
    def size(self, value: typing.SupportsIndex) -> None: ...
    @property
    def update(self) -> ProbeUpdate | int:
        """
        str or int: "on_change", "once", "manual", or n: every n-th call.
        """

    @update.setter
    def update(self, value: ProbeUpdate | typing.SupportsIndex) -> None: ...

class PlanarMirror:
    """
    What a flat mirror shows, exactly: the scene from behind the mirror, clipped at its plane.

    Assign it to ``node.environment``; the plane is that of the node's mesh, and moves with the node. Each picture
    that shows the node's front gets a picture of its own of what is in the mirror, of the same size and with the same
    samples: frames, both eyes of a stereo frame, captures, probes and render textures alike. It is drawn again only
    where it would change. Where the node shows its back (``double_sided``), it reflects that side.

    The mirror shows all nodes that the picture may show, except its own nodes and those with
    ``in_captures=False``, with the picture's background behind them. Nodes with one PlanarMirror in one plane, as the
    tiles of a floor, are one mirror.

    Every material that looks up its environment shows it: `MirrorMaterial`, `StandardMaterial`, `GlassMaterial`, and a
    `ShaderMaterial` by ``environment(direction)``. On a flat surface each pixel is exact. Other directions are
    approximations: of normal maps, of normals that are not the plane's, and of rough surfaces. Such a ray is taken to
    end at ``distance`` from the surface; rays that leave the picture see its border. A rough surface looks up a level of
    the picture's mipmaps as wide as its lobe at that distance, which blurs near and far things alike. Light that goes
    through the plane, as what `GlassMaterial` refracts, and the irradiance of `StandardMaterial` are those of the scene's
    environment.

    Parameters
    ----------
    bounces : int
        A path may meet so many planar mirrors, with this one as the last of them, at least 1. Beyond that the mirror shows the
        scene's environment, or black. With 1, mirrors in this mirror show that. Facing mirrors need one picture for each bounce;
        where mirrors see each other in many ways, one for each path, and more than 256 in one call are an error.
    distance : float
        How far from the surface bent and rough rays are taken to end, world units, above 0. Flat smooth mirrors do
        not depend on it.

    Raises
    ------
    ValueError
        For a number out of its range. A picture of a node whose mesh is not flat, within 1e-5 of its size, raises it, too, and
        says by how much.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> glass = scene.add(cc.Mesh.plane(2), cc.MirrorMaterial(), environment=cc.PlanarMirror())
    >>> glass.environment.bounces
    1
    """

    def __init__(
        self: PlanarMirror,
        *,
        bounces: typing.SupportsIndex = 1,
        distance: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: PlanarMirror) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def bounces(self) -> int:
        """
        int: how many planar mirrors a path may meet, this one as the last of them.
        """

    @bounces.setter
    def bounces(self, value: typing.SupportsIndex) -> None: ...
    @property
    def distance(self) -> float:
        """
        float: how far from the surface bent and rough rays are taken to end, world units.
        """

    @distance.setter
    def distance(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ProbeBlend:
    """
    Several probes as the environment of a node: each point of its surface sees those that reach it.

    Assign it to ``node.environment``. A probe counts fully in its `Probe.influence`, and less and less outside of it, until it
    ceases to count at its ``blend_distance``. So what a ball reflects does not jump where it rolls from room to room,
    and a long floor shows each room in its part of it. Every material that looks up its environment shows the blend:
    `MirrorMaterial`, `StandardMaterial`, `GlassMaterial`, and a `ShaderMaterial`, in which ``environment_at(position,
    direction)`` sees the probes that reach `position`. Each probe keeps its own parallax, levels by roughness and irradiance.

    With t the distance of a point from the influence of probe i over its ``blend_distance``, the influence is
    ``w_i = 1 - 3 t^2 + 2 t^3``, 1 inside and 0 from t = 1 on. The weight of a probe is ``w_i / max(1, sum w)``. The
    scene's environment, black without one, has the rest, ``1 - min(1, sum w)``: it shows where no influence reaches. The
    weights sum to 1 and are continuous, and so are their slopes, except where the sum of the influences becomes 1.

    The probes do not show the nodes that use the blend, whether they reach them or not.

    Parameters
    ----------
    probes : iterable of Probe
        Any number, each once. Of these at most 4 may reach the bounds of one node; a picture of a scene
        where more do raises ValueError. Only probes that reach a node which is drawn are drawn.

    Raises
    ------
    ValueError
        For no probe, or one that occurs twice.
    TypeError
        For what is no probe.

    Notes
    -----
    The proxy of a probe with ``parallax="box"`` or ``"sphere"`` should contain its influence with the blend distance: a
    point outside of the proxy sees the cube as if it were infinitely far away, which jumps at the proxy's side.

    ``environment_levels``, ``environment_is_local`` and ``environment_position`` of a `ShaderMaterial` are those of the first
    probe that reaches the node. For the limit, a probe reaches a node if the box around its influence, with the
    blend distance on all sides, overlaps ``node.world_bounds``. Each further probe costs the lookups of one more
    environment for every pixel of the node.

    Examples
    --------
    Two rooms that meet at x = 0:

    >>> import cubecam as cc
    >>> left = cc.Probe((-4, 1, 0), influence=((-8, 0, -3), (0, 3, 3)), blend_distance=.5)
    >>> right = cc.Probe((4, 1, 0), influence=((0, 0, -3), (8, 3, 3)), blend_distance=.5)
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(-2, 1, 0))
    >>> ball.environment = cc.ProbeBlend([left, right])
    >>> len(ball.environment.probes)
    2
    """

    def __init__(self: ProbeBlend, probes: collections.abc.Iterable[Probe]) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: ProbeBlend) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def probes(self) -> tuple[Probe, ...]:
        """
        tuple of Probe: in the order in which they were given.
        """

class ProbeGrid:
    """
    Light from all around at the nodes of a grid in a box, for surfaces in between.

    Assign it to ``scene.probe_grid`` and call `bake`. The diffuse part of `StandardMaterial`, its sheen, and
    ``environment_irradiance(normal)`` of a `ShaderMaterial` then see the light that the nodes around a point captured, in place
    of the irradiance of their environment; what they reflect is still that of the environment. Walls may lie outside
    of the box: the light of its border counts up to one cell outside, and from there fades to that of the environment
    within another cell.

    Parameters
    ----------
    box : array_like (2, 3)
        The low and the high corner, world units: the first and the last node.
    counts : (int, int, int)
        Nodes along x, y and z, each at least 2.
    size : int
        Texels along an edge of the cubemaps that `bake` captures, from 1 to 128.
    resolution : int
        Texels along an edge of the octahedral map of distances of each node, from 4 to 32.
    visibility : bool
        True: a node counts less where it does not see a point, and where it lies behind the point's surface. False:
        trilinear interpolation alone, by which light leaks through walls.
    normal_bias, view_bias : float
        The visibility of a point counts at a place before its surface: so far along its normal and towards the viewer, in
        least steps of the grid, at least 0. Too little darkens surfaces by themselves, too much lets light through thin walls.

    Notes
    -----
    Z. Majercik et al., "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields", JCGT 8(2), 2019. Of the eight
    nodes round a point each has the product of its trilinear weight and w. With c the cosine of the angle between the
    normal and the way to the node, d the distance from the node to the biased point, m and s the means of the distance
    and of its square that the node captured in that direction, and v = abs(m^2 - s), w is ((1 + c) / 2)^2 + .2,
    times (v / (v + (d - m)^2))^3 where d > m; a w below .2 becomes w^3 / .04. The light of a node are spherical
    harmonics of orders 0 to 2, as `CubeMap.sh` gives them, with the cosine's factors 1, 2/3 and 1/4 (R. Ramamoorthi and P.
    Hanrahan, SIGGRAPH 2001); a sum below 0 counts as 0.

    Without visibility a field of light that is linear in space is exact between the nodes. With it, it is not: nodes
    before a surface count more than those beside it.

    The arrays are the grid: they may be set, and are kept by pickles and saved scenes. Setting a bias or the visibility needs no
    new bake.

    Raises
    ------
    ValueError
        For an empty box, a number out of its range, a grid that is too large for a texture, or arrays of another shape.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 1, 1))
    >>> scene.probe_grid = cc.ProbeGrid(((-1, 0, -1), (1, 2, 1)), (2, 2, 2), size=8)
    >>> with cc.Renderer() as renderer:
    ...     scene.probe_grid.bake(renderer, scene)
    >>> scene.probe_grid.coefficients.shape, scene.probe_grid.distances.shape
    ((2, 2, 2, 9, 3), (2, 2, 2, 16, 16, 2))
    """

    def __init__(
        self: ProbeGrid,
        box: np.typing.ArrayLike,
        counts: tuple[int, int, int],
        *,
        size: typing.SupportsIndex = 32,
        resolution: typing.SupportsIndex = 16,
        visibility: bool = True,
        normal_bias: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        view_bias: typing.SupportsFloat | typing.SupportsIndex = 0.2,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: ProbeGrid) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: ProbeGrid, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def bake(
        self,
        renderer: Renderer,
        scene: Scene,
        *,
        bounces: int = 1,
        exclude: collections.abc.Iterable[Node] = tuple(),
        near: float = 0.01,
        far: float = 1000.0,
        progress: collections.abc.Callable[[int, int], object] | None = None,
    ) -> None:
        """
        Capture a scene at all nodes of the grid, and keep what they see.

        With one bounce a node sees lamps, sky and emission, and surfaces as lights alone light them. With more, surfaces
        of later rounds have the light of the round before as well, and so paths of one more reflection. In the first round
        the grid is black: the irradiance of the scene's environment, which does not know of walls, counts nowhere in the
        box.

        Nodes that lie in bodies are not `ProbeGrid.active`: those that see the backs of single-sided surfaces in more than
        a quarter of all directions. They get the mean light of the active nodes beside them.

        Parameters
        ----------
        renderer : Renderer
            What captures.
        scene : Scene
            What is captured; its `Scene.probe_grid` is this one meanwhile, and afterwards what it was.
        bounces : int
            How many reflections by surfaces paths have at most, from 1 to 16.
        exclude : iterable of Node
            Nodes that are left out with all nodes below them, for example those that move.
        near, far : float
            Clip distances of the captures, world units, 0 < near < far.
        progress : callable, optional
            Called after each capture with how many are done and how many there are. If it raises, the grid stays as it was.

        Raises
        ------
        TypeError, ValueError, ContextError
            As `Renderer.capture` raises, and for bounces out of their range.

        Examples
        --------
        A white sky lights a matt surface alike from all around:

        >>> import cubecam as cc
        >>> scene = cc.Scene(background=(1, 1, 1))
        >>> grid = cc.ProbeGrid(((-1, 0, -1), (1, 2, 1)), (2, 2, 2), size=8)
        >>> with cc.Renderer() as renderer:
        ...     grid.bake(renderer, scene)
        >>> (grid.coefficients[0, 0, 0, 0] / (4 * 3.14159265) ** 0.5).round(4).tolist()
        [1.0, 1.0, 1.0]
        """

    @property
    def active(self) -> np.typing.NDArray[np.bool_]:
        """
        ndarray (nz, ny, nx) bool: False for nodes that lie in bodies, which count only where no other node does; read-only.
        """

    @active.setter
    def active(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def box(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2, 3) float64: the first and the last node, world; read-only.
        """

    @property
    def coefficients(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (nz, ny, nx, 9, 3) float32: integrals of radiance times the basis of `CubeMap.sh` at each node; read-only.
        """

    @coefficients.setter
    def coefficients(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def counts(self) -> tuple[int, int, int]:
        """
        tuple of three int: nodes along x, y and z.
        """

    @property
    def distances(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (nz, ny, nx, R, R, 2) float32: means of the distance and of its square round the directions of an octahedral map of R = `resolution`, world units; read-only.
        """

    @distances.setter
    def distances(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def normal_bias(self) -> float:
        """
        float: how far before its surface the visibility of a point counts, in least steps.
        """

    @normal_bias.setter
    def normal_bias(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def resolution(self) -> int:
        """
        int: texels along an edge of the map of distances of a node.
        """

    @property
    def size(self) -> int:
        """
        int: texels along an edge of the cubemaps that `bake` captures.
        """

    @size.setter
    def size(self, value: typing.SupportsIndex) -> None: ...
    @property
    def view_bias(self) -> float:
        """
        float: how far towards the viewer the visibility of a point counts, in least steps.
        """

    @view_bias.setter
    def view_bias(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def visibility(self) -> bool:
        """
        bool: whether nodes that do not see a point count less there.
        """

    @visibility.setter
    def visibility(self, value: bool) -> None: ...

class RenderTexture:
    """
    A picture that a scene is drawn into and that materials show in the same frame.

    A render texture is only a description, and any number of materials in any number of scenes may use it:
    give it as the ``map`` of a `BasicMaterial` or `PhongMaterial`. Each renderer holds its own contents of the
    texture (``renderer.read_texture(render_texture)``). It brings them up to date before it draws the pictures
    that show them, and draws them again only if they would change.

    Parameters
    ----------
    scene : Scene
        The scene that is drawn; the texture keeps it alive. The scene may show other render textures, and
        mirrors with probes.
    camera : Camera
        The camera that the scene is drawn by; the aspect is that of `size`.
    size : (int, int)
        (width, height), texels.
    format : {"rgba8", "rgba16f", "rgba32f", "rgb565"}
        The format of a texel. rgba8 and rgb565 clip light above 1.
    samples : int
        Samples of each texel, for smooth edges (MSAA); 1 is none.
    mipmaps : bool
        True: lookups are trilinear, for pictures that appear small. False: lookups are bilinear.
    wrap : {"clamp", "repeat", "mirror"}
        What lookups outside 0..1 return: "repeat" repeats the picture, "clamp" its border.
    exclude : iterable of Node
        Nodes of `scene` that the texture leaves out, with all nodes below them.
    name : str
        A name for people, which messages use.
    effects : sequence of ImageEffect
        Passes over the picture, one after the other, in linear float. With an empty scene, the effects alone
        make the picture.
    depth_format : str or None
        The format of the depth and stencil buffer, see `Renderer.render`; None paints nodes one over the other.

    Raises
    ------
    ValueError
        For a size or samples below 1, or another format or wrap.
    TypeError
        For a scene, a camera or an excluded object of another type.

    Notes
    -----
    uv (0, 0) is the picture's bottom-left, as with an `Image`. The picture's alpha counts where the material's
    own opacity is below 1; it does not make a surface translucent by itself.

    A picture must not show itself, neither directly nor through other render textures or probes: drawing an
    object that shows it raises ValueError. `exclude` leaves out, for example, the monitor in a room that shows
    this room. An excluded node still casts shadows, so its vertices must not depend on the picture if its
    shadow falls into the picture.

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
        format: Format = "rgba8",
        samples: typing.SupportsIndex = 1,
        mipmaps: bool = False,
        wrap: Wrap = "clamp",
        exclude: collections.abc.Iterable[Node] = (),
        name: str = "",
        effects: collections.abc.Iterable[ImageEffect] = (),
        depth_format: DepthFormat | None = "depth_component32f",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: RenderTexture) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: RenderTexture, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def camera(self) -> Camera:
        """
        Camera: the camera that the scene is drawn by.
        """

    @camera.setter
    def camera(self, value: Camera) -> None: ...
    @property
    def depth_format(self) -> DepthFormat | None:
        """
        str or None: the format of the depth and stencil buffer, see `Renderer.render`.
        """

    @depth_format.setter
    def depth_format(self, value: DepthFormat | None) -> None: ...
    @property
    def effects(self) -> tuple[ImageEffect, ...]:
        """
        tuple of ImageEffect: passes over the picture, one after the other.
        """

    @effects.setter
    def effects(self, value: collections.abc.Iterable[ImageEffect]) -> None: ...
    @property
    def exclude(self) -> tuple[Node, ...]:
        """
        tuple of Node: nodes of `scene` that the texture leaves out, with all nodes below them.
        """

    @exclude.setter
    def exclude(self, value: collections.abc.Iterable[Node]) -> None: ...
    @property
    def format(self) -> Format:
        """
        str: "rgba8", "rgba16f", "rgba32f" or "rgb565".
        """

    @format.setter
    def format(self, value: Format) -> None: ...
    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """

    @mipmaps.setter
    def mipmaps(self, value: bool) -> None: ...
    @property
    def name(self) -> str:
        """
        str: a name for people; need not be unique.
        """

    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def samples(self) -> int:
        """
        int: samples of each texel (MSAA); 1 is none.
        """

    @samples.setter
    def samples(self, value: typing.SupportsIndex) -> None: ...
    @property
    def scene(self) -> Scene:
        """
        Scene: the scene that is drawn.
        """

    @scene.setter
    def scene(self, value: Scene) -> None: ...
    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height), texels.
        """

    @size.setter
    def size(self, value: tuple[int, int]) -> None: ...
    @property
    def wrap(self) -> Wrap:
        """
        str: "repeat", "clamp" or "mirror".
        """

    @wrap.setter
    def wrap(self, value: Wrap) -> None: ...

class Scene:
    """
    Nodes, lights and their surroundings.

    A scene does not depend on a renderer: any number of renderers may draw it, on any threads.

    Parameters
    ----------
    environment : CubeMap, optional
        The surroundings that mirrors and glass show; see `load_environment`. It lights no other material.
    background : array_like (3,) or (4,), str, or CubeMap, optional
        A colour, or a cubemap as skybox, that pictures show where no node is. Numbers are linear; a CSS name
        or "#rrggbb" is sRGB and is decoded. None: the environment if there is one, else transparent black.
    environment_intensity : float
        The factor of the environment's light, at least 0.
    environment_rotation : array_like (4,), optional
        Quaternion (w, x, y, z) of any length except 0 that turns the environment: what the cubemap shows in a
        direction d appears in the direction R d of the world. None: (1, 0, 0, 0).

    Raises
    ------
    TypeError
        For an environment or background of another type.
    ValueError
        For a colour, intensity or rotation that is not finite, a negative intensity, or a rotation of length 0.

    Notes
    -----
    Intensity and rotation belong to the scene's own environment: to the surfaces that show it, to the
    background where that is None, and so to captures and probes, which show both. They change neither the
    environment that a node has of its own nor a background that is a cubemap.

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

    def __bool__(self: Scene) -> bool:
        """
        True, also for a scene without nodes, so that ``scene or other`` is the scene.
        """

    def __contains__(self: Scene, thing: object) -> bool:
        """
        Whether a node, a light, a camera, an animation or a node of a name is in the scene.
        """

    def __getitem__(self: Scene, name: str) -> Node:
        """
        Get a node by its name; of several, the one of the lowest id.

        Parameters
        ----------
        name : str
            The exact name of the node.

        Returns
        -------
        Node
            The node; `find` gives all nodes of a name.

        Raises
        ------
        KeyError
            If no node has this name; the message suggests similar names.
        TypeError
            For a name that is not a str.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> lamp = scene.add(cc.Mesh.sphere(.1), name="lamp")
        >>> scene["lamp"] is lamp, "lamp" in scene, [node.name for node in scene], len(scene)
        (True, True, ['lamp'], 1)
        """

    def __init__(
        self: Scene,
        *,
        environment: CubeMap | None = None,
        background: str | np.typing.ArrayLike | CubeMap | None = None,
        environment_intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        environment_rotation: np.typing.ArrayLike | None = None,
    ) -> None: ...
    def __iter__(self: Scene) -> collections.abc.Iterator[Node]:
        """
        Iterate over all nodes, in order of id, as they are at this moment.
        """

    def __len__(self: Scene) -> int:
        """
        The number of nodes.
        """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Scene) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Scene, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def _restore(self: Scene, id: typing.SupportsInt | typing.SupportsIndex) -> Node:
        """
        For unpickling: the node with an id.
        """

    @typing.overload
    def add(self: Scene, light: AnyLight) -> AnyLight:
        """
        Add a light.

        Parameters
        ----------
        light : Light
            The light to add. It may be in other scenes, too.

        Returns
        -------
        Light
            The same light.

        Raises
        ------
        ValueError
            If the light is already in this scene.
        """

    @typing.overload
    def add(self: Scene, camera: Camera) -> Camera:
        """
        Add a camera to `Scene.cameras`.

        Parameters
        ----------
        camera : Camera
            The camera to add. It may be in other scenes, too. No picture depends on the cameras of a scene: any
            camera can draw any scene.

        Returns
        -------
        Camera
            The same camera.

        Raises
        ------
        ValueError
            If the camera is already in this scene.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> car = scene.add(position=(0, 0, 5), name="car")
        >>> camera = scene.add(cc.PerspectiveCamera(position=(0, 1, 0), parent=car))
        >>> camera in scene, camera.world_position.tolist()
        (True, [0.0, 1.0, 5.0])
        """

    @typing.overload
    def add(self: Scene, animation: Animation) -> Animation:
        """
        Add an animation to `Scene.animations`.

        Parameters
        ----------
        animation : Animation
            An animation of nodes of this scene.

        Returns
        -------
        Animation
            The same animation.

        Raises
        ------
        ValueError
            If the animation is already in this scene, or moves a node that is not.
        """

    @typing.overload
    def add(
        self: Scene,
        mesh: Mesh | None = None,
        material: Material | None = None,
        *,
        position: np.typing.ArrayLike | None = None,
        rotation: np.typing.ArrayLike | None = None,
        scale: float | np.typing.ArrayLike | None = None,
        matrix: np.typing.ArrayLike | None = None,
        parent: Node | None = None,
        environment: CubeMap | Probe | ProbeBlend | PlanarMirror | None = None,
        visible: bool = True,
        in_captures: bool = True,
        name: str = "",
        render_order: typing.SupportsIndex = 0,
        cast_shadow: bool = True,
        receive_shadow: bool = True,
        label: typing.SupportsIndex = 0,
        skin: Skin | None = None,
        weights: np.typing.ArrayLike | None = None,
    ) -> Node:
        """
        Add a mesh with a material, or a group.

        Parameters
        ----------
        mesh : Mesh, optional
            None: the node is a group, which carries other nodes.
        material : Material, optional
            None: a new `PhongMaterial`.
        position : array_like (3,), optional
            Relative to the parent. None: (0, 0, 0).
        rotation : array_like (4,), optional
            Quaternion (w, x, y, z) of any length except 0, such as `axis_angle` gives. None: (1, 0, 0, 0).
        scale : float or array_like (3,), optional
            Factors along the node's own axes, not 0. A negative number mirrors. None: 1.
        matrix : array_like (4, 4), optional
            Node to parent, in place of position, rotation and scale: not singular, last row (0, 0, 0, 1).
        parent : Node, optional
            A node of this scene that the new node moves with.
        environment : CubeMap, Probe, ProbeBlend or PlanarMirror, optional
            The surroundings that mirrors and glass show on this node. None: the scene's environment.
        visible : bool
            False: no picture shows the node or any node below it.
        in_captures : bool
            False: captures and probes show neither the node nor any node below it; frames do.
        name : str
            A name for people; need not be unique.
        render_order : int
            Nodes of lower order are drawn first, before any distance counts, among opaque and among translucent
            nodes; 32 bits.
        cast_shadow : bool
            False: neither the node nor any node below it casts shadows; see `Shadow`. Translucent nodes never
            cast shadows.
        receive_shadow : bool
            Whether shadows show on the node's own surface.
        label : int
            A number of your own that the output "label" shows, such as a class; 32 bits. Nodes may share a label.
        skin : Skin, optional
            The joints that move the mesh's vertices. None: the mesh does not bend.
        weights : array_like (T,), optional
            How much of each of the mesh's morph targets is added. None: nothing.

        Returns
        -------
        Node
            The new node, with the next id; the first id is 1.

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
        Remove all nodes, lights, cameras, animations and variants.
        """

    def find(
        self: Scene, name: str | None = None, *, label: typing.SupportsIndex | None = None
    ) -> list[Node]:
        """
        Find all nodes of a name, of a label, or of both.

        Parameters
        ----------
        name : str, optional
            The exact name.
        label : int, optional
            The `Node.label`.

        Returns
        -------
        list of Node
            In order of id; empty if there is no such node.

        Raises
        ------
        TypeError
            Without a name and a label, or for values of other types.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> for x in range(3):
        ...     tree = scene.add(cc.Mesh.cone(), position=(x, 0, 0), name="tree")
        >>> [node.id for node in scene.find("tree")]
        [1, 2, 3]
        >>> scene["tree"].label = 7
        >>> [node.id for node in scene.find(label=7)]
        [1]
        """

    def remove(self: Scene, thing: Node | Light | Camera | Animation) -> None:
        """
        Remove a light, a camera, an animation, or a node with all nodes below it.

        Removed objects keep their values; their ids are not used again.

        Parameters
        ----------
        thing : Node, Light, Camera or Animation
            The object to remove.

        Raises
        ------
        ValueError
            If the object is not in this scene.

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

    def save(self, path: str | os.PathLike[str]) -> None:
        """
        Write a scene to a file of glTF 2.0, which other programs read. The method `Scene.save`.

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

    def set_matrices(
        self: Scene, nodes: collections.abc.Iterable[Node], matrices: np.typing.ArrayLike
    ) -> None:
        """
        Place many nodes at once, as `Node.matrix` does for each node.

        Parameters
        ----------
        nodes : sequence of Node
            Nodes of this scene.
        matrices : array_like (len(nodes), 4, 4)
            Node to parent, for column vectors; the last row of each is (0, 0, 0, 1).

        Raises
        ------
        ValueError
            For another number of matrices than nodes, a matrix that is singular or not finite, or a node of another scene. In
            this case no node moves.

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
        self: Scene, nodes: collections.abc.Iterable[Node], positions: np.typing.ArrayLike
    ) -> None:
        """
        Place many nodes at once, as `Node.position` does for each node, in a hundredth of the time.

        Parameters
        ----------
        nodes : sequence of Node
            Nodes of this scene.
        positions : array_like (len(nodes), 3)
            Positions relative to the parent of each node, world units.

        Raises
        ------
        ValueError
            For another number of positions than nodes, numbers that are not finite, or a node of another scene. In this case
            no node moves.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> scene = cc.Scene()
        >>> nodes = [scene.add(cc.Mesh.box(0.1)) for _ in range(3)]
        >>> scene.set_positions(nodes, np.eye(3))
        >>> nodes[1].position.tolist()
        [0.0, 1.0, 0.0]
        """

    def set_time(
        self: Scene,
        seconds: typing.SupportsFloat | typing.SupportsIndex,
        animation: typing.SupportsIndex | str | Animation = 0,
    ) -> Scene:
        """
        Move the nodes to where an animation has them at a time.

        Parameters
        ----------
        seconds : float
            Before the first and after the last key of a channel, the channel has the value of that key.
        animation : int, str or Animation
            Which animation: an index of `animations`, a name, or the animation itself.

        Returns
        -------
        Scene
            This scene.

        Raises
        ------
        IndexError
            For an index that no animation has.
        KeyError
            For a name that no animation has; the message names similar ones.
        TypeError
            For another kind of object.
        ValueError
            For seconds that are not finite, or a node whose `matrix` has a shear, which position, rotation and scale
            cannot express. In this case no node changes.

        Notes
        -----
        What the animation does not name stays as it is, and so do nodes that are no longer in the scene. A node that
        was given a whole `matrix` is taken apart, as by setting `Node.rotation`; glTF has no animations of such nodes.
        A scale nearer to 0 than 1e-6 becomes 1e-6, since a node's matrix must not be singular.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> ball = scene.add(cc.Mesh.sphere(), name="ball")
        >>> way = cc.AnimationChannel(ball, "translation", [0, 2], [(0, 0, 0), (4, 0, 0)])
        >>> fly = scene.add(cc.Animation([way], name="fly"))
        >>> scene.set_time(.5)["ball"].position.tolist()
        [1.0, 0.0, 0.0]
        >>> scene.set_time(9, "fly")["ball"].position.tolist()
        [4.0, 0.0, 0.0]
        """

    def show(
        self,
        where: Place | None = None,
        *,
        camera: PerspectiveCamera | OrthographicCamera | None = None,
        controls: ControlsName | cubecam.viewer.controls.Controls = "orbit",
        browser: bool = True,
        block: bool | None = None,
        size: tuple[int, int] = (640, 480),
        renderer: Renderer | None = None,
        samples: int = 4,
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        encode: Encode | None = "srgb",
        output: Output | Probe = "color",
        title: str = "cubecam",
    ) -> cubecam.Viewer:
        """
        Explore the scene: in the notebook, in a window, on a page of the browser or in the terminal.

        Parameters
        ----------
        where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
            Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
            for a browser on this machine.
        camera, controls, size, renderer, samples, exposure, tonemap, encode, output, title
            As in `Viewer`.
        browser : bool
            Whether a page is opened in the browser.
        block : bool, optional
            Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
            notebooks and in Python's prompt no.

        Returns
        -------
        Viewer

        Raises
        ------
        ValueError, TypeError
            As `Viewer`.
        ImportError
            If a package is missing; the message names the extra of cubecam that has it.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> ball = scene.add(cc.Mesh.sphere(1))
        >>> viewer = scene.show("offscreen", size=(64, 48))
        >>> viewer.camera.orbit(yaw=30)
        >>> viewer.draw().shape
        (48, 64, 4)
        >>> viewer.close()
        """

    def to_mitsuba(
        self,
        camera: PerspectiveCamera | OrthographicCamera | None = None,
        size: tuple[int, int] = (512, 512),
        *,
        path: str | os.PathLike[str] | None = None,
        transform: collections.abc.Callable[[np.typing.NDArray[np.float64]], object] | None = None,
        samples: int = 64,
        max_depth: int | None = None,
    ) -> dict[str, object]:
        """
        Describe the scene for Mitsuba 3: a dict for ``mitsuba.load_dict``, and a file. The method `Scene.to_mitsuba`.

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

    @property
    def animations(self) -> tuple[Animation, ...]:
        """
        tuple of Animation: all animations of the scene, in order of add.
        """

    @property
    def background(self) -> np.typing.NDArray[np.float32] | CubeMap | None:
        """
        ndarray (4,) float32, CubeMap or None: what pictures show where no node is. None: the environment if there is one, else transparent black.
        """

    @background.setter
    def background(self, value: str | np.typing.ArrayLike | CubeMap | None) -> None: ...
    @property
    def bounds(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2, 3) float64: the lowest and the highest corner of all visible nodes, read-only.

        The numbers are world units and exact for the vertices: the bounds of the transformed vertices, not of
        transformed boxes. The ``vertex`` function of a `ShaderMaterial` is not taken into account. Without a
        visible mesh the bounds are those of nothing, ``[[inf, inf, inf], [-inf, -inf, -inf]]``: the minimum of the
        first rows and the maximum of the second rows unites any bounds.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> box = scene.add(cc.Mesh.box(2), position=(3, 0, 0))
        >>> ball = scene.add(cc.Mesh.sphere(.5), position=(0, 2, 0))
        >>> scene.bounds.tolist()
        [[-0.5, -1.0, -1.0], [4.0, 2.5, 1.0]]
        """

    @property
    def cameras(self) -> tuple[Camera, ...]:
        """
        tuple of Camera: all cameras of the scene, in order of add; no picture depends on them.
        """

    @property
    def environment(self) -> CubeMap | None:
        """
        CubeMap or None: what mirrors and glass without an environment of their own show.
        """

    @environment.setter
    def environment(self, value: CubeMap | None) -> None: ...
    @property
    def environment_intensity(self) -> float:
        """
        float: the factor of the light of the scene's environment, at least 0.
        """

    @environment_intensity.setter
    def environment_intensity(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def environment_rotation(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4,) float64: unit quaternion (w, x, y, z) that turns the scene's environment; read-only.
        """

    @environment_rotation.setter
    def environment_rotation(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def lights(self) -> tuple[Light, ...]:
        """
        tuple of Light: all lights of the scene, in order of add.
        """

    @property
    def nodes(self) -> tuple[Node, ...]:
        """
        tuple of Node: all nodes of the scene, in order of id.
        """

    @property
    def probe_grid(self) -> ProbeGrid | None:
        """
        ProbeGrid or None: the light that falls on `StandardMaterial` from all around in its box, in place of the environment's.
        """

    @probe_grid.setter
    def probe_grid(self, value: ProbeGrid | None) -> None: ...
    @property
    def variant(self) -> str | None:
        """
        str or None: which of `variants` the scene shows; see `Node.variants`.

        Setting it gives each node that has a material of that name this material. None gives each node its own
        material again, which is the one that was last set by `Node.material`.
        """

    @variant.setter
    def variant(self, value: str | None) -> None: ...
    @property
    def variants(self) -> tuple[str, ...]:
        """
        tuple of str: the names of the variants that the scene can show. If the present one is not among the names that are set, `variant` becomes None.
        """

    @variants.setter
    def variants(self, value: collections.abc.Iterable[str]) -> None: ...

class Face(enum.IntEnum):
    """
    The six faces of a cube, in the order of every array here.

    A face is an integer from 0 to 5: ``cube.faces[cc.Face.POS_Y]``. Axes and orientation are those of OpenGL
    4.6, section 8.13; docs/conventions.md has a drawing.
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

    The memory always has the layout of OpenGL's cube maps: ``faces[f, row, col]`` is the texel with
    ``s = (col + .5)/N`` and ``t = (row + .5)/N`` on face `f` of +X -X +Y -Y +Z -Z (OpenGL 4.6, section
    8.13; docs/conventions.md). Threads may share a cubemap. Cubemaps are compared by their contents.

    Parameters
    ----------
    faces : array_like (6, N, N, C), or six of (N, N, C)
        C is 1, 3 or 4. uint8 (which stands for value/255), float16 and float32 are kept; float64 becomes
        float32. NaN raises ValueError; inf is kept. Lookups and resampling
        give inf where an infinite texel has a weight, and no NaN beside it; the GPU may give NaN there.
    convention : {"gl", "inside", "three"}, default "gl"
        The convention of `faces`: "gl" is the layout above; "inside" shows the faces as seen from the center
        of the cube (OpenEXR); "three" is that of three.js and D3D skybox files.
    mipmaps : bool, default False
        True: lookups, here and on the GPU, are trilinear over box-filtered levels. False: they are bilinear.
    encoding : {"linear", "srgb"}, optional
        What the numbers are: proportional to light, or encoded for a screen, as in 8-bit files. It changes no
        lookup, only how pictures of the cube are saved and shown (docs/conventions.md). None: that of the
        CubeMap given as `faces`; for an array, "srgb" for uint8, else "linear".

    Raises
    ------
    ValueError
        For faces that are not square or not of one shape, another number of channels, NaN, or an unknown
        convention or encoding.
    TypeError
        For bool, complex, text, or integers other than uint8.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cube = cc.CubeMap(np.full((6, 8, 8, 3), 0.5, np.float32))
    >>> cube
    CubeMap(size=8, channels=3, dtype=float32, mipmaps=False, encoding='linear')
    >>> cube.sample([0, 1, 0])
    array([0.5, 0.5, 0.5], dtype=float32)
    """

    __hash__: typing.ClassVar[None] = None  # type: ignore[assignment]

    @staticmethod
    def from_angular_map(
        image: np.typing.ArrayLike,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from an angular map, such as Debevec's light probe images: the inverse of `to_angular_map`.

        Parameters
        ----------
        image : array_like (S, S, C)
            A square whose sides the disc touches, as in `from_perspective`. Pixels outside the disc do not count.
        direction, up
            As in `to_angular_map`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            The new cube in `dtype`.

        Raises
        ------
        ValueError, TypeError
            As `to_angular_map` and `from_equirect`, and for an image that is not square.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_angular_map(np.ones((200, 200, 3), np.float32)).size
        64
        """

    @staticmethod
    def from_cylindrical(
        image: np.typing.ArrayLike,
        *,
        fov: float = 360.0,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from a panorama on a cylinder: the inverse of `to_cylindrical`.

        Parameters
        ----------
        image : array_like (H, W, C)
            As in `from_perspective`. With a `fov` of 360 the first column continues the last one.
        fov, direction, up
            As in `to_cylindrical`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            Texels whose centre the picture does not show, such as those straight up, are 0, in all channels.

        Raises
        ------
        ValueError, TypeError
            As `to_cylindrical` and `from_equirect`.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_cylindrical(np.ones((64, 201, 3), np.float32)).sample([[1, 0, 0], [0, 1, 0]]).tolist()
        [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
        """

    @staticmethod
    def from_dual_paraboloid(
        image: np.typing.ArrayLike,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from a dual paraboloid map: the inverse of `to_dual_paraboloid`.

        Parameters
        ----------
        image : array_like (S, 2S, C)
            Both halves side by side, as in `from_perspective`. Pixels outside the discs do not count.
        direction, up
            As in `to_dual_paraboloid`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            The new cube in `dtype`.

        Raises
        ------
        ValueError, TypeError
            As `to_dual_paraboloid` and `from_equirect`, and for an image that is not twice as wide as high.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_dual_paraboloid(np.ones((64, 128, 3), np.float32)).size
        64
        """

    @staticmethod
    def from_equirect(
        image: np.typing.ArrayLike,
        *,
        size: typing.SupportsIndex | None = None,
        center: Center = "-z",
        sampling: Sampling = "centers",
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from an equirectangular panorama.

        Each texel is filtered over its footprint, so that smaller faces do not alias; near the poles the footprint
        covers whole rows. Larger faces are bilinear, across the seam and over the poles.

        Parameters
        ----------
        image : array_like (H, 2H, C)
            uint8 (value/255), float16, float32 or float64; not mirrored, row 0 at +Y. NaN raises ValueError; inf
            counts as the largest finite number of the image, or 65504 if that is more.
        size : int, optional
            Texels along an edge of a face. None: the next power of two from W / pi, which loses no detail.
        center : {"-z", "+z", "+x", "-x"}, default "-z"
            The axis at the center column.
        sampling : {"centers", "borders"}, default "centers"
            Where the samples of `image` lie; with "borders" (OpenEXR) any shape from (2, 2) is allowed.
        mipmaps : bool, default False
            Whether lookups in the new cube are trilinear.
        dtype : dtype, optional
            "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `image`.
        encoding : {"linear", "srgb"}, optional
            What the numbers of `image` are, as in `CubeMap`.

        Returns
        -------
        CubeMap
            The new cube in `dtype`, rounded as `to_equirect` rounds.

        Raises
        ------
        ValueError
            For an image that is not twice as wide as high, NaN, a size below 1, an unknown center or sampling, or
            another dtype.
        TypeError
            For an image of bool, complex, text, or integers other than uint8.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_equirect(np.zeros((64, 128, 3), np.uint8))
        CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
        """

    @staticmethod
    def from_fisheye(
        image: np.typing.ArrayLike,
        *,
        fov: float = 180.0,
        model: FisheyeModel = "equidistant",
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from the circular picture of a fisheye lens: the inverse of `to_fisheye`.

        Parameters
        ----------
        image : array_like (S, S, C)
            A square whose sides the circle touches, as in `from_perspective`. Pixels outside the circle do not count.
        fov, model, direction, up
            As in `to_fisheye`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            Texels whose centre the picture does not show are 0, in all channels.

        Raises
        ------
        ValueError, TypeError
            As `to_fisheye` and `from_equirect`, and for an image that is not square.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_fisheye(np.ones((64, 64, 3), np.float32)).sample([[0, 0, -1], [0, 0, 1]]).tolist()
        [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
        """

    @staticmethod
    def from_layout(
        image: np.typing.ArrayLike,
        *,
        layout: Layout | None = None,
        convention: Convention = "gl",
        size: typing.SupportsIndex | None = None,
        center: Center = "-z",
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from one picture of all faces: the inverse of `to_layout`.

        Parameters
        ----------
        image : array_like (H, W, C)
        layout : str, optional
            A layout of `to_layout`. None: the layout follows from the shape; width to height of 4:3 is a cross, 3:4 a
            vertical_cross, 6:1 a row, 1:6 a column, 2:1 an equirect. The convention does not follow from the shape.
        convention : {"gl", "inside", "three"}, default "gl"
            The convention of the faces in `image`.
        size, center
            As in `from_equirect`, for "equirect" only.
        mipmaps : bool, default False
            Whether lookups in the new cube are trilinear.
        dtype : dtype, optional
            "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `image`.
        encoding : {"linear", "srgb"}, optional
            What the numbers of `image` are, as in `CubeMap`.

        Returns
        -------
        CubeMap
            The new cube in `dtype`, rounded as `to_equirect` rounds.

        Raises
        ------
        ValueError
            For a shape of no layout, or a shape that `layout` does not have.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_layout(np.zeros((24, 32, 3), np.uint8))
        CubeMap(size=8, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
        """

    @staticmethod
    def from_levels(levels: collections.abc.Sequence[CubeMap]) -> CubeMap:
        """
        Make a filtered cubemap of its levels, for example those that another program filtered.

        Parameters
        ----------
        levels : sequence of CubeMap
            Level k of L, 2 to 64 of them, holds the light filtered for the roughness ``k / (L - 1)``; level 0 is the cube
            itself. All have the same dtype and number of channels; their sizes are free.

        Returns
        -------
        CubeMap
            With `levels` and `roughness`, and the `mipmaps` and `encoding` of level 0.

        Raises
        ------
        ValueError
            For another number of levels, or levels of different channels or dtypes.
        TypeError
            For levels that are no cubemaps.

        See Also
        --------
        prefilter : makes the levels of a cubemap.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> sharp, rough = (cc.CubeMap(np.full((6, n, n, 3), 0.5, np.float32)) for n in (64, 16))
        >>> cc.CubeMap.from_levels([sharp, rough]).roughness.tolist()
        [0.0, 1.0]
        """

    @staticmethod
    def from_mirror_ball(
        image: np.typing.ArrayLike,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from a photograph of a mirror ball: the inverse of `to_mirror_ball`.

        Parameters
        ----------
        image : array_like (S, S, C)
            A square whose sides the ball touches, as in `from_perspective`. Pixels outside the ball do not count.
        direction, up
            As in `to_mirror_ball`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            Little of the picture shows what lies behind the ball, in `direction`: there the cube is blurred.

        Raises
        ------
        ValueError, TypeError
            As `to_mirror_ball` and `from_equirect`, and for an image that is not square.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_mirror_ball(np.ones((64, 64, 3), np.float32))
        CubeMap(size=32, channels=3, dtype=float32, mipmaps=False, encoding='linear')
        """

    @staticmethod
    def from_octahedral(
        image: np.typing.ArrayLike,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Make a cube from an octahedral map: the inverse of `to_octahedral`.

        Parameters
        ----------
        image : array_like (S, S, C)
            A square, as in `from_perspective`. Lookups at its border continue on the other side of the fold.
        direction, up
            As in `to_octahedral`.
        size, mipmaps, dtype, encoding
            As in `from_perspective`.

        Returns
        -------
        CubeMap
            The new cube in `dtype`.

        Raises
        ------
        ValueError, TypeError
            As `to_octahedral` and `from_equirect`, and for an image that is not square.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap.from_octahedral(np.ones((64, 64, 3), np.uint8))
        CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
        """

    @staticmethod
    def from_perspective(
        image: np.typing.ArrayLike,
        fov: float,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        size: int | None = None,
        mipmaps: bool = False,
        dtype: np.typing.DTypeLike | None = None,
        encoding: Encoding | None = None,
    ) -> CubeMap:
        """
        Put a picture of a perspective camera into a cube, which is 0 around it: the inverse of `to_perspective`.

        Parameters
        ----------
        image : array_like (H, W, C)
            uint8 (value/255), float16, float32 or float64, row 0 on top. NaN raises ValueError; inf counts as the largest
            finite number of the image, or 65504 if that is more.
        fov, direction, up
            As in `to_perspective`.
        size : int, optional
            Texels along an edge of a face. None: the power of two whose texels are no larger than the pixels in the middle.
        mipmaps : bool
            Whether lookups in the new cube are trilinear.
        dtype : dtype, optional
            "uint8", "float16" or "float32". None: that of `image`.
        encoding : {"linear", "srgb"}, optional
            What the numbers of `image` are, as in `CubeMap`.

        Returns
        -------
        CubeMap
            Texels whose centre the picture does not show are 0, in all channels.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective` and `from_equirect`.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.CubeMap.from_perspective([[[1.0, 1.0, 1.0]]], 90, size=4)
        >>> float(cube.faces[cc.Face.NEG_Z].min()), float(cube.faces[cc.Face.POS_Z].max())
        (1.0, 0.0)
        """

    @staticmethod
    def from_sh(coefficients: np.typing.ArrayLike, *, size: typing.SupportsIndex = 32) -> CubeMap:
        """
        Make a cube of the light that coefficients of spherical harmonics describe.

        Parameters
        ----------
        coefficients : array_like ((order + 1)^2, C)
            As `sh` returns them, for one, three or four channels.
        size : int, default 32
            Texels along an edge of a face.

        Returns
        -------
        CubeMap
            float32: the sum of coefficient times basis function at the center of each texel. It may be negative.

        Raises
        ------
        ValueError
            For another number of rows or columns, numbers that are not finite, or a size below 1.
        TypeError
            For values that are not real numbers.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.CubeMap.from_sh([[0.0], [1.0], [0.0], [0.0]])  # .488603 y
        >>> cube.sample([[0, 1, 0], [0, -1, 0]]).ravel().round(2)
        array([ 0.49, -0.49], dtype=float32)
        """

    def __array__(
        self, dtype: np.dtype[np.generic] | None = None, copy: bool | None = None
    ) -> np.typing.NDArray[np.generic]:
        """
        Give the picture's numbers to ``numpy.asarray``: the colour of a frame, the faces of a cubemap.

        Parameters
        ----------
        dtype : dtype, optional
            None: that of the picture.
        copy : bool, optional
            True: always a copy. False: never; raises ValueError if `dtype` needs one. None: a copy if `dtype` needs one.

        Returns
        -------
        ndarray (H, W, C), of a cubemap (6, N, N, C)
            Without a copy, that of a cubemap or an image is read-only.

        Raises
        ------
        ValueError
            For a frame without a colour, or a copy that is not allowed.
        """

    def __copy__(self: CubeMap) -> CubeMap: ...
    def __deepcopy__(self: CubeMap, memo: dict[int, object]) -> CubeMap: ...
    def __dlpack__(
        self,
        *,
        stream: object = None,
        max_version: tuple[int, int] | None = None,
        dl_device: tuple[int, int] | None = None,
        copy: bool | None = None,
    ) -> object:
        """
        Give the picture's numbers to ``from_dlpack`` of numpy, torch, jax and others (DLPack, array API 2023.12).

        A frame's colour is shared. The numbers of a cubemap and an image must not change: they are shared as read-only if
        the reader knows version 1 of DLPack, which can say so, and are copied otherwise.
        """

    def __dlpack_device__(self) -> tuple[int, int]:
        """
        Give the device of the numbers to ``from_dlpack``: main memory.
        """

    def __eq__(self: CubeMap, other: object) -> bool:
        """
        Whether the contents are the same bit for bit, captured outputs and filtered levels included.
        """

    def __getstate__(self: CubeMap) -> tuple[object, ...]: ...
    def __init__(
        self: CubeMap,
        faces: np.typing.ArrayLike,
        *,
        convention: Convention = "gl",
        mipmaps: bool = False,
        encoding: Encoding | None = None,
    ) -> None: ...
    def __ne__(self: CubeMap, other: object) -> bool: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: CubeMap) -> str: ...
    def __setstate__(self: CubeMap, state: object) -> None: ...
    def _repr_png_(self) -> bytes:
        """
        Give the picture that Jupyter shows: a cross seen from within, as `to_screen` turns it into 8 bits.
        """

    def copy(self: CubeMap) -> CubeMap:
        """
        An independent cubemap with the same contents.
        """

    def irradiance(
        self: CubeMap,
        size: typing.SupportsIndex = 32,
        *,
        progress: collections.abc.Callable[[float], object] | None = None,
    ) -> CubeMap:
        """
        Compute the diffuse light: the cosine-weighted mean around each direction.

        Parameters
        ----------
        size : int, default 32
            Texels along an edge of the result.
        progress : callable, optional
            As in `prefilter`.

        Returns
        -------
        CubeMap
            A new cubemap of the same dtype, channels, `mipmaps` and `encoding`. Its texel at N is
            ``(1/pi) * integral of radiance(l) max(N.l, 0) dl``, the irradiance divided by pi: what a white matt surface with the
            normal N sends to the eye. A constant cubemap stays as it is.

        Raises
        ------
        ValueError
            For a size below 1.
        TypeError
            For a size that is not whole, or a `progress` that cannot be called.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> faces = np.zeros((6, 64, 64, 1), np.float32)
        >>> faces[cc.Face.POS_Z] = 1
        >>> diffuse = cc.CubeMap(faces).irradiance()
        >>> diffuse.sample([[0, 0, 1], [1, 0, 0], [0, 0, -1]]).ravel().round(2)
        array([0.55, 0.11, 0.  ], dtype=float32)
        """

    def numpy(self, *, writable: bool = False) -> Pixels:
        """
        Give the faces as an array.

        Parameters
        ----------
        writable : bool
            False: `faces`, the read-only view without a copy. True: a copy, which belongs to the caller.

        Returns
        -------
        ndarray (6, N, N, C) in the cube's `dtype`

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> cube = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32))
        >>> own = cube.numpy(writable=True)
        >>> own[cc.Face.POS_Y] = 1
        >>> float(cube.faces.max()), float(own.max())
        (0.0, 1.0)
        """

    def prefilter(
        self: CubeMap,
        levels: typing.SupportsIndex = 6,
        size: typing.SupportsIndex | None = None,
        *,
        progress: collections.abc.Callable[[float], object] | None = None,
    ) -> CubeMap:
        """
        Filter the light by roughness, as rough metal reflects it.

        Level k holds, for each direction N, the mean radiance around N under the lobe of GGX for the roughness
        ``k / (levels - 1)``. The renderer uses the levels of a cubemap that has them; of other cubemaps it makes such levels
        itself where a material needs them.

        Parameters
        ----------
        levels : int, default 6
            The number of levels with level 0, which is the cube itself, 2 to 64.
        size : int, optional
            Texels along an edge of level 0. None: those of this cube; otherwise the cube is resampled first, as by `resize`.
        progress : callable, optional
            A function that is called on this thread with the share that is done, from 0 to 1, about every 10 ms. If it raises,
            the work ends, and so it does with Ctrl-C.

        Returns
        -------
        CubeMap
            A new cubemap with `levels` and `roughness`, of the same dtype, channels, `mipmaps` and `encoding`. The outputs of
            a capture are left out. `set_face` raises ValueError for it, since the levels would not belong to the new face;
            `resize` leaves the levels out, and so do files and `to_layout`. Copies, pickles and comparisons include the levels.

        Raises
        ------
        ValueError
            For a number of levels or a size outside its limits.
        TypeError
            For numbers that are not whole, or a `progress` that cannot be called.

        Notes
        -----
        The weight of the radiance from l is ``D(h) (N.l)`` with ``V = N`` and ``h = normalize(N + l)``, and the mean is
        divided by the sum of weights (B. Karis, "Real Shading in Unreal Engine 4", 2013); D is that of glTF 2.0, appendix
        B.3.2, with ``alpha = roughness^2``. All texels are summed, with their solid angles: there is no noise. Alpha is
        filtered as a channel, and numbers are taken as they are, also with ``encoding="srgb"``.

        The texels along an edge of a level are the power of two that is nearest, in ratio, to ``25.6 / roughness``, at least
        32, and at most `size`: 128 at .2, 64 at .4, 32 from .6 on. Each texel is adjusted so that bilinear lookups, which
        flatten peaks, are right on average: they differ from the sum over all texels of a 256 x 256 photograph by .3 % rms.

        NaN counts as 0, infinity as 65504, the largest float16.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> faces = np.zeros((6, 64, 64, 3), np.float32)
        >>> faces[cc.Face.POS_Y] = 1  # light from above
        >>> cube = cc.CubeMap(faces).prefilter(levels=3)
        >>> [level.shape for level in cube.levels]
        [(6, 64, 64, 3), (6, 64, 64, 3), (6, 32, 32, 3)]
        >>> cube.roughness.tolist()
        [0.0, 0.5, 1.0]
        >>> cc.CubeMap(cube.levels[2]).sample([0, 1, 0]).round(2)
        array([0.55, 0.55, 0.55], dtype=float32)
        """

    def resize(
        self: CubeMap, size: typing.SupportsIndex, *, dtype: np.typing.DTypeLike | None = None
    ) -> CubeMap:
        """
        Resample the faces to another size.

        Parameters
        ----------
        size : int
            Texels along an edge of the new faces. Smaller faces average the area of each texel; larger faces are
            bilinear and have no seams.
        dtype : dtype, optional
            "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

        Returns
        -------
        CubeMap
            A new cube in `dtype`, rounded as `to_equirect` rounds, with the same `mipmaps` and `encoding`. Its outputs are
            the nearest texels of this cube's outputs.

        Raises
        ------
        ValueError
            For a size below 1, or another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).resize(2).faces.shape
        (6, 2, 2, 3)
        """

    def rotate(self: CubeMap, rotation: np.typing.ArrayLike) -> CubeMap:
        """
        Turn what this cube shows.

        The result shows in the direction R d what this cube shows in d, as ``Scene.environment_rotation`` turns an
        environment. ``renderer.capture(scene, rotation=q).rotate(q)`` shows the scene in the world's axes again.

        Parameters
        ----------
        rotation : array_like (4,)
            The quaternion (w, x, y, z) of R, of any length except 0, as `axis_angle` gives.

        Returns
        -------
        CubeMap
            A new cube of the same size, dtype, `mipmaps`, `encoding` and `levels`. A rotation that brings axes to axes, such
            as a quarter turn, copies texels; others filter each texel over its footprint, and round as `to_equirect` does.
            Outputs are the nearest texels of this cube's outputs: normals and positions stay vectors of the scene's world,
            "z" is converted to the axes of the new faces, and "depth" stays as the capture drew it.

        Raises
        ------
        ValueError
            For a quaternion of length 0, another shape, or numbers that are not finite.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cube = cc.CubeMap(np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1))  # each face its number
        >>> turned = cube.rotate(cc.axis_angle((0, 1, 0), 90))  # +Z goes to +X
        >>> float(cube.sample([0, 0, 1])[0]), float(turned.sample([1, 0, 0])[0])
        (4.0, 4.0)
        """

    @typing.overload
    def sample(
        self: CubeMap, directions: np.typing.ArrayLike, *, lod: np.typing.ArrayLike = 0.0
    ) -> np.typing.NDArray[np.float32]:
        """
        Look up directions, bilinear and without seams.

        The numbers are those of GLSL ``textureLod`` with GL_LINEAR and GL_TEXTURE_CUBE_MAP_SEAMLESS (OpenGL 4.6,
        section 8.14): a texel beyond an edge is taken from the neighbouring face; the fourth texel at a corner, where
        only three meet, is the average of these three.

        Parameters
        ----------
        directions : array_like (..., 3)
            Directions from the center of the cube outwards, in world axes, of any length except 0.
        lod : float or array_like (...,), default 0
            Level of detail: 0 is `faces`, each further level has half the size. Levels other than 0 need
            ``mipmaps=True``; they are looked up trilinearly and clamped to the levels of the cube.

        Returns
        -------
        ndarray (..., C) float32
            A new array; uint8 is looked up as value/255.

        Raises
        ------
        ValueError
            For a direction that is not finite or has length 0, a `lod` other than 0 without mipmaps, or a `lod`
            of another shape.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> faces = np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1).repeat(4, 1).repeat(4, 2)
        >>> cube = cc.CubeMap(faces)
        >>> cube.sample([[1, 0, 0], [0, -1, 0], [1, 0, 1]]).ravel()
        array([0., 3., 2.], dtype=float32)
        """

    @typing.overload
    def sample(
        self: CubeMap,
        directions: np.typing.ArrayLike,
        *,
        lod: np.typing.ArrayLike = 0.0,
        output: str = "color",
    ) -> np.typing.NDArray[np.float32 | np.int32 | np.uint8]:
        """
        Look up an output of a capture: its nearest texels.

        Parameters
        ----------
        directions : array_like (..., 3)
            Directions from the center of the cube outwards, in world axes, of any length except 0.
        lod : float, default 0
            0; outputs have one level.
        output : str, default "color"
            "color", or a name in `outputs`, such as "distance", "normal" or "id".

        Returns
        -------
        ndarray (...) or (..., channels) in the output's dtype
            A new array. Each entry is the texel that the direction meets; no two are mixed.

        Raises
        ------
        ValueError
            For a direction that is not finite or has length 0, another `lod`, or an output that the cube does not have.
        """

    def save(
        self,
        path: str | os.PathLike[str] | collections.abc.Sequence[str | os.PathLike[str]],
        *,
        layout: FileLayout | None = None,
        convention: Convention | None = None,
        width: int | None = None,
        center: Center = "-z",
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        srgb: bool | None = None,
        half: bool = False,
        output: str = "color",
        compression: Compression | None = None,
    ) -> None:
        """
        Write a cubemap as one picture or six files. The method `CubeMap.save`.

        A file of 8 bits holds what a screen shows: linear floats are mapped by the tone curve, then everything linear is
        sRGB-encoded. EXR and HDR hold linear numbers; KTX2 and DDS hold the cube's own, with filtered levels
        (`CubeMap.levels` of `prefilter`), which other kinds leave out.

        Parameters
        ----------
        path : path, sequence of six paths, or a name with {face}
            The extension names the kind of file, as in `save_image`, or .ktx2, .dds, .env (Babylon.js: filtered by
            roughness, in Babylon's own steps) or .json (the numbers of `sh`). {face} becomes px nx py ny pz nz. {level}
            becomes 0, 1, ...: a name such as "sky/{level}_{face}.hdr" stands for six files of each filtered level.
        layout : str, optional
            "cross", "vertical_cross", "row", "column", "equirect" or "openexr" for one picture ("cross" if None);
            "faces" or None for six files. "openexr" is OpenEXR's environment cube: a column of "inside" faces with
            samples on the borders and the `envmap` attribute, .exr only.
        convention : {"gl", "inside", "three"}, optional
            How the faces are stored; "gl" by default ("inside" for "openexr").
        width : int, optional
            Width of an equirect in pixels, an even number. None: 4 times the face size.
        center : {"-z", "+z", "+x", "-x"}
            The direction in the middle of an equirect.
        exposure : float
            Stops: colours are multiplied by ``2**exposure``.
        tonemap : {"neutral", "reinhard", "aces"} or None
            The curve for linear floats, see `to_screen`. None clips, with a warning.
        srgb : bool, optional
            False writes the numbers as they are; None and True as described above.
        half : bool
            True stores an EXR with 16 bits a number.
        output : str
            "color", or the name of an output in `outputs`, such as "distance", "normal" and "id". Its numbers are written
            to .exr as they are, as floats or whole numbers of 32 bits, in any layout, and never mixed (`to_equirect`).
        compression : {"zstd", "zlib"}, optional
            How the levels of a .ktx2 file are packed. "zstd" needs the package of the extra "ktx2".

        Raises
        ------
        OSError
            If a folder does not exist or may not be written, or the disk is full. The old files stay as they were.
        ValueError
            For unknown names, options that do not go together, numbers that the file cannot hold, or an output that the
            cube does not have.

        Notes
        -----
        Cells of a cross without a face are 0. A cubemap of float16 is written to EXR as half.

        A KTX2 or DDS file holds uint8 as it is, in a format of the cube's `encoding`, and floats as light; three channels
        become four. Level k has N >> k texels an edge; filtered levels of other sizes are resized. The file says
        that its levels are filtered (docs/conventions.md), and `load_cubemap` reads them back. A cube with ``mipmaps=True``
        and without filtered levels gets plain mipmaps, all others one level. Fewer levels than N has powers of two keep the
        last one from becoming too small: `prefilter` with log2(N) - 3 of them ends at 16 texels.

        Examples
        --------
        >>> import cubecam as cc, tempfile, pathlib
        >>> folder = pathlib.Path(tempfile.mkdtemp())
        >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=32)
        >>> cube.save(folder / "probe.exr", layout="cross", convention="inside")
        >>> cc.load_cubemap(folder / "probe.exr", convention="inside") == cube
        True
        """

    def save_for(self, engine: Engine, folder: str | os.PathLike[str]) -> list[pathlib.Path]:
        """
        Write light for an engine: files that it loads, the right way round. The method `CubeMap.save_for`.

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

    def set_face(
        self: CubeMap,
        face: Face | typing.SupportsIndex | FaceName,
        pixels: np.typing.ArrayLike,
        *,
        convention: Convention = "gl",
    ) -> None:
        """
        Replace one face.

        Only this face is uploaded to the GPU again, and only if its pixels differ from the old ones.

        Parameters
        ----------
        face : Face, int from 0 to 5, or str
            The face, named in `convention`. A str is "+x", "px" or "pos_x", and so on.
        pixels : array_like (N, N, C)
            The new pixels, in the cube's size, channels and dtype.
        convention : {"gl", "inside", "three"}, default "gl"
            The convention of `pixels` and `face`.

        Raises
        ------
        ValueError
            For another shape, NaN, or an unknown face, or if `prefilter` made this cube: its levels would not belong to
            the new face. ``CubeMap(cube.faces)`` has no levels.
        TypeError
            For another dtype (float64 counts as float32).
        IndexError
            For a number outside 0 to 5.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cube = cc.CubeMap(np.zeros((6, 2, 2, 1), np.uint8))
        >>> cube.set_face("+y", np.full((2, 2, 1), 255, np.uint8))
        >>> cube.sample([0, 1, 0])
        array([1.], dtype=float32)
        """

    def sh(self: CubeMap, order: typing.SupportsIndex = 2) -> np.typing.NDArray[np.float64]:
        """
        Project the light onto spherical harmonics.

        Parameters
        ----------
        order : int, default 2
            The highest order, 0 to 64.

        Returns
        -------
        ndarray ((order + 1)^2, C) float64
            The integral of radiance times basis function over the sphere: the sum over texels, weighted by their exact solid
            angles; uint8 as value/255. Row ``l (l + 1) + m`` belongs to the real orthonormal function of order l and degree m:
            Y00 = .282095; then .488603 times y, z, x; then 1.092548 xy, 1.092548 yz, .315392 (3zz - 1), 1.092548 xz,
            .546274 (xx - yy); and so on. NaN counts as 0, infinity as 65504.

        Raises
        ------
        ValueError
            For an order outside its limits.

        See Also
        --------
        from_sh : the inverse, for light that has no more than these orders.

        Notes
        -----
        P.-P. Sloan, "Stupid Spherical Harmonics (SH) Tricks", 2008. The irradiance divided by pi has the coefficients of order
        0, 1 and 2 times 1, 2/3 and 1/4 (R. Ramamoorthi and P. Hanrahan, "An efficient representation for irradiance environment
        maps", 2001).

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> coefficients = cc.CubeMap(np.ones((6, 8, 8, 1), np.float32)).sh()
        >>> coefficients.shape, float(coefficients[0, 0].round(4))  # sqrt(4 pi)
        ((9, 1), 3.5449)
        """

    def show(
        self,
        where: Place | None = None,
        *,
        mode: CubeMode = "cross",
        size: tuple[int, int] = (800, 600),
        convention: Convention = "inside",
        center: Center = "-z",
        level: int = 0,
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        seams: bool = False,
        names: bool = True,
        smooth: bool = True,
        background: Theme = "dark",
        browser: bool = True,
        block: bool | None = None,
    ) -> cubecam.viewer.cube_view.CubeView:
        """
        Show the cube live: as a cross, as a panorama, or from inside. The method `CubeMap.show`.

        Dragging moves the cross and the panorama and turns the look; the wheel zooms; a double click looks at the place
        that was clicked; the key h lists the keys. The text under the picture says what is under the pointer: face, row and
        column in the three conventions "gl", "inside" and "three", direction, and value as linear floats.

        Parameters
        ----------
        where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
            Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
            for a browser on this machine.
        mode : {"cross", "panorama", "look"}
            How the cube is shown first; a control of the panel and the keys 1, 2 and 3 change it.
        size : (int, int)
            Width and height of the picture in logical pixels.
        convention : {"inside", "gl", "three"}
            The convention of the faces in the cross.
        center : {"-z", "+z", "+x", "-x"}
            The direction in the middle of the panorama.
        level : int
            The level that is shown first. A cube with ``mipmaps=True`` has levels.
        exposure : float
            Stops: the light is multiplied by ``2**exposure``.
        tonemap : {"neutral", "reinhard", "aces"} or None
            The curve for linear floats, see `to_screen`.
        seams : bool
            Whether the edges show how much the cube changes over them: blue where the step over the edge is no more than
            the steps beside it, red from 2.5 times as much (`cc.plot.seams`).
        names : bool
            Whether the faces show their names.
        smooth : bool
            True shows bilinear lookups in the panorama and the look, as a shader's; False shows each texel.
        background : {"dark", "light"}
            The colour around the faces.
        browser : bool
            Whether a page is opened in the browser.
        block : bool, optional
            Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
            notebooks and in Python's prompt no.

        Returns
        -------
        CubeView
            The live view, whose properties have the names of these options.

        Raises
        ------
        ValueError
            For an unknown name, or a level that the cube does not have.
        TypeError
            For a value of another type.
        ImportError
            If a package is missing; the message names the extra of cubecam that has it.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=64)
        >>> with cube.show("offscreen", mode="look") as view:
        ...     view.yaw, view.exposure = 30, 1
        ...     picture = view.draw()
        >>> picture.shape
        (600, 800, 4)
        """

    def to_angular_map(
        self,
        size: int | None = None,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make an angular map, the form of Debevec's light probe images.

        Parameters
        ----------
        size : int, optional
            Pixels of an edge of the square picture. None: as many as keep the resolution in the middle.
        direction, up, dtype, output
            As in `to_perspective`.

        Returns
        -------
        ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
            A new array, row 0 on top: a disc with `direction` in the middle and the opposite direction all round its rim.
            Pixels whose centre lies outside the disc are 0, in all channels, and of an output the value of the background.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`.

        Notes
        -----
        It is the "equidistant" fisheye of 360 degrees: the distance from the middle is in proportion to the angle from
        `direction`. P. Debevec, Light Probe Image Gallery: ``r = acos(Dz) / (pi sqrt(Dx^2 + Dy^2))``, u = Dx r, v = Dy r,
        with Dx to the right, Dy up and Dz forward.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_angular_map(100).shape
        (100, 100, 3)
        """

    @typing.overload
    def to_convention(
        self: CubeMap, convention: Convention
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        Convert the six faces to another convention.

        Parameters
        ----------
        convention : {"gl", "inside", "three"}
            The convention of the result.

        Returns
        -------
        ndarray (6, N, N, C) in `dtype`
            A copy. ``CubeMap(array, convention=convention)`` makes exactly this cube again.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cube = cc.CubeMap(np.random.default_rng(1).random((6, 4, 4, 3)).astype("float32"))
        >>> cc.CubeMap(cube.to_convention("three"), convention="three") == cube
        True
        """

    @typing.overload
    def to_convention(
        self: CubeMap, convention: Convention, *, output: str = "color"
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Convert the faces of an output to another convention.

        Its texels move as those of the colours do. The numbers stay as they are: normals and positions are world vectors in
        every convention.

        Parameters
        ----------
        convention : {"gl", "inside", "three"}
            The convention of the result.
        output : str, default "color"
            "color", or a name in `outputs`.

        Returns
        -------
        ndarray (6, N, N) or (6, N, N, channels) in the output's dtype
            A copy.

        Raises
        ------
        ValueError
            For an unknown convention, or an output that the cube does not have.
        """

    def to_cylindrical(
        self,
        size: int | tuple[int, int] | None = None,
        *,
        fov: float = 360.0,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make a panorama on a cylinder round `up`, on which vertical lines stay straight and upright.

        Parameters
        ----------
        size : int or (int, int), optional
            (width, height), or the width of a picture that shows 45 degrees up and down. None: the width that keeps the
            resolution in the middle.
        fov : float
            The horizontal field of view in degrees, above 0 and up to 360.
        direction, up, dtype, output
            As in `to_perspective`. The cylinder stands along what is at right angles to `direction` on the side of `up`.

        Returns
        -------
        ndarray (height, width, C), or (height, width) and (height, width, channels) of an output
            A new array, row 0 on top. Straight up and down are outside of every picture.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`.

        Notes
        -----
        "Cylindrical" of Hugin and PanoTools: x is in proportion to the longitude, y to the tangent of the latitude, with
        square pixels in the middle. With f = width / fov pixels and fov in radians, the picture shows latitudes up to
        ``atan(height / (2 f))``.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_cylindrical().shape
        (64, 201, 3)
        """

    def to_dual_paraboloid(
        self,
        size: int | None = None,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make a dual paraboloid map: two discs of half the world each, side by side.

        Parameters
        ----------
        size : int, optional
            Pixels of an edge of each half. None: twice the size of the cube.
        direction, up, dtype, output
            As in `to_perspective`. The left half looks in `direction`, the right half back, with the same `up`.

        Returns
        -------
        ndarray (size, 2 size, C), or (size, 2 size) and (size, 2 size, channels) of an output
            A new array, row 0 on top; neither half is mirrored. Pixels whose centre lies outside the discs are 0, in all
            channels, and of an output the value of the background.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`.

        Notes
        -----
        W. Heidrich and H.-P. Seidel, View-independent Environment Maps, Graphics Hardware 1998: a direction (x, y, z) along
        right, up and forward of a half is shown at ``(x, y) / (1 + z)``. The right axis of the half that looks back is
        the left one of the other half. Where a shader uses the same x for both, flip the right half left-right.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_dual_paraboloid().shape
        (128, 256, 3)
        """

    @typing.overload
    def to_equirect(
        self: CubeMap,
        *,
        width: typing.SupportsIndex | None = None,
        center: Center = "-z",
        sampling: Sampling = "centers",
        dtype: np.typing.DTypeLike | None = None,
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        Make an equirectangular panorama of this cube.

        The panorama is not mirrored; row 0 is at +Y. Each texel is filtered over its footprint, so that a smaller
        panorama does not alias; a larger one is bilinear and has no seams.

        Parameters
        ----------
        width : int, optional
            Pixels of a row, an even number. None: 4 * size, which keeps the resolution.
        center : {"-z", "+z", "+x", "-x"}, default "-z"
            The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
        sampling : {"centers", "borders"}, default "centers"
            Where samples lie. "centers": in the middle of each texel. "borders": the first and last row and column
            lie on the edges, as in OpenEXR's latitude-longitude maps.
        dtype : dtype, optional
            "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

        Returns
        -------
        ndarray (width / 2, width, C) in `dtype`
            A new array. Numbers are filtered in float32, with uint8 as value/255, then rounded to nearest. In uint8,
            numbers below 0 become 0 and numbers above 1 become 255; in float16, numbers above 65504 become inf.

        Raises
        ------
        ValueError
            For a width that is not even and positive, an unknown center or sampling, or another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> panorama = cc.CubeMap(np.ones((6, 16, 16, 4), np.float16)).to_equirect(center="+z")
        >>> panorama.shape, panorama.dtype.name
        ((32, 64, 4), 'float16')
        """

    @typing.overload
    def to_equirect(
        self: CubeMap,
        *,
        width: typing.SupportsIndex | None = None,
        center: Center = "-z",
        sampling: Sampling = "centers",
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make a panorama of an output of a capture.

        Outputs are not filtered, since a mixture of two distances or ids belongs to no surface: each pixel is the
        texel that its direction meets.

        Parameters
        ----------
        width, center, sampling
            As for the colours.
        dtype : None
            An output keeps its dtype.
        output : str, default "color"
            "color", or a name in `outputs`. "distance" is the length of the ray, as panoramas of depth hold it. "z" and "depth"
            are measured along the axis of the face on which the direction lies. Normals and positions are world
            vectors.

        Returns
        -------
        ndarray (width / 2, width) or (width / 2, width, channels) in the output's dtype
            A new array.

        Raises
        ------
        ValueError
            For a width that is not even and positive, an unknown center or sampling, a dtype, or an output that the
            cube does not have.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> ball = scene.add(cc.Mesh.sphere(1), position=(0, 0, -4))
        >>> with cc.Renderer() as renderer:
        ...     cube = renderer.capture(scene, size=64, outputs=("distance", "id"))
        >>> distances = cube.to_equirect(output="distance")
        >>> distances.shape, float(distances[0, 0])
        ((128, 256), inf)
        >>> sorted(set(cube.to_equirect(output="id").ravel().tolist())) == [0, ball.id]
        True
        """

    def to_fisheye(
        self,
        size: int | None = None,
        *,
        fov: float = 180.0,
        model: FisheyeModel = "equidistant",
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make the circular picture of a fisheye lens.

        Parameters
        ----------
        size : int, optional
            Pixels of an edge of the square picture; the circle touches its four sides. None: as many as keep the resolution
            in the middle.
        fov : float
            The field of view across the circle in degrees: above 0, up to 360 ("equidistant", "equisolid"), below 360
            ("stereographic") or up to 180 ("orthographic").
        model : {"equidistant", "equisolid", "stereographic", "orthographic"}
            How far from the middle an angle a from `direction` is shown: in proportion to a, sin(a/2), tan(a/2) or sin(a).
        direction, up, dtype, output
            As in `to_perspective`.

        Returns
        -------
        ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
            A new array, row 0 on top. Pixels whose centre lies outside the circle are 0, in all channels, and of an output
            the value of the background.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`, and for an unknown model.

        Notes
        -----
        These are the lens models of Hugin and PanoTools (their "fisheye" is "equidistant"), which are those of Ray,
        Applied Photographic Optics, 2002: r = f a, 2 f sin(a/2), 2 f tan(a/2) and f sin(a).

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> up = cube.to_fisheye(101, direction=(0, 1, 0), up=(0, 0, -1))
        >>> up.shape, float(up[0, 0].max())
        ((101, 101, 3), 0.0)
        """

    @typing.overload
    def to_layout(
        self: CubeMap,
        layout: Layout = "cross",
        *,
        convention: Convention = "gl",
        dtype: np.typing.DTypeLike | None = None,
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        Arrange all faces in one picture.

        Parameters
        ----------
        layout : {"cross", "vertical_cross", "row", "column", "equirect", "openexr"}, default "cross"
            "cross" (or "horizontal_cross") is 4N x 3N. Its middle row is -X +Z +X -Z from left to right (-X -Z +X +Z
            for "inside"); +Y is above and -Y below the second cell. "vertical_cross" is 3N x 4N, with the last face of
            that row below -Y, turned by 180 degrees. "row" and "column" have the faces in their order. "equirect" is
            ``to_equirect()``. "openexr" is OpenEXR's cube: a column of "inside" faces, resampled so that their samples
            lie on the borders.
        convention : {"gl", "inside", "three"}, default "gl"
            The convention of the faces in the picture. "equirect" and "openexr" ignore it.
        dtype : dtype, optional
            "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

        Returns
        -------
        ndarray (H, W, C) in `dtype`
            A new array; cells without a face are 0. Numbers that change their dtype or are resampled are rounded as
            `to_equirect` rounds them.

        Raises
        ------
        ValueError
            For an unknown layout or convention, or another dtype.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).to_layout("cross", convention="inside").shape
        (24, 32, 3)
        """

    @typing.overload
    def to_layout(
        self: CubeMap,
        layout: Layout = "cross",
        *,
        convention: Convention = "gl",
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Arrange all faces of an output in one picture.

        Its texels move as those of the colours do, and are never mixed, in "equirect" and "openexr", too.

        Parameters
        ----------
        layout, convention
            As for the colours.
        dtype : None
            An output keeps its dtype.
        output : str, default "color"
            "color", or a name in `outputs`.

        Returns
        -------
        ndarray (H, W) or (H, W, channels) in the output's dtype
            A new array; cells without a face are 0.

        Raises
        ------
        ValueError
            For an unknown layout or convention, a dtype, or an output that the cube does not have.
        """

    def to_mirror_ball(
        self,
        size: int | None = None,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make the picture of a mirror ball, photographed from far away.

        Parameters
        ----------
        size : int, optional
            Pixels of an edge of the square picture, whose sides the ball touches. None: twice the size of the cube.
        direction, up : array_like (3,)
            The direction in which the camera looks at the ball. The middle of the ball shows what lies behind the camera.
        dtype, output
            As in `to_perspective`.

        Returns
        -------
        ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
            A new array, row 0 on top. It is mirrored, as the ball mirrors the world. Pixels whose centre lies outside the
            ball are 0, in all channels, and of an output the value of the background.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`.

        Notes
        -----
        P. Debevec, Rendering Synthetic Objects into Real Scenes, SIGGRAPH 1998: a ray that looks forward is reflected at
        the normal ``x right + y up - sqrt(1 - x^2 - y^2) forward``. It goes to
        ``2 n x right + 2 n y up + (2 x^2 + 2 y^2 - 1) forward`` with ``n = sqrt(1 - x^2 - y^2)``.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_mirror_ball().shape
        (128, 128, 3)
        """

    def to_octahedral(
        self,
        size: int | None = None,
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make an octahedral map: all directions in a square without empty corners.

        Parameters
        ----------
        size : int, optional
            Pixels of an edge of the square picture. None: twice the size of the cube.
        direction, up, dtype, output
            As in `to_perspective`; the opposite of `direction` is in the four corners.

        Returns
        -------
        ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
            A new array, row 0 on top.

        Raises
        ------
        ValueError, TypeError
            As `to_perspective`.

        Notes
        -----
        Z. Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014, "oct": for a
        direction (x, y, z) along right, up and forward, ``p = (x, y) / (|x| + |y| + |z|)``, and where z is below 0
        ``p = (1 - |p.yx|) * sign(p)``. Engines whose maps have the world's up in the middle have
        ``direction=(0, 1, 0)``.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_octahedral().shape
        (128, 128, 3)
        """

    def to_perspective(
        self,
        fov: float,
        size: int | tuple[int, int],
        *,
        direction: np.typing.ArrayLike = (0, 0, -1),
        up: np.typing.ArrayLike = (0, 1, 0),
        dtype: np.typing.DTypeLike | None = None,
        output: str = "color",
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
        """
        Make the picture that a camera in the cube's centre takes.

        It is the picture that ``Renderer.render`` gives for ``PerspectiveCamera(fov=fov)`` of that place and direction, up
        to the resolution of the cube.

        Parameters
        ----------
        fov : float
            The vertical field of view in degrees, above 0 and below 180.
        size : int or (int, int)
            Pixels of an edge of a square picture, or (width, height).
        direction, up : array_like (3,)
            The direction in the middle of the picture, and what the picture shows above it; `up` is not along `direction`.
        dtype : dtype, optional
            "uint8", "float16" or "float32". None: that of the cube. Numbers are rounded as `to_equirect` rounds them.
        output : str
            "color", or a name in `outputs`: its nearest texels, in its own dtype.

        Returns
        -------
        ndarray (height, width, C), or (height, width) and (height, width, channels) of an output
            A new array, row 0 on top. Each pixel is filtered over its footprint.

        Raises
        ------
        ValueError
            For a field of view, size, direction or output that does not exist.
        TypeError
            For arguments of another type.

        Notes
        -----
        The pixel of row i and column j of W x H lies at x = 2 (j + .5) / W - 1, y = 1 - 2 (i + .5) / H; it shows the
        direction ``forward + tan(fov / 2) (x W/H right + y up)``.

        Examples
        --------
        >>> import cubecam as cc
        >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
        >>> cube.to_perspective(60, (80, 60), direction=(1, 0, 0)).shape
        (60, 80, 3)
        """

    @property
    def channels(self) -> int:
        """
        int: C, 1, 3 or 4.
        """

    @property
    def depth(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: OpenGL's window-space z with the precision of ``depth_format``, 0 at the near plane, 1 at the far plane and in the background.
        """

    @property
    def distance(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: length of the ray, world units; +inf background. In an orthographic picture it counts from the near plane.
        """

    @property
    def dtype(self) -> np.dtype[np.uint8 | np.float16 | np.float32]:
        """
        numpy.dtype: uint8, float16 or float32.
        """

    @property
    def encoding(self) -> Encoding:
        """
        str: "linear" or "srgb", what the numbers of `faces` are.
        """

    @property
    def faces(self) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        ndarray (6, N, N, C) in `dtype`: the pixels, in the convention "gl".

        The array is a read-only view. It stays valid without the cube, and keeps its values when the cube changes. To change
        texels, take a copy, ``cube.numpy(writable=True)``, and make a CubeMap of it, or give one face to `set_face`.
        """

    @property
    def id(self) -> np.typing.NDArray[np.int32]:
        """
        ndarray (6, N, N) int32, read-only, of a capture that requested it, or None: ``Node.id`` of the visible node; 0 background.
        """

    @property
    def label(self) -> np.typing.NDArray[np.int32]:
        """
        ndarray (6, N, N) int32, read-only, of a capture that requested it, or None: ``Node.label`` of the visible node; 0 background.
        """

    @property
    def levels(self) -> tuple[np.typing.NDArray[np.uint8 | np.float16 | np.float32], ...]:
        """
        ndarray (6, M, M, C) in `dtype`, read-only, of each level, in a tuple: the filtered faces.

        Level 0 is `faces`; level k holds the faces filtered for ``roughness[k]``, in the convention "gl". A cubemap that
        `prefilter` did not make has one level. The levels of `mipmaps` are others, and `sample` looks those up.
        """

    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups are trilinear.
        """

    @property
    def normal(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (6, N, N, 3) float32, read-only, of a capture that requested it, or None: world shading normal, unit length, towards the viewer; 0 background.
        """

    @property
    def outputs(self) -> dict[str, np.typing.NDArray[np.float32 | np.int32 | np.uint8]]:
        """
        dict of str to ndarray: the outputs of a capture besides `faces`, by name. The arrays are read-only.

        The dict holds the built-in outputs, which are attributes as well, and the outputs that a ``ShaderMaterial``
        declares, such as `out vec4 heat;`: float32 (6, N, N, 4), with fewer channels for vec3 and vec2 and
        (6, N, N) for float. A declared output is 0 where the visible node does not write it.
        """

    @property
    def position(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (6, N, N, 3) float32, read-only, of a capture that requested it, or None: world position; NaN background.
        """

    @property
    def roughness(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (L,) float32, read-only: the roughness of each of `levels`, from 0 to 1.

        A cubemap that `prefilter` did not make has one level, whose roughness is 0.
        """

    @property
    def size(self) -> int:
        """
        int: N, texels along an edge of a face.
        """

    @property
    def stencil(self) -> np.typing.NDArray[np.uint8]:
        """
        ndarray (6, N, N) uint8, read-only, of a capture that requested it, or None: the stencil buffer after all drawing; 0 background.
        """

    @property
    def z(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (6, N, N) float32, read-only, of a capture that requested it, or None: distance along the camera's axis, or a face's, world units; +inf background.
        """

class Image:
    """
    A picture that a material shows. It never changes.
    
    `StandardMaterial` decodes 8-bit pictures in its maps of colours. All other materials compute with the
    numbers as they are (uint8 as value/255): for these, under lights, decode an 8-bit photograph with
    ``load_image(path, srgb=True)`` first; see docs/conventions.md, "Encoding".
    
    Parameters
    ----------
    pixels : array_like (H, W, C)
        1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
        becomes float32. uv (0, 0) is the bottom-left corner.
    mipmaps : bool
        True: lookups are trilinear, for pictures that appear small. False: lookups are bilinear.
    wrap : {"repeat", "clamp", "mirror"} or a pair of these
        What lookups outside 0..1 return, along both axes or along u and v: "repeat" repeats the picture, "clamp"
        its border, "mirror" repeats it with every other copy mirrored.
    encoding : {"linear", "srgb"}, optional
        What the numbers are: how pictures of it are saved and shown, and whether a map of colours of
        `StandardMaterial` decodes its 8-bit numbers. None: that of the Frame or Image given as `pixels`; for an
        array, "srgb" for uint8, else "linear".
    mag_filter : {"linear", "nearest"}
        What a lookup takes where a texel is larger than a pixel: a mix of four texels, or the nearest one.
    min_filter : {"linear", "nearest", "linear_mipmap_linear", "linear_mipmap_nearest", "nearest_mipmap_linear", \\
    "nearest_mipmap_nearest"}, optional
        The same where a texel is smaller than a pixel. The last four use mip levels: the first word says how a
        level is looked up, the last one whether two levels are mixed. None: "linear_mipmap_linear" with
        `mipmaps`, else "linear".
    
    Raises
    ------
    TypeError
        For pixels of another type.
    ValueError
        For another shape, an image without pixels, NaN, another name, or `mipmaps` with a `min_filter` that uses
        no levels.
    
    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> checks = np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.uint8(255)
    >>> image = cc.Image(checks.astype(np.uint8), wrap="clamp")
    >>> image.size, image.channels, image.dtype, image.encoding
    ((8, 8), 1, dtype('uint8'), 'srgb')
    """

    def __array__(
        self, dtype: np.dtype[np.generic] | None = None, copy: bool | None = None
    ) -> np.typing.NDArray[np.generic]:
        """
        Give the picture's numbers to ``numpy.asarray``: the colour of a frame, the faces of a cubemap.

        Parameters
        ----------
        dtype : dtype, optional
            None: that of the picture.
        copy : bool, optional
            True: always a copy. False: never; raises ValueError if `dtype` needs one. None: a copy if `dtype` needs one.

        Returns
        -------
        ndarray (H, W, C), of a cubemap (6, N, N, C)
            Without a copy, that of a cubemap or an image is read-only.

        Raises
        ------
        ValueError
            For a frame without a colour, or a copy that is not allowed.
        """

    def __copy__(self: Image) -> Image: ...
    def __deepcopy__(self: Image, memo: dict[int, object]) -> Image: ...
    def __dlpack__(
        self,
        *,
        stream: object = None,
        max_version: tuple[int, int] | None = None,
        dl_device: tuple[int, int] | None = None,
        copy: bool | None = None,
    ) -> object:
        """
        Give the picture's numbers to ``from_dlpack`` of numpy, torch, jax and others (DLPack, array API 2023.12).

        A frame's colour is shared. The numbers of a cubemap and an image must not change: they are shared as read-only if
        the reader knows version 1 of DLPack, which can say so, and are copied otherwise.
        """

    def __dlpack_device__(self) -> tuple[int, int]:
        """
        Give the device of the numbers to ``from_dlpack``: main memory.
        """

    def __init__(
        self: Image,
        pixels: np.typing.ArrayLike,
        *,
        mipmaps: bool = False,
        wrap: Wrap | tuple[Wrap, Wrap] = "repeat",
        encoding: Encoding | None = None,
        mag_filter: MagFilter = "linear",
        min_filter: MinFilter | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
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
    def dtype(self) -> np.dtype[np.uint8 | np.float16 | np.float32]:
        """
        numpy.dtype: uint8, float16 or float32.
        """

    @property
    def encoding(self) -> Encoding:
        """
        str: "linear" or "srgb", what the numbers are.
        """

    @property
    def mag_filter(self) -> MagFilter:
        """
        str: "linear" or "nearest", for texels larger than a pixel.
        """

    @property
    def min_filter(self) -> MinFilter:
        """
        str: for texels smaller than a pixel; with mip levels "linear_mipmap_linear" or the like.
        """

    @property
    def mipmaps(self) -> bool:
        """
        bool: whether lookups use mip levels.
        """

    @property
    def pixels(self) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        ndarray (H, W, C): a read-only view, row 0 on top.
        """

    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height).
        """

    @property
    def wrap(self) -> Wrap | tuple[Wrap, Wrap]:
        """
        str, or a pair for u and v: "repeat", "clamp" or "mirror".
        """

class MorphTarget:
    """
    A change of a mesh's shape: what a weight of 1 adds to each vertex.

    A mesh has any number of them, and each node its own `Node.weights`. Normals and tangents get unit length
    afterwards, and colours are limited to 0 to 1. Smooth normals that the mesh computed are computed again for
    the changed shape. A kind of numbers that the mesh itself does not have, for example colours, has no effect.
    Morph targets never change.

    Parameters
    ----------
    positions : array_like (V, 3), optional
        Added to the positions, one row for each vertex of the mesh. None: positions stay; so do all others.
    normals : array_like (V, 3), optional
        Added to the normals.
    tangents : array_like (V, 3), optional
        Added to the first three numbers of the tangents; the sign stays.
    uvs : array_like (V, 2), optional
        Added to the texture coordinates.
    colors : array_like (V, 3) or (V, 4), optional
        Added to the colours; three numbers leave alpha as it is.
    uvs1 : array_like (V, 2), optional
        Added to the second texture coordinates.
    name : str
        A name for people.

    Raises
    ------
    ValueError
        For no array, arrays of unequal lengths, other shapes, NaN or infinity.

    Notes
    -----
    glTF 2.0, section 3.7.2.2.

    Examples
    --------
    >>> import cubecam as cc, numpy as np
    >>> box = cc.Mesh.box(2)
    >>> taller = cc.MorphTarget(positions=np.where(box.positions > 0, (0, 1, 0), 0), name="taller")
    >>> box.morph_targets = [taller]
    >>> node = cc.Scene().add(box, weights=[0.5])
    >>> node.world_bounds.tolist()
    [[-1.0, -1.0, -1.0], [1.0, 1.5, 1.0]]
    """

    def __init__(
        self: MorphTarget,
        *,
        positions: np.typing.ArrayLike | None = None,
        normals: np.typing.ArrayLike | None = None,
        tangents: np.typing.ArrayLike | None = None,
        uvs: np.typing.ArrayLike | None = None,
        colors: np.typing.ArrayLike | None = None,
        uvs1: np.typing.ArrayLike | None = None,
        name: str = "",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: MorphTarget) -> str: ...
    @property
    def colors(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 4) float32 or None: added to the colours; a read-only view.
        """

    @property
    def name(self) -> str:
        """
        str: a name for people.
        """

    @property
    def normals(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 3) float32 or None: added to the normals; a read-only view.
        """

    @property
    def positions(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 3) float32 or None: added to the positions; a read-only view.
        """

    @property
    def tangents(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 3) float32 or None: added to the tangents; a read-only view.
        """

    @property
    def uvs(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 2) float32 or None: added to the texture coordinates; a read-only view.
        """

    @property
    def uvs1(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 2) float32 or None: added to the second texture coordinates; a read-only view.
        """

class Skin:
    """
    Joints that bend a mesh: nodes of a scene, which move the vertices near them.

    A vertex with the joints j and the weights w of the mesh goes to the mean of ``joint[j].world_matrix @
    inverse_bind_matrices[j] @ vertex``, weighted by w. Moving a joint moves the mesh, with no other call. `Node.skin` is
    the attribute that uses a skin; any number of nodes may share one. Skins never change, and do not keep their
    joints alive.

    Parameters
    ----------
    joints : sequence of Node
        Nodes of one scene. None in place of a node stands for one that is gone; pickles may need that.
    inverse_bind_matrices : array_like (J, 4, 4), optional
        For each joint the matrix from the mesh's space to that of the joint, with the last row (0, 0, 0, 1). In most
        cases it is the inverse of the joint's `Node.world_matrix` at the time when the mesh lies at rest. None: unit
        matrices.
    skeleton : Node, optional
        The node above all joints, for files; no picture depends on it.

    Raises
    ------
    TypeError
        For joints that are no nodes.
    ValueError
        For no joint, another number of matrices than joints, or a matrix that is not finite or has another last row.

    Notes
    -----
    glTF 2.0, section 3.7.3. Normals are multiplied by the inverse of the transposed matrix. Where joints mirror, the
    triangles whose corners are mostly mirrored are turned round, so that they stay visible from outside.

    Examples
    --------
    A stick of two bones, whose upper half bends:

    >>> import cubecam as cc, numpy as np
    >>> stick = cc.Mesh.box((0.1, 2, 0.1))
    >>> upper = stick.positions[:, 1] > 0
    >>> stick.update(joints=np.c_[upper, 0 * np.ones((len(upper), 3), int)],
    ...              joint_weights=np.tile((1, 0, 0, 0), (len(upper), 1)))
    >>> scene = cc.Scene()
    >>> root = scene.add(position=(0, -1, 0))
    >>> elbow = scene.add(position=(0, 1, 0), parent=root)
    >>> rest = [np.linalg.inv(joint.world_matrix) for joint in (root, elbow)]
    >>> node = scene.add(stick, skin=cc.Skin([root, elbow], rest))
    >>> elbow.rotation = cc.axis_angle((0, 0, 1), -90)
    >>> node.world_bounds.round(2).tolist()
    [[-0.05, -1.0, -0.05], [1.0, 0.05, 0.05]]
    """

    def __init__(
        self: Skin,
        joints: collections.abc.Iterable[Node | None],
        inverse_bind_matrices: np.typing.ArrayLike | None = None,
        *,
        skeleton: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Skin) -> str: ...
    @property
    def inverse_bind_matrices(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (J, 4, 4) float64: for each joint the matrix from the mesh's space to that of the joint; read-only.
        """

    @property
    def joints(self) -> tuple[Node | None, ...]:
        """
        tuple of Node or None: the nodes that `Mesh.joints` counts from 0; None for a node that is gone.
        """

    @property
    def skeleton(self) -> Node | None:
        """
        Node or None: the node above all joints; no picture depends on it.
        """

class Mesh:
    """
    Indexed triangles, which any number of nodes, scenes and renderers share.

    The vertices can be replaced: `update` replaces several arrays at once. The number of vertices and
    the triangles never change.

    A mesh may have levels of detail, of which calls with ``max_lod_error`` draw one: see `with_levels`.

    Parameters
    ----------
    positions : array_like (V, 3)
        Object-space positions, finite; kept as float32.
    indices : array_like (F, 3) of int
        The three corners of each triangle, counter-clockwise seen from outside, from 0 to V - 1.
    normals : array_like (V, 3), optional
        Outward normals of any length. A normal of length 0 becomes a smooth one. None: all normals are
        smooth: the sum of the triangles' normals, weighted by the angle at the vertex (G. Thuermer and
        C. Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT 3(1), 1998).
    uvs : array_like (V, 2), optional
        Texture coordinates; (0, 0) is a picture's bottom-left corner, (1, 1) its top-right one.
    colors : array_like (V, 3) or (V, 4), optional
        Linear RGB or RGBA, alpha from 0 to 1; uint8 stands for value/255. Materials with
        ``vertex_colors=True`` show them.
    uvs1 : array_like (V, 2), optional
        A second set of texture coordinates, for a `Texture` with ``uv_set=1``.
    tangents : array_like (V, 4), optional
        For normal maps. The first three numbers, of any length, point along +u in the surface; the fourth,
        1 or -1, is the factor of ``cross(normal, tangent)``, which points along +v. None: materials that
        need tangents use those of `with_tangents`.
    joints : array_like (V, 4 k) of int, optional
        For a `Skin`: the numbers of the joints that move each vertex, from 0; k is any number of sets. The
        number of a joint whose weight is 0 means nothing and becomes 0.
    joint_weights : array_like (V, 4 k), optional
        How much each of these joints moves the vertex, 0 or more; given together with `joints`. The weights
        are kept as they are, and divided by their sum where they are used. A vertex without any weight moves
        with joint 0.
    morph_targets : sequence of MorphTarget
        Changes of the shape, which `Node.weights` mixes.
    levels : sequence of (array_like (F, 3) of int, float)
        Levels of detail from fine to coarse: triangles between the same vertices, and the error, see `levels`.

    Raises
    ------
    TypeError
        For arrays of bool, complex, object or str, and for indices that are not integers.
    ValueError
        For other shapes, unequal lengths, NaN or infinity, no triangle, or errors of levels that are negative or decrease.
    IndexError
        For an index outside 0 to V - 1, or a joint outside 0 to 65535.

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
    def arrow(
        length: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        *,
        radius: typing.SupportsFloat | typing.SupportsIndex | None = None,
        head_length: typing.SupportsFloat | typing.SupportsIndex | None = None,
        head_radius: typing.SupportsFloat | typing.SupportsIndex | None = None,
        segments: typing.SupportsIndex = 64,
    ) -> Mesh:
        """
        A closed arrow along +Z, from the origin to (0, 0, length): a cylinder with a cone as its head.

        `Node.look_at` turns +Z, and so the arrow, towards a point. u runs round the shaft and the head as on
        `cylinder`, and v along the arrow, from 0 to 1; the two flat faces show the round middle of a picture.

        Parameters
        ----------
        length : float
            Length from the tail to the tip, above 0.
        radius : float, optional
            Radius of the shaft. None: length / 20.
        head_length : float, optional
            Length of the head, below `length`. None: length / 4.
        head_radius : float, optional
            Radius of the head, above `radius`. None: length / 10.
        segments : int
            Segments round the axis, at least 3.

        Returns
        -------
        Mesh
            6 * segments triangles.

        Raises
        ------
        ValueError
            For a length that is not above 0, a head that is longer than the arrow or thinner than the shaft,
            or too few or too many segments.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.arrow(2).bounds.round(6).tolist()
        [[-0.2, -0.2, 0.0], [0.2, 0.2, 2.0]]
        >>> scene = cc.Scene()
        >>> wind = scene.add(cc.Mesh.arrow(), position=(0, 1, 0))
        >>> wind.look_at((5, 1, 0))
        >>> wind.world_bounds[1].round(6).tolist()
        [1.0, 1.1, 0.1]
        """

    @staticmethod
    def box(size: float | np.typing.ArrayLike = 1.0) -> Mesh:
        """
        A centred box with flat faces, each with uv from 0 to 1.

        Pictures are upright seen from outside: +Y up on the sides, -Z on top (as on `plane`), +Z below.

        Parameters
        ----------
        size : float or array_like (3,)
            Extents along X, Y and Z, above 0; a single number is the extent along all three.

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
        segments: typing.SupportsIndex = 64,
    ) -> Mesh:
        """
        A centred, closed cone round the Y axis: base at -height/2, apex at +height/2.

        Parameters
        ----------
        radius, height : float
            Radius of the base, and height from the base to the apex, above 0.
        segments : int
            Segments round the axis, at least 3.

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
        segments: typing.SupportsIndex = 64,
    ) -> Mesh:
        """
        A centred, closed cylinder round the Y axis.

        On the side, u runs round as on `sphere`, and v upwards. Each cap shows the round middle of a picture.

        Parameters
        ----------
        radius, height : float
            Radius, and height along the axis, above 0.
        segments : int
            Segments round the axis, at least 3.

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
    def from_trimesh(mesh: object) -> Mesh:
        """
        Make a mesh from a mesh or a scene of trimesh.

        Parameters
        ----------
        mesh : trimesh.Trimesh or trimesh.Scene
            The objects of a scene become one mesh, each placed by its transform; those without triangles are
            left out.

        Returns
        -------
        Mesh
            The vertices and faces in their order, normals as ``mesh.vertex_normals`` gives them (smooth ones
            where these have length 0), and texture coordinates and vertex colours if there are any. Colours of
            faces, and textures, are not read.

        Raises
        ------
        TypeError
            For another kind of object.
        ValueError
            For no triangles, positions that are not finite, or all vertices in one place.
        IndexError
            For an index outside the vertices.

        Examples
        --------
        >>> import cubecam as cc, trimesh
        >>> capsule = trimesh.creation.capsule(height=2, radius=0.5)
        >>> mesh = cc.Mesh.from_trimesh(capsule)
        >>> len(mesh.positions) == len(capsule.vertices), mesh.bounds.round(2).tolist()
        (True, [[-0.5, -0.5, -1.5], [0.5, 0.5, 1.5]])
        """

    @staticmethod
    def icosphere(
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        subdivisions: typing.SupportsIndex = 3,
    ) -> Mesh:
        """
        A centred sphere of triangles of nearly equal size: a subdivided icosahedron.

        Texture coordinates are those of `sphere`.

        Parameters
        ----------
        radius : float
            Radius, above 0.
        subdivisions : int
            Number of subdivisions, from 0 to 9; each one splits every triangle into four.

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

        Seen from +Y with -Z up, a picture on the plane is upright. The back is culled unless the material is
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
        segments: typing.SupportsIndex = 64,
        rings: typing.SupportsIndex = 32,
    ) -> Mesh:
        """
        A centred sphere of rings and segments, as on a globe.

        u runs once round the Y axis, and v from the south pole (-Y) to the north pole. An equirectangular
        picture on the sphere is not mirrored when seen from outside; its center is at +Z and its seam at -Z.

        Parameters
        ----------
        radius : float
            Radius, above 0.
        segments : int
            Segments round the Y axis, at least 3.
        rings : int
            Rings from pole to pole, at least 2.

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
        segments: typing.SupportsIndex = 64,
        sides: typing.SupportsIndex = 32,
    ) -> Mesh:
        """
        A centred torus round the Y axis.

        Parameters
        ----------
        radius : float
            Distance from the axis to the center of the tube.
        tube : float
            Radius of the tube: above 0, below `radius`.
        segments : int
            Segments round the axis, at least 3.
        sides : int
            Sides round the tube, at least 3.

        Returns
        -------
        Mesh
            2 * segments * sides triangles.

        Raises
        ------
        ValueError
            For a length or number out of its range, or more than 16,777,216 vertices.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.torus(1, .25).bounds[1].tolist()
        [1.25, 0.25, 1.25]
        """

    def __init__(
        self: Mesh,
        positions: np.typing.ArrayLike,
        indices: np.typing.ArrayLike,
        *,
        normals: np.typing.ArrayLike | None = None,
        uvs: np.typing.ArrayLike | None = None,
        colors: np.typing.ArrayLike | None = None,
        uvs1: np.typing.ArrayLike | None = None,
        tangents: np.typing.ArrayLike | None = None,
        joints: np.typing.ArrayLike | None = None,
        joint_weights: np.typing.ArrayLike | None = None,
        morph_targets: collections.abc.Iterable[MorphTarget] = (),
        levels: collections.abc.Iterable[tuple[np.typing.ArrayLike, int | float]] = (),
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Mesh) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def flat_shaded(self: Mesh) -> Mesh:
        """
        Copy the mesh with flat faces: its triangles share no vertex.

        Vertices 3 i, 3 i + 1 and 3 i + 2 are the corners of triangle i, with the normal of its plane on the side
        from which they are counter-clockwise. A triangle without area, which no picture shows, has the normal
        (0, 1, 0). Texture coordinates and colours stay. The normals follow new positions (`update`).

        Materials do the same with ``flat_shading=True`` when they are drawn; calls and pictures share the arrays
        until this mesh changes.

        Returns
        -------
        Mesh
            3 * F vertices, F triangles.

        Examples
        --------
        >>> import cubecam as cc
        >>> ball = cc.Mesh.icosphere(1, subdivisions=0)
        >>> ball, ball.flat_shaded()
        (Mesh(15 vertices, 20 triangles), Mesh(60 vertices, 20 triangles))
        """

    def resized(self: Mesh, size: typing.SupportsFloat | typing.SupportsIndex) -> Mesh:
        """
        Copy the mesh, centred at the origin and scaled evenly.

        Parameters
        ----------
        size : float
            The largest extent that the result has, in world units.

        Returns
        -------
        Mesh
            A new mesh; all but the positions is the same.

        Raises
        ------
        ValueError
            For a size that is not above 0, a mesh whose vertices are all at one point, or one with joints, since
            the matrices of a skin fit one size only.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.box((1, 2, 4)).resized(1).bounds[1].tolist()
        [0.125, 0.25, 0.5]
        """

    def update(
        self: Mesh,
        *,
        positions: np.typing.ArrayLike | None = None,
        normals: np.typing.ArrayLike | None = None,
        uvs: np.typing.ArrayLike | None = None,
        colors: np.typing.ArrayLike | None = None,
        uvs1: np.typing.ArrayLike | None = None,
        tangents: np.typing.ArrayLike | None = None,
        joints: np.typing.ArrayLike | None = None,
        joint_weights: np.typing.ArrayLike | None = None,
        morph_targets: collections.abc.Iterable[MorphTarget] | None = None,
    ) -> None:
        """
        Replace several arrays of the vertices at once.

        All nodes of the mesh show the new values in the next picture; only the given arrays are uploaded to
        the GPU again. Any call with an array counts as a change, even if all numbers are the same, since
        comparing them would cost more than it saves. Other threads may draw at the same time: a picture shows
        the mesh before or after an update, never a part of it. Arrays that were read before keep their values.

        New positions, normals, uvs, colours or tangents end the `levels` of the mesh.

        Parameters
        ----------
        positions : array_like (V, 3), optional
            Object-space positions, finite. None: the positions stay.
        normals : array_like (V, 3), optional
            Outward normals of any length. None: normals that were given stay, also those of primitives and of
            `load_mesh`; smooth normals that the mesh computed are computed again with new positions.
            ``mesh.normals = None`` makes all normals smooth.
        uvs : array_like (V, 2), optional
            Texture coordinates. None: the texture coordinates stay.
        colors : array_like (V, 3) or (V, 4), optional
            Linear RGB or RGBA; uint8 stands for value/255. None: the colours stay.
        uvs1 : array_like (V, 2), optional
            The second set of texture coordinates. None: it stays.
        tangents : array_like (V, 4), optional
            Tangents. None: tangents that were given stay, also with new positions.
        joints, joint_weights : array_like (V, 4 k), optional
            The joints that move the vertices, and their weights. None: they stay.
        morph_targets : sequence of MorphTarget, optional
            New morph targets. None: they stay, and add the same numbers to new positions.

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

    def with_levels(
        self: Mesh, *, ratio: typing.SupportsFloat | typing.SupportsIndex = 0.5
    ) -> Mesh:
        """
        Copy the mesh with levels of detail, which calls with ``max_lod_error`` draw where they are small.

        Edges are contracted to one of their ends, those first that change the surface and its attributes least, until nothing
        more can be left out without a tear or a fold. Vertices keep their normals, uvs and colours. Borders keep to borders;
        seams, where vertices at one place differ in their attributes, stay closed.

        Parameters
        ----------
        ratio : float
            How many triangles a level has, relative to the one before; 0.1 to 0.9.

        Returns
        -------
        Mesh
            A new mesh with `levels`; none if nothing can be left out.

        Raises
        ------
        ValueError
            For a ratio that is not from 0.1 to 0.9.

        Notes
        -----
        The order is that of the quadric errors of M. Garland and P. Heckbert, "Surface Simplification Using Quadric Error
        Metrics", SIGGRAPH 1997, with attributes after H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance
        Attributes", IEEE Visualization 1999. The error of a level is the greater of two. One is an upper bound for the
        Hausdorff distance of the surfaces, above it by at most 5 % or 1e-4 of the mesh's extent, which is found by cutting
        triangles (after M. Tang, M. Lee and Y. Kim, "Interactive Hausdorff Distance Computation for General Polygonal Models",
        SIGGRAPH 2009). The other is the greatest root of a mean square by which normals, uvs or colours differ round a vertex,
        where a difference of 1 counts as the length on the surface over which they change by 1 on average, at most a quarter of
        the mesh's extent: that one is an estimate.

        Nodes draw the exact mesh where a level would not fit: with joints or morph targets; with materials that move vertices
        or count triangles, that set ``flat_shading`` or need tangents that the mesh lacks, and glass that follows light through
        its body; and where a node both casts and receives shadows. Shadow maps, probes and render textures show exact meshes.

        Examples
        --------
        >>> import cubecam as cc
        >>> ball = cc.Mesh.sphere(1).with_levels()
        >>> scene = cc.Scene()
        >>> near, far = (scene.add(ball, cc.BasicMaterial(), position=(0, 0, z)) for z in (-3, -50))
        >>> with cc.Renderer() as renderer:
        ...     cube = renderer.capture(scene, size=64, max_lod_error=0.5)
        ...     print(renderer.stats.triangles_simplified > 0)
        True
        """

    def with_tangents(self: Mesh, *, uv_set: typing.SupportsIndex = 0) -> Mesh:
        """
        Copy the mesh with the tangents of MikkTSpace, by which most programs bake normal maps.

        Around a vertex the triangles that share edges and have the same orientation of their uvs get one tangent:
        the mean of their directions of +u in the plane of the vertex's normal, weighted by the angle at the vertex.
        Where triangles of both orientations, or the sides of a seam, share a vertex, the vertex is split: copies follow
        all other vertices. Materials that need tangents use such a mesh by themselves where a mesh has none.

        Parameters
        ----------
        uv_set : {0, 1}
            The texture coordinates: 0 for `uvs`, 1 for `uvs1`.

        Returns
        -------
        Mesh
            A new mesh; it keeps its tangents when its vertices are replaced.

        Raises
        ------
        ValueError
            For a mesh without these texture coordinates.

        Notes
        -----
        M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3. Triangles without an area of
        their uvs take the tangent of a neighbour; every tangent is finite and of unit length.

        Examples
        --------
        >>> import cubecam as cc
        >>> cc.Mesh.plane().with_tangents().tangents[0].tolist()
        [1.0, 0.0, 0.0, 1.0]
        """

    @property
    def bounds(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2, 3) float64: the least and the greatest x, y, z of the vertices.
        """

    @property
    def colors(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 4) float32 or None: linear RGBA; a read-only view.

        Colours can be set. None: the mesh has none.
        """

    @colors.setter
    def colors(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def indices(self) -> np.typing.NDArray[np.uint32]:
        """
        ndarray (F, 3) uint32: the corners of each triangle, counter-clockwise seen from outside; a read-only view.
        """

    @property
    def joint_weights(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 4 k) float32 or None: how much each of the `joints` moves the vertex; a read-only view.

        `update` replaces them.
        """

    @property
    def joints(self) -> np.typing.NDArray[np.uint16] | None:
        """
        ndarray (V, 4 k) uint16 or None: the joints that move each vertex; a read-only view.

        They count the joints of `Node.skin` from 0. `update` replaces them.
        """

    @property
    def levels(self) -> tuple[tuple[np.typing.NDArray[np.uint32], float], ...]:
        """
        ndarray (6, M, M, C) in `dtype`, read-only, of each level, in a tuple: the filtered faces.

        Level 0 is `faces`; level k holds the faces filtered for ``roughness[k]``, in the convention "gl". A cubemap that
        `prefilter` did not make has one level. The levels of `mipmaps` are others, and `sample` looks those up.
        """

    @levels.setter
    def levels(
        self, value: collections.abc.Iterable[tuple[np.typing.ArrayLike, int | float]]
    ) -> None: ...
    @property
    def morph_targets(self) -> tuple[MorphTarget, ...]:
        """
        tuple of MorphTarget: changes of the shape, which `Node.weights` mixes.

        They can be set. Where a node has fewer weights than there are targets, the others are 0.
        """

    @morph_targets.setter
    def morph_targets(self, value: collections.abc.Iterable[MorphTarget]) -> None: ...
    @property
    def normals(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (V, 3) float32: unit vectors; a read-only view.

        Normals can be set. None: smooth normals, computed now and whenever positions are set without normals.
        """

    @normals.setter
    def normals(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def positions(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (V, 3) float32: the positions of the vertices; a read-only view.

        Positions can be set; `update` says what the normals become. An array that was read before keeps its
        values.
        """

    @positions.setter
    def positions(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def tangents(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 4) float32 or None: unit vectors along +u and a sign; a read-only view.

        The fourth number, 1 or -1, is the factor of ``cross(normal, tangent)``, which points along +v. Tangents can be
        set. None: materials that need tangents use those of `with_tangents`, made again whenever vertices change.
        """

    @tangents.setter
    def tangents(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def uvs(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 2) float32 or None: (0, 0) is a picture's bottom-left; a read-only view.

        Texture coordinates can be set. None: the mesh has none.
        """

    @uvs.setter
    def uvs(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def uvs1(self) -> np.typing.NDArray[np.float32] | None:
        """
        ndarray (V, 2) float32 or None: a second set of texture coordinates; a read-only view.

        It can be set. None: the mesh has none.
        """

    @uvs1.setter
    def uvs1(self, value: np.typing.ArrayLike | None) -> None: ...

class Blend:
    """
    Blending by OpenGL's own factors, for any material as ``blend=``.

    S is the colour of the surface and D the colour that is already in the picture. The colour becomes
    src * S + dst * D, and the alpha src_alpha * S + dst_alpha * D. The colour of S is not multiplied by its
    alpha; its alpha is the product of opacity and the alphas of colour and map. The formats rgba8 and rgb565
    clamp S, and the result, to 0..1. A surface with a `Blend` is drawn like every blended surface: after the
    background, far to near, and without writing depth, except with ``depth_write=True``. A Blend never
    changes; two Blends are compared by their values.

    Parameters
    ----------
    src : str
        The factor of S: "zero", "one", "src_color", "one_minus_src_color", "dst_color",
        "one_minus_dst_color", "src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha" or
        "src_alpha_saturate", which is min(alpha of S, 1 - alpha of D) for colours and 1 for alphas.
    dst : str
        The factor of D.
    src_alpha, dst_alpha : str, optional
        The factors of the alphas, where "src_color" is the alpha of S. None: the factor of the colour.
    equation : {"add", "subtract", "reverse_subtract", "min", "max"}
        "add": as above; "subtract": src * S - dst * D; "reverse_subtract": dst * D - src * S; "min" and
        "max": of S and D, channel by channel, without the factors.

    Raises
    ------
    ValueError
        For an unknown name.
    TypeError
        For a factor that is not a str.

    Notes
    -----
    OpenGL 4.5, section 17.3.6.

    Examples
    --------
    The factors of many tutorials, which blend the alpha as if it were a colour:

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

    def __eq__(self: Blend, other: object) -> bool: ...
    def __hash__(self: Blend) -> int: ...
    def __init__(
        self: Blend,
        src: BlendFactor,
        dst: BlendFactor,
        *,
        src_alpha: BlendFactor | None = None,
        dst_alpha: BlendFactor | None = None,
        equation: BlendEquation = "add",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Blend) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Blend, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def dst(self) -> BlendFactor:
        """
        str: the factor of the colour in the picture.
        """

    @property
    def dst_alpha(self) -> BlendFactor:
        """
        str: the factor of the alpha in the picture.
        """

    @property
    def equation(self) -> BlendEquation:
        """
        str: how the two products are combined.
        """

    @property
    def src(self) -> BlendFactor:
        """
        str: the factor of the surface's colour.
        """

    @property
    def src_alpha(self) -> BlendFactor:
        """
        str: the factor of the surface's alpha.
        """

class Stencil:
    """
    A stencil test, and how drawing changes the stencil buffer.

    Give a Stencil to any material as ``stencil=``, and request a stencil buffer by
    ``depth_format="depth24_stencil8"``, "depth32f_stencil8" or "stencil_index8"; without a stencil buffer the
    Stencil has no effect. The buffer holds 8 bits for each pixel and is 0 at the start of a picture. A mask
    must be drawn before the surfaces that it masks: see ``Node.render_order``. A Stencil never changes; two
    Stencils are compared by their values.

    Parameters
    ----------
    func : {"always", "never", "less", "equal", "lequal", "greater", "notequal", "gequal"}
        The comparison of ``reference & read_mask`` with ``stored & read_mask``; a pixel is drawn where it is
        true. With "less" a pixel is drawn where the reference is less than the stored number.
    reference : int
        The number that is compared, and that "replace" writes; from 0 to 255.
    read_mask : int
        The bits that are compared, from 0 to 255.
    write_mask : int
        The bits that may change, from 0 to 255.
    fail : {"keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert"}
        How the stored number changes where the test fails. "replace" stores the reference. "incr" adds 1 and
        stops at 255, "incr_wrap" continues at 0; "decr" subtracts 1 and stops at 0, "decr_wrap" continues at 255.
    depth_fail : str
        How the stored number changes where the test passes and the depth test fails.
    depth_pass : str
        How the stored number changes where both tests pass, or the stencil test passes and there is no depth test.

    Raises
    ------
    ValueError
        For an unknown name, or a number out of its range.
    TypeError
        For an argument of another type.

    Notes
    -----
    OpenGL 4.6, section 17.3.3. Front and back faces use the same settings.

    Examples
    --------
    A disc as a window: the disc is invisible, and the red plane behind it shows only within its outline.

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

    def __eq__(self: Stencil, other: object) -> bool: ...
    def __hash__(self: Stencil) -> int: ...
    def __init__(
        self: Stencil,
        *,
        func: StencilFunc = "always",
        reference: typing.SupportsIndex = 0,
        read_mask: typing.SupportsIndex = 255,
        write_mask: typing.SupportsIndex = 255,
        fail: StencilOp = "keep",
        depth_fail: StencilOp = "keep",
        depth_pass: StencilOp = "keep",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Stencil) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def depth_fail(self) -> StencilOp:
        """
        str: how the number changes where only the depth test fails.
        """

    @property
    def depth_pass(self) -> StencilOp:
        """
        str: how the number changes where both tests pass.
        """

    @property
    def fail(self) -> StencilOp:
        """
        str: how the number changes where the test fails.
        """

    @property
    def func(self) -> StencilFunc:
        """
        str: the comparison of the reference with the stored number.
        """

    @property
    def read_mask(self) -> int:
        """
        int: the bits that are compared.
        """

    @property
    def reference(self) -> int:
        """
        int: the number that is compared and written.
        """

    @property
    def write_mask(self) -> int:
        """
        int: the bits that may change.
        """

class Texture:
    """
    A picture with its place on a surface, for materials that have several maps.

    A map of `StandardMaterial` is looked up at ``offset + R @ (scale * (u, v))``, where R turns by `rotation`. A
    picture that lies by the mesh's uvs as they are needs no Texture. A Texture never changes; two are equal if
    they have the same picture and equal numbers.

    Parameters
    ----------
    source : Image, array_like (H, W, C) or RenderTexture
        The picture; an array becomes an Image. In a map of colours, 8-bit pixels are sRGB, as in glTF, unless the
        Image says ``encoding="linear"``; they are decoded before they are filtered. In any other map the numbers
        count as they are.
    uv_set : {0, 1}
        The mesh's texture coordinates: 0 for `Mesh.uvs`, 1 for `Mesh.uvs1`.
    offset : array_like (2,)
        What is added to (u, v) last; (0, 0) is the picture's bottom-left corner.
    rotation : float
        The angle by which (u, v) is turned around (0, 0), in degrees, from u towards v. The picture appears turned
        the other way.
    scale : array_like (2,)
        The factors of u and v; 2 shows the picture twice in a length.

    Raises
    ------
    ValueError
        For another `uv_set`, or numbers that are not finite.
    TypeError
        For a source of another type.

    Notes
    -----
    KHR_texture_transform of glTF 2.0, except that v points upwards here. A transform in a glTF file has the same
    rotation and scale here, and the offset ``(x + sin(r) * sy, 1 - y - cos(r) * sy)``.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> checks = cc.Image(np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.float32(1))
    >>> cc.Texture(checks, uv_set=1, scale=(4, 4))
    Texture(Image(8 x 8, 1 channels, float32, linear), uv_set=1, scale=(4, 4))
    """

    def __eq__(self: Texture, other: object) -> bool: ...
    def __hash__(self: Texture) -> int: ...
    def __init__(
        self: Texture,
        source: Image | RenderTexture | np.typing.ArrayLike,
        *,
        uv_set: typing.SupportsIndex = 0,
        offset: np.typing.ArrayLike = (0, 0),
        rotation: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        scale: np.typing.ArrayLike = (1, 1),
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Texture) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def matrix(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2, 3): the picture is looked up at ``matrix @ (u, v, 1)``.
        """

    @property
    def offset(self) -> tuple[float, float]:
        """
        tuple of float: what is added to (u, v) last.
        """

    @property
    def rotation(self) -> float:
        """
        float: the angle by which (u, v) is turned, degrees, counter-clockwise.
        """

    @property
    def scale(self) -> tuple[float, float]:
        """
        tuple of float: the factors of u and v.
        """

    @property
    def source(self) -> Image | RenderTexture:
        """
        Image or RenderTexture: the picture.
        """

    @property
    def uv_set(self) -> int:
        """
        int: 0 for the mesh's uvs, 1 for its uvs1.
        """

class Material:
    """
    Base of the materials: how a surface reflects light.

    Any number of nodes may share a material; all of them show a change of it. A colour is 3 or 4 linear
    numbers, or a CSS name or "#rrggbb", which are sRGB; a fourth number, from 0 to 1, multiplies `opacity`.
    A surface that is not fully opaque is blended over the surfaces behind it.

    Every material takes these options by keyword, and has them as attributes:

    ======================  =========================================================================
    opacity=1               from 0 to 1; multiplies the alpha of the colours
    double_sided=False      True shows both sides; False culls back faces. Of a translucent mesh the
                            triangles that show their backs are drawn first, then the others
    blend=None              how the material's colour S, of alpha a, is combined with D, the colour
                            that is already in the picture:
                            "opaque": S, with alpha 1;
                            "alpha": a S + (1 - a) D, alpha a + (1 - a) D;
                            "alpha_keep": the same colour; the alpha of D stays;
                            "additive": a S + D, alpha a + D;
                            "multiply": (1 - a + a S) D; the alpha of D stays;
                            "premultiplied": S + (1 - a) D in all four channels, for maps whose colour
                            is already multiplied by their alpha; opacity and the colour's alpha
                            multiply both;
                            a `Blend`: by its factors.
                            None: "alpha" if any part of the material is translucent, else "opaque"
    depth_write=None        whether the surface hides farther surfaces that are drawn after it; None:
                            True if the blend is "opaque"; shadows do not depend on it
    depth_test=True         False: the surface is drawn over nearer ones, too
    color_write=True        which channels are written: one bool, or four (red, green, blue, alpha)
    stencil=None            a `Stencil`: how the surface tests and changes the stencil buffer, if
                            ``depth_format`` has one; None: it does neither
    flat_shading=False      True shows each triangle with the normal of its plane, in place of the mesh's
                            normals; see `Mesh.flat_shaded`
    ======================  =========================================================================

    A surface that is blended, or writes no depth, is drawn after the background, far to near; it writes
    colour and no other output. A mask, which writes a stencil but neither colour nor depth, is drawn among
    the opaque nodes.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Material, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def blend(self) -> BlendMode | Blend | None:
        """
        str, Blend or None: how the material is combined with the picture: "opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied" or a `Blend`; see `Material`. None: "alpha" if any part of the material is translucent, else "opaque".
        """

    @blend.setter
    def blend(self, value: BlendMode | Blend | None) -> None: ...
    @property
    def color_write(self) -> tuple[bool, bool, bool, bool]:
        """
        tuple of bool: which of red, green, blue, alpha are written; one bool sets all four. Depth and the other outputs do not depend on this option.
        """

    @color_write.setter
    def color_write(self, value: bool | tuple[bool, bool, bool, bool]) -> None: ...
    @property
    def depth_test(self) -> bool:
        """
        bool: False: the surface is drawn over nearer ones, too.
        """

    @depth_test.setter
    def depth_test(self, value: bool) -> None: ...
    @property
    def depth_write(self) -> bool | None:
        """
        bool or None: whether the surface hides farther surfaces that are drawn after it. None: True if the blend is "opaque".
        """

    @depth_write.setter
    def depth_write(self, value: bool | None) -> None: ...
    @property
    def double_sided(self) -> bool:
        """
        bool: True shows both sides, with the normal turned to the viewer; False culls back faces.
        """

    @double_sided.setter
    def double_sided(self, value: bool) -> None: ...
    @property
    def flat_shading(self) -> bool:
        """
        bool: True shows each triangle with the normal of its plane, as `Mesh.flat_shaded` has them.
        """

    @flat_shading.setter
    def flat_shading(self, value: bool) -> None: ...
    @property
    def name(self) -> str:
        """
        str: a name for people, empty by default; no picture depends on it, and it need not be unique.
        """

    @name.setter
    def name(self, value: str) -> None: ...
    @property
    def opacity(self) -> float:
        """
        float: from 0 to 1; multiplies the alpha of the colours.
        """

    @opacity.setter
    def opacity(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def stencil(self) -> Stencil | None:
        """
        Stencil or None: how the surface tests and changes the stencil buffer, if ``depth_format`` has one. None: it does neither.
        """

    @stencil.setter
    def stencil(self, value: Stencil | None) -> None: ...

class BasicMaterial(Material):
    """
    Unlit: color * map * vertex colour * cubemap.

    Parameters
    ----------
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA; a CSS name or "#rrggbb" is sRGB and is decoded.
    map : Image, array_like (H, W, C) or RenderTexture, optional
        A picture, placed by the mesh's uvs.
    cubemap : CubeMap or Probe, optional
        A cubemap that is looked up in the direction of the object-space position, so that a box or a
        sphere shows all of it, and turns it when it turns. The alpha of the cubemap does not count.
    vertex_colors : bool
        Whether the mesh's colours multiply color.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

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
        color: str | np.typing.ArrayLike = (1, 1, 1),
        map: Image | RenderTexture | np.typing.ArrayLike | None = None,
        cubemap: CubeMap | Probe | None = None,
        vertex_colors: bool = False,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    @property
    def color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """

    @color.setter
    def color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def cubemap(self) -> CubeMap | Probe | None:
        """
        CubeMap, Probe or None: looked up by the object-space position.
        """

    @cubemap.setter
    def cubemap(self, value: CubeMap | Probe | None) -> None: ...
    @property
    def map(self) -> Image | RenderTexture | None:
        """
        Image, RenderTexture or None: times the colour, by the mesh's uvs. An array (H, W, C) becomes an Image.
        """

    @map.setter
    def map(self, value: Image | RenderTexture | np.typing.ArrayLike | None) -> None: ...
    @property
    def vertex_colors(self) -> bool:
        """
        bool: whether the colour is multiplied by the mesh's vertex colours.
        """

    @vertex_colors.setter
    def vertex_colors(self, value: bool) -> None: ...

class GlassMaterial(Material):
    """
    Glass: F * environment(R) + (1 - F) * tint * environment(T).

    R is the reflected direction, and T the refracted direction of GLSL's ``refract``: at a single surface,
    or through both sides of the body. F is Fresnel's reflectance of a dielectric for unpolarised light: the
    mean of both polarisations (M. Born and E. Wolf, "Principles of Optics", section 1.5.2). Where there is
    no T, F is 1.

    Parameters
    ----------
    ior : float
        The index of refraction inside divided by that outside, above 0. 1.5 is glass in air, 1.33 water in
        air, 1/1.33 a bubble of air in water. GLSL's ``refract`` takes the inverse, eta.
    fresnel : bool
        False: F is 0, and only T shows.
    tint : array_like (3,) or (4,), or str
        Linear RGB or RGBA that multiplies the refracted light; a CSS name or "#rrggbb" is sRGB and is decoded.
    roughness : float
        From 0, clear, to 1, frosted. A rough surface sees the environment filtered by roughness
        (`CubeMap.prefilter`): round R, moved towards the normal (S. Lagarde and C. de Rousiers, "Moving
        Frostbite to Physically Based Rendering", 2014), and round T for roughness * (2 max(ior, 1/ior) - 2),
        at most roughness. F stays that of a smooth surface. With two surfaces, see the notes.
    surfaces : int
        1: light is refracted where it enters, and the environment is looked up in this direction: right for
        the surface of water, and the fastest. 2: light goes on through the body, the mesh, is reflected
        totally inside or refracted again where it leaves, and the environment is looked up from there, with
        the parallax of a `Probe`.
    dispersion : float
        How much red and blue part, as KHR_materials_dispersion defines it: 20 divided by the Abbe number, not
        negative. Red, green and blue have the indices ior - s, ior and ior + s, with
        s = (ior - 1) * 0.025 * dispersion; of an ior below 1, the inverses have. Each of them is followed.
    attenuation_distance : float
        The way in the body, in world units, after which white light has `attenuation_color`, above 0, as
        KHR_materials_volume defines it; inf absorbs nothing. With ``surfaces=1`` there is no such way, and
        nothing is absorbed.
    attenuation_color : array_like (3,), or str
        Linear RGB, from 0 to 1.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite.

    Notes
    -----
    With ``surfaces=2`` a body should be closed, with triangles that are counter-clockwise seen from outside.
    Each mesh has a small cube of its own inner side, as the middle of its bounds sees it; any number of nodes
    share it, and it is made again when the vertices move. So a ray finds its way out of what the middle sees
    directly: all of a ball, a box, a prism or an egg, of a ring, or of a bowl. From other parts, such as the
    handle of a teapot, and out of open meshes, light does not find its way: it is looked up where it has got
    to, as with ``surfaces=1``. So is what the back of a double-sided surface shows.

    Light meets the inner side up to four times. If it is reflected totally the fourth time, it leaves the
    body in that direction. What is reflected there in part is not followed: it is taken to be as bright as
    what leaves the body. Light does not enter a body again that it has left, or another body inside. The tint
    counts once.

    A rough body spreads what passes like a mirror of the roughness r' with r'^4 = r^4 (2 v^2 + k ior^2),
    v = (ior - 1) / 2, after k total reflections: facets that lean by a small angle d turn light by 2 d where
    a mirror reflects it, by (ior - 1) d where it goes through a surface, and by 2 ior d where it is reflected
    inside, and variances add up (L. Belcour, "Efficient Rendering of Layered Materials using an Atomic
    Decomposition with Statistical Operators", 2018). Facets of the two sides are independent.

    `cubecam.truth` follows rays through all surfaces of the scene, whatever `surfaces` says.

    Examples
    --------
    >>> import cubecam as cc
    >>> water = cc.GlassMaterial(ior=1.33, tint=(.8, .9, 1))
    >>> water
    GlassMaterial(ior=1.33, tint=(0.8, 0.9, 1, 1))
    >>> bottle = cc.GlassMaterial(surfaces=2, attenuation_distance=.5, attenuation_color="seagreen")
    """

    def __init__(
        self: GlassMaterial,
        *,
        ior: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        fresnel: bool = True,
        tint: str | np.typing.ArrayLike = (1, 1, 1),
        roughness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        surfaces: typing.SupportsIndex = 1,
        dispersion: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        attenuation_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
        attenuation_color: str | np.typing.ArrayLike = (1, 1, 1),
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    @property
    def attenuation_color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB, from 0 to 1, read-only.
        """

    @attenuation_color.setter
    def attenuation_color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def attenuation_distance(self) -> float:
        """
        float: world units, above 0, after which white light in the body has the attenuation colour; inf: never.
        """

    @attenuation_distance.setter
    def attenuation_distance(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def dispersion(self) -> float:
        """
        float: 20 divided by the Abbe number, not negative; 0: none.
        """

    @dispersion.setter
    def dispersion(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fresnel(self) -> bool:
        """
        bool: whether part of the light is reflected; False: all is refracted.
        """

    @fresnel.setter
    def fresnel(self, value: bool) -> None: ...
    @property
    def ior(self) -> float:
        """
        float: refractive index inside divided by the one outside.
        """

    @ior.setter
    def ior(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def roughness(self) -> float:
        """
        float: from 0, clear, to 1, frosted.
        """

    @roughness.setter
    def roughness(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def surfaces(self) -> int:
        """
        int: 1, light is refracted where it enters; 2, also where it leaves the body.
        """

    @surfaces.setter
    def surfaces(self, value: typing.SupportsIndex) -> None: ...
    @property
    def tint(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA, times what is refracted.
        """

    @tint.setter
    def tint(self, value: str | np.typing.ArrayLike) -> None: ...

class MirrorMaterial(Material):
    """
    A mirror: env_weight * tint * environment(R) + color_weight * color.

    R = I - 2 (N.I) N, where I points from the eye to the surface, in world space. The environment is that of
    the node, a CubeMap or a Probe, or else that of the scene; without any, a mirror
    reflects black.

    Parameters
    ----------
    tint : array_like (3,) or (4,), or str
        Linear RGB or RGBA that multiplies the reflected light; a CSS name or "#rrggbb" is sRGB and is decoded.
    env_weight : float
        Weight of the reflected light, not negative.
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA that the surface adds; a CSS name or "#rrggbb" is sRGB and is decoded.
    color_weight : float
        Weight of color, not negative.
    f0 : float, optional
        The reflectance seen head-on, from 0 to 1: env_weight is multiplied by
        f0 + (1 - f0) (1 - N.V)**5 (C. Schlick, "An Inexpensive BRDF Model for Physically-based
        Rendering", 1994). None: env_weight is the same at all angles.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

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
        tint: str | np.typing.ArrayLike = (1, 1, 1),
        env_weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        color: str | np.typing.ArrayLike = (0, 0, 0),
        color_weight: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        f0: typing.SupportsFloat | typing.SupportsIndex | None = None,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    @property
    def color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """

    @color.setter
    def color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def color_weight(self) -> float:
        """
        float: weight of the mirror's own colour.
        """

    @color_weight.setter
    def color_weight(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def env_weight(self) -> float:
        """
        float: weight of what is reflected.
        """

    @env_weight.setter
    def env_weight(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def f0(self) -> float | None:
        """
        float or None: the reflectance seen head-on, from 0 to 1; None reflects evenly.
        """

    @f0.setter
    def f0(self, value: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def tint(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA, times what is reflected.
        """

    @tint.setter
    def tint(self, value: str | np.typing.ArrayLike) -> None: ...

class PhongMaterial(Material):
    """
    Phong's reflection model.

    The colour is ka * color, plus, for every light, kd * color * max(N.L, 0) and, where N.L > 0, a white
    highlight ks * max(R.V, 0)**shininess (B. T. Phong, "Illumination for Computer Generated Pictures",
    CACM 18(6), 1975). An `AmbientLight` adds its light times ka * color.
    Without a light ka * color is all that is left, a flat silhouette: an environment does not light it.

    Parameters
    ----------
    color : array_like (3,) or (4,), or str
        Linear RGB or RGBA; a CSS name or "#rrggbb" is sRGB and is decoded.
    ka, kd, ks : float
        Ambient, diffuse and specular weights, not negative.
    shininess : float
        Exponent of the highlight, above 0; a greater one makes a smaller highlight.
    map : Image, array_like (H, W, C) or RenderTexture, optional
        A picture that multiplies color, placed by the mesh's uvs.
    vertex_colors : bool
        Whether the mesh's colours multiply color.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

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
        color: str | np.typing.ArrayLike = (1, 1, 1),
        ka: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        kd: typing.SupportsFloat | typing.SupportsIndex = 0.7,
        ks: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        shininess: typing.SupportsFloat | typing.SupportsIndex = 10.0,
        map: Image | RenderTexture | np.typing.ArrayLike | None = None,
        vertex_colors: bool = False,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    @property
    def color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA, read-only.
        """

    @color.setter
    def color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def ka(self) -> float:
        """
        float: ambient weight.
        """

    @ka.setter
    def ka(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def kd(self) -> float:
        """
        float: diffuse weight.
        """

    @kd.setter
    def kd(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def ks(self) -> float:
        """
        float: specular weight; highlights are white.
        """

    @ks.setter
    def ks(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def map(self) -> Image | RenderTexture | None:
        """
        Image, RenderTexture or None: times the colour, by the mesh's uvs. An array (H, W, C) becomes an Image.
        """

    @map.setter
    def map(self, value: Image | RenderTexture | np.typing.ArrayLike | None) -> None: ...
    @property
    def shininess(self) -> float:
        """
        float: Phong's exponent.
        """

    @shininess.setter
    def shininess(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def vertex_colors(self) -> bool:
        """
        bool: whether the colour is multiplied by the mesh's vertex colours.
        """

    @vertex_colors.setter
    def vertex_colors(self, value: bool) -> None: ...

class ShaderMaterial(Material):
    """
    A material that its user writes in GLSL (4.50 core), with access to the scene.

    Parameters
    ----------
    fragment : str or path
        GLSL with a function ``vec3 shade(Surface surface)``, which returns the linear colour of a fragment, or
        a ``vec4`` with an alpha, which counts where `blend` is not "opaque". A str is the source itself; a
        path (``pathlib.Path``) names a file with the source.
    vertex : str or path, optional
        GLSL with a function ``void vertex(inout Vertex vertex)``, which moves vertices in the mesh's own
        space.
    uniforms : dict of str, optional
        Values of the uniforms that the source declares: numbers, bools, vectors (2,) to (4,), matrices
        (2, 2) to (4, 4) in reading order, or arrays of these, with the number of elements as the first axis.
        A uniform without a value has the value of its declaration, else 0.
    textures : dict of str, optional
        For each ``uniform sampler2D`` an Image or an array (H, W, C); for each ``uniform samplerCube`` a
        CubeMap or a Probe. Such a probe leaves the node out of its own pictures.
    displacement : float, optional
        The greatest distance by which `vertex` moves a vertex, in the mesh's units. None: unknown; the node is
        never culled, and any change of it draws the whole picture again.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

    Attributes
    ----------
    uniforms, textures : mutable mapping
        ``material.uniforms["time"] = 2`` shows in the next picture.

    Raises
    ------
    ValueError
        For a source without its function, or a name or value that no uniform can have. When the material is
        drawn: for a name that the source does not declare, or a value of another shape.
    TypeError
        For values of another type.
    OSError
        For a path that cannot be read.
    ShaderError
        When the material is drawn, for a source that does not compile; the message quotes the user's own lines
        with their numbers.

    Notes
    -----
    A material may declare outputs: ``out vec4 heat;`` in `fragment` (float, vec2, vec3 or vec4, without a
    layout) declares an output that ``outputs=("heat",)`` requests and that ``frame.outputs["heat"]`` or
    ``cube.outputs["heat"]`` returns: float32, and 0 where the visible node does not write it. Only opaque
    nodes that write depth write outputs. The number of the driver's draw buffers (usually 8) limits colour
    and these outputs together. Without a request the output is an ordinary variable.

    A variable without a value, also one that only some ways through the source set, is 0; so are an output and what a function
    without a ``return`` gives. A loop without an end gives black on llvmpipe, which ends it after 65,536 steps; a GPU may
    reset itself. GLSL that takes uniforms in blocks, buffers, images or attributes of its own is refused, and so is a ``main``.
    ``#line`` has no effect: messages count the lines of the source.

    The source may use the names below. Names that begin with ``u_``, ``v_``, ``a_``, ``o_``, ``gl_`` or
    ``environment_`` are reserved.

    In both stages: ``mat4 model_matrix()`` (mesh to world), ``mat3 normal_matrix()`` (its inverse
    transpose, whose result may have any length), ``vec3 eye_position()`` (world space; for perspective views).
    A value that goes from the vertex to the fragment is declared in both, as ``out vec3 x;`` and
    ``in vec3 x;``.

    ``struct Vertex { vec3 position; vec3 normal; vec2 uv; vec4 color; }``, in the mesh's space.

    ``struct Surface``: ``position`` (world), ``normal`` (world, unit, towards the viewer on
    double-sided surfaces), ``incident`` (world, unit, from the eye to the surface), ``position_object``,
    ``normal_object``, ``uv``, ``color`` (of the vertices; white if the mesh has no colours), ``vec2 uv1`` (`Mesh.uvs1`;
    0 if the mesh has none), ``vec4 tangent`` (`Mesh.tangents` in the world, or those of `Mesh.with_tangents`; 0 if the
    mesh has neither tangents nor uvs).

    ``vec3 environment(vec3 direction)``: the light from a world direction in the node's environment, without
    seams; ``environment_lod(direction, level)``: the same at a level of its mipmaps, or of its levels by
    roughness. ``int environment_levels()``: how many levels the environment has, 1 without mipmaps or levels by roughness, and 0
    where there is no environment.
    ``vec3 environment_filtered(vec3 direction, float roughness)``: the light round a direction, filtered by the
    lobe of GGX for a roughness from 0, the environment itself, to 1 (`CubeMap.prefilter`).
    ``vec3 environment_irradiance(vec3 normal)``: the mean of the light round a direction, weighted by the cosine
    (`CubeMap.irradiance`): a white diffuse surface has this colour.
    ``vec2 brdf(float n_dot_v, float roughness)``: a GGX surface with the reflectance F0 head-on reflects F0 * x + y
    of uniform light (`brdf`). If a source contains one of these three names, the renderer filters the environment
    by roughness, if it has no such levels yet; a probe with ``prefilter=False`` keeps its mipmaps instead, and
    roughness 1 and irradiance are then the coarsest of these.
    ``vec3 environment_mip(vec3 direction, float level)``: the light at a level of mipmaps that are averages of
    boxes of texels, whether the environment has mipmaps or not; ``float environment_size()``: the texels along an edge of
    level 0.
    ``vec3 environment_at(vec3 position, vec3 direction)``: ``environment`` for another world position than the
    surface's own. The position matters for a probe with a `Probe.parallax`; the other functions take the surface's.
    ``bool environment_is_local()``: whether a probe captured it; ``vec3 environment_position()``: where in the world the probe
    did.
    ``int light_count()``, ``LightSample sample_light(int index, Surface surface)`` with ``direction`` (unit, to
    the light) and ``radiance``; ``vec3 ambient_light()``, the sum of the
    ambient lights.
    ``vec3 phong(Surface surface, vec3 color, float ka, float kd, float ks, float shininess)``: the colour of a
    `PhongMaterial`.
    ``float schlick(Surface surface, float f0)``: Schlick's Fresnel term.

    Examples
    --------
    A golden mirror in GLSL, on a ball that shows the moving scene:

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

    A material with an output, the height of its surface above the floor:

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
        fragment: str | os.PathLike[str] | None,
        *,
        vertex: str | os.PathLike[str] | None = None,
        uniforms: collections.abc.Mapping[str, np.typing.ArrayLike] | None = None,
        textures: collections.abc.Mapping[
            str, Image | RenderTexture | CubeMap | Probe | np.typing.ArrayLike
        ]
        | None = None,
        displacement: typing.SupportsFloat | typing.SupportsIndex | None = None,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: ShaderMaterial) -> str: ...
    def __setstate__(self: ShaderMaterial, state: object) -> None:
        """
        For unpickling.
        """

    def _remove_texture(self: ShaderMaterial, name: str) -> None: ...
    def _remove_uniform(self: ShaderMaterial, name: str) -> None: ...
    def _set_inputs(self: ShaderMaterial, uniforms: object = None, textures: object = None) -> None:
        """
        Replace all uniforms, all textures, or both.
        """

    def _set_texture(self: ShaderMaterial, name: str, value: object) -> None: ...
    def _set_uniform(self: ShaderMaterial, name: str, value: object) -> None: ...
    def _textures(self: ShaderMaterial) -> dict[str, Image | RenderTexture | CubeMap | Probe]: ...
    def _uniforms(self: ShaderMaterial) -> dict[str, float | np.typing.NDArray[np.float64]]: ...
    def reload(self: ShaderMaterial) -> bool:
        """
        Read the source again from its file.

        If the new source does not compile, the next picture raises ShaderError; a later `reload` of a corrected file
        works.

        Returns
        -------
        bool
            Whether the source changed.

        Raises
        ------
        ValueError
            If no part of the source came from a file, or the file lacks its function.
        OSError
            If the file cannot be read; the old source stays.
        """

    @property
    def displacement(self) -> float | None:
        """
        float or None: how far `vertex` moves a vertex at most, in the mesh's units; None: unknown, so the node is never culled.
        """

    @displacement.setter
    def displacement(self, value: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def fragment(self) -> str | None:
        """
        str: GLSL of every fragment. Setting it, to text or a path, shows in the next picture.
        """

    @fragment.setter
    def fragment(self, value: str | os.PathLike[str] | None) -> None: ...
    @property
    def textures(self) -> cubecam._shader_inputs.Textures:
        """
        Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture.
        """

    @textures.setter
    def textures(
        self,
        value: collections.abc.Mapping[
            str, Image | RenderTexture | CubeMap | Probe | np.typing.ArrayLike
        ],
    ) -> None:
        """
        Replace all textures.
        """

    @property
    def uniforms(self) -> cubecam._shader_inputs.Uniforms:
        """
        Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture.
        """

    @uniforms.setter
    def uniforms(self, value: collections.abc.Mapping[str, np.typing.ArrayLike]) -> None:
        """
        Replace all uniforms.
        """

    @property
    def vertex(self) -> str | None:
        """
        str or None: GLSL of every vertex.
        """

    @vertex.setter
    def vertex(self, value: str | os.PathLike[str] | None) -> None: ...

class StandardMaterial(Material):
    """
    The metallic-roughness material of glTF 2.0, with the KHR_materials extensions.

    The model is that of glTF 2.0, section 3.9 and appendix B: a metal and a dielectric of GGX microfacets (D of
    Trowbridge and Reitz, separable V of Smith, F of Schlick, alpha = roughness**2), mixed by `metallic`; the
    dielectric has a Lambertian base. Above it lie, in this order, a thin film, sheen, emission and a clear coat.
    The parameters, their ranges and most defaults are glTF's. Only `color`, `metallic` and `roughness` matter for
    most materials; every other part costs nothing until it is used.

    Light comes from the environment, which is that of the node, a CubeMap or a Probe, or else that of the scene,
    filtered by roughness; and from lights. The unit of a `DirectionalLight` is lux and that of a `PointLight` or
    `SpotLight` with ``decay=2`` is candela, as in KHR_lights_punctual: a white surface that faces one lux has the
    radiance 1/pi. An `AmbientLight` acts as an environment of constant radiance.

    A map is an Image, an array (H, W, C), a RenderTexture, or one of these with a place (`Texture`). Maps multiply
    the parameter beside them, except those of normals and occlusion. Colours in maps of 8 bits (`map`,
    `emissive_map`, `specular_color_map`, `sheen_color_map`) are sRGB and are decoded; all other maps and all
    floats are linear. Maps are not shown on meshes without uvs.

    Parameters
    ----------
    color : array_like (3,) or (4,), or str
        Base colour, linear RGB or RGBA from 0 to 1: what a metal reflects head-on and a dielectric scatters; a CSS
        name or "#rrggbb" is sRGB and is decoded (3.9.2).
    metallic : float
        From 0, a dielectric, to 1, a metal (3.9.2).
    roughness : float
        From 0, a mirror, to 1 (3.9.2, B.2.3).
    map : map, optional
        Times `color`, alpha included.
    metallic_roughness_map : map, optional
        Green times `roughness`, blue times `metallic`.
    normal_map : map, optional
        Normals in the tangent frame, x along growing u and y along growing v; 0 to 1 stands for -1 to 1 (3.9.3).
    normal_scale : float
        Factor of the normals' x and y, finite.
    occlusion_map : map, optional
        Red is the share of the light from all around, of the environment and of ambient lights, that reaches the
        surface; other lights and what shows through are not changed (3.9.3).
    occlusion_strength : float
        From 0, no occlusion, to 1.
    emissive : array_like (3,) or str
        Linear RGB of the radiance that the surface emits, not negative (3.9.3).
    emissive_map : map, optional
        Times `emissive`.
    emissive_strength : float
        Times `emissive`, not negative (KHR_materials_emissive_strength).
    vertex_colors : bool
        Whether the mesh's colours multiply `color`, alpha included (3.9.2).
    alpha_mode : {"opaque", "mask", "blend"} or None
        "opaque" ignores the alpha of colour, map and vertices; "mask" makes holes where it is below `alpha_cutoff`;
        "blend" blends the surface (3.9.4). None blends it if any alpha is below 1, as other materials do. `opacity`
        counts in all modes, and ``blend=`` decides how the surface is blended, if it is given. A blended surface
        multiplies all of its light by alpha, reflections included.
    alpha_cutoff : float
        The smallest alpha that "mask" shows, not negative.
    ior : float
        Index of refraction of the dielectric, at least 1; 0 stands for infinity (KHR_materials_ior).
    specular_weight : float
        Strength of the dielectric's reflection, from 0 to 1 (KHR_materials_specular).
    specular_map : map, optional
        Alpha times `specular_weight`.
    specular_color : array_like (3,) or str
        Factor of the dielectric's reflectance seen head-on, not negative; the product ends at 1.
    specular_color_map : map, optional
        Times `specular_color`.
    clearcoat : float
        Share of a clear coat with an index of refraction of 1.5, from 0 to 1 (KHR_materials_clearcoat).
    clearcoat_map : map, optional
        Red times `clearcoat`.
    clearcoat_roughness : float
        Roughness of the coat, from 0 to 1.
    clearcoat_roughness_map : map, optional
        Green times `clearcoat_roughness`.
    clearcoat_normal_map : map, optional
        Normals of the coat. Without it the coat has the normals of the mesh.
    clearcoat_normal_scale : float
        Factor of the coat's normals' x and y, finite.
    sheen_color : array_like (3,) or str
        Linear RGB from 0 to 1 of fibres on the surface, as of velvet (KHR_materials_sheen).
    sheen_color_map : map, optional
        Times `sheen_color`.
    sheen_roughness : float
        How much the fibres spread, from 0 to 1.
    sheen_roughness_map : map, optional
        Alpha times `sheen_roughness`.
    iridescence : float
        Share of a thin film in which light interferes, from 0 to 1 (KHR_materials_iridescence).
    iridescence_map : map, optional
        Red times `iridescence`.
    iridescence_ior : float
        Index of refraction of the film, at least 1.
    iridescence_thickness_min, iridescence_thickness_max : float
        Thickness of the film in nanometres where the map is 0 and 1, not negative; without a map it is the latter.
    iridescence_thickness_map : map, optional
        Green goes from one thickness to the other.
    anisotropy : float
        How much highlights are stretched, from 0 to 1 (KHR_materials_anisotropy).
    anisotropy_rotation : float
        Direction of the stretch, degrees from the tangent towards the bitangent.
    anisotropy_map : map, optional
        Red and green are a direction to be turned by `anisotropy_rotation`, 0 to 1 for -1 to 1; blue times
        `anisotropy`.
    transmission : float
        Share of the light entering the dielectric that passes through it, times `color`, from 0 to 1
        (KHR_materials_transmission). The surface shows what lies behind.
    transmission_map : map, optional
        Red times `transmission`.
    thickness : float
        Thickness of the volume behind the surface, in the mesh's units, not negative; 0 is a thin wall, which bends
        no light (KHR_materials_volume).
    thickness_map : map, optional
        Green times `thickness`.
    attenuation_distance : float
        World units, above 0, after which white light in the volume has the colour `attenuation_color`.
    attenuation_color : array_like (3,) or str
        Linear RGB from 0 to 1.
    dispersion : float
        20 divided by the Abbe number, not negative: how far colours part in the volume (KHR_materials_dispersion).
    unlit : bool
        Whether `color` times its map is all that shows (KHR_materials_unlit).
    specular : {"levels", "sampled"}
        How the reflection of the environment is found. "levels": one lookup in the environment filtered by
        roughness, in the main direction of Lagarde and de Rousiers (2014), times the split sum of Karis (2013).
        "sampled": `specular_samples` directions by the visible normals of GGX (Dupuy and Benyoub 2023), looked up in
        box mipmaps (Krivanek and Colbert 2008): slower and closer to the exact integral. Clear coats always use the
        levels.
    specular_samples : int
        From 1 to 1024: 16 leave an error of about 12 %, 64 of 5 %.
    multiple_scattering : bool
        Whether the light that rough surfaces scatter more than once is added (Fdez-Aguera 2019); it is lost
        otherwise. Lights with a place or direction are not changed.
    opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
        The options of every `Material`.

    Raises
    ------
    ValueError
        For a value out of its range or not finite, or a name that is not in the list.
    TypeError
        For a map of another type.

    Notes
    -----
    Where glTF leaves a choice: lights see a roughness of at least 1/32, since a lamp of no size would be infinitely
    bright in a smooth mirror. The light of lights that passes through a transmissive surface is left out.

    Examples
    --------
    >>> import cubecam as cc
    >>> gold = cc.StandardMaterial(color=(1, .77, .34), roughness=.3)
    >>> gold.metallic, gold.roughness, gold.alpha_mode
    (1.0, 0.3, None)
    >>> cc.StandardMaterial(color="red", metallic=0, roughness=.5, clearcoat=1)
    StandardMaterial(color=(1, 0, 0, 1), metallic=0.0, roughness=0.5, clearcoat=1.0)
    """

    def __init__(
        self: StandardMaterial,
        *,
        color: str | np.typing.ArrayLike = (1, 1, 1),
        metallic: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        roughness: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        metallic_roughness_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        normal_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        normal_scale: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        occlusion_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        occlusion_strength: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        emissive: str | np.typing.ArrayLike = (0, 0, 0),
        emissive_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        emissive_strength: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        vertex_colors: bool = True,
        alpha_mode: AlphaMode | None = None,
        alpha_cutoff: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        ior: typing.SupportsFloat | typing.SupportsIndex = 1.5,
        specular_weight: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        specular_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        specular_color: str | np.typing.ArrayLike = (1, 1, 1),
        specular_color_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        clearcoat: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        clearcoat_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        clearcoat_roughness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        clearcoat_roughness_map: Texture
        | Image
        | RenderTexture
        | np.typing.ArrayLike
        | None = None,
        clearcoat_normal_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        clearcoat_normal_scale: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        sheen_color: str | np.typing.ArrayLike = (0, 0, 0),
        sheen_color_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        sheen_roughness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        sheen_roughness_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        iridescence: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        iridescence_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        iridescence_ior: typing.SupportsFloat | typing.SupportsIndex = 1.3,
        iridescence_thickness_min: typing.SupportsFloat | typing.SupportsIndex = 100.0,
        iridescence_thickness_max: typing.SupportsFloat | typing.SupportsIndex = 400.0,
        iridescence_thickness_map: Texture
        | Image
        | RenderTexture
        | np.typing.ArrayLike
        | None = None,
        anisotropy: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        anisotropy_rotation: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        anisotropy_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        transmission: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        transmission_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        thickness: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        thickness_map: Texture | Image | RenderTexture | np.typing.ArrayLike | None = None,
        attenuation_distance: typing.SupportsFloat | typing.SupportsIndex = ...,
        attenuation_color: str | np.typing.ArrayLike = (1, 1, 1),
        dispersion: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        unlit: bool = False,
        specular: SpecularMode = "levels",
        specular_samples: typing.SupportsIndex = 16,
        multiple_scattering: bool = True,
        opacity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        double_sided: bool = False,
        blend: BlendMode | Blend | None = None,
        depth_write: bool | None = None,
        depth_test: bool = True,
        color_write: bool | tuple[bool, bool, bool, bool] = True,
        stencil: Stencil | None = None,
        flat_shading: bool = False,
        name: str = "",
    ) -> None: ...
    @property
    def alpha_cutoff(self) -> float:
        """
        float: with "mask", the smallest alpha that shows, not negative.
        """

    @alpha_cutoff.setter
    def alpha_cutoff(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def alpha_mode(self) -> AlphaMode | None:
        """
        str or None: what alpha does; None blends if anything is translucent.
        """

    @alpha_mode.setter
    def alpha_mode(self, value: AlphaMode | None) -> None: ...
    @property
    def anisotropy(self) -> float:
        """
        float: how much highlights are stretched, from 0 to 1.
        """

    @anisotropy.setter
    def anisotropy(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def anisotropy_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: red and green are the direction, 0..1 for -1..1, blue times anisotropy.
        """

    @anisotropy_map.setter
    def anisotropy_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def anisotropy_rotation(self) -> float:
        """
        float: angle of the stretch from the tangent, counter-clockwise, degrees.
        """

    @anisotropy_rotation.setter
    def anisotropy_rotation(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def attenuation_color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB, from 0 to 1, read-only.
        """

    @attenuation_color.setter
    def attenuation_color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def attenuation_distance(self) -> float:
        """
        float: world units, above 0, after which white light has the attenuation colour; inf: never.
        """

    @attenuation_distance.setter
    def attenuation_distance(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearcoat(self) -> float:
        """
        float: share of a clear coat, from 0 to 1.
        """

    @clearcoat.setter
    def clearcoat(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearcoat_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: red times clearcoat.
        """

    @clearcoat_map.setter
    def clearcoat_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def clearcoat_normal_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: normals of the coat; None: those of the mesh.
        """

    @clearcoat_normal_map.setter
    def clearcoat_normal_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def clearcoat_normal_scale(self) -> float:
        """
        float: factor of x and y in clearcoat_normal_map.
        """

    @clearcoat_normal_scale.setter
    def clearcoat_normal_scale(
        self, value: typing.SupportsFloat | typing.SupportsIndex
    ) -> None: ...
    @property
    def clearcoat_roughness(self) -> float:
        """
        float: roughness of the coat, from 0 to 1.
        """

    @clearcoat_roughness.setter
    def clearcoat_roughness(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearcoat_roughness_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: green times clearcoat_roughness.
        """

    @clearcoat_roughness_map.setter
    def clearcoat_roughness_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (4,) float32: linear RGBA of the base, from 0 to 1, read-only.
        """

    @color.setter
    def color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def dispersion(self) -> float:
        """
        float: 20 divided by the Abbe number, not negative; 0: none.
        """

    @dispersion.setter
    def dispersion(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def emissive(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB of the light that the surface emits, read-only.
        """

    @emissive.setter
    def emissive(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def emissive_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: times emissive.
        """

    @emissive_map.setter
    def emissive_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def emissive_strength(self) -> float:
        """
        float: times emissive, not negative.
        """

    @emissive_strength.setter
    def emissive_strength(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def ior(self) -> float:
        """
        float: index of refraction, at least 1; 0 stands for infinity, where all light is reflected.
        """

    @ior.setter
    def ior(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def iridescence(self) -> float:
        """
        float: share of a thin film, from 0 to 1.
        """

    @iridescence.setter
    def iridescence(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def iridescence_ior(self) -> float:
        """
        float: index of refraction of the film, at least 1.
        """

    @iridescence_ior.setter
    def iridescence_ior(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def iridescence_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: red times iridescence.
        """

    @iridescence_map.setter
    def iridescence_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def iridescence_thickness_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: green goes from the least to the greatest thickness.
        """

    @iridescence_thickness_map.setter
    def iridescence_thickness_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def iridescence_thickness_max(self) -> float:
        """
        float: thickness of the film in nanometres where the map is 1, or without one.
        """

    @iridescence_thickness_max.setter
    def iridescence_thickness_max(
        self, value: typing.SupportsFloat | typing.SupportsIndex
    ) -> None: ...
    @property
    def iridescence_thickness_min(self) -> float:
        """
        float: thickness of the film in nanometres where the map is 0.
        """

    @iridescence_thickness_min.setter
    def iridescence_thickness_min(
        self, value: typing.SupportsFloat | typing.SupportsIndex
    ) -> None: ...
    @property
    def map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: times the colour and its alpha.
        """

    @map.setter
    def map(self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None) -> None: ...
    @property
    def metallic(self) -> float:
        """
        float: 0 is a dielectric, 1 a metal.
        """

    @metallic.setter
    def metallic(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def metallic_roughness_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: green times the roughness, blue times metallic.
        """

    @metallic_roughness_map.setter
    def metallic_roughness_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def multiple_scattering(self) -> bool:
        """
        bool: whether light that rough surfaces scatter several times is added.
        """

    @multiple_scattering.setter
    def multiple_scattering(self, value: bool) -> None: ...
    @property
    def normal_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: normals in the tangent frame, 0..1 for -1..1.
        """

    @normal_map.setter
    def normal_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def normal_scale(self) -> float:
        """
        float: factor of the normal map's x and y; negative ones turn bumps into dents.
        """

    @normal_scale.setter
    def normal_scale(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def occlusion_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: red is the share of the environment that reaches the surface.
        """

    @occlusion_map.setter
    def occlusion_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def occlusion_strength(self) -> float:
        """
        float: how much the occlusion map counts, from 0 to 1.
        """

    @occlusion_strength.setter
    def occlusion_strength(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def roughness(self) -> float:
        """
        float: from 0 (smooth) to 1; alpha is its square.
        """

    @roughness.setter
    def roughness(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sheen_color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB of a layer of fibres, from 0 to 1, read-only.
        """

    @sheen_color.setter
    def sheen_color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def sheen_color_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: times sheen_color.
        """

    @sheen_color_map.setter
    def sheen_color_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def sheen_roughness(self) -> float:
        """
        float: how much the fibres spread, from 0 to 1.
        """

    @sheen_roughness.setter
    def sheen_roughness(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def sheen_roughness_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: alpha times sheen_roughness.
        """

    @sheen_roughness_map.setter
    def sheen_roughness_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def specular(self) -> SpecularMode:
        """
        str: "levels" looks the reflection up once, in filtered levels; "sampled" takes many samples.
        """

    @specular.setter
    def specular(self, value: SpecularMode) -> None: ...
    @property
    def specular_color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB, factor of a dielectric's reflectance seen head-on, read-only.
        """

    @specular_color.setter
    def specular_color(self, value: str | np.typing.ArrayLike) -> None: ...
    @property
    def specular_color_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: times specular_color.
        """

    @specular_color_map.setter
    def specular_color_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def specular_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: alpha times specular_weight.
        """

    @specular_map.setter
    def specular_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def specular_samples(self) -> int:
        """
        int: how many samples "sampled" takes, from 1 to 1024.
        """

    @specular_samples.setter
    def specular_samples(self, value: typing.SupportsIndex) -> None: ...
    @property
    def specular_weight(self) -> float:
        """
        float: strength of a dielectric's reflection, from 0 to 1.
        """

    @specular_weight.setter
    def specular_weight(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def thickness(self) -> float:
        """
        float: of the volume behind the surface, in the mesh's units; 0: a thin wall.
        """

    @thickness.setter
    def thickness(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def thickness_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: green times thickness.
        """

    @thickness_map.setter
    def thickness_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def transmission(self) -> float:
        """
        float: share of the light entering a dielectric that passes through, from 0 to 1.
        """

    @transmission.setter
    def transmission(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def transmission_map(self) -> Texture | Image | RenderTexture | None:
        """
        Texture, Image, RenderTexture or None: red times transmission.
        """

    @transmission_map.setter
    def transmission_map(
        self, value: Texture | Image | RenderTexture | np.typing.ArrayLike | None
    ) -> None: ...
    @property
    def unlit(self) -> bool:
        """
        bool: whether the colour alone shows, without light or emission.
        """

    @unlit.setter
    def unlit(self, value: bool) -> None: ...
    @property
    def vertex_colors(self) -> bool:
        """
        bool: whether the colour is multiplied by the mesh's vertex colours.
        """

    @vertex_colors.setter
    def vertex_colors(self, value: bool) -> None: ...

class ImageEffect:
    """
    A pass over a finished picture, in GLSL (4.50 core): ``renderer.render(..., effects=[effect])``.

    Effects run one after the other, each over all pixels, in linear float32, after multisamples are resolved and before
    tone mapping and encoding.

    Parameters
    ----------
    fragment : str or path
        GLSL with a function ``vec4 effect(vec2 uv)``, which returns a pixel's new value, or a ``vec3``, which
        keeps the alpha. uv (0, 0) is the picture's bottom-left corner and (1, 1) its top-right. A str is the
        source itself; a path (``pathlib.Path``) names a file with the source.
    uniforms, textures : dict of str, optional
        As in `ShaderMaterial`, except that a probe is not allowed.

    Attributes
    ----------
    uniforms, textures : mutable mapping
        ``effect.uniforms["strength"] = 2`` shows in the next picture.

    Raises
    ------
    ValueError, TypeError, OSError, ShaderError
        As in `ShaderMaterial`.

    Notes
    -----
    The source may call ``vec4 frame(vec2 uv)`` (the picture so far, bilinear), ``vec4 frame_pixel(ivec2 pixel)`` (one
    pixel, unfiltered; (0, 0) is the bottom-left one) and ``ivec2 frame_size()``. The first two repeat the border pixels
    outside the picture.

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
        fragment: str | os.PathLike[str] | None,
        *,
        uniforms: collections.abc.Mapping[str, np.typing.ArrayLike] | None = None,
        textures: collections.abc.Mapping[
            str, Image | RenderTexture | CubeMap | Probe | np.typing.ArrayLike
        ]
        | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: ImageEffect) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: ImageEffect, state: object) -> None:
        """
        For unpickling.
        """

    def _remove_texture(self: ImageEffect, name: str) -> None: ...
    def _remove_uniform(self: ImageEffect, name: str) -> None: ...
    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def _set_inputs(self: ImageEffect, uniforms: object = None, textures: object = None) -> None:
        """
        Replace all uniforms, all textures, or both.
        """

    def _set_texture(self: ImageEffect, name: str, value: object) -> None: ...
    def _set_uniform(self: ImageEffect, name: str, value: object) -> None: ...
    def _textures(self: ImageEffect) -> dict[str, Image | RenderTexture | CubeMap | Probe]: ...
    def _uniforms(self: ImageEffect) -> dict[str, float | np.typing.NDArray[np.float64]]: ...
    def reload(self: ImageEffect) -> bool:
        """
        Read the source again from its file.

        If the new source does not compile, the next picture raises ShaderError; a later `reload` of a corrected file
        works.

        Returns
        -------
        bool
            Whether the source changed.

        Raises
        ------
        ValueError
            If no part of the source came from a file, or the file lacks its function.
        OSError
            If the file cannot be read; the old source stays.
        """

    @property
    def fragment(self) -> str:
        """
        str: GLSL that runs for every pixel. It can be set to text or a path; the next picture shows the change.
        """

    @fragment.setter
    def fragment(self, value: str | os.PathLike[str] | None) -> None: ...
    @property
    def textures(self) -> cubecam._shader_inputs.Textures:
        """
        Mapping of str to Image, RenderTexture, CubeMap or Probe: a name set here shows in the next picture.
        """

    @textures.setter
    def textures(
        self,
        value: collections.abc.Mapping[
            str, Image | RenderTexture | CubeMap | Probe | np.typing.ArrayLike
        ],
    ) -> None:
        """
        Replace all textures.
        """

    @property
    def uniforms(self) -> cubecam._shader_inputs.Uniforms:
        """
        Mapping of str to numbers: ``uniforms["time"] = 2`` shows in the next picture.
        """

    @uniforms.setter
    def uniforms(self, value: collections.abc.Mapping[str, np.typing.ArrayLike]) -> None:
        """
        Replace all uniforms.
        """

class Shadow:
    """
    How a light makes its shadow: a depth map from the light's view, and the filter of its lookups.

    A Shadow never changes; give a light a new one instead. All visible opaque nodes whose ``cast_shadow`` is
    True cast shadows, in or out of a picture's view, from either side of their surface, whether their material
    writes depth and colour or not. Shadows fall on
    every node with a `PhongMaterial` whose ``receive_shadow`` is True. A map is drawn again only when
    something in its view changes.

    The map of a directional light covers all casters, so a wide floor makes its texels wide. In this case set
    the floor's ``cast_shadow`` to False, or set an ``extent``.

    The edge of a shadow is about ``2 * radius + 1`` texels wide. A surface does not shadow itself, because
    each texel is compared with the depth of the surface's own plane at that texel; no bias has to be tuned.

    Parameters
    ----------
    size : int
        Texels along a side of the map; a point light has six maps. At least 8, and more for a larger radius;
        at most ``info.limits.max_frame_size``.
    radius : float
        Radius of the percentage-closer filter (Reeves, Salesin and Cook, 1987) in texels, from 0 to 16: a box
        of ``2 * radius + 1`` texels. 0 gives the hardest edge.
    bias : float
        World units, not negative: a caster nearer than this to a surface casts no shadow on it. The bias is
        added to a fraction of a texel that is always there.
    near : float
        Point and spot lights: a caster nearer than this to the light casts no shadow. World units, above 0.
    far : float or None
        Point and spot lights: a caster farther than this from the light casts no shadow. World units, above
        near. None: there is no such limit.
    extent : float or None
        Directional lights: width and height of the area that the map covers, world units, around the middle of
        the bounds of all casters (except its outermost texels, which stay empty); everything outside is lit.
        None: the map covers all casters.

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

    def __eq__(self: Shadow, other: object) -> bool: ...
    def __hash__(self: Shadow) -> int: ...
    def __init__(
        self: Shadow,
        *,
        size: typing.SupportsIndex = 1024,
        radius: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        bias: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex | None = None,
        extent: typing.SupportsFloat | typing.SupportsIndex | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Shadow) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def bias(self) -> float:
        """
        float: the distance within which nothing casts, world units.
        """

    @property
    def extent(self) -> float | None:
        """
        float or None: side of the area that the map covers, world units; directional lights.
        """

    @property
    def far(self) -> float | None:
        """
        float or None: casters farther from the light cast no shadow; point and spot lights.
        """

    @property
    def near(self) -> float:
        """
        float: casters nearer to the light cast no shadow; point and spot lights.
        """

    @property
    def radius(self) -> float:
        """
        float: radius of the filter, texels.
        """

    @property
    def size(self) -> int:
        """
        int: texels along a side of the map.
        """

class Light:
    """
    Base of the lights.

    A light may be in several scenes; every scene shows a change of it.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def __setstate__(self: Light, state: object) -> None:
        """
        For unpickling.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def color(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (3,) float32: linear RGB, read-only.
        """

    @color.setter
    def color(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def intensity(self) -> float:
        """
        float: a factor of color.
        """

    @intensity.setter
    def intensity(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class PointLight(Light):
    """
    Light from one point, the same in all directions.

    Parameters
    ----------
    position : array_like (3,)
        World space, or with a parent its coordinates.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
        decoded to linear. A light has no alpha: "transparent" raises ValueError.
    intensity : float
        A factor of `color`, not negative.
    decay : float
        The light falls with distance**-decay: 0 is no fall, 2 is the law of physics. Not negative.
    range : float
        The light ends at this distance, world units, above 0: it is multiplied by max(min(1 - (distance /
        range)**4, 1), 0), the window of KHR_lights_punctual. Infinity: no end.
    shadow : Shadow, bool or None
        None or False: the light casts no shadows. True: ``Shadow()``.
    parent : Node, optional
        A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
        changes neither its strength nor its range. The light does not keep the node alive; when the node no
        longer exists, `parent` is None.

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
        position: np.typing.ArrayLike = (0, 0, 0),
        *,
        color: str | np.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        decay: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        range: typing.SupportsFloat | typing.SupportsIndex = ...,
        shadow: Shadow | bool | None = None,
        parent: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: PointLight) -> str: ...
    @property
    def decay(self) -> float:
        """
        float: the light falls with distance**-decay.
        """

    @decay.setter
    def decay(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the light moves with. Position and direction stay, and are in the node's coordinates.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: world space, or the parent's coordinates; read-only.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def range(self) -> float:
        """
        float: the distance at which the light ends, world units; infinity for none.
        """

    @range.setter
    def range(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None casts no shadows; True sets ``Shadow()``.
        """

    @shadow.setter
    def shadow(self, value: Shadow | bool | None) -> None: ...
    @property
    def world_position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the position in world space, read-only.
        """

class SpotLight(Light):
    """
    Light from one point into a cone, by the formulas of glTF's KHR_lights_punctual.

    Parameters
    ----------
    position : array_like (3,)
        World space, or with a parent its coordinates.
    direction : array_like (3,)
        The way the light travels along the cone's axis, in world space or with a parent in its
        coordinates, of any length except 0; it is kept normalised. Straight down by default.
    angle : float
        Angle from the axis to the cone's edge, degrees: above 0, below 90. There is no light outside the cone.
    penumbra : float
        Share of the angle, from the edge inwards, over which the light fades: with 0 the edge is sharp, with
        1 the light fades from the axis on. The fade is the square of the share between the cosines of the two
        angles, as KHR_lights_punctual recommends; three.js has GLSL's smoothstep there.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
        decoded to linear. A light has no alpha: "transparent" raises ValueError.
    intensity : float
        A factor of `color`, not negative.
    decay : float
        The light falls with distance**-decay: 0 is no fall, 2 is the law of physics. Not negative.
    range : float
        The light ends at this distance, world units, above 0: it is multiplied by max(min(1 - (distance /
        range)**4, 1), 0), the window of KHR_lights_punctual. Infinity: no end.
    shadow : Shadow, bool or None
        None or False: the light casts no shadows. True: ``Shadow()``.
    parent : Node, optional
        A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
        changes neither its strength nor its range. The light does not keep the node alive; when the node no
        longer exists, `parent` is None.

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
        position: np.typing.ArrayLike = (0, 0, 0),
        direction: np.typing.ArrayLike = (0, -1, 0),
        *,
        angle: typing.SupportsFloat | typing.SupportsIndex = 30.0,
        penumbra: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        color: str | np.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        decay: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        range: typing.SupportsFloat | typing.SupportsIndex = ...,
        shadow: Shadow | bool | None = None,
        parent: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: SpotLight) -> str: ...
    @property
    def angle(self) -> float:
        """
        float: angle from the axis to the cone's edge, above 0 and below 90 degrees.
        """

    @angle.setter
    def angle(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def decay(self) -> float:
        """
        float: the light falls with distance**-decay.
        """

    @decay.setter
    def decay(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def direction(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the way the light travels, in world space or the parent's coordinates; unit length, read-only.
        """

    @direction.setter
    def direction(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the light moves with. Position and direction stay, and are in the node's coordinates.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def penumbra(self) -> float:
        """
        float: share of the angle over which the light fades, from 0 to 1.
        """

    @penumbra.setter
    def penumbra(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: world space, or the parent's coordinates; read-only.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def range(self) -> float:
        """
        float: the distance at which the light ends, world units; infinity for none.
        """

    @range.setter
    def range(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None casts no shadows; True sets ``Shadow()``.
        """

    @shadow.setter
    def shadow(self, value: Shadow | bool | None) -> None: ...
    @property
    def world_direction(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the way the light travels in world space, unit length, read-only.
        """

    @property
    def world_position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the position in world space, read-only.
        """

class DirectionalLight(Light):
    """
    Light from far away, such as the sun's.

    Parameters
    ----------
    direction : array_like (3,)
        The way the light travels, in world space or with a parent in its coordinates, of any length except 0; it
        is kept normalised. Straight down by default.
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
        decoded to linear. A light has no alpha: "transparent" raises ValueError.
    intensity : float
        A factor of `color`, not negative.
    shadow : Shadow, bool or None
        None or False: the light casts no shadows. True: ``Shadow()``.
    parent : Node, optional
        A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
        changes neither its strength nor its range. The light does not keep the node alive; when the node no
        longer exists, `parent` is None.

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
        direction: np.typing.ArrayLike = (0, -1, 0),
        *,
        color: str | np.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        shadow: Shadow | bool | None = None,
        parent: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: DirectionalLight) -> str: ...
    @property
    def direction(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the way the light travels, in world space or the parent's coordinates; unit length, read-only.
        """

    @direction.setter
    def direction(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the light moves with. Position and direction stay, and are in the node's coordinates.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def shadow(self) -> Shadow | None:
        """
        Shadow or None: None casts no shadows; True sets ``Shadow()``.
        """

    @shadow.setter
    def shadow(self, value: Shadow | bool | None) -> None: ...
    @property
    def world_direction(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the way the light travels in world space, unit length, read-only.
        """

class AmbientLight(Light):
    """
    Light of the same strength from all directions.

    Parameters
    ----------
    color : array_like (3,) or str
        Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
        decoded to linear. A light has no alpha: "transparent" raises ValueError.
    intensity : float
        A factor of `color`, not negative.

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
        color: str | np.typing.ArrayLike = (1, 1, 1),
        intensity: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: AmbientLight) -> str: ...

class Camera:
    """
    A camera given by its matrices.

    Matrices act on column vectors and are written in reading order, so that ``view @ point`` works.
    World and camera space are right-handed with +Y up, and the camera looks along -Z. Clip space is
    OpenGL's, from -1 to 1 in x, y and z.

    Parameters
    ----------
    view : array_like (4, 4)
        World to camera; last row (0, 0, 0, 1).
    projection : array_like (4, 4)
        Camera to clip space, for the aspect of the pictures that the camera will draw.

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
        self: Camera, *, view: np.typing.ArrayLike, projection: np.typing.ArrayLike
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Camera) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def intrinsics(self: Camera, size: tuple[int, int]) -> np.typing.NDArray[np.float64]:
        """
        Make the camera matrix K of the pinhole model, in OpenCV's convention.

        A point (x, y, z) in OpenCV's camera axes (x to the right, y down, z forwards; see `world_to_camera_cv`) is
        seen at the pixel coordinates (u, v): ``K @ (x, y, z)`` is ``z * (u, v, 1)``. u counts from the left edge of
        the picture and v from its upper edge, so that the middle of the pixel of row i and column j is at
        (j + 0.5, i + 0.5). OpenCV's own functions count from the middle of the first pixel: subtract 0.5 from K[0, 2]
        and K[1, 2] for these.

        Parameters
        ----------
        size : tuple of int
            The (width, height) of the picture in pixels.

        Returns
        -------
        ndarray (3, 3) float64
            ``[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]`` in pixels. The projection of a `Camera` may also
            have a skew, K[0, 1].

        Raises
        ------
        ValueError
            For a camera of parallel rays, or a size below 1.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(fov=90)
        >>> camera.intrinsics((640, 480)).tolist()
        [[240.0, 0.0, 320.0], [0.0, 240.0, 240.0], [0.0, 0.0, 1.0]]
        """

    def projection(
        self: Camera, aspect: typing.SupportsFloat | typing.SupportsIndex = 1.0
    ) -> np.typing.NDArray[np.float64]:
        """
        Camera to clip space.

        Parameters
        ----------
        aspect : float
            Width of the picture divided by its height. A camera given by its matrices ignores `aspect`.

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
    def view(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """

    @view.setter
    def view(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def world_to_camera_cv(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: world to camera in OpenCV's axes (x to the right, y down, z forwards), read-only: the extrinsics [R t].
        """

    @property
    def world_to_camera_gl(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: world to camera in OpenGL's axes (x to the right, y up, z backwards), read-only; the same as `view`.
        """

class PerspectiveCamera(Camera):
    """
    A camera with a vanishing point.

    Parameters
    ----------
    fov : float
        Vertical field of view in degrees, above 0 and below 180.
    position : array_like (3,)
        World space, or with a parent its coordinates, as target and up.
    target : array_like (3,), optional
        The point that the camera looks at. None: the camera looks along -Z from any position, with a parent
        along the parent's -Z.
    up : array_like (3,)
        The direction that is up in the picture; not along the line of sight.
    near, far : float
        Depths in world units between which surfaces are drawn: 0 < near < far.
    shift : array_like (2,)
        How far the middle of the picture lies right of and above the camera's axis, in heights of the
        picture: an off-axis frustum. With (0, .5) the horizon is at the lower edge, and vertical lines stay
        vertical, as with a shift lens for architecture.
    pixel_aspect : float
        The width of a pixel over its height, above 0: 1 for the pixels of screens, and close to 1 for those
        of calibrated cameras; see `from_intrinsics`.
    parent : Node, optional
        A node, of any scene, that the camera moves with. A scale of the node moves the camera's points, but
        changes neither the lens nor any length of it. With the position (0, 0, 0) and no target the camera is
        that of a glTF node. The camera does not keep the node alive; when the node no longer exists, `parent`
        is None. `look_at`, `fit`, `orbit` and the like take and keep points and lengths of the world.

    Raises
    ------
    ValueError
        For a target equal to the position, an up along the line of sight, near >= far, or a number out
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

    @staticmethod
    def from_intrinsics(
        K: np.typing.ArrayLike,
        size: tuple[int, int],
        *,
        world_to_camera_cv: np.typing.ArrayLike | None = None,
        position: np.typing.ArrayLike | None = None,
        target: np.typing.ArrayLike | None = None,
        up: np.typing.ArrayLike | None = None,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
    ) -> PerspectiveCamera:
        """
        Make the camera whose `intrinsics` are K: the inverse of that function.

        The field of view follows from the focal length fy, `shift` from the principal point (cx, cy), and
        `pixel_aspect` from fy / fx, so that any calibrated camera without skew is drawn exactly. Lens distortion is
        not drawn: undistort the photographs.

        Parameters
        ----------
        K : array_like (3, 3)
            ``[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]`` in pixels; the middle of the first pixel is at (0.5, 0.5). Add
            0.5 to cx and cy of ``cv2.calibrateCamera``, which counts from there.
        size : tuple of int
            The (width, height) in pixels of the pictures to which K belongs.
        world_to_camera_cv : array_like (4, 4), optional
            The extrinsics in OpenCV's axes, a rotation and a translation, in place of position, target and up.
        position, target, up, near, far
            As for `PerspectiveCamera`.

        Returns
        -------
        PerspectiveCamera
            It draws pictures of any size; those of the same aspect show the same view.

        Raises
        ------
        ValueError
            For a K with skew (a `Camera` draws it), focal lengths that are not above 0, another last row than
            (0, 0, 1), or a matrix with a scale, a shear or a mirror.

        Examples
        --------
        >>> import cubecam as cc, numpy as np
        >>> K = np.array([[525.0, 0, 319.5], [0, 525.5, 239.5], [0, 0, 1]])
        >>> camera = cc.PerspectiveCamera.from_intrinsics(K, (640, 480), position=(0, 0, 2), target=(0, 0, 0))
        >>> bool(np.allclose(camera.intrinsics((640, 480)), K, rtol=1e-12))
        True
        """

    def __init__(
        self: PerspectiveCamera,
        *,
        fov: typing.SupportsFloat | typing.SupportsIndex = 60.0,
        position: np.typing.ArrayLike = (0, 0, 0),
        target: np.typing.ArrayLike | None = None,
        up: np.typing.ArrayLike = (0, 1, 0),
        near: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        shift: np.typing.ArrayLike = (0, 0),
        pixel_aspect: typing.SupportsFloat | typing.SupportsIndex = 1.0,
        parent: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: PerspectiveCamera) -> str: ...
    def __setstate__(self: PerspectiveCamera, state: object) -> None:
        """
        For unpickling.
        """

    def _place_in_world(
        self: PerspectiveCamera, position: np.typing.ArrayLike, target: np.typing.ArrayLike | None
    ) -> None:
        """
        Set position and target, in world space.
        """

    def _world_placement(
        self: PerspectiveCamera,
    ) -> tuple[
        np.typing.NDArray[np.float64],
        np.typing.NDArray[np.float64] | None,
        np.typing.NDArray[np.float64],
        np.typing.NDArray[np.float64],
    ]:
        """
        Position, target, up and the way to the target, in world space.
        """

    def fit(
        self: PerspectiveCamera,
        what: Scene | Node | np.typing.ArrayLike,
        *,
        size: tuple[int, int] | None = None,
        aspect: typing.SupportsFloat | typing.SupportsIndex | None = None,
        margin: typing.SupportsFloat | typing.SupportsIndex = 0.05,
    ) -> None:
        """
        Move the camera, without turning it, so that a scene or node fills the picture.

        All corners of the bounds are in the picture, and two opposite borders are reached, up to the margin. The
        target becomes the point on the line of sight nearest to the middle of the bounds, so that `orbit` goes
        round it. An `OrthographicCamera` gets another `height` and moves back if anything is behind it. `near` and
        `far` stay if the bounds lie between them; otherwise near becomes half the depth of the nearest corner, and
        far twice that of the farthest one.

        Parameters
        ----------
        what : Scene, Node or array_like (2, 3)
            What fills the picture: `Scene.bounds`, `Node.world_bounds`, or a lowest and a highest corner.
        size : tuple of int, optional
            The (width, height) of the picture, as for `Renderer.render`.
        aspect : float, optional
            Width over height, in place of `size`. Without both: 1, a square, which fits wider pictures, too.
        margin : float
            The share of width and height that stays free at each border, at least 0 and below 0.5.

        Raises
        ------
        TypeError
            For another kind of object.
        ValueError
            For bounds of nothing or of a single point, or a number out of its range. The camera then stays as it
            was.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> box = scene.add(cc.Mesh.box(2), position=(5, 0, 0))
        >>> camera = cc.PerspectiveCamera(fov=90)
        >>> camera.fit(scene, margin=0)
        >>> camera.position.round(6).tolist(), camera.target.round(6).tolist()
        ([5.0, 0.0, 2.0], [5.0, 0.0, 0.0])
        """

    def look(self, direction: np.typing.ArrayLike) -> None:
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
            For a direction that is not three finite numbers, has length 0, or lies along `up`.
        TypeError
            For a camera given by its matrices, or a direction that is not a vector.

        Notes
        -----
        The new target lies in this direction, at the distance of the old target, or at distance 1 if there was none.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(1, 0, 0))
        >>> camera.look((0, 0, 2))
        >>> camera.target.tolist()
        [1.0, 0.0, 1.0]
        """

    def look_at(
        self: PerspectiveCamera,
        target: Node | np.typing.ArrayLike,
        *,
        up: np.typing.ArrayLike | None = None,
    ) -> None:
        """
        Turn the camera, from where it is, towards a point.

        Parameters
        ----------
        target : array_like (3,) or Node
            World space, of a node its origin; it becomes the camera's `target`, with a parent in its coordinates.
        up : array_like (3,), optional
            The direction that is up in the picture; it becomes the camera's `up`. None: the camera's `up` stays.

        Raises
        ------
        ValueError
            For a target at the camera's position, or an up along the line of sight: a camera that looks straight
            down needs another one, such as ``up=(0, 0, -1)``. The camera then stays as it was.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 10, 0))
        >>> camera.look_at((0, 0, 0), up=(0, 0, -1))
        >>> camera.world_to_camera_cv[2].tolist()
        [0.0, -1.0, 0.0, 10.0]
        """

    def orbit(self, *, yaw: float = 0.0, pitch: float = 0.0) -> None:
        """
        Move round the target, as if the viewer turned the scene by hand.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            A camera with a target.
        yaw : float
            Degrees round `up`. Positive turns the scene to the right, like a drag to the right: the camera moves to its
            left.
        pitch : float
            Degrees of elevation. Positive tips the scene towards the viewer, like a drag downwards: the camera rises. It
            stops 1 degree (`POLE_MARGIN`) before straight above and straight below the target.

        Raises
        ------
        ValueError
            For a camera without a target, or a number that is not finite.
        TypeError
            As `yaw`.

        Notes
        -----
        The target and the distance to it stay.

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
            Positive looks up. The view stops 1 degree (`POLE_MARGIN`) before straight up and straight down; a view that
            is already nearer to a pole does not move towards it.

        Raises
        ------
        ValueError, TypeError
            As `yaw`.

        Notes
        -----
        The position and the distance to the target stay. A camera without a target gets one at distance 1.

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
        Move position and target to the right.

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
        Move position and target along the view direction.

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
            For a camera given by its matrices, or an angle that is not a number.

        Notes
        -----
        The position and the distance to the target stay. A camera without a target gets one at distance 1.

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
        float: the farthest depth that is drawn, world units.
        """

    @far.setter
    def far(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def fov(self) -> float:
        """
        float: vertical, above 0 and below 180 degrees.
        """

    @fov.setter
    def fov(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def near(self) -> float:
        """
        float: the nearest depth that is drawn, world units.
        """

    @near.setter
    def near(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the camera moves with. Position, target and up stay, and are in the node's coordinates.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def pixel_aspect(self) -> float:
        """
        float: the width of a pixel over its height; 1 for pixels of every screen.
        """

    @pixel_aspect.setter
    def pixel_aspect(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: world space, or the parent's coordinates; read-only. Setting the position keeps the target.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def shift(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (2,) float64: how far the middle of the picture lies right of and above the axis, in heights of the picture, read-only.
        """

    @shift.setter
    def shift(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def target(self) -> np.typing.NDArray[np.float64] | None:
        """
        ndarray (3,) float64 or None: the point that the camera looks at, in world space or the parent's coordinates; read-only. None: the camera looks along -Z, with a parent along the parent's.
        """

    @target.setter
    def target(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def up(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the direction that is up in the picture, in world space or the parent's coordinates; read-only.
        """

    @up.setter
    def up(self, value: np.typing.ArrayLike) -> None: ...
    @property  # type: ignore[misc]
    def view(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """

    @property
    def world_position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the position in world space, read-only.
        """

class OrthographicCamera(Camera):
    """
    A camera of parallel rays.

    For mirrors and highlights, the incident direction is the view direction. The output `distance` counts
    from the near plane.

    Parameters
    ----------
    height : float
        World units from the bottom to the top of the picture, above 0.
    position : array_like (3,)
        World space, or with a parent its coordinates, as target and up.
    target : array_like (3,), optional
        The point that the camera looks at. None: the camera looks along -Z from any position, with a parent
        along the parent's -Z.
    up : array_like (3,)
        The direction that is up in the picture; not along the line of sight.
    near, far : float
        Depths in world units between which surfaces are drawn: near < far.
    parent : Node, optional
        A node, of any scene, that the camera moves with. A scale of the node moves the camera's points, but
        changes neither the lens nor any length of it. With the position (0, 0, 0) and no target the camera is
        that of a glTF node. The camera does not keep the node alive; when the node no longer exists, `parent`
        is None. `look_at`, `fit`, `orbit` and the like take and keep points and lengths of the world.

    Raises
    ------
    ValueError
        For a target equal to the position, an up along the line of sight, near >= far, or a number out
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
        position: np.typing.ArrayLike = (0, 0, 0),
        target: np.typing.ArrayLike | None = None,
        up: np.typing.ArrayLike = (0, 1, 0),
        near: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        parent: Node | None = None,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: OrthographicCamera) -> str: ...
    def __setstate__(self: OrthographicCamera, state: object) -> None:
        """
        For unpickling.
        """

    def _place_in_world(
        self: OrthographicCamera, position: np.typing.ArrayLike, target: np.typing.ArrayLike | None
    ) -> None:
        """
        Set position and target, in world space.
        """

    def _world_placement(
        self: OrthographicCamera,
    ) -> tuple[
        np.typing.NDArray[np.float64],
        np.typing.NDArray[np.float64] | None,
        np.typing.NDArray[np.float64],
        np.typing.NDArray[np.float64],
    ]:
        """
        Position, target, up and the way to the target, in world space.
        """

    def fit(
        self: OrthographicCamera,
        what: Scene | Node | np.typing.ArrayLike,
        *,
        size: tuple[int, int] | None = None,
        aspect: typing.SupportsFloat | typing.SupportsIndex | None = None,
        margin: typing.SupportsFloat | typing.SupportsIndex = 0.05,
    ) -> None:
        """
        Move the camera, without turning it, so that a scene or node fills the picture.

        All corners of the bounds are in the picture, and two opposite borders are reached, up to the margin. The
        target becomes the point on the line of sight nearest to the middle of the bounds, so that `orbit` goes
        round it. An `OrthographicCamera` gets another `height` and moves back if anything is behind it. `near` and
        `far` stay if the bounds lie between them; otherwise near becomes half the depth of the nearest corner, and
        far twice that of the farthest one.

        Parameters
        ----------
        what : Scene, Node or array_like (2, 3)
            What fills the picture: `Scene.bounds`, `Node.world_bounds`, or a lowest and a highest corner.
        size : tuple of int, optional
            The (width, height) of the picture, as for `Renderer.render`.
        aspect : float, optional
            Width over height, in place of `size`. Without both: 1, a square, which fits wider pictures, too.
        margin : float
            The share of width and height that stays free at each border, at least 0 and below 0.5.

        Raises
        ------
        TypeError
            For another kind of object.
        ValueError
            For bounds of nothing or of a single point, or a number out of its range. The camera then stays as it
            was.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> box = scene.add(cc.Mesh.box(2), position=(5, 0, 0))
        >>> camera = cc.PerspectiveCamera(fov=90)
        >>> camera.fit(scene, margin=0)
        >>> camera.position.round(6).tolist(), camera.target.round(6).tolist()
        ([5.0, 0.0, 2.0], [5.0, 0.0, 0.0])
        """

    def look(self, direction: np.typing.ArrayLike) -> None:
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
            For a direction that is not three finite numbers, has length 0, or lies along `up`.
        TypeError
            For a camera given by its matrices, or a direction that is not a vector.

        Notes
        -----
        The new target lies in this direction, at the distance of the old target, or at distance 1 if there was none.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(1, 0, 0))
        >>> camera.look((0, 0, 2))
        >>> camera.target.tolist()
        [1.0, 0.0, 1.0]
        """

    def look_at(
        self: OrthographicCamera,
        target: Node | np.typing.ArrayLike,
        *,
        up: np.typing.ArrayLike | None = None,
    ) -> None:
        """
        Turn the camera, from where it is, towards a point.

        Parameters
        ----------
        target : array_like (3,) or Node
            World space, of a node its origin; it becomes the camera's `target`, with a parent in its coordinates.
        up : array_like (3,), optional
            The direction that is up in the picture; it becomes the camera's `up`. None: the camera's `up` stays.

        Raises
        ------
        ValueError
            For a target at the camera's position, or an up along the line of sight: a camera that looks straight
            down needs another one, such as ``up=(0, 0, -1)``. The camera then stays as it was.

        Examples
        --------
        >>> import cubecam as cc
        >>> camera = cc.PerspectiveCamera(position=(0, 10, 0))
        >>> camera.look_at((0, 0, 0), up=(0, 0, -1))
        >>> camera.world_to_camera_cv[2].tolist()
        [0.0, -1.0, 0.0, 10.0]
        """

    def orbit(self, *, yaw: float = 0.0, pitch: float = 0.0) -> None:
        """
        Move round the target, as if the viewer turned the scene by hand.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            A camera with a target.
        yaw : float
            Degrees round `up`. Positive turns the scene to the right, like a drag to the right: the camera moves to its
            left.
        pitch : float
            Degrees of elevation. Positive tips the scene towards the viewer, like a drag downwards: the camera rises. It
            stops 1 degree (`POLE_MARGIN`) before straight above and straight below the target.

        Raises
        ------
        ValueError
            For a camera without a target, or a number that is not finite.
        TypeError
            As `yaw`.

        Notes
        -----
        The target and the distance to it stay.

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
            Positive looks up. The view stops 1 degree (`POLE_MARGIN`) before straight up and straight down; a view that
            is already nearer to a pole does not move towards it.

        Raises
        ------
        ValueError, TypeError
            As `yaw`.

        Notes
        -----
        The position and the distance to the target stay. A camera without a target gets one at distance 1.

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
        Move position and target to the right.

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
        Move position and target along the view direction.

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
            For a camera given by its matrices, or an angle that is not a number.

        Notes
        -----
        The position and the distance to the target stay. A camera without a target gets one at distance 1.

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
        float: the farthest depth that is drawn, world units.
        """

    @far.setter
    def far(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def height(self) -> float:
        """
        float: world units from the bottom to the top of the picture.
        """

    @height.setter
    def height(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def near(self) -> float:
        """
        float: the nearest depth that is drawn, world units.
        """

    @near.setter
    def near(self, value: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def parent(self) -> Node | None:
        """
        Node or None: the node that the camera moves with. Position, target and up stay, and are in the node's coordinates.
        """

    @parent.setter
    def parent(self, value: Node | None) -> None: ...
    @property
    def position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: world space, or the parent's coordinates; read-only. Setting the position keeps the target.
        """

    @position.setter
    def position(self, value: np.typing.ArrayLike) -> None: ...
    @property
    def target(self) -> np.typing.NDArray[np.float64] | None:
        """
        ndarray (3,) float64 or None: the point that the camera looks at, in world space or the parent's coordinates; read-only. None: the camera looks along -Z, with a parent along the parent's.
        """

    @target.setter
    def target(self, value: np.typing.ArrayLike | None) -> None: ...
    @property
    def up(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the direction that is up in the picture, in world space or the parent's coordinates; read-only.
        """

    @up.setter
    def up(self, value: np.typing.ArrayLike) -> None: ...
    @property  # type: ignore[misc]
    def view(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (4, 4) float64: world to camera, read-only.
        """

    @property
    def world_position(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (3,) float64: the position in world space, read-only.
        """

class AnimationChannel:
    """
    One property of a node as a function of time, by keys.

    A channel does not change once it is made.

    Parameters
    ----------
    node : Node
        The node that moves.
    path : str
        "translation" (`Node.position`), "rotation" (w, x, y, z), "scale" or "weights" (`Node.weights`).
    times : array_like (K,)
        Seconds, increasing strictly.
    values : array_like (K, n) or (3K, n)
        A row for each key. n is 3, for rotations 4, for weights the number of the mesh's morph targets. Of
        "cubic" three rows for each key: in-tangent, value, out-tangent.
    interpolation : str
        "step": a value stays until the next key. "linear": rotations are interpolated spherically, along the
        shorter way. "cubic": a cubic Hermite spline.

    Raises
    ------
    TypeError
        For a node of another type.
    ValueError
        For times that do not increase or are not finite, values of another shape or not finite, a rotation of
        length 0, or another name.

    Notes
    -----
    The formulas are those of glTF 2.0, appendix C. Rotations are normalised, keys and results. A channel does
    not keep its node alive.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> door = scene.add(cc.Mesh.box((1, 2, .1)))
    >>> turns = [cc.axis_angle((0, 1, 0), degrees) for degrees in (0, 90)]
    >>> channel = cc.AnimationChannel(door, "rotation", [0, 1], turns)
    >>> channel
    AnimationChannel(node 1, 'rotation', 2 keys, 0 to 1 s, 'linear')
    >>> bool((channel.sample(.5) == channel.sample(.5)).all()), channel.sample(.5).round(3).tolist()
    (True, [0.924, 0.0, 0.383, 0.0])
    """

    @staticmethod
    def _remake(
        format: typing.SupportsIndex,
        path: AnimationPath,
        times: np.typing.ArrayLike,
        values: np.typing.ArrayLike,
        interpolation: Interpolation,
    ) -> AnimationChannel:
        """
        For unpickling: a channel without a node.
        """

    def __init__(
        self: AnimationChannel,
        node: Node,
        path: AnimationPath,
        times: np.typing.ArrayLike,
        values: np.typing.ArrayLike,
        *,
        interpolation: Interpolation = "linear",
    ) -> None: ...
    def __reduce__(self) -> tuple[object, tuple[type], tuple[object, ...]]: ...
    def __repr__(self: AnimationChannel) -> str: ...
    def __setstate__(self: AnimationChannel, state: object) -> None:
        """
        For unpickling.
        """

    def sample(
        self: AnimationChannel, seconds: typing.SupportsFloat | typing.SupportsIndex
    ) -> np.typing.NDArray[np.float64]:
        """
        The value of the channel at a time.

        Parameters
        ----------
        seconds : float
            Before the first and after the last key, the value is that of the key.

        Returns
        -------
        ndarray (n,) float64

        Raises
        ------
        ValueError
            For seconds that are not finite.
        """

    @property
    def interpolation(self) -> Interpolation:
        """
        str: "step", "linear" or "cubic".
        """

    @property
    def node(self) -> Node | None:
        """
        Node or None: the node that moves; None once it no longer exists.
        """

    @property
    def path(self) -> AnimationPath:
        """
        str: "translation", "rotation", "scale" or "weights".
        """

    @property
    def times(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (K,) float64: seconds, read-only.
        """

    @property
    def values(self) -> np.typing.NDArray[np.float64]:
        """
        ndarray (K, n) or (3K, n) float64: as they were given, read-only.
        """

class Animation:
    """
    Channels that move nodes of a scene together.

    `Scene.set_time` moves the nodes. An animation does not change once it is made.

    Parameters
    ----------
    channels : sequence of AnimationChannel
        At most one for each path of each node.
    name : str
        A name for people, and for `Scene.set_time`.

    Raises
    ------
    TypeError
        For another kind of object.
    ValueError
        For two channels of the same path of the same node.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> lift = scene.add(cc.Mesh.box())
    >>> rise = cc.AnimationChannel(lift, "translation", [0, 4], [(0, 0, 0), (0, 3, 0)])
    >>> animation = scene.add(cc.Animation([rise], name="rise"))
    >>> animation
    Animation(name='rise', 1 channel, 4 s)
    >>> for frame in range(5):
    ...     height = scene.set_time(frame).nodes[0].position[1]
    >>> float(height)
    3.0
    """

    def __init__(
        self: Animation, channels: collections.abc.Iterable[AnimationChannel], *, name: str = ""
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Animation) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def channels(self) -> tuple[AnimationChannel, ...]:
        """
        tuple of AnimationChannel: in the order in which they were given.
        """

    @property
    def duration(self) -> float:
        """
        float: the time of the last key of all channels, seconds.
        """

    @property
    def name(self) -> str:
        """
        str: a name for people.
        """

class StereoCamera:
    """
    Two eyes, whose pictures are drawn in one call and combined.

    ``renderer.render(scene, stereo_camera, size)`` returns one Frame of that size. Each eye's picture equals,
    bit for bit, the picture that its camera draws alone with the aspect of its part. Tone mapping and encoding
    come before the pictures are combined. Only an eye whose picture changed is drawn again.

    Parameters
    ----------
    left, right : Camera
        Any two cameras; the next picture shows a change of either.
    layout : {"anaglyph", "side_by_side", "top_bottom"}
        "anaglyph", for red-cyan glasses: red from the left eye, green and blue from the right, and the greater
        alpha of both; there are no outputs. "side_by_side": the left eye fills the left half; the width must be
        even. "top_bottom": the left eye fills the upper half; the height must be even. Outputs are placed side
        by side, or top to bottom, like the colour.

    Raises
    ------
    TypeError
        For an eye that is not a Camera.
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
        layout: StereoLayout = "anaglyph",
    ) -> StereoCamera:
        """
        Place two eyes beside a camera, with parallel axes.

        The eyes stand half of `separation` to the left and to the right of the camera, along its own right axis,
        and look in the camera's direction. Without `convergence`, infinitely far points have no parallax, and all
        other points appear in front of the screen.

        Parameters
        ----------
        camera : Camera
            The camera in the middle between the eyes; it is copied.
        separation : float
            Distance between the eyes, world units, not negative. 0.065 is that of a person, in metres.
        convergence : float, optional
            Distance along the camera's axis, world units, at which points have the same place in both pictures:
            farther points appear behind the screen, nearer points in front of it. The frusta are sheared and not
            turned, so that there is no vertical parallax. An orthographic camera has no convergence.
        layout : {"anaglyph", "side_by_side", "top_bottom"}
            See `StereoCamera`.

        Returns
        -------
        StereoCamera

        Raises
        ------
        ValueError
            For a number out of its range or not finite, or a convergence with an orthographic camera.

        Notes
        -----
        P. Bourke, "Calculating Stereo Pairs", 1999. In the right eye's picture, a point at depth z lies
        ``separation * (1 / convergence - 1 / z) * f / 2`` widths of the picture farther to the right than in the
        left eye's picture, where f is ``camera.projection(aspect)[0, 0]``.
        """

    @staticmethod
    def toe_in(
        camera: Camera,
        *,
        degrees: typing.SupportsFloat | typing.SupportsIndex = 4.0,
        layout: StereoLayout = "anaglyph",
    ) -> StereoCamera:
        """
        Place two eyes on a circle round a camera's target; both look at the target.

        The view is turned by half of `degrees` to the left and to the right, about the axis through the target
        that is up in the camera's picture. This causes vertical parallax towards the corners, which `off_axis`
        avoids.

        Parameters
        ----------
        camera : PerspectiveCamera or OrthographicCamera
            The camera in the middle between the eyes, with a target; it is copied.
        degrees : float
            Angle between the two eyes as seen from the target: from 0 to below 180.
        layout : {"anaglyph", "side_by_side", "top_bottom"}
            See `StereoCamera`.

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
        self: StereoCamera, left: Camera, right: Camera, *, layout: StereoLayout = "anaglyph"
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: StereoCamera) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def layout(self) -> StereoLayout:
        """
        str: "anaglyph", "side_by_side" or "top_bottom".
        """

    @layout.setter
    def layout(self, value: StereoLayout) -> None: ...
    @property
    def left(self) -> Camera:
        """
        Camera: the camera of the left eye.
        """

    @left.setter
    def left(self, value: Camera) -> None: ...
    @property
    def right(self) -> Camera:
        """
        Camera: the camera of the right eye.
        """

    @right.setter
    def right(self, value: Camera) -> None: ...

class Stats:
    """
    What the last call of a renderer drew and skipped, and how long it took.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Stats) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def bounce_changes(self) -> tuple[float, ...]:
        """
        tuple of float: how much each bounce after the first changed what mirrors show.

        Entry i compares the picture of a probe with i + 2 bounces to that with i + 1: the root of the mean of the squared differences of red, green and blue, as the pictures hold them, in the directions of the texels of a cube of 32 texels an edge, over all probes that the call drew and of which it needed both pictures; nan if there is no such probe. Empty if no probe of more than one bounce was drawn.
        """

    @property
    def draw_calls(self) -> int:
        """
        int
        """

    @property
    def faces_filtered(self) -> int:
        """
        int: faces of cubemaps and probes that were filtered by roughness, since they had changed.
        """

    @property
    def milliseconds(self) -> float:
        """
        float: time of the whole call, including the copy to main memory.
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
        int: triangles sent to the GPU, counted once for each view.
        """

    @property
    def triangles_simplified(self) -> int:
        """
        int: how many triangles the levels of detail that were drawn have fewer than their meshes (``max_lod_error``); counted once for each view.
        """

    @property
    def triangles_skipped(self) -> int:
        """
        int: triangles of drawn meshes that were not sent, since they lie outside of the part of the picture that was drawn; counted once for each view.

        A large mesh (in software one of 2,000 triangles, on a GPU of 100,000) is drawn in part where only a part of it shows in what changed, or in the picture. The picture has the same bytes.
        """

    @property
    def views_drawn(self) -> int:
        """
        int: pictures drawn: frames, faces of captures, faces of probes, textures.
        """

    @property
    def views_skipped(self) -> int:
        """
        int: pictures that were up to date and not drawn again.
        """

class Limits:
    """
    The greatest values that the driver allows.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

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
        int: pixels along an edge of a face of a cubemap that is looked up.
        """

    @property
    def max_face_size(self) -> int:
        """
        int: pixels along an edge of a face that can be captured; a driver may draw smaller ones than it looks up.
        """

    @property
    def max_frame_size(self) -> int:
        """
        int: pixels along a side of a frame that can be drawn.
        """

    @property
    def max_samples(self) -> int:
        """
        int: samples of each pixel (MSAA).
        """

    @property
    def max_texture_size(self) -> int:
        """
        int: pixels along a side of a texture.
        """

class RendererInfo:
    """
    The device, driver and limits of a renderer.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: RendererInfo) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    @property
    def device(self) -> Device:
        """
        Device: the device of the renderer.
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
        bool: whether one draw call draws a mesh on all faces of a cube.
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
        bool: whether the device renders on the CPU.
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
    A rendered picture: arrays with row 0 on top, which belong to the caller.

    An output that ``outputs=`` does not request is None; type checkers see the array of an output that was
    requested. Only opaque nodes write the outputs; `depth` and
    `stencil` are the contents of these buffers after the last node is drawn.

    ``frame.save("x.png")`` writes the picture as a screen shows it, and a notebook shows it the same way.
    ``np.asarray(frame)`` is `color`, and functions that take arrays, such as ``plt.imshow``, take the frame.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 0, 0))
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(scene, cc.PerspectiveCamera(), size=(4, 2))
    >>> frame
    Frame(size=(4, 2), format='rgba8', encoding='linear')
    >>> frame.color.shape, frame.color[0, 0].tolist()
    ((2, 4, 4), [255, 0, 0, 255])
    """

    def __array__(
        self, dtype: np.dtype[np.generic] | None = None, copy: bool | None = None
    ) -> np.typing.NDArray[np.generic]:
        """
        Give the picture's numbers to ``numpy.asarray``: the colour of a frame, the faces of a cubemap.

        Parameters
        ----------
        dtype : dtype, optional
            None: that of the picture.
        copy : bool, optional
            True: always a copy. False: never; raises ValueError if `dtype` needs one. None: a copy if `dtype` needs one.

        Returns
        -------
        ndarray (H, W, C), of a cubemap (6, N, N, C)
            Without a copy, that of a cubemap or an image is read-only.

        Raises
        ------
        ValueError
            For a frame without a colour, or a copy that is not allowed.
        """

    def __dlpack__(
        self,
        *,
        stream: object = None,
        max_version: tuple[int, int] | None = None,
        dl_device: tuple[int, int] | None = None,
        copy: bool | None = None,
    ) -> object:
        """
        Give the picture's numbers to ``from_dlpack`` of numpy, torch, jax and others (DLPack, array API 2023.12).

        A frame's colour is shared. The numbers of a cubemap and an image must not change: they are shared as read-only if
        the reader knows version 1 of DLPack, which can say so, and are copied otherwise.
        """

    def __dlpack_device__(self) -> tuple[int, int]:
        """
        Give the device of the numbers to ``from_dlpack``: main memory.
        """

    def __reduce__(self: Frame) -> tuple[object, ...]: ...
    def __repr__(self: Frame) -> str: ...
    def _repr_png_(self) -> bytes | None:
        """
        Give the picture that Jupyter shows: the file that `Frame.save` writes; None for a frame without a colour.
        """

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        exposure: float = 0.0,
        tonemap: Tonemap | None = "neutral",
        srgb: bool | None = None,
        half: bool = False,
    ) -> None:
        """
        Write the frame's colour as a picture. The method `Frame.save`.

        A file of 8 bits holds what a screen shows: linear floats are mapped by the tone curve, then everything linear is
        sRGB-encoded. EXR and HDR hold linear numbers.

        Parameters
        ----------
        path : str or os.PathLike
            The extension names the kind of file, as in `save_image`.
        exposure : float
            Stops: colours are multiplied by ``2**exposure``.
        tonemap : {"neutral", "reinhard", "aces"} or None
            The curve for linear floats, see `to_screen`. None clips, with a warning.
        srgb : bool, optional
            False writes the numbers as they are; None and True as described above.
        half : bool
            True stores an EXR with 16 bits a number.

        Raises
        ------
        OSError
            If the folder does not exist or may not be written, or the disk is full. The old file stays as it was.
        ValueError
            For a frame without a colour, an extension that is not in the list, or an alpha that the file cannot hold.

        Examples
        --------
        >>> import cubecam as cc, tempfile, pathlib
        >>> path = pathlib.Path(tempfile.mkdtemp(), "frame.png")
        >>> with cc.Renderer() as renderer:
        ...     frame = renderer.render(cc.Scene(background=(0.2, 0.2, 0.2)), cc.PerspectiveCamera(), size=(2, 1))
        >>> frame.save(path)
        >>> cc.load_image(path)[0, 0].tolist()
        [124, 124, 124, 255]
        """

    @property
    def _tonemapped(self) -> bool:
        """
        bool: whether `Renderer.render` applied a tone curve, so that files need none.
        """

    @property
    def color(self) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        ndarray (H, W, 4): the colour, uint8, float16 or float32 by ``format``; `encoding` says what the numbers are. None with ``format=None``.
        """

    @property
    def depth(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (H, W) float32: OpenGL's window-space z with the precision of ``depth_format``, 0 at the near plane, 1 at the far plane and in the background.
        """

    @property
    def distance(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (H, W) float32: length of the ray, world units; +inf background. In an orthographic picture it counts from the near plane.
        """

    @property
    def encoding(self) -> Encoding:
        """
        str: "linear" or "srgb", what the numbers of `color` are.
        """

    @property
    def format(self) -> Format | None:
        """
        str: the format of `color`, as `Renderer.render` takes it; None without a colour.
        """

    @property
    def id(self) -> np.typing.NDArray[np.int32]:
        """
        ndarray (H, W) int32: ``Node.id`` of the visible node; 0 background.
        """

    @property
    def label(self) -> np.typing.NDArray[np.int32]:
        """
        ndarray (H, W) int32: ``Node.label`` of the visible node; 0 background.
        """

    @property
    def normal(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (H, W, 3) float32: world shading normal, unit length, towards the viewer; 0 background.
        """

    @property
    def outputs(self) -> dict[str, np.typing.NDArray[np.float32 | np.int32 | np.uint8]]:
        """
        dict of str to ndarray: the outputs that were requested, by name.

        The dict holds the built-in outputs, which are attributes as well, and the outputs that a ``ShaderMaterial``
        declares, such as `out vec4 heat;`: float32 (H, W, 4), with fewer channels for vec3 and vec2 and (H, W) for
        float. A declared output is 0 where the visible node does not write it.
        """

    @property
    def position(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (H, W, 3) float32: world position; NaN background.
        """

    @property
    def size(self) -> tuple[int, int]:
        """
        tuple of int: (width, height), pixels.
        """

    @property
    def stencil(self) -> np.typing.NDArray[np.uint8]:
        """
        ndarray (H, W) uint8: the stencil buffer after all drawing; 0 background.
        """

    @property
    def z(self) -> np.typing.NDArray[np.float32]:
        """
        ndarray (H, W) float32: distance along the camera's axis, or a face's, world units; +inf background.
        """

class _LaterCall:
    """
    A call of a renderer that waits to be drawn.
    """

    def __reduce__(self) -> tuple[object, ...]: ...
    def draw(self: _LaterCall) -> bool:
        """
        Draw. Returns whether the pixels are there; if not, the next call can be drawn.
        """

    def join_line(self: _LaterCall) -> None:
        """
        Take a place in the line of the renderer's calls: in the order of drawing.
        """

    def leave_line(self: _LaterCall) -> None:
        """
        Leave it: the call will not be drawn. Nothing if it is being drawn.
        """

    def result(self: _LaterCall) -> object:
        """
        Wait for the pixels, and give the result.
        """

    @property
    def notices(self) -> list[str]:
        """
        list of str: what the last of these two had to tell, also if it raised.
        """

class Renderer:
    """
    Draws scenes without a screen: frames, cubemaps and the probes that mirrors need.

    A renderer owns an OpenGL 4.5 context on EGL, on a GPU if there is one, else on Mesa's software rasteriser. Any thread
    may use a renderer; calls on one renderer run one after the other, and several renderers work in parallel. Use a
    renderer in a ``with`` block, or call :meth:`close`.

    If the context is lost, because another library in the process ended the EGL display (VTK does) or because the GPU was
    reset, the call makes a new context, does its work again with the same result, and gives one :class:`RendererWarning`.
    Probes with ``update="manual"`` are drawn again from the scene as it is then.

    Parameters
    ----------
    device : str, int, Device or None
        "auto" (the environment variable CUBECAM_DEVICE if it is set, else a GPU, else software), "gpu", "software", an
        index into the list that :func:`devices` returns, a device of that list, a part of a device's name, or a UUID. None
        means "auto".
    layered : bool or None
        True: one draw call draws a mesh in all views. False: each view has a draw call of its own. None: the renderer takes
        the way that is faster on its device. Both give the same bytes on llvmpipe.
    cache_bytes : int
        GPU memory in which the renderer keeps the targets of frames and captures, so that an unchanged picture is not drawn
        again. The renderer also keeps at most as much main memory of arrays that the caller no longer uses, for the next
        results of the same size. Memory that eight calls did not use is freed; :meth:`close` frees the rest. Default
        256 MiB; ``stats.pictures_not_kept`` reports how many pictures of a call are larger than that.
    debug : bool
        True: the context is a debug context, whose errors say more.
    trust_shaders : bool
        False: GLSL of a :class:`ShaderMaterial` or an :class:`ImageEffect` that is new goes first to a process of its own,
        which compiles it and draws one pixel; if the driver crashes there, or takes more than 10 seconds or a GiB of memory,
        the call raises ShaderError. True: GLSL is compiled at once, and a source with which the driver crashes ends the
        program. docs/security.md says more.

    Raises
    ------
    ContextError
        If no OpenGL context can be made. The message names each device that was tried, why it failed, and what to install.

    Warns
    -----
    RendererWarning
        If "auto" leads to a software driver although EGL lists a GPU.

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
    def __exit__(self: Renderer, *args: object) -> None: ...
    def __init__(
        self: Renderer,
        *,
        device: str | typing.SupportsIndex | Device | None = "auto",
        layered: bool | None = None,
        cache_bytes: typing.SupportsIndex = 268435456,
        debug: bool = False,
        trust_shaders: bool = False,
    ) -> None: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __repr__(self: Renderer) -> str: ...
    def __rich__(self) -> object:
        """
        Give what `rich.print` shows.
        """

    def _repr_html_(self) -> str:
        """
        Give the HTML that Jupyter shows.
        """

    def capture(
        self: Renderer,
        scene: Scene,
        position: np.typing.ArrayLike = (0.0, 0.0, 0.0),
        size: typing.SupportsIndex = 256,
        *,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        exclude: collections.abc.Iterable[Node] = (),
        outputs: collections.abc.Iterable[str] = (),
        format: Format | None = "rgba32f",
        samples: typing.SupportsIndex = 1,
        eye: np.typing.ArrayLike | None = None,
        depth_format: DepthFormat | None = "depth_component32f",
        depth_order: DepthOrder = "nearest",
        rotation: np.typing.ArrayLike | None = None,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> CubeMap:
        """
        Draw the surroundings of a point into a cubemap.

        Parameters
        ----------
        scene : Scene
        position : array_like (3,)
            World position. The six views look along the axes of the cube, 90 degrees each.
        size : int
            Pixels along an edge of a face.
        near, far : float
            Clip distances along each face's axis, world units, 0 < near < far.
        exclude : sequence of Node
            Nodes that are left out, with all nodes below them.
        outputs : sequence of str
            What the cubemap holds besides ``faces``: any of "distance", "z", "normal", "position", "id", "label", "depth" and
            "stencil", and any output that the GLSL of a :class:`ShaderMaterial` of a visible node declares.
        format : str
            "rgba32f" (float32), "rgba16f" (float16), "rgba8" (uint8, clamped) or "rgb565" (uint8).
        samples : int
            Samples of each texel's colour (MSAA), see :meth:`render`.
        eye : array_like (3,) or None
            The point from which highlights and mirrors are computed. None: ``position``.
        depth_format : str or None
            The format of the depth and stencil buffer, see :meth:`render`.
        depth_order : str
            "nearest": colour and outputs are those of the nearest opaque surface along each ray. "farthest": those of the
            farthest opaque surface between ``near`` and ``far``, and the background where there is none. A single-sided
            material shows only its front faces, so the far side of a body counts only with ``double_sided=True``. Translucent
            surfaces show where they lie beyond the farthest opaque surface. "farthest" needs a depth buffer.
        rotation : array_like (4,) or None
            The quaternion (w, x, y, z) that turns the cube's axes against the world's, as `axis_angle` gives: what the scene
            shows in the direction R d, the cube shows in d. Normals and positions stay world vectors. None: the axes are the
            world's, as lookups of a scene's environment expect.
        max_lod_error : float
            Pixels by which levels of detail may be off, see :meth:`render`; 0: exact meshes. The six faces show the same level
            of a node.

        Returns
        -------
        CubeMap
            ``faces`` has the shape (6, size, size, 4), in the order +X -X +Y -Y +Z -Z, in the layout of OpenGL (section 8.13 of
            the 4.6 specification): ``texture(cube, world_direction)`` needs no flip.

        Raises
        ------
        ValueError, TypeError, ContextError
            As :meth:`render` raises; also for an excluded node of another scene.

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

    def capture_async(
        self: Renderer,
        scene: Scene,
        position: np.typing.ArrayLike = (0.0, 0.0, 0.0),
        size: typing.SupportsIndex = 256,
        *,
        near: typing.SupportsFloat | typing.SupportsIndex = 0.05,
        far: typing.SupportsFloat | typing.SupportsIndex = 1000.0,
        exclude: collections.abc.Iterable[Node] = (),
        outputs: collections.abc.Iterable[str] = (),
        format: Format | None = "rgba32f",
        samples: typing.SupportsIndex = 1,
        eye: np.typing.ArrayLike | None = None,
        depth_format: DepthFormat | None = "depth_component32f",
        depth_order: DepthOrder = "nearest",
        rotation: np.typing.ArrayLike | None = None,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> cubecam._futures.PictureFuture[CubeMap]:
        """
        Have the surroundings of a point drawn by a thread of the renderer, and return at once.

        The arguments are those of :meth:`capture`, and so are the bytes of the cubemap. :meth:`render_async` says in which
        order calls are drawn, how many can wait, and which errors are raised when.

        Parameters
        ----------
        scene, position, size
            See :meth:`capture`.
        near, far, exclude, outputs, format, samples, eye, depth_format, depth_order, rotation, max_lod_error
            See :meth:`capture`.

        Returns
        -------
        PictureFuture of CubeMap

        Raises
        ------
        ValueError, TypeError, ContextError
            As :meth:`render_async` raises; also for an excluded node of another scene.

        Examples
        --------
        >>> import asyncio
        >>> import cubecam as cc
        >>> async def captures(renderer, scene):
        ...     return await asyncio.gather(*(renderer.capture_async(scene, (x, 0, 0), size=8) for x in range(4)))
        >>> with cc.Renderer() as renderer:
        ...     cubes = asyncio.run(captures(renderer, cc.Scene(background="teal")))
        >>> len(cubes), cubes[0].faces.shape
        (4, (6, 8, 8, 4))
        """

    def capture_many(
        self,
        scene: Scene,
        positions: np.typing.ArrayLike,
        size: int = 256,
        *,
        outputs: collections.abc.Iterable[str] = tuple(),
        rotations: np.typing.ArrayLike | None = None,
        near: float = 0.05,
        far: float = 1000.0,
        exclude: collections.abc.Iterable[Node] = tuple(),
        format: Format = "rgba32f",
        samples: int = 1,
        eye: np.typing.ArrayLike | None = None,
        depth_format: DepthFormat = "depth_component32f",
        depth_order: DepthOrder = "nearest",
        max_lod_error: float = 0.0,
        progress: bool = True,
    ) -> cubecam.CubeMapBatch:
        """
        Capture a scene from many places.

        Each cubemap has the same bytes as `Renderer.capture` gives for its place, but the driver is waited for once for
        many of them, faces that show nothing are filled without it, and the results are one array. The scene is that of the
        moment of the call; what is drawn for a batch is not kept for later calls.

        Parameters
        ----------
        scene : Scene
            What is captured.
        positions : array_like (P, 3)
            The places, world.
        size : int
            N, pixels along an edge of a face.
        outputs : iterable of str
            Further numbers for each texel, as in `Renderer.capture`.
        rotations : array_like (P, 4), optional
            Quaternions w, x, y, z that turn the axes of each cube against the world's, of any length but 0. None: no cube
            is turned.
        near, far : float
            Clip distances, world units, 0 < near < far.
        exclude : iterable of Node
            Nodes that are left out with all nodes below them.
        format, samples, eye, depth_format, depth_order, max_lod_error
            As in `Renderer.capture`, for all captures.
        progress : bool
            Whether a bar shows on the error stream how many captures are done, if it is a terminal and the work takes more
            than half a second.

        Returns
        -------
        CubeMapBatch
            ``faces`` (P, 6, N, N, 4) and outputs, with the places. `Renderer.stats` has the numbers of the last part of it.

        Raises
        ------
        TypeError, ValueError, ContextError
            As `Renderer.capture` raises; ValueError, too, if the memory does not hold the results. `iter_captures` needs
            less.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> scene = cc.Scene(background=(0, 0, 1))
        >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color="red"))
        >>> places = [(x, 0, 3) for x in range(10)]
        >>> with cc.Renderer() as renderer:
        ...     batch = renderer.capture_many(scene, places, 16, outputs=["distance"])
        >>> batch.faces.shape, batch.distance.shape
        ((10, 6, 16, 16, 4), (10, 6, 16, 16))
        >>> bool(batch.distance[0].min().round(1) == 2)
        True
        """

    def close(self: Renderer) -> None:
        """
        Free the OpenGL context and its memory. Calls after that raise ContextError; a second close() does nothing. Calls of :meth:`render_async` and :meth:`capture_async` that were made before are drawn first; leaving a ``with`` block by an exception cancels those that have not begun.
        """

    def iter_captures(
        self,
        scene: Scene,
        positions: np.typing.ArrayLike,
        size: int = 256,
        *,
        outputs: collections.abc.Iterable[str] = tuple(),
        rotations: np.typing.ArrayLike | None = None,
        near: float = 0.05,
        far: float = 1000.0,
        exclude: collections.abc.Iterable[Node] = tuple(),
        format: Format = "rgba32f",
        samples: int = 1,
        eye: np.typing.ArrayLike | None = None,
        depth_format: DepthFormat = "depth_component32f",
        depth_order: DepthOrder = "nearest",
        max_lod_error: float = 0.0,
        progress: bool = True,
    ) -> collections.abc.Iterator[CubeMap]:
        """
        Capture a scene from many places, and give one cubemap after the other.

        It draws as `capture_many` does, some captures at a time, and never holds more than these: at most 64, or 8 MiB on a
        software driver. The scene is that of the moment of the call, whatever is changed while the loop runs.

        Parameters
        ----------
        scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
            As in `capture_many`.
        depth_format, depth_order, max_lod_error
            As in `capture_many`.
        progress : bool
            As in `capture_many`.

        Yields
        ------
        CubeMap
            The captures, in the order of `positions`.

        Raises
        ------
        TypeError, ValueError, ContextError
            As `Renderer.capture` raises; wrong arguments at the call and not in the loop.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene(background=(0, 0.5, 1))
        >>> with cc.Renderer() as renderer:
        ...     for cube in renderer.iter_captures(scene, [(0, 0, 0), (0, 1, 0)], 16):
        ...         print(cube.sh(0).round(2)[0, :3].tolist())
        [0.0, 1.77, 3.54]
        [0.0, 1.77, 3.54]
        """

    def read_probe(self: Renderer, probe: Probe) -> CubeMap:
        """
        Read the present contents of a probe, in the probe's format.

        Parameters
        ----------
        probe : Probe
            A probe that a picture of this renderer has shown, or that :meth:`update_probes` has drawn.

        Returns
        -------
        CubeMap
            A copy; uint8, float16 or float32, with faces of the shape (6, size, size, 4).

        Raises
        ------
        ValueError
            If this renderer has not drawn the object yet.
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

    def read_texture(
        self: Renderer, render_texture: RenderTexture
    ) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
        """
        Read the present contents of a render texture, in its format.

        Parameters
        ----------
        render_texture : RenderTexture
            A render texture that a picture of this renderer has shown.

        Returns
        -------
        ndarray (H, W, 4)
            uint8, float16 or float32, row 0 on top. The array belongs to the caller.

        Raises
        ------
        ValueError
            If this renderer has not drawn the object yet.
        """

    def render(
        self: Renderer,
        scene: Scene,
        camera: Camera | StereoCamera,
        size: tuple[int, int],
        *,
        outputs: collections.abc.Iterable[str] = (),
        format: Format | None = "rgba8",
        samples: typing.SupportsIndex = 1,
        exposure: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        tonemap: Tonemap | None = None,
        encode: Encode | None = None,
        effects: collections.abc.Iterable[ImageEffect] = (),
        depth_format: DepthFormat | None = "depth_component32f",
        screen_reflections: bool = False,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> Frame:
        """
        Draw a picture of a scene. The probes that its mirrors need are brought up to date first.

        If nothing changed since the last picture of this size and format, the picture is not drawn again.

        Parameters
        ----------
        scene : Scene
        camera : Camera or StereoCamera
        size : (int, int)
            (width, height), pixels.
        outputs : sequence of str
            What the frame holds besides colour: any of "distance", "z", "normal", "position", "id" and "label"; any output that
            the GLSL of a :class:`ShaderMaterial` of a visible node declares; "depth" and "stencil", the contents of these
            buffers after the last node is drawn.
        format : str or None
            "rgba8" (uint8, clamped to 0..1), "rgba16f" (float16), "rgba32f" (float32) or "rgb565" (5, 6 and 5 bits, scaled to
            uint8 from 0 to 255; alpha 255). None: there is no colour buffer, and only the outputs are drawn.
        samples : int
            Samples of each pixel's colour (MSAA): 1 for none, at most ``info.limits.max_samples``. The outputs are the same for
            every number of samples.
        exposure : float
            Stops: the colour is multiplied by ``2**exposure``, after effects and before the tone curve. Default 0.
        tonemap : str or None
            "reinhard" (Reinhard et al. 2002), "aces" (Narkowicz's fit, 2015) or "neutral" (Khronos PBR Neutral, 2024), applied
            after multisamples are resolved. None: values stay as they are. Files, notebooks and :func:`to_screen` do not map
            a mapped frame again.
        encode : str or None
            "srgb" encodes the colour (IEC 61966-2-1), for a screen. None: the colour stays as it is; `Frame.save`, notebooks
            and :func:`to_screen` encode it when they need it. A picture that is "srgb" as drawn (see below) is not encoded
            again and has no curve; exposure changes it in linear light.
        effects : sequence of ImageEffect
            Passes over the colour, one after the other, after multisamples are resolved and before tone mapping.
        depth_format : str or None
            The format of the depth and stencil buffer, by OpenGL's names: "depth_component32f", "depth_component24",
            "depth_component16", "depth24_stencil8", "depth32f_stencil8", "stencil_index8" (no depth) or None (neither). Without
            a depth buffer no node hides another: nodes are painted one over the other, in order of ``render_order``, then id,
            and "stencil" is the only output.
        screen_reflections : bool
            True: what mirrors, glass and shiny surfaces reflect is looked up in the picture itself first, by its depths, and in
            the environment or the probe where the picture does not show it. Default False. It sharpens what probes show near
            their mirrors, and where a frame shows nothing, since it is hidden or out of view, nothing changes. Blended surfaces
            are not found; surfaces with a `PlanarMirror`, captures, probes, render textures and what a pane of transmissive
            material shows do without. It needs a colour and a depth buffer, and draws the nodes twice.
        max_lod_error : float
            Pixels. Of a mesh with levels of detail (`Mesh.with_levels`) the coarsest is drawn of which every point that the
            picture shows lies at most so many pixels from a point of the mesh, and the other way round. The error of a level
            counts with the node's largest scale, at the nearest point of the node's bounds in the world, for the widest angle
            under which the picture may show it. 0: exact meshes. `Mesh.with_levels` says which nodes are always exact, and so
            are shadow maps, probes and render textures. ``stats.triangles_simplified`` tells what it saves.

        Returns
        -------
        Frame
            Arrays of shape (height, width, ...), row 0 on top. ``frame.encoding`` is "srgb" with ``encode="srgb"``, and for an
            unlit scene whose images and cubemaps are all "srgb"; else "linear".

        Raises
        ------
        ValueError
            For an unknown name, a size or sample count beyond the driver's limits, formats that the driver cannot draw into,
            outputs that ``depth_format`` does not allow, a ``max_lod_error`` that is negative or not finite, an exposure that is not from -64 to 64, tone mapping or effects with
            ``format=None``, ``screen_reflections`` without a colour or a depth buffer, or a camera without a valid view.
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

    def render_async(
        self: Renderer,
        scene: Scene,
        camera: Camera | StereoCamera,
        size: tuple[int, int],
        *,
        outputs: collections.abc.Iterable[str] = (),
        format: Format | None = "rgba8",
        samples: typing.SupportsIndex = 1,
        exposure: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        tonemap: Tonemap | None = None,
        encode: Encode | None = None,
        effects: collections.abc.Iterable[ImageEffect] = (),
        depth_format: DepthFormat | None = "depth_component32f",
        screen_reflections: bool = False,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> cubecam._futures.PictureFuture[Frame]:
        """
        Have a picture of a scene drawn by a thread of the renderer, and return at once.

        The arguments are those of :meth:`render`, and so are the bytes of the picture. It shows the scene and the camera as
        they are now; later changes do not count. The future can be awaited by asyncio, and has ``result()``, ``cancel()`` and
        the other methods of `concurrent.futures.Future`.

        All calls of a renderer are drawn in the order in which they were made, whatever their kind. 64 calls can wait; a
        further call waits until there is room, and so does one whose result the memory cannot hold besides those that are not
        done. At the end of the program calls that wait are cancelled: wait for their results, or use a ``with`` block.

        Parameters
        ----------
        scene, camera, size
            See :meth:`render`.
        outputs, format, samples, exposure, tonemap, encode, effects, depth_format, screen_reflections, max_lod_error
            See :meth:`render`.

        Returns
        -------
        PictureFuture of Frame

        Raises
        ------
        ValueError, TypeError
            At once for what the arguments say, as :meth:`render` raises; what drawing finds is raised by the future.
        ContextError
            At once after :meth:`close`, or in a forked process.

        Warns
        -----
        RendererWarning
            At the line of this call, before the future is done. If a filter makes an error of it, the future raises it.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene, camera = cc.Scene(background=(1, 0, 0)), cc.PerspectiveCamera()
        >>> with cc.Renderer() as renderer:
        ...     red = renderer.render_async(scene, camera, size=(1, 1))
        ...     scene.background = (0, 0, 1)
        ...     blue = renderer.render_async(scene, camera, size=(1, 1))
        >>> red.result().color.tolist(), blue.result().color.tolist()
        ([[[255, 0, 0, 255]]], [[[0, 0, 255, 255]]])
        """

    def render_many(
        self,
        scene: Scene,
        cameras: collections.abc.Iterable[Camera | StereoCamera],
        size: tuple[int, int],
        *,
        outputs: collections.abc.Iterable[str] = tuple(),
        format: Format | None = "rgba8",
        samples: int = 1,
        exposure: float = 0.0,
        tonemap: Tonemap | None = None,
        encode: Encode | None = None,
        effects: collections.abc.Iterable[ImageEffect] = tuple(),
        depth_format: DepthFormat | None = "depth_component32f",
        screen_reflections: bool = False,
        max_lod_error: float = 0.0,
        progress: bool = True,
    ) -> cubecam.FrameBatch:
        """
        Render a scene for many cameras, as `Renderer.render` does for one.

        The scene and the cameras are those of the moment of the call.

        Parameters
        ----------
        scene : Scene
            What is rendered.
        cameras : iterable of Camera or StereoCamera
            A frame is rendered for each.
        size : (int, int)
            (width, height) of each frame, pixels.
        outputs, format, samples, exposure, tonemap, encode, effects, depth_format, screen_reflections, max_lod_error
            As in `Renderer.render`, for all frames.
        progress : bool
            Whether a bar shows on the error stream how many frames are done, if it is a terminal and the work takes more
            than half a second.

        Returns
        -------
        FrameBatch
            ``color`` (F, H, W, 4) and outputs; the same bytes as single calls give.

        Raises
        ------
        TypeError, ValueError, ContextError
            As `Renderer.render` raises; ValueError, too, if there is no camera, or if the memory does not hold the results.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene()
        >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial())
        >>> cameras = [cc.PerspectiveCamera(position=(0, 0, z)) for z in (3, 4, 5)]
        >>> with cc.Renderer() as renderer:
        ...     batch = renderer.render_many(scene, cameras, (40, 30), outputs=["distance"])
        >>> batch.color.shape, batch.distance.min(axis=(1, 2)).round(1).tolist()
        ((3, 30, 40, 4), [2.0, 3.0, 4.0])
        """

    def shadow_map(self: Renderer, scene: Scene, light: Light) -> np.typing.NDArray[np.float32]:
        """
        Draw the shadow map of a light, as distances, to look at. A map that is up to date is not drawn again.

        Parameters
        ----------
        scene : Scene
        light : Light
            A light of the scene, with a shadow.

        Returns
        -------
        ndarray (L, size, size) float32
            Distances in world units along the axis of each view, +inf where no node casts a shadow. A spot light has one view,
            from the light along its direction. A point light has six, +X -X +Y -Y +Z -Z, laid out as the faces of a capture.
            The views of point and spot lights are a little wider than 90 degrees or the cone, since the filter reads
            ``ceil(radius) + 2`` texels beyond each side. A directional light has one view of parallel rays; its distances count
            from the plane at which the bounds of all casters begin, and its outermost texels stay empty. Row 0 of a single view
            is on top: +Y is up, or -Z for light from straight above or below.

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

    def update_probes(
        self: Renderer,
        scene: Scene,
        *,
        probes: Probe | collections.abc.Iterable[Probe] | None = None,
    ) -> None:
        """
        Draw probes now, whatever value their ``update`` has.

        Parameters
        ----------
        scene : Scene
        probes : Probe, sequence of Probe, or None
            The probes to draw. None: all probes that visible nodes of the scene use.

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
        bool: whether close() was called.
        """

    @property
    def info(self) -> RendererInfo:
        """
        RendererInfo: the device, driver and limits; readable after close(), too.
        """

    @property
    def stats(self) -> Stats:
        """
        Stats: what the last call drew.
        """

class _CaptureBatch:
    """
    A scene at one moment, and the places of its captures.
    """

    def __init__(
        self: _CaptureBatch,
        renderer: Renderer,
        scene: Scene,
        positions: np.typing.ArrayLike,
        rotations: np.typing.ArrayLike | None,
        size: typing.SupportsIndex,
        *,
        near: typing.SupportsFloat | typing.SupportsIndex,
        far: typing.SupportsFloat | typing.SupportsIndex,
        exclude: collections.abc.Iterable[Node],
        outputs: collections.abc.Iterable[str],
        format: Format | None,
        samples: typing.SupportsIndex,
        eye: np.typing.ArrayLike | None,
        depth_format: DepthFormat | None,
        depth_order: DepthOrder,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __len__(self: _CaptureBatch) -> int: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def allocate(
        self: _CaptureBatch, count: typing.SupportsIndex
    ) -> tuple[
        np.typing.NDArray[np.uint8 | np.float16 | np.float32],
        list[np.typing.NDArray[np.float32 | np.int32 | np.uint8]],
    ]: ...
    def draw(
        self: _CaptureBatch,
        first: typing.SupportsInt | typing.SupportsIndex,
        faces: np.typing.NDArray[np.uint8 | np.float16 | np.float32],
        outputs: list[np.typing.NDArray[np.float32 | np.int32 | np.uint8]],
    ) -> None: ...
    @property
    def dtype(self) -> np.dtype[np.uint8 | np.float16 | np.float32]: ...
    @property
    def encoding(self) -> Encoding: ...
    @property
    def keeps_pictures(self) -> bool:
        """
        bool: whether its pictures depend on what was drawn of the scene before.
        """

    @property
    def most_cubes(self) -> int: ...
    @property
    def outputs(self) -> list[tuple[str, int, np.dtype[np.generic]]]: ...
    @property
    def revision(self) -> int:
        """
        int: of the scene; equal ones show the same.
        """

    @property
    def size(self) -> int: ...

class _RenderBatch:
    """
    A scene at one moment, and cameras.
    """

    def __init__(
        self: _RenderBatch,
        renderer: Renderer,
        scene: Scene,
        cameras: collections.abc.Iterable[Camera | StereoCamera],
        size: tuple[int, int],
        *,
        outputs: collections.abc.Iterable[str],
        format: Format | None,
        samples: typing.SupportsIndex,
        exposure: typing.SupportsFloat | typing.SupportsIndex,
        tonemap: Tonemap | None,
        encode: Encode | None,
        effects: collections.abc.Iterable[ImageEffect],
        depth_format: DepthFormat | None,
        screen_reflections: bool,
        max_lod_error: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None: ...
    def __len__(self: _RenderBatch) -> int: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def draw(self: _RenderBatch, number: typing.SupportsInt | typing.SupportsIndex) -> Frame: ...
    def shape(
        self: _RenderBatch,
    ) -> tuple[
        tuple[int, int], np.dtype[np.generic] | None, list[tuple[str, int, np.dtype[np.generic]]]
    ]:
        """
        The size, the dtype of colours or None, and the outputs of all frames; checks what can be known before one is drawn.
        """

    @property
    def encoding(self) -> Encoding: ...
    @property
    def revision(self) -> int:
        """
        int: of the scene with the effects; equal ones show the same.
        """

def _at_interrupt_check(function: object) -> None:
    """
    For tests: a function without arguments that is called at each look for signals in a long call of the main thread; None: no function.
    """

def _brdf(
    n_dot_v: typing.Annotated[np.typing.ArrayLike, np.float32],
    roughness: typing.Annotated[np.typing.ArrayLike, np.float32],
) -> np.typing.NDArray[np.float32]:
    """
    For cubecam.brdf: (..., 2) of arrays of one shape.
    """

def _brdf_table() -> np.typing.NDArray[np.float32]:
    """
    The table of the shaders, (64, 64, 4) float32: roughness by N.V; scale, bias, the albedo of sheen, 0.
    """

def _check_memory(bytes: typing.SupportsFloat | typing.SupportsIndex, what: str) -> None:
    """
    Raises ValueError for what the memory cannot hold.
    """

def _check_pickle(format: object) -> None:
    """
    For unpickling: raises TypeError for a format that is not this version's.
    """

def _cube_of_batch(
    faces: np.typing.ArrayLike, outputs: dict[str, object], encoding: Encoding
) -> CubeMap:
    """
    A cubemap from a part of a batch.
    """

def _interrupt_pause(milliseconds: typing.SupportsInt | typing.SupportsIndex) -> int:
    """
    For tests: the time between two looks for signals in a long call; returns the one before.
    """

def _is_real_number(value: object) -> bool:
    """
    Whether a value is a number that a float can hold, and no bool.
    """

def _is_truth_value(value: object) -> bool:
    """
    Whether a value is a bool of Python or numpy.
    """

def _is_whole_number(value: object) -> bool:
    """
    Whether a value is an int of Python or numpy, and no bool.
    """

def _kept_taps() -> int:
    """
    Bytes of the filter's taps that are kept, for tests.
    """

def _map_shared(
    descriptor: typing.SupportsInt | typing.SupportsIndex,
    bytes: typing.SupportsInt | typing.SupportsIndex,
) -> np.typing.NDArray[np.uint8]:
    """
    The memory of a file, (bytes,) uint8: what is written there, all processes see. It is unmapped when no array needs it.
    """

def _memory_left(root: str = "/") -> tuple[float, str]:
    """
    The bytes that this process may still take, and the name of the limit; `root` is the folder with proc/ and sys/.
    """

def _newest_revision() -> int:
    """
    The newest revision of this process. While it stays the same, no object has changed.
    """

def _output_table() -> list[tuple[str, bool, int, str, str]]:
    """
    Of each output: its name, whether shaders write it, channels, dtype, and meaning.
    """

def _project(
    cube: CubeMap,
    kind: str,
    fov: typing.SupportsFloat | typing.SupportsIndex,
    axes: np.typing.ArrayLike,
    size: tuple[typing.SupportsIndex, typing.SupportsIndex],
    dtype: np.typing.DTypeLike | None,
    output: str,
) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """
    A picture of a projection (math/projections.hpp); `fov` is in radians, `axes` has the rows right, up and forward, and `size` is (width, height).
    """

def _read_radiance(
    data: bytes,
    start: typing.SupportsInt | typing.SupportsIndex,
    scanlines: typing.SupportsInt | typing.SupportsIndex,
    length: typing.SupportsInt | typing.SupportsIndex,
) -> np.typing.NDArray[np.float32]:
    """
    The scanlines of a Radiance picture, (scanlines, length, 3) float32.

    ValueError names the scanline that is broken.
    """

def _read_through_buffers(always: bool) -> bool:
    """
    For tests: software drivers read pictures through buffers, as GPUs do; returns the value before.
    """

def _restore_frame(state: tuple[object, ...]) -> Frame:
    """
    For unpickling.
    """

def _text_of(value: object) -> str:
    """
    A short text for a value in a message. It never raises an Exception.
    """

def _to_array(value: object, name: str) -> np.typing.NDArray[np.generic]:
    """
    The value as an array. Raises TypeError for a masked array that hides values, also in lists and tuples, and ValueError for rows of unequal length.
    """

def _unproject(
    image: np.typing.ArrayLike,
    kind: str,
    fov: typing.SupportsFloat | typing.SupportsIndex,
    axes: np.typing.ArrayLike,
    size: typing.SupportsIndex,
    mipmaps: bool,
    dtype: np.typing.DTypeLike | None,
    encoding: Encoding | None,
) -> CubeMap:
    """
    A cube of a picture that `_project` could have made.
    """

def axis_angle(
    axis: np.typing.ArrayLike, degrees: typing.SupportsFloat | typing.SupportsIndex
) -> np.typing.NDArray[np.float64]:
    """
    Make the quaternion of a rotation round an axis.

    Parameters
    ----------
    axis : array_like (3,)
        The axis, of any length except 0. If the axis points at the viewer, the rotation is counter-clockwise.
    degrees : float
        The angle of the rotation.

    Returns
    -------
    ndarray (4,) float64
        (w, x, y, z), unit length: cos(degrees / 2), then sin(degrees / 2) times the axis.

    Raises
    ------
    ValueError
        For an axis of length 0, or numbers that are not finite.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.axis_angle((0, 2, 0), 180).round(12).tolist()
    [0.0, 0.0, 1.0, 0.0]
    """

def devices() -> list[Device]:
    """
    List the devices that can render.

    The list does not affect which device a `Renderer` chooses. The first call may start drivers to learn
    their names. A device whose driver does not start is listed too, with the reason in its `problem`.

    Returns
    -------
    list of Device
        The devices in the order of ``Renderer(device=index)``. The list is empty if EGL cannot list devices; a
        `Renderer` may still find the surfaceless or the default display.

    Raises
    ------
    ContextError
        If there is no EGL library, or in a process forked after EGL was opened.
    """

def equirect_to_faces(
    images: np.typing.ArrayLike,
    *,
    size: typing.SupportsIndex | None = None,
    center: Center = "-z",
    sampling: Sampling = "centers",
    dtype: np.typing.DTypeLike | None = None,
    out: np.typing.NDArray[np.uint8 | np.float16 | np.float32] | None = None,
) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
    """
    Make the faces of cubes from panoramas of one size.

    The numbers are those of `CubeMap.from_equirect`. Arrays go in and come out, with any axes in front: a film or a
    batch is one call, in which each part of the filter is made once for all pictures, and all cores share the work.

    Parameters
    ----------
    images : array_like (..., H, 2H, C)
        uint8 (value/255), float16, float32 or float64, with 1 to 4 channels; not mirrored, row 0 at +Y. NaN raises
        ValueError; inf counts as the largest finite number of its picture, or 65504 if that is more.
    size : int, optional
        N, texels along an edge of a face. None: the next power of two from W / pi, which loses no detail.
    center : {"-z", "+z", "+x", "-x"}, default "-z"
        The axis at the center column.
    sampling : {"centers", "borders"}, default "centers"
        Where the samples of `images` lie; with "borders" (OpenEXR) any shape from (2, 2) is allowed.
    dtype : dtype, optional
        "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `out`, or else that of
        `images`.
    out : ndarray (..., 6, N, N, C), optional
        Memory for the result, in C order and not that of `images`. None: a new array.

    Returns
    -------
    ndarray (..., 6, N, N, C) in `dtype`
        +X -X +Y -Y +Z -Z in the convention "gl", as `CubeMap.faces`; `out` if that was given. Numbers are filtered in
        float32, then rounded as `CubeMap.to_equirect` rounds.

    Raises
    ------
    ValueError
        For pictures that are not twice as wide as high, NaN, a size below 1, an unknown center or sampling, another
        dtype, or an `out` that does not fit; after NaN, the contents of `out` are undefined.
    TypeError
        For images of bool, complex, text, or integers other than uint8, and an `out` that is no array.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> film = np.zeros((8, 64, 128, 3), np.uint8)
    >>> cc.equirect_to_faces(film, size=32).shape
    (8, 6, 32, 32, 3)
    """

def faces_to_equirect(
    faces: np.typing.ArrayLike,
    *,
    width: typing.SupportsIndex | None = None,
    center: Center = "-z",
    sampling: Sampling = "centers",
    dtype: np.typing.DTypeLike | None = None,
    out: np.typing.NDArray[np.uint8 | np.float16 | np.float32] | None = None,
) -> np.typing.NDArray[np.uint8 | np.float16 | np.float32]:
    """
    Make panoramas from the faces of cubes of one size.

    The numbers are those of `CubeMap.to_equirect`; the reverse of `equirect_to_faces`, also for many cubes in one call.

    Parameters
    ----------
    faces : array_like (..., 6, N, N, C)
        uint8 (value/255), float16, float32 or float64, with 1 to 4 channels: +X -X +Y -Y +Z -Z in the convention "gl",
        as `CubeMap.faces`. NaN and inf stay where they have a weight.
    width : int, optional
        Pixels of a row, an even number. None: 4 * N, which keeps the resolution.
    center : {"-z", "+z", "+x", "-x"}, default "-z"
        The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
    sampling : {"centers", "borders"}, default "centers"
        Where samples of the result lie, as in `CubeMap.to_equirect`.
    dtype : dtype, optional
        "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `out`, or else that of
        `faces`.
    out : ndarray (..., width / 2, width, C), optional
        Memory for the result, in C order and not that of `faces`. None: a new array.

    Returns
    -------
    ndarray (..., width / 2, width, C) in `dtype`
        The panoramas, not mirrored, with row 0 at +Y; `out` if that was given. Numbers are filtered in float32, then
        rounded as `CubeMap.to_equirect` rounds.

    Raises
    ------
    ValueError
        For a width that is not even and positive, an unknown center or sampling, another dtype, or an `out` that does
        not fit.
    TypeError
        For faces of bool, complex, text, or integers other than uint8, and an `out` that is no array.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> faces = np.ones((5, 6, 16, 16, 2), np.float16)
    >>> panoramas = np.empty((5, 32, 64, 2), np.float16)
    >>> cc.faces_to_equirect(faces, out=panoramas) is panoramas
    True
    """

AnyLight = typing.TypeVar("AnyLight", bound="Light")
__version__: str = "0.2.0"
