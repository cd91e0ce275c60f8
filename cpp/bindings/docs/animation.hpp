/// Docstrings of cubecam.Animation and cubecam.AnimationChannel.
#pragma once

namespace cubecam::docs {

inline constexpr const char* channel =
    R"doc(One property of a node as a function of time, by keys.

A channel does not change once it is made.

Parameters
----------
node : Node
    The node that moves.
path : str
    "translation" (`Node.position`), "rotation" (w, x, y, z), "scale" or "weights" (`Node.weights`).
times : array_like (K,)
    Seconds, increasing strictly.
values : array_like (K, n) or (3K, n)
    A row for each key. n is 3, for rotations 4, for weights the number of the mesh's morph targets. Of
    "cubic" three rows for each key: in-tangent, value, out-tangent.
interpolation : str
    "step": a value stays until the next key. "linear": rotations are interpolated spherically, along the
    shorter way. "cubic": a cubic Hermite spline.

Raises
------
TypeError
    For a node of another type.
ValueError
    For times that do not increase or are not finite, values of another shape or not finite, a rotation of
    length 0, or another name.

Notes
-----
The formulas are those of glTF 2.0, appendix C. Rotations are normalised, keys and results. A channel does
not keep its node alive.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> door = scene.add(cc.Mesh.box((1, 2, .1)))
>>> turns = [cc.axis_angle((0, 1, 0), degrees) for degrees in (0, 90)]
>>> channel = cc.AnimationChannel(door, "rotation", [0, 1], turns)
>>> channel
AnimationChannel(node 1, 'rotation', 2 keys, 0 to 1 s, 'linear')
>>> bool((channel.sample(.5) == channel.sample(.5)).all()), channel.sample(.5).round(3).tolist()
(True, [0.924, 0.0, 0.383, 0.0])
)doc";

inline constexpr const char* sample = R"doc(The value of the channel at a time.

Parameters
----------
seconds : float
    Before the first and after the last key, the value is that of the key.

Returns
-------
ndarray (n,) float64

Raises
------
ValueError
    For seconds that are not finite.
)doc";

inline constexpr const char* animation = R"doc(Channels that move nodes of a scene together.

`Scene.set_time` moves the nodes. An animation does not change once it is made.

Parameters
----------
channels : sequence of AnimationChannel
    At most one for each path of each node.
name : str
    A name for people, and for `Scene.set_time`.

Raises
------
TypeError
    For another kind of object.
ValueError
    For two channels of the same path of the same node.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> lift = scene.add(cc.Mesh.box())
>>> rise = cc.AnimationChannel(lift, "translation", [0, 4], [(0, 0, 0), (0, 3, 0)])
>>> animation = scene.add(cc.Animation([rise], name="rise"))
>>> animation
Animation(name='rise', 1 channel, 4 s)
>>> for frame in range(5):
...     height = scene.set_time(frame).nodes[0].position[1]
>>> float(height)
3.0
)doc";

}  // namespace cubecam::docs
