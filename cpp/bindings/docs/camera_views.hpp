/// Docstrings of what cubecam's cameras see.
#pragma once

namespace cubecam::docs {

inline constexpr const char* camera_look_at =
    R"doc(Turn the camera, from where it is, towards a point.

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
)doc";

inline constexpr const char* fit =
    R"doc(Move the camera, without turning it, so that a scene or node fills the picture.

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
)doc";

inline constexpr const char* intrinsics =
    R"doc(Make the camera matrix K of the pinhole model, in OpenCV's convention.

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
)doc";

inline constexpr const char* from_intrinsics =
    R"doc(Make the camera whose `intrinsics` are K: the inverse of that function.

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
)doc";

}  // namespace cubecam::docs
