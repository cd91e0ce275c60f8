/// Docstrings of cubecam.ShaderMaterial and cubecam.ImageEffect.
#pragma once

namespace cubecam::docs {

inline constexpr const char* shader_material =
    R"doc(A material that its user writes in GLSL (4.50 core), with access to the scene.

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
)doc";

}  // namespace cubecam::docs
