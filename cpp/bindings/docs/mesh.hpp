/// Docstrings of cubecam.Mesh.
#pragma once

namespace cubecam::docs {

inline constexpr const char* mesh =
    R"doc(Indexed triangles, which any number of nodes, scenes and renderers share.

The vertices can be replaced: `update` replaces several arrays at once. The number of vertices and
the triangles never change.

A mesh may have levels of detail, of which calls with ``max_lod_error`` draw one: see `with_levels`.

Parameters
----------
positions : array_like (V, 3)
    Object-space positions, finite; kept as float32.
indices : array_like (F, 3) of int
    The three corners of each triangle, counter-clockwise seen from outside, from 0 to V - 1.
normals : array_like (V, 3), optional
    Outward normals of any length. A normal of length 0 becomes a smooth one. None: all normals are
    smooth: the sum of the triangles' normals, weighted by the angle at the vertex (G. Thuermer and
    C. Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT 3(1), 1998).
uvs : array_like (V, 2), optional
    Texture coordinates; (0, 0) is a picture's bottom-left corner, (1, 1) its top-right one.
colors : array_like (V, 3) or (V, 4), optional
    Linear RGB or RGBA, alpha from 0 to 1; uint8 stands for value/255. Materials with
    ``vertex_colors=True`` show them.
uvs1 : array_like (V, 2), optional
    A second set of texture coordinates, for a `Texture` with ``uv_set=1``.
tangents : array_like (V, 4), optional
    For normal maps. The first three numbers, of any length, point along +u in the surface; the fourth,
    1 or -1, is the factor of ``cross(normal, tangent)``, which points along +v. None: materials that
    need tangents use those of `with_tangents`.
joints : array_like (V, 4 k) of int, optional
    For a `Skin`: the numbers of the joints that move each vertex, from 0; k is any number of sets. The
    number of a joint whose weight is 0 means nothing and becomes 0.
joint_weights : array_like (V, 4 k), optional
    How much each of these joints moves the vertex, 0 or more; given together with `joints`. The weights
    are kept as they are, and divided by their sum where they are used. A vertex without any weight moves
    with joint 0.
morph_targets : sequence of MorphTarget
    Changes of the shape, which `Node.weights` mixes.
levels : sequence of (array_like (F, 3) of int, float)
    Levels of detail from fine to coarse: triangles between the same vertices, and the error, see `levels`.

Raises
------
TypeError
    For arrays of bool, complex, object or str, and for indices that are not integers.
ValueError
    For other shapes, unequal lengths, NaN or infinity, no triangle, or errors of levels that are negative or decrease.
IndexError
    For an index outside 0 to V - 1, or a joint outside 0 to 65535.

Examples
--------
>>> import cubecam as cc
>>> mesh = cc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
>>> mesh.normals[0].tolist()
[0.0, 0.0, 1.0]
>>> mesh.bounds.tolist()
[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0]]
>>> cc.Mesh.box(2)
Mesh(24 vertices, 12 triangles)
)doc";

inline constexpr const char* positions =
    R"doc(ndarray (V, 3) float32: the positions of the vertices; a read-only view.

Positions can be set; `update` says what the normals become. An array that was read before keeps its
values.)doc";

inline constexpr const char* normals =
    R"doc(ndarray (V, 3) float32: unit vectors; a read-only view.

Normals can be set. None: smooth normals, computed now and whenever positions are set without normals.)doc";

inline constexpr const char* uvs =
    R"doc(ndarray (V, 2) float32 or None: (0, 0) is a picture's bottom-left; a read-only view.

Texture coordinates can be set. None: the mesh has none.)doc";

inline constexpr const char* colors =
    R"doc(ndarray (V, 4) float32 or None: linear RGBA; a read-only view.

Colours can be set. None: the mesh has none.)doc";

inline constexpr const char* uvs1 =
    R"doc(ndarray (V, 2) float32 or None: a second set of texture coordinates; a read-only view.

It can be set. None: the mesh has none.)doc";

