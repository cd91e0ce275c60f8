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

inline constexpr const char* node_skin =
    R"doc(Skin or None: the joints that move the vertices of the node's mesh.

The mesh needs `Mesh.joints` and `Mesh.joint_weights`. A picture then shows the mesh where its joints are:
the place of the node itself, its `matrix` and its parents, has no effect on the mesh, as in glTF (2.0, section
3.7.3), but has on the nodes below it. While a joint is not in the scene of the node, for example because
it was removed, or if the mesh has lost its joints, the node is drawn as if it had no skin.

ValueError is raised for a mesh without joints, for a joint of another scene, and if the mesh names a joint that
the skin does not have.)doc";

inline constexpr const char* node_weights =
    R"doc(ndarray (T,) float32: how much of each of the mesh's `morph_targets` is added; read-only.

Any numbers are possible; 0 by default. Another mesh with another number of targets makes all 0. ValueError is
raised for another number of weights than the mesh has targets.)doc";

inline constexpr const char* world_bounds =
    R"doc(ndarray (2, 3) float64: the lowest and the highest corner of the node and all nodes below it, read-only.

The numbers are world units and exact for the vertices, as `Scene.bounds`. Hidden nodes below the node do
not count; whether the node itself is visible does not matter. Without a mesh the bounds are those of
nothing, ``[[inf, inf, inf], [-inf, -inf, -inf]]``.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> cart = scene.add(position=(0, 5, 0))
>>> box = scene.add(cc.Mesh.box(2), parent=cart, rotation=cc.axis_angle((0, 1, 0), 45))
>>> cart.world_bounds.round(3).tolist()
[[-1.414, 4.0, -1.414], [1.414, 6.0, 1.414]]
)doc";

inline constexpr const char* look_at =
    R"doc(Turn the node round its own position, so that its +Z axis points at a point of the world.

As in three.js and glTF, an object's front is +Z (and the front of a camera is -Z). The parents may have
any transforms. Position and scale stay.

Parameters
----------
target : array_like (3,) or Node
    World space, of a node its origin.
up : array_like (3,)
    World space: +Y of the node lies in the plane of `up` and the direction, on the side of `up`. An
    `up` along the direction is replaced: by +Y or, if the direction is vertical, by -Z for a target
    above the node and +Z for one below it.

Raises
------
ValueError
    For a target at the node's position, an `up` of length 0, numbers that are not finite, or a `matrix`
    with a shear.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> head = scene.add(cc.Mesh.box(), position=(0, 1, 0))
>>> head.look_at((4, 1, 0))
>>> head.world_matrix[:3, 2].round(12).tolist()
[1.0, 0.0, 0.0]
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

inline constexpr const char* node_variants =
    R"doc(dict of str to Material: what `material` becomes while the scene shows a variant of that name.

The dict is a copy: set it as a whole. A name that is none of `Scene.variants` has no effect.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> scene.variants = ["day", "night"]
>>> shoe = scene.add(cc.Mesh.box(), cc.PhongMaterial(name="white"))
>>> shoe.variants = {"night": cc.PhongMaterial(color="navy", name="blue")}
>>> scene.variant = "night"
>>> shoe.material.name, shoe.own_material.name
('blue', 'white')
>>> scene.variant = None
>>> shoe.material.name
'white'
)doc";

}  // namespace cubecam::docs
