/// Docstrings of cubecam.Blend.
#pragma once

namespace cubecam::docs {

inline constexpr const char* blend =
    R"doc(Blending by OpenGL's own factors, for any material as ``blend=``.

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
)doc";

}  // namespace cubecam::docs
