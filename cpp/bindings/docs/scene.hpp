/// Docstrings of cubecam.Scene.
#pragma once

namespace cubecam::docs {

inline constexpr const char* scene = R"doc(Nodes, lights and their surroundings.

A scene does not depend on a renderer: any number of renderers may draw it, on any threads.

Parameters
----------
environment : CubeMap, optional
    The surroundings that mirrors and glass show; see `load_environment`. It lights no other material.
background : array_like (3,) or (4,), str, or CubeMap, optional
    A colour, or a cubemap as skybox, that pictures show where no node is. Numbers are linear; a CSS name
    or "#rrggbb" is sRGB and is decoded. None: the environment if there is one, else transparent black.
environment_intensity : float
    The factor of the environment's light, at least 0.
environment_rotation : array_like (4,), optional
    Quaternion (w, x, y, z) of any length except 0 that turns the environment: what the cubemap shows in a
    direction d appears in the direction R d of the world. None: (1, 0, 0, 0).

Raises
------
TypeError
    For an environment or background of another type.
ValueError
    For a colour, intensity or rotation that is not finite, a negative intensity, or a rotation of length 0.

Notes
-----
Intensity and rotation belong to the scene's own environment: to the surfaces that show it, to the
background where that is None, and so to captures and probes, which show both. They change neither the
environment that a node has of its own nor a background that is a cubemap.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene(background=(.4, .4, .4))
>>> lamp = scene.add(cc.PointLight(position=(3, 4, 3)))
>>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
>>> scene
Scene(1 node, 1 light)
>>> ball.id, ball in scene
(1, True)
)doc";

inline constexpr const char* add_light = R"doc(Add a light.

Parameters
----------
light : Light
    The light to add. It may be in other scenes, too.

Returns
-------
Light
    The same light.

Raises
------
ValueError
    If the light is already in this scene.
)doc";

inline constexpr const char* add_camera = R"doc(Add a camera to `Scene.cameras`.

Parameters
----------
camera : Camera
    The camera to add. It may be in other scenes, too. No picture depends on the cameras of a scene: any
    camera can draw any scene.

Returns
-------
Camera
    The same camera.

Raises
------
ValueError
    If the camera is already in this scene.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> car = scene.add(position=(0, 0, 5), name="car")
>>> camera = scene.add(cc.PerspectiveCamera(position=(0, 1, 0), parent=car))
>>> camera in scene, camera.world_position.tolist()
(True, [0.0, 1.0, 5.0])
)doc";

inline constexpr const char* add_animation = R"doc(Add an animation to `Scene.animations`.

Parameters
----------
animation : Animation
    An animation of nodes of this scene.

Returns
-------
Animation
    The same animation.

Raises
------
ValueError
    If the animation is already in this scene, or moves a node that is not.
)doc";

inline constexpr const char* set_time =
    R"doc(Move the nodes to where an animation has them at a time.

Parameters
----------
seconds : float
    Before the first and after the last key of a channel, the channel has the value of that key.
animation : int, str or Animation
    Which animation: an index of `animations`, a name, or the animation itself.

Returns
-------
Scene
    This scene.

Raises
------
IndexError
    For an index that no animation has.
KeyError
    For a name that no animation has; the message names similar ones.
TypeError
    For another kind of object.
ValueError
    For seconds that are not finite, or a node whose `matrix` has a shear, which position, rotation and scale
    cannot express. In this case no node changes.

Notes
-----
What the animation does not name stays as it is, and so do nodes that are no longer in the scene. A node that
was given a whole `matrix` is taken apart, as by setting `Node.rotation`; glTF has no animations of such nodes.
A scale nearer to 0 than 1e-6 becomes 1e-6, since a node's matrix must not be singular.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> ball = scene.add(cc.Mesh.sphere(), name="ball")
>>> way = cc.AnimationChannel(ball, "translation", [0, 2], [(0, 0, 0), (4, 0, 0)])
>>> fly = scene.add(cc.Animation([way], name="fly"))
>>> scene.set_time(.5)["ball"].position.tolist()
[1.0, 0.0, 0.0]
>>> scene.set_time(9, "fly")["ball"].position.tolist()
[4.0, 0.0, 0.0]
)doc";

inline constexpr const char* variant =
    R"doc(str or None: which of `variants` the scene shows; see `Node.variants`.

Setting it gives each node that has a material of that name this material. None gives each node its own
material again, which is the one that was last set by `Node.material`.
)doc";

