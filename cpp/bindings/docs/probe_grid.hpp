/// Docstrings of cubecam.ProbeGrid.
#pragma once

namespace cubecam::docs {

inline constexpr const char* probe_grid =
    R"doc(Light from all around at the nodes of a grid in a box, for surfaces in between.

Assign it to ``scene.probe_grid`` and call `bake`. The diffuse part of `StandardMaterial`, its sheen, and
``environment_irradiance(normal)`` of a `ShaderMaterial` then see the light that the nodes around a point captured, in place
of the irradiance of their environment; what they reflect is still that of the environment. Walls may lie outside
of the box: the light of its border counts up to one cell outside, and from there fades to that of the environment
within another cell.

Parameters
----------
box : array_like (2, 3)
    The low and the high corner, world units: the first and the last node.
counts : (int, int, int)
    Nodes along x, y and z, each at least 2.
size : int
    Texels along an edge of the cubemaps that `bake` captures, from 1 to 128.
resolution : int
    Texels along an edge of the octahedral map of distances of each node, from 4 to 32.
visibility : bool
    True: a node counts less where it does not see a point, and where it lies behind the point's surface. False:
    trilinear interpolation alone, by which light leaks through walls.
normal_bias, view_bias : float
    The visibility of a point counts at a place before its surface: so far along its normal and towards the viewer, in
    least steps of the grid, at least 0. Too little darkens surfaces by themselves, too much lets light through thin walls.

Notes
-----
Z. Majercik et al., "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields", JCGT 8(2), 2019. Of the eight
nodes round a point each has the product of its trilinear weight and w. With c the cosine of the angle between the
normal and the way to the node, d the distance from the node to the biased point, m and s the means of the distance
and of its square that the node captured in that direction, and v = abs(m^2 - s), w is ((1 + c) / 2)^2 + .2,
times (v / (v + (d - m)^2))^3 where d > m; a w below .2 becomes w^3 / .04. The light of a node are spherical
harmonics of orders 0 to 2, as `CubeMap.sh` gives them, with the cosine's factors 1, 2/3 and 1/4 (R. Ramamoorthi and P.
Hanrahan, SIGGRAPH 2001); a sum below 0 counts as 0.

Without visibility a field of light that is linear in space is exact between the nodes. With it, it is not: nodes
before a surface count more than those beside it.

The arrays are the grid: they may be set, and are kept by pickles and saved scenes. Setting a bias or the visibility needs no
new bake.

Raises
------
ValueError
    For an empty box, a number out of its range, a grid that is too large for a texture, or arrays of another shape.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene(background=(1, 1, 1))
>>> scene.probe_grid = cc.ProbeGrid(((-1, 0, -1), (1, 2, 1)), (2, 2, 2), size=8)
>>> with cc.Renderer() as renderer:
...     scene.probe_grid.bake(renderer, scene)
>>> scene.probe_grid.coefficients.shape, scene.probe_grid.distances.shape
((2, 2, 2, 9, 3), (2, 2, 2, 16, 16, 2))
)doc";

}  // namespace cubecam::docs