inline constexpr const char* tangents =
    R"doc(ndarray (V, 4) float32 or None: unit vectors along +u and a sign; a read-only view.

The fourth number, 1 or -1, is the factor of ``cross(normal, tangent)``, which points along +v. Tangents can be
set. None: materials that need tangents use those of `with_tangents`, made again whenever vertices change.)doc";

inline constexpr const char* joints =
    R"doc(ndarray (V, 4 k) uint16 or None: the joints that move each vertex; a read-only view.

They count the joints of `Node.skin` from 0. `update` replaces them.)doc";

inline constexpr const char* joint_weights =
    R"doc(ndarray (V, 4 k) float32 or None: how much each of the `joints` moves the vertex; a read-only view.

`update` replaces them.)doc";

inline constexpr const char* morph_targets =
    R"doc(tuple of MorphTarget: changes of the shape, which `Node.weights` mixes.

They can be set. Where a node has fewer weights than there are targets, the others are 0.)doc";

inline constexpr const char* levels =
    R"doc(tuple of (ndarray (F, 3) uint32, float): simpler forms of the mesh, from fine to coarse.

Each is a pair of triangles between vertices of the mesh and an error in the mesh's units: no point of either surface
lies farther from the other than that. A call with ``max_lod_error`` draws the coarsest level whose error, seen from
the call's place, is at most so many pixels; three.js chooses by a distance, ``LOD.addLevel(object, distance)``.
`with_levels` makes levels; others can be set, and an empty sequence takes them away. New vertices end them: positions,
normals, uvs, colours or tangents that are set or updated. `resized` scales the errors.

Examples
--------
>>> import cubecam as cc
>>> ball = cc.Mesh.sphere(1).with_levels()
>>> len(ball.indices), [len(indices) for indices, _ in ball.levels[:3]]
(3968, [1984, 992, 496])
>>> cc.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.1]], [[0, 1, 2], [0, 2, 3]], levels=[([[0, 1, 2]], 0.7)])
Mesh(4 vertices, 2 triangles, 1 level)
)doc";

inline constexpr const char* with_levels =
    R"doc(Copy the mesh with levels of detail, which calls with ``max_lod_error`` draw where they are small.

Edges are contracted to one of their ends, those first that change the surface and its attributes least, until nothing
more can be left out without a tear or a fold. Vertices keep their normals, uvs and colours. Borders keep to borders;
seams, where vertices at one place differ in their attributes, stay closed.

Parameters
----------
ratio : float
    How many triangles a level has, relative to the one before; 0.1 to 0.9.

Returns
-------
Mesh
    A new mesh with `levels`; none if nothing can be left out.

Raises
------
ValueError
    For a ratio that is not from 0.1 to 0.9.

Notes
-----
The order is that of the quadric errors of M. Garland and P. Heckbert, "Surface Simplification Using Quadric Error
Metrics", SIGGRAPH 1997, with attributes after H. Hoppe, "New Quadric Metric for Simplifying Meshes with Appearance
Attributes", IEEE Visualization 1999. The error of a level is the greater of two. One is an upper bound for the
Hausdorff distance of the surfaces, above it by at most 5 % or 1e-4 of the mesh's extent, which is found by cutting
triangles (after M. Tang, M. Lee and Y. Kim, "Interactive Hausdorff Distance Computation for General Polygonal Models",
SIGGRAPH 2009). The other is the greatest root of a mean square by which normals, uvs or colours differ round a vertex,
where a difference of 1 counts as the length on the surface over which they change by 1 on average, at most a quarter of
the mesh's extent: that one is an estimate.

Nodes draw the exact mesh where a level would not fit: with joints or morph targets; with materials that move vertices
or count triangles, that set ``flat_shading`` or need tangents that the mesh lacks, and glass that follows light through
its body; and where a node both casts and receives shadows. Shadow maps, probes and render textures show exact meshes.

