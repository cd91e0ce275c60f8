/// Docstrings of cubecam.ImageEffect.
#pragma once

namespace cubecam::docs {

inline constexpr const char* image_effect =
    R"doc(A pass over a finished picture, in GLSL (4.50 core): ``renderer.render(..., effects=[effect])``.

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
)doc";

}  // namespace cubecam::docs