inline constexpr const char* add_node = R"doc(Add a mesh with a material, or a group.

Parameters
----------
mesh : Mesh, optional
    None: the node is a group, which carries other nodes.
material : Material, optional
    None: a new `PhongMaterial`.
position : array_like (3,), optional
    Relative to the parent. None: (0, 0, 0).
rotation : array_like (4,), optional
    Quaternion (w, x, y, z) of any length except 0, such as `axis_angle` gives. None: (1, 0, 0, 0).
scale : float or array_like (3,), optional
    Factors along the node's own axes, not 0. A negative number mirrors. None: 1.
matrix : array_like (4, 4), optional
    Node to parent, in place of position, rotation and scale: not singular, last row (0, 0, 0, 1).
parent : Node, optional
    A node of this scene that the new node moves with.
environment : CubeMap, Probe, ProbeBlend or PlanarMirror, optional
    The surroundings that mirrors and glass show on this node. None: the scene's environment.
visible : bool
    False: no picture shows the node or any node below it.
in_captures : bool
    False: captures and probes show neither the node nor any node below it; frames do.
name : str
    A name for people; need not be unique.
render_order : int
    Nodes of lower order are drawn first, before any distance counts, among opaque and among translucent
    nodes; 32 bits.
cast_shadow : bool
    False: neither the node nor any node below it casts shadows; see `Shadow`. Translucent nodes never
    cast shadows.
receive_shadow : bool
    Whether shadows show on the node's own surface.
label : int
    A number of your own that the output "label" shows, such as a class; 32 bits. Nodes may share a label.
skin : Skin, optional
    The joints that move the mesh's vertices. None: the mesh does not bend.
weights : array_like (T,), optional
    How much of each of the mesh's morph targets is added. None: nothing.

Returns
-------
Node
    The new node, with the next id; the first id is 1.

Raises
------
TypeError
    For an argument of another type.
ValueError
    For numbers that are not finite, a singular matrix or a scale of 0, a matrix together with
    parts, or a parent that is not in this scene.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> box = scene.add(cc.Mesh.box(), cc.PhongMaterial(color=(1, .4, .4)), scale=2,
...                 rotation=cc.axis_angle((0, 1, 0), 45), name="crate")
>>> box.scale.tolist(), box.name
([2.0, 2.0, 2.0], 'crate')
)doc";

inline constexpr const char* set_positions =
    R"doc(Place many nodes at once, as `Node.position` does for each node, in a hundredth of the time.

Parameters
----------
nodes : sequence of Node
    Nodes of this scene.
positions : array_like (len(nodes), 3)
    Positions relative to the parent of each node, world units.

Raises
------
ValueError
    For another number of positions than nodes, numbers that are not finite, or a node of another scene. In this case
    no node moves.

Examples
--------
>>> import cubecam as cc, numpy as np
>>> scene = cc.Scene()
>>> nodes = [scene.add(cc.Mesh.box(0.1)) for _ in range(3)]
>>> scene.set_positions(nodes, np.eye(3))
>>> nodes[1].position.tolist()
[0.0, 1.0, 0.0]
)doc";

inline constexpr const char* set_matrices =
    R"doc(Place many nodes at once, as `Node.matrix` does for each node.

Parameters
----------
nodes : sequence of Node
    Nodes of this scene.
matrices : array_like (len(nodes), 4, 4)
    Node to parent, for column vectors; the last row of each is (0, 0, 0, 1).

Raises
------
ValueError
    For another number of matrices than nodes, a matrix that is singular or not finite, or a node of another scene. In
    this case no node moves.

Examples
--------
>>> import cubecam as cc, numpy as np
>>> scene = cc.Scene()
>>> nodes = [scene.add(cc.Mesh.box(0.1)) for _ in range(2)]
>>> scene.set_matrices(nodes, [np.diag([2, 2, 2, 1]), np.eye(4)])
>>> nodes[0].scale.tolist()
[2.0, 2.0, 2.0]
)doc";

inline constexpr const char* remove =
    R"doc(Remove a light, a camera, an animation, or a node with all nodes below it.

Removed objects keep their values; their ids are not used again.

Parameters
----------
thing : Node, Light, Camera or Animation
    The object to remove.

Raises
------
ValueError
    If the object is not in this scene.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> group = scene.add()
>>> child = scene.add(cc.Mesh.box(), parent=group)
>>> scene.remove(group)
>>> scene.nodes, child.parent is group
((), True)
)doc";

}  // namespace cubecam::docs
