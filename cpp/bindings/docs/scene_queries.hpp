/// Docstrings of what cubecam.Scene says about its nodes.
#pragma once

namespace cubecam::docs {

inline constexpr const char* get_item =
    R"doc(Get a node by its name; of several, the one of the lowest id.

Parameters
----------
name : str
    The exact name of the node.

Returns
-------
Node
    The node; `find` gives all nodes of a name.

Raises
------
KeyError
    If no node has this name; the message suggests similar names.
TypeError
    For a name that is not a str.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> lamp = scene.add(cc.Mesh.sphere(.1), name="lamp")
>>> scene["lamp"] is lamp, "lamp" in scene, [node.name for node in scene], len(scene)
(True, True, ['lamp'], 1)
)doc";

inline constexpr const char* find = R"doc(Find all nodes of a name, of a label, or of both.

Parameters
----------
name : str, optional
    The exact name.
label : int, optional
    The `Node.label`.

Returns
-------
list of Node
    In order of id; empty if there is no such node.

Raises
------
TypeError
    Without a name and a label, or for values of other types.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> for x in range(3):
...     tree = scene.add(cc.Mesh.cone(), position=(x, 0, 0), name="tree")
>>> [node.id for node in scene.find("tree")]
[1, 2, 3]
>>> scene["tree"].label = 7
>>> [node.id for node in scene.find(label=7)]
[1]
)doc";

inline constexpr const char* scene_bounds =
    R"doc(ndarray (2, 3) float64: the lowest and the highest corner of all visible nodes, read-only.

The numbers are world units and exact for the vertices: the bounds of the transformed vertices, not of
transformed boxes. The ``vertex`` function of a `ShaderMaterial` is not taken into account. Without a
visible mesh the bounds are those of nothing, ``[[inf, inf, inf], [-inf, -inf, -inf]]``: the minimum of the
first rows and the maximum of the second rows unites any bounds.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> box = scene.add(cc.Mesh.box(2), position=(3, 0, 0))
>>> ball = scene.add(cc.Mesh.sphere(.5), position=(0, 2, 0))
>>> scene.bounds.tolist()
[[-0.5, -1.0, -1.0], [4.0, 2.5, 1.0]]
)doc";

}  // namespace cubecam::docs
