/// Docstrings of cubecam.Renderer.
#pragma once

namespace cubecam::docs {

inline constexpr const char* renderer =
    R"doc(Draws scenes without a screen: frames, cubemaps and the probes that mirrors need.

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
)doc";

inline constexpr const char* render =
    R"doc(Draw a picture of a scene. The probes that its mirrors need are brought up to date first.

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
)doc";

inline constexpr const char* capture =
    R"doc(Draw the surroundings of a point into a cubemap.

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
)doc";

inline constexpr const char* render_async =
    R"doc(Have a picture of a scene drawn by a thread of the renderer, and return at once.

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
)doc";

inline constexpr const char* capture_async =
    R"doc(Have the surroundings of a point drawn by a thread of the renderer, and return at once.

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
)doc";

inline constexpr const char* update_probes =
    R"doc(Draw probes now, whatever value their ``update`` has.

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
)doc";

inline constexpr const char* read_probe =
    R"doc(Read the present contents of a probe, in the probe's format.

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
)doc";

inline constexpr const char* read_texture =
    R"doc(Read the present contents of a render texture, in its format.

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
)doc";

inline constexpr const char* shadow_map =
    R"doc(Draw the shadow map of a light, as distances, to look at. A map that is up to date is not drawn again.

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
)doc";

}  // namespace cubecam::docs
