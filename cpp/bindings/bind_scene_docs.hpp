/// Docstrings of cubecam.Scene.
#pragma once

namespace cubecam::bindings {

inline constexpr const char* scene_doc = R"doc(Nodes, lights and what surrounds them.

A scene knows nothing of who draws it; any number of renderers may, on any threads.

Parameters
----------
environment : CubeMap, optional
    What mirrors and glass show; see `load_environment`.
background : array_like (3,) or (4,), str, or CubeMap, optional
    What is seen where nothing is: a colour, or a cubemap as skybox. Numbers are linear; a CSS name or
    "#rrggbb" says sRGB and is decoded. None: the environment if there is one, else transparent black.

Raises
------
TypeError
    For an environment or background of another type.
ValueError
    For a colour that is not finite.

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

inline constexpr const char* add_light_doc = R"doc(Add a light.

Parameters
----------
light : Light
    It may be in other scenes as well.

Returns
-------
Light
    The same light.

Raises
------
ValueError
    If it is in this scene already.
)doc";

inline constexpr const char* add_node_doc = R"doc(Add a mesh with a material, or a group.

Parameters
----------
mesh : Mesh, optional
    None: a group, to carry other nodes.
material : Material, optional
    None: a new PhongMaterial.
position : array_like (3,), optional
    Relative to the parent; (0, 0, 0).
rotation : array_like (4,), optional
    Quaternion (w, x, y, z) of any length but 0, such as `axis_angle` gives; (1, 0, 0, 0).
scale : float or array_like (3,), optional
    Along the node's own axes, never 0; 1. A negative number mirrors.
matrix : array_like (4, 4), optional
    Node to parent, in place of position, rotation and scale: not singular, last row (0, 0, 0, 1).
parent : Node, optional
    A node of this scene that the new one moves with.
environment : CubeMap or Probe, optional
    What mirrors and glass show; None is the scene's.
visible : bool
    False is drawn nowhere, nor is anything below it.
in_captures : bool
    False is absent from captures and probes, as is all below it; still drawn in frames.
name : str
    For people.
render_order : int
    Among opaque and among translucent nodes, lower is drawn first, before distance; of 32 bits.
cast_shadow : bool
    False casts no shadows, nor does anything below it; see `Shadow`. Translucent nodes never cast.
receive_shadow : bool
    Whether shadows show on its own surface.

Returns
-------
Node
    With the next id: 1 for the first.

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

inline constexpr const char* remove_doc = R"doc(Take a node and all below it, or a light, out.

They keep their values; ids are not used again.

Parameters
----------
thing : Node or Light
    What to remove.

Raises
------
ValueError
    If it is not in this scene.

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

}  // namespace cubecam::bindings
