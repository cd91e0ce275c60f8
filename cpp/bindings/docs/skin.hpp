/// Docstrings of cubecam.MorphTarget and cubecam.Skin.
#pragma once

namespace cubecam::docs {

inline constexpr const char* morph_target =
    R"doc(A change of a mesh's shape: what a weight of 1 adds to each vertex.

A mesh has any number of them, and each node its own `Node.weights`. Normals and tangents get unit length
afterwards, and colours are limited to 0 to 1. Smooth normals that the mesh computed are computed again for
the changed shape. A kind of numbers that the mesh itself does not have, for example colours, has no effect.
Morph targets never change.

Parameters
----------
positions : array_like (V, 3), optional
    Added to the positions, one row for each vertex of the mesh. None: positions stay; so do all others.
normals : array_like (V, 3), optional
    Added to the normals.
tangents : array_like (V, 3), optional
    Added to the first three numbers of the tangents; the sign stays.
uvs : array_like (V, 2), optional
    Added to the texture coordinates.
colors : array_like (V, 3) or (V, 4), optional
    Added to the colours; three numbers leave alpha as it is.
uvs1 : array_like (V, 2), optional
    Added to the second texture coordinates.
name : str
    A name for people.

Raises
------
ValueError
    For no array, arrays of unequal lengths, other shapes, NaN or infinity.

Notes
-----
glTF 2.0, section 3.7.2.2.

Examples
--------
>>> import cubecam as cc, numpy as np
>>> box = cc.Mesh.box(2)
>>> taller = cc.MorphTarget(positions=np.where(box.positions > 0, (0, 1, 0), 0), name="taller")
>>> box.morph_targets = [taller]
>>> node = cc.Scene().add(box, weights=[0.5])
>>> node.world_bounds.tolist()
[[-1.0, -1.0, -1.0], [1.0, 1.5, 1.0]]
)doc";

inline constexpr const char* skin =
    R"doc(Joints that bend a mesh: nodes of a scene, which move the vertices near them.

A vertex with the joints j and the weights w of the mesh goes to the mean of ``joint[j].world_matrix @
inverse_bind_matrices[j] @ vertex``, weighted by w. Moving a joint moves the mesh, with no other call. `Node.skin` is
the attribute that uses a skin; any number of nodes may share one. Skins never change, and do not keep their
joints alive.

Parameters
----------
joints : sequence of Node
    Nodes of one scene. None in place of a node stands for one that is gone; pickles may need that.
inverse_bind_matrices : array_like (J, 4, 4), optional
    For each joint the matrix from the mesh's space to that of the joint, with the last row (0, 0, 0, 1). In most
    cases it is the inverse of the joint's `Node.world_matrix` at the time when the mesh lies at rest. None: unit
    matrices.
skeleton : Node, optional
    The node above all joints, for files; no picture depends on it.

Raises
------
TypeError
    For joints that are no nodes.
ValueError
    For no joint, another number of matrices than joints, or a matrix that is not finite or has another last row.

Notes
-----
glTF 2.0, section 3.7.3. Normals are multiplied by the inverse of the transposed matrix. Where joints mirror, the
triangles whose corners are mostly mirrored are turned round, so that they stay visible from outside.

Examples
--------
A stick of two bones, whose upper half bends:

>>> import cubecam as cc, numpy as np
>>> stick = cc.Mesh.box((0.1, 2, 0.1))
>>> upper = stick.positions[:, 1] > 0
>>> stick.update(joints=np.c_[upper, 0 * np.ones((len(upper), 3), int)],
...              joint_weights=np.tile((1, 0, 0, 0), (len(upper), 1)))
>>> scene = cc.Scene()
>>> root = scene.add(position=(0, -1, 0))
>>> elbow = scene.add(position=(0, 1, 0), parent=root)
>>> rest = [np.linalg.inv(joint.world_matrix) for joint in (root, elbow)]
>>> node = scene.add(stick, skin=cc.Skin([root, elbow], rest))
>>> elbow.rotation = cc.axis_angle((0, 0, 1), -90)
>>> node.world_bounds.round(2).tolist()
[[-0.05, -1.0, -0.05], [1.0, 0.05, 0.05]]
)doc";

}  // namespace cubecam::docs