Examples
--------
>>> import cubecam as cc
>>> ball = cc.Mesh.sphere(1).with_levels()
>>> scene = cc.Scene()
>>> near, far = (scene.add(ball, cc.BasicMaterial(), position=(0, 0, z)) for z in (-3, -50))
>>> with cc.Renderer() as renderer:
...     cube = renderer.capture(scene, size=64, max_lod_error=0.5)
...     print(renderer.stats.triangles_simplified > 0)
True
)doc";

inline constexpr const char* with_tangents =
    R"doc(Copy the mesh with the tangents of MikkTSpace, by which most programs bake normal maps.

Around a vertex the triangles that share edges and have the same orientation of their uvs get one tangent:
the mean of their directions of +u in the plane of the vertex's normal, weighted by the angle at the vertex.
Where triangles of both orientations, or the sides of a seam, share a vertex, the vertex is split: copies follow
all other vertices. Materials that need tangents use such a mesh by themselves where a mesh has none.

Parameters
----------
uv_set : {0, 1}
    The texture coordinates: 0 for `uvs`, 1 for `uvs1`.

Returns
-------
Mesh
    A new mesh; it keeps its tangents when its vertices are replaced.

Raises
------
ValueError
    For a mesh without these texture coordinates.

Notes
-----
M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, section 3. Triangles without an area of
their uvs take the tangent of a neighbour; every tangent is finite and of unit length.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.plane().with_tangents().tangents[0].tolist()
[1.0, 0.0, 0.0, 1.0]
)doc";

inline constexpr const char* update =
    R"doc(Replace several arrays of the vertices at once.

All nodes of the mesh show the new values in the next picture; only the given arrays are uploaded to
the GPU again. Any call with an array counts as a change, even if all numbers are the same, since
comparing them would cost more than it saves. Other threads may draw at the same time: a picture shows
the mesh before or after an update, never a part of it. Arrays that were read before keep their values.

New positions, normals, uvs, colours or tangents end the `levels` of the mesh.

Parameters
----------
positions : array_like (V, 3), optional
    Object-space positions, finite. None: the positions stay.
normals : array_like (V, 3), optional
    Outward normals of any length. None: normals that were given stay, also those of primitives and of
    `load_mesh`; smooth normals that the mesh computed are computed again with new positions.
    ``mesh.normals = None`` makes all normals smooth.
uvs : array_like (V, 2), optional
    Texture coordinates. None: the texture coordinates stay.
colors : array_like (V, 3) or (V, 4), optional
    Linear RGB or RGBA; uint8 stands for value/255. None: the colours stay.
uvs1 : array_like (V, 2), optional
    The second set of texture coordinates. None: it stays.
tangents : array_like (V, 4), optional
    Tangents. None: tangents that were given stay, also with new positions.
joints, joint_weights : array_like (V, 4 k), optional
    The joints that move the vertices, and their weights. None: they stay.
morph_targets : sequence of MorphTarget, optional
    New morph targets. None: they stay, and add the same numbers to new positions.

Raises
------
TypeError
    For arrays of bool, complex, object or str.
ValueError
    For another number of vertices, NaN, infinity or an alpha outside 0 to 1. The mesh then stays
    as it was.

Examples
--------
A sheet that waves:

>>> import cubecam as cc
>>> import numpy as np
>>> x, z = np.meshgrid(np.linspace(-1, 1, 20), np.linspace(-1, 1, 20))
>>> i = np.arange(19 * 20).reshape(19, 20)[:, :-1].ravel()
>>> triangles = np.concatenate([np.c_[i, i + 20, i + 21], np.c_[i, i + 21, i + 1]])
>>> mesh = cc.Mesh(np.c_[x.ravel(), 0 * x.ravel(), z.ravel()], triangles)
>>> scene = cc.Scene()
>>> sheet = scene.add(mesh)
>>> for time in np.linspace(0, 1, 3):
...     y = 0.2 * np.sin(3 * x + time)
...     mesh.update(positions=np.c_[x.ravel(), y.ravel(), z.ravel()])
>>> mesh.bounds[1].round(2).tolist()
[1.0, 0.2, 1.0]
)doc";

inline constexpr const char* plane = R"doc(A rectangle in the XZ plane, centred, normal +Y.

