/// Docstrings of cubecam.Frame.
#pragma once

namespace cubecam::docs {

inline constexpr const char* frame =
    R"doc(A rendered picture: arrays with row 0 on top, which belong to the caller.

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
)doc";

inline constexpr const char* frame_outputs =
    R"doc(dict of str to ndarray: the outputs that were requested, by name.

The dict holds the built-in outputs, which are attributes as well, and the outputs that a ``ShaderMaterial``
declares, such as `out vec4 heat;`: float32 (H, W, 4), with fewer channels for vec3 and vec2 and (H, W) for
float. A declared output is 0 where the visible node does not write it.
)doc";

}  // namespace cubecam::docs
