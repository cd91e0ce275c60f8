/// Docstrings of cubecam.RenderTexture.
#pragma once

namespace cubecam::docs {

inline constexpr const char* render_texture =
    R"doc(A picture that a scene is drawn into and that materials show in the same frame.

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
)doc";

}  // namespace cubecam::docs
