/// Docstrings of cubecam.StereoCamera.
#pragma once

namespace cubecam::docs {

inline constexpr const char* stereo =
    R"doc(Two eyes, whose pictures are drawn in one call and combined.

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
)doc";

inline constexpr const char* off_axis =
    R"doc(Place two eyes beside a camera, with parallel axes.

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
)doc";

inline constexpr const char* toe_in =
    R"doc(Place two eyes on a circle round a camera's target; both look at the target.

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
)doc";

}  // namespace cubecam::docs
