/// Docstrings of cubecam.Node and cubecam.axis_angle.
#pragma once

namespace cubecam::docs {

inline constexpr const char* node =
    R"doc(An object in a scene: a mesh with a material at some place, or a group of nodes.

`Scene.add` makes nodes. Attributes may be set at any time; the next picture shows the change. The arrays
that attributes return are read-only: set the whole array, ``node.position = (1, 2, 3)``.

The pickle of a node holds its scene, so that ``pickle.dumps((scene, ball))`` keeps ball inside scene. The
pickle of a removed node holds only the node and the nodes above it.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> arm = scene.add(position=(0, 1, 0), rotation=cc.axis_angle((0, 0, 1), 90))
>>> hand = scene.add(cc.Mesh.box(.1), position=(2, 0, 0), parent=arm)
>>> hand.world_matrix[:3, 3].round(12).tolist()
[0.0, 3.0, 0.0]
)doc";

inline constexpr const char* axis_angle =
    R"doc(Make the quaternion of a rotation round an axis.

Parameters
----------
axis : array_like (3,)
    The axis, of any length except 0. If the axis points at the viewer, the rotation is counter-clockwise.
degrees : float
    The angle of the rotation.

Returns
-------
ndarray (4,) float64
    (w, x, y, z), unit length: cos(degrees / 2), then sin(degrees / 2) times the axis.

Raises
------
ValueError
    For an axis of length 0, or numbers that are not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.axis_angle((0, 2, 0), 180).round(12).tolist()
[0.0, 0.0, 1.0, 0.0]
)doc";

}  // namespace cubecam::docs
