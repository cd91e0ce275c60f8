/// Docstrings of cubecam.Stencil.
#pragma once

namespace cubecam::docs {

inline constexpr const char* stencil =
    R"doc(A stencil test, and how drawing changes the stencil buffer.

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
)doc";

}  // namespace cubecam::docs
