/// Docstrings of cubecam.ProbeBlend.
#pragma once

namespace cubecam::docs {

inline constexpr const char* probe_blend =
    R"doc(Several probes as the environment of a node: each point of its surface sees those that reach it.

Assign it to ``node.environment``. A probe counts fully in its `Probe.influence`, and less and less outside of it, until it
ceases to count at its ``blend_distance``. So what a ball reflects does not jump where it rolls from room to room,
and a long floor shows each room in its part of it. Every material that looks up its environment shows the blend:
`MirrorMaterial`, `StandardMaterial`, `GlassMaterial`, and a `ShaderMaterial`, in which ``environment_at(position,
direction)`` sees the probes that reach `position`. Each probe keeps its own parallax, levels by roughness and irradiance.

With t the distance of a point from the influence of probe i over its ``blend_distance``, the influence is
``w_i = 1 - 3 t^2 + 2 t^3``, 1 inside and 0 from t = 1 on. The weight of a probe is ``w_i / max(1, sum w)``. The
scene's environment, black without one, has the rest, ``1 - min(1, sum w)``: it shows where no influence reaches. The
weights sum to 1 and are continuous, and so are their slopes, except where the sum of the influences becomes 1.

The probes do not show the nodes that use the blend, whether they reach them or not.

Parameters
----------
probes : iterable of Probe
    Any number, each once. Of these at most 4 may reach the bounds of one node; a picture of a scene
    where more do raises ValueError. Only probes that reach a node which is drawn are drawn.

Raises
------
ValueError
    For no probe, or one that occurs twice.
TypeError
    For what is no probe.

Notes
-----
The proxy of a probe with ``parallax="box"`` or ``"sphere"`` should contain its influence with the blend distance: a
point outside of the proxy sees the cube as if it were infinitely far away, which jumps at the proxy's side.

``environment_levels``, ``environment_is_local`` and ``environment_position`` of a `ShaderMaterial` are those of the first
probe that reaches the node. For the limit, a probe reaches a node if the box around its influence, with the
blend distance on all sides, overlaps ``node.world_bounds``. Each further probe costs the lookups of one more
environment for every pixel of the node.

Examples
--------
Two rooms that meet at x = 0:

>>> import cubecam as cc
>>> left = cc.Probe((-4, 1, 0), influence=((-8, 0, -3), (0, 3, 3)), blend_distance=.5)
>>> right = cc.Probe((4, 1, 0), influence=((0, 0, -3), (8, 3, 3)), blend_distance=.5)
>>> scene = cc.Scene()
>>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(-2, 1, 0))
>>> ball.environment = cc.ProbeBlend([left, right])
>>> len(ball.environment.probes)
2
)doc";

}  // namespace cubecam::docs
