/// Docstrings of cubecam.Probe.
#pragma once

namespace cubecam::docs {

inline constexpr const char* probe =
    R"doc(A cubemap of the scene that renderers keep up to date.

A probe is only a description, and any number of nodes may use it: assign it to ``node.environment``, or
to the cubemap of a `BasicMaterial`. Each renderer holds its own contents of the probe
(``renderer.read_probe(probe)``) and draws a face again only if the face would change. The probe leaves out
the nodes that use it.

Parameters
----------
position : array_like (3,)
    World space; with a parent, relative to the parent's position.
size : int
    Texels along an edge of a face.
near, far : float
    Clip distances along each face's axis, world units: 0 < near < far.
format : {"rgba16f", "rgba8", "rgba32f", "rgb565"}
    The format of a texel. rgba8 and rgb565 clip light above 1.
mipmaps : bool
    True: lookups are trilinear. False: lookups are bilinear.
samples : int
    Samples of each texel, for smooth edges (MSAA); 1 is none.
update : {"on_change", "once", "manual"} or int
    "on_change": the probe is drawn whenever its picture would change. "once": it is drawn when a picture
    first needs it. "manual": only ``renderer.update_probes`` draws it. n: it is drawn on every n-th call
    that needs it.
exclude : iterable of Node
    Nodes that the probe leaves out with all nodes below them, besides the nodes that use it.
parent : Node, optional
    A node that the probe moves with; the axes of the probe stay those of the world. The probe does not
    keep the node alive.
faces_per_frame : int
    The greatest number of faces that one call draws, from 1 to 6; of each bounce, if there are several.
depth_format : str or None
    The format of the depth and stencil buffer, see `Renderer.render`.
prefilter : bool, optional
    Whether the probe is filtered by roughness, as rough surfaces see it (`CubeMap.prefilter`), whenever a
    face was drawn. None: only if a drawn surface looks it up by roughness. True: always, so that
    ``environment_lod`` in a `ShaderMaterial` finds these levels, too. False: never; rough surfaces then see
    the probe's mipmaps, or the probe as it is.
parallax : {"none", "box", "sphere", "distance", "layers"}
    How a surface finds what its reflected ray meets, in a cube that was captured elsewhere. "none": as if
    the scene were infinitely far away. "box": the scene lies on the inside of `box`. "sphere": on the inside
    of the ellipsoid that `box` encloses, a sphere if its edges are equal. A ray from outside that misses the proxy sees
    the cube as with "none". "distance": the ray is followed through the distances of what the probe captured. "layers":
    the probe captures the farthest surfaces, too, and the ray finds what the nearest ones hide; such a probe
    costs twice as much to draw.
box : array_like (2, 3), optional
    The low and the high corner of the proxy, world units; in the space of `proxy_matrix` if there is one. It does not
    move with the parent.
proxy_matrix : array_like (4, 4), optional
    From the space of `box` to the world, for a room that is turned; its last row is (0, 0, 0, 1). None: the world.
fetches : {14, 6, 35}
    About how many lookups of distance a ray makes with "distance" and "layers". More find thinner things; the cost of
    a pixel grows with them.
bounces : int
    How many mirrors of a circle a path meets, from 1 to 16; beyond that it sees the scene's environment, or
    black without one. Probes whose pictures may show each other's users, in view or not, form a circle. With
    1, the other mirrors of the circle show the environment in this one. All probes of a circle have the
    largest ``bounces`` among them, so none is preferred. Time and memory grow with it;
    ``renderer.stats.bounce_changes`` says how much each bounce changed. Without a circle it has no effect.
influence : array_like (2, 3), optional
    Where the probe counts fully in a `ProbeBlend`: the low and the high corner, world units; in the space of
    `proxy_matrix` if there is one. It does not move with the parent. None: everywhere. It matters to no other use of the probe.
influence_shape : {"box", "sphere"}
    "sphere": the ellipsoid that `influence` encloses, a sphere if its edges are equal.
blend_distance : float
    How far outside of `influence` the probe ceases to count, world units, above 0. Over this distance its weight falls from
    1 to 0.

Notes
-----
With a parallax, rough surfaces look the cube up by the roughness whose lobe, seen from the probe, is as wide as the
surface's own lobe where it meets the scene. Irradiance is that of the probe's place. Surfaces that are blended are in the
colours, but not in the distances, as in other outputs.

"box": S. Lagarde and A. Zanuttini, "Local Image-based Lighting with Parallax-corrected Cubemaps", SIGGRAPH 2012. "distance" and
"layers": after L. Szirmay-Kalos et al., "Approximate Ray-Tracing on the GPU with Distance Impostors", Eurographics 2005; 1 / z is
interpolated, which is exact on planes.

Raises
------
ValueError
    For a number out of its range, near >= far, another format, update, parallax or shape, a proxy without a box, a box or
    influence whose low corner is not below its high one, a singular matrix, or a march without depths of 32 bits.
TypeError
    For a parent or an excluded object that is not a node.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
>>> ball.environment = cc.Probe(parent=ball, size=128)
>>> ball.environment.update
'on_change'

The walls of a room that reaches from (-5, 0, -4) to (5, 3, 4) are then in their places:

>>> ball.environment.box = (-5, 0, -4), (5, 3, 4)
>>> ball.environment.parallax = "box"

Two mirrors that face each other, with two reflections of each:

>>> other = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(1.2, 1, 0))
>>> other.environment = cc.Probe(parent=other, size=128, bounces=2)
>>> other.environment.bounces
2
)doc";

}  // namespace cubecam::docs
