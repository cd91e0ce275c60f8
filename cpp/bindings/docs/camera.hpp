/// Docstrings of cubecam.Camera and the cameras below it.
#pragma once

namespace cubecam::docs {

inline constexpr const char* camera =
    R"doc(A camera given by its matrices.

Matrices act on column vectors and are written in reading order, so that ``view @ point`` works.
World and camera space are right-handed with +Y up, and the camera looks along -Z. Clip space is
OpenGL's, from -1 to 1 in x, y and z.

Parameters
----------
view : array_like (4, 4)
    World to camera; last row (0, 0, 0, 1).
projection : array_like (4, 4)
    Camera to clip space, for the aspect of the pictures that the camera will draw.

Raises
------
ValueError
    For a matrix that is singular or not finite, or another shape.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> lens = cc.PerspectiveCamera(fov=90).projection(aspect=2)
>>> camera = cc.Camera(view=np.eye(4), projection=lens)
>>> float(camera.projection()[0, 0])
0.5
)doc";

inline constexpr const char* perspective =
    R"doc(A camera with a vanishing point.

Parameters
----------
fov : float
    Vertical field of view in degrees, above 0 and below 180.
position : array_like (3,)
    World space, or with a parent its coordinates, as target and up.
target : array_like (3,), optional
    The point that the camera looks at. None: the camera looks along -Z from any position, with a parent
    along the parent's -Z.
up : array_like (3,)
    The direction that is up in the picture; not along the line of sight.
near, far : float
    Depths in world units between which surfaces are drawn: 0 < near < far.
shift : array_like (2,)
    How far the middle of the picture lies right of and above the camera's axis, in heights of the
    picture: an off-axis frustum. With (0, .5) the horizon is at the lower edge, and vertical lines stay
    vertical, as with a shift lens for architecture.
pixel_aspect : float
    The width of a pixel over its height, above 0: 1 for the pixels of screens, and close to 1 for those
    of calibrated cameras; see `from_intrinsics`.
parent : Node, optional
    A node, of any scene, that the camera moves with. A scale of the node moves the camera's points, but
    changes neither the lens nor any length of it. With the position (0, 0, 0) and no target the camera is
    that of a glTF node. The camera does not keep the node alive; when the node no longer exists, `parent`
    is None. `look_at`, `fit`, `orbit` and the like take and keep points and lengths of the world.

Raises
------
ValueError
    For a target equal to the position, an up along the line of sight, near >= far, or a number out
    of its range or not finite.

Notes
-----
The matrices are those of gluLookAt and gluPerspective.

Examples
--------
>>> import cubecam as cc
>>> camera = cc.PerspectiveCamera(fov=70, position=(0, 1, 5), target=(0, 0, 0))
>>> camera.position = (0, 1, 8)
>>> camera.target.tolist()
[0.0, 0.0, 0.0]
)doc";

inline constexpr const char* orthographic =
    R"doc(A camera of parallel rays.

For mirrors and highlights, the incident direction is the view direction. The output `distance` counts
from the near plane.

Parameters
----------
height : float
    World units from the bottom to the top of the picture, above 0.
position : array_like (3,)
    World space, or with a parent its coordinates, as target and up.
target : array_like (3,), optional
    The point that the camera looks at. None: the camera looks along -Z from any position, with a parent
    along the parent's -Z.
up : array_like (3,)
    The direction that is up in the picture; not along the line of sight.
near, far : float
    Depths in world units between which surfaces are drawn: near < far.
parent : Node, optional
    A node, of any scene, that the camera moves with. A scale of the node moves the camera's points, but
    changes neither the lens nor any length of it. With the position (0, 0, 0) and no target the camera is
    that of a glTF node. The camera does not keep the node alive; when the node no longer exists, `parent`
    is None. `look_at`, `fit`, `orbit` and the like take and keep points and lengths of the world.

Raises
------
ValueError
    For a target equal to the position, an up along the line of sight, near >= far, or a number out
    of its range or not finite.

Notes
-----
The matrices are those of gluLookAt and glOrtho.

Examples
--------
>>> import cubecam as cc
>>> cc.OrthographicCamera(height=4).projection(aspect=2)[:2, :2].tolist()
[[0.25, 0.0], [0.0, 0.5]]
)doc";

inline constexpr const char* projection =
    R"doc(Camera to clip space.

Parameters
----------
aspect : float
    Width of the picture divided by its height. A camera given by its matrices ignores `aspect`.

Returns
-------
ndarray (4, 4) float64
    Read-only.

Raises
------
ValueError
    For an aspect that is not above 0.
)doc";

}  // namespace cubecam::docs
