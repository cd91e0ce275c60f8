/// Docstrings of cubecam.ShaderMaterial and cubecam.ImageEffect.
#pragma once

namespace cubecam::bindings {

inline constexpr const char* shader_material_doc =
    R"doc(A material of one's own, in GLSL (4.50 core) with the scene at hand.

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
)doc";

inline constexpr const char* image_effect_doc =
    R"doc(A pass over a finished picture, in GLSL (4.50 core): ``renderer.render(..., effects=[effect])``.

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
)doc";

inline constexpr const char* reload_doc = R"doc(Read the source again from its file.

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
)doc";

}  // namespace cubecam::bindings