Seen from +Y with -Z up, a picture on the plane is upright. The back is culled unless the material is
double-sided.

Parameters
----------
width, depth : float
    Extents along X and Z, above 0.

Returns
-------
Mesh
    4 vertices, 2 triangles.

Raises
------
ValueError
    For an extent that is not above 0.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.plane(10, 4).bounds.tolist()
[[-5.0, 0.0, -2.0], [5.0, 0.0, 2.0]]
)doc";

inline constexpr const char* box =
    R"doc(A centred box with flat faces, each with uv from 0 to 1.

Pictures are upright seen from outside: +Y up on the sides, -Z on top (as on `plane`), +Z below.

Parameters
----------
size : float or array_like (3,)
    Extents along X, Y and Z, above 0; a single number is the extent along all three.

Returns
-------
Mesh
    24 vertices, 12 triangles.

Raises
------
ValueError
    For an extent that is not above 0.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.box((1, 2, 3)).bounds[1].tolist()
[0.5, 1.0, 1.5]
)doc";

inline constexpr const char* sphere =
    R"doc(A centred sphere of rings and segments, as on a globe.

u runs once round the Y axis, and v from the south pole (-Y) to the north pole. An equirectangular
picture on the sphere is not mirrored when seen from outside; its center is at +Z and its seam at -Z.

Parameters
----------
radius : float
    Radius, above 0.
segments : int
    Segments round the Y axis, at least 3.
rings : int
    Rings from pole to pole, at least 2.

Returns
-------
Mesh
    2 * segments * (rings - 1) triangles.

Raises
------
ValueError
    For a radius that is not above 0, too few segments or rings, or more than 16,777,216 vertices.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.sphere(0.5)
Mesh(2145 vertices, 3968 triangles)
)doc";

inline constexpr const char* icosphere =
    R"doc(A centred sphere of triangles of nearly equal size: a subdivided icosahedron.

Texture coordinates are those of `sphere`.

Parameters
----------
radius : float
    Radius, above 0.
subdivisions : int
    Number of subdivisions, from 0 to 9; each one splits every triangle into four.

Returns
-------
Mesh
    20 * 4**subdivisions triangles.

Raises
------
ValueError
    For a radius that is not above 0 or another number of subdivisions.

Examples
--------
>>> import cubecam as cc
>>> len(cc.Mesh.icosphere(1, subdivisions=3).indices)
1280
)doc";

inline constexpr const char* cylinder = R"doc(A centred, closed cylinder round the Y axis.

On the side, u runs round as on `sphere`, and v upwards. Each cap shows the round middle of a picture.

Parameters
----------
radius, height : float
    Radius, and height along the axis, above 0.
segments : int
    Segments round the axis, at least 3.

Returns
-------
Mesh
    4 * segments triangles.

Raises
------
ValueError
    For a length that is not above 0, or too few or too many segments.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.cylinder(1, 4).bounds[1].tolist()
[1.0, 2.0, 1.0]
)doc";

inline constexpr const char* cone =
    R"doc(A centred, closed cone round the Y axis: base at -height/2, apex at +height/2.

Parameters
----------
radius, height : float
    Radius of the base, and height from the base to the apex, above 0.
segments : int
    Segments round the axis, at least 3.

Returns
-------
Mesh
    2 * segments triangles.

Raises
------
ValueError
    For a length that is not above 0, or too few or too many segments.

Examples
--------
>>> import cubecam as cc
>>> len(cc.Mesh.cone(segments=16).indices)
32
)doc";

inline constexpr const char* torus = R"doc(A centred torus round the Y axis.

Parameters
----------
radius : float
    Distance from the axis to the center of the tube.
tube : float
    Radius of the tube: above 0, below `radius`.
segments : int
    Segments round the axis, at least 3.
sides : int
    Sides round the tube, at least 3.

Returns
-------
Mesh
    2 * segments * sides triangles.

Raises
------
ValueError
    For a length or number out of its range, or more than 16,777,216 vertices.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.torus(1, .25).bounds[1].tolist()
