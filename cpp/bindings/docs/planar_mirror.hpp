/// Docstrings of cubecam.PlanarMirror.
#pragma once

namespace cubecam::docs {

inline constexpr const char* planar_mirror =
    R"doc(What a flat mirror shows, exactly: the scene from behind the mirror, clipped at its plane.

Assign it to ``node.environment``; the plane is that of the node's mesh, and moves with the node. Each picture
that shows the node's front gets a picture of its own of what is in the mirror, of the same size and with the same
samples: frames, both eyes of a stereo frame, captures, probes and render textures alike. It is drawn again only
where it would change. Where the node shows its back (``double_sided``), it reflects that side.

The mirror shows all nodes that the picture may show, except its own nodes and those with
``in_captures=False``, with the picture's background behind them. Nodes with one PlanarMirror in one plane, as the
tiles of a floor, are one mirror.

Every material that looks up its environment shows it: `MirrorMaterial`, `StandardMaterial`, `GlassMaterial`, and a
`ShaderMaterial` by ``environment(direction)``. On a flat surface each pixel is exact. Other directions are
approximations: of normal maps, of normals that are not the plane's, and of rough surfaces. Such a ray is taken to
end at ``distance`` from the surface; rays that leave the picture see its border. A rough surface looks up a level of
the picture's mipmaps as wide as its lobe at that distance, which blurs near and far things alike. Light that goes
through the plane, as what `GlassMaterial` refracts, and the irradiance of `StandardMaterial` are those of the scene's
environment.

Parameters
----------
bounces : int
    A path may meet so many planar mirrors, with this one as the last of them, at least 1. Beyond that the mirror shows the
    scene's environment, or black. With 1, mirrors in this mirror show that. Facing mirrors need one picture for each bounce;
    where mirrors see each other in many ways, one for each path, and more than 256 in one call are an error.
distance : float
    How far from the surface bent and rough rays are taken to end, world units, above 0. Flat smooth mirrors do
    not depend on it.

Raises
------
ValueError
    For a number out of its range. A picture of a node whose mesh is not flat, within 1e-5 of its size, raises it, too, and
    says by how much.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> glass = scene.add(cc.Mesh.plane(2), cc.MirrorMaterial(), environment=cc.PlanarMirror())
>>> glass.environment.bounces
1
)doc";

}  // namespace cubecam::docs