[1.25, 0.25, 1.25]
)doc";

inline constexpr const char* arrow =
    R"doc(A closed arrow along +Z, from the origin to (0, 0, length): a cylinder with a cone as its head.

`Node.look_at` turns +Z, and so the arrow, towards a point. u runs round the shaft and the head as on
`cylinder`, and v along the arrow, from 0 to 1; the two flat faces show the round middle of a picture.

Parameters
----------
length : float
    Length from the tail to the tip, above 0.
radius : float, optional
    Radius of the shaft. None: length / 20.
head_length : float, optional
    Length of the head, below `length`. None: length / 4.
head_radius : float, optional
    Radius of the head, above `radius`. None: length / 10.
segments : int
    Segments round the axis, at least 3.

Returns
-------
Mesh
    6 * segments triangles.

Raises
------
ValueError
    For a length that is not above 0, a head that is longer than the arrow or thinner than the shaft,
    or too few or too many segments.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.arrow(2).bounds.round(6).tolist()
[[-0.2, -0.2, 0.0], [0.2, 0.2, 2.0]]
>>> scene = cc.Scene()
>>> wind = scene.add(cc.Mesh.arrow(), position=(0, 1, 0))
>>> wind.look_at((5, 1, 0))
>>> wind.world_bounds[1].round(6).tolist()
[1.0, 1.1, 0.1]
)doc";

inline constexpr const char* flat_shaded =
    R"doc(Copy the mesh with flat faces: its triangles share no vertex.

Vertices 3 i, 3 i + 1 and 3 i + 2 are the corners of triangle i, with the normal of its plane on the side
from which they are counter-clockwise. A triangle without area, which no picture shows, has the normal
(0, 1, 0). Texture coordinates and colours stay. The normals follow new positions (`update`).

Materials do the same with ``flat_shading=True`` when they are drawn; calls and pictures share the arrays
until this mesh changes.

Returns
-------
Mesh
    3 * F vertices, F triangles.

Examples
--------
>>> import cubecam as cc
>>> ball = cc.Mesh.icosphere(1, subdivisions=0)
>>> ball, ball.flat_shaded()
(Mesh(15 vertices, 20 triangles), Mesh(60 vertices, 20 triangles))
)doc";

inline constexpr const char* from_trimesh = R"doc(Make a mesh from a mesh or a scene of trimesh.

Parameters
----------
mesh : trimesh.Trimesh or trimesh.Scene
    The objects of a scene become one mesh, each placed by its transform; those without triangles are
    left out.

Returns
-------
Mesh
    The vertices and faces in their order, normals as ``mesh.vertex_normals`` gives them (smooth ones
    where these have length 0), and texture coordinates and vertex colours if there are any. Colours of
    faces, and textures, are not read.

Raises
------
TypeError
    For another kind of object.
ValueError
    For no triangles, positions that are not finite, or all vertices in one place.
IndexError
    For an index outside the vertices.

Examples
--------
>>> import cubecam as cc, trimesh
>>> capsule = trimesh.creation.capsule(height=2, radius=0.5)
>>> mesh = cc.Mesh.from_trimesh(capsule)
>>> len(mesh.positions) == len(capsule.vertices), mesh.bounds.round(2).tolist()
(True, [[-0.5, -0.5, -1.5], [0.5, 0.5, 1.5]])
)doc";

inline constexpr const char* resized =
    R"doc(Copy the mesh, centred at the origin and scaled evenly.

Parameters
----------
size : float
    The largest extent that the result has, in world units.

Returns
-------
Mesh
    A new mesh; all but the positions is the same.

Raises
------
ValueError
    For a size that is not above 0, a mesh whose vertices are all at one point, or one with joints, since
    the matrices of a skin fit one size only.

Examples
--------
>>> import cubecam as cc
>>> cc.Mesh.box((1, 2, 4)).resized(1).bounds[1].tolist()
[0.125, 0.25, 0.5]
)doc";

}  // namespace cubecam::docs
