/// Docstrings of cubecam.Shadow.
#pragma once

namespace cubecam::docs {

inline constexpr const char* shadow =
    R"doc(How a light makes its shadow: a depth map from the light's view, and the filter of its lookups.

A Shadow never changes; give a light a new one instead. All visible opaque nodes whose ``cast_shadow`` is
True cast shadows, in or out of a picture's view, from either side of their surface, whether their material
writes depth and colour or not. Shadows fall on
every node with a `PhongMaterial` whose ``receive_shadow`` is True. A map is drawn again only when
something in its view changes.

The map of a directional light covers all casters, so a wide floor makes its texels wide. In this case set
the floor's ``cast_shadow`` to False, or set an ``extent``.

The edge of a shadow is about ``2 * radius + 1`` texels wide. A surface does not shadow itself, because
each texel is compared with the depth of the surface's own plane at that texel; no bias has to be tuned.

Parameters
----------
size : int
    Texels along a side of the map; a point light has six maps. At least 8, and more for a larger radius;
    at most ``info.limits.max_frame_size``.
radius : float
    Radius of the percentage-closer filter (Reeves, Salesin and Cook, 1987) in texels, from 0 to 16: a box
    of ``2 * radius + 1`` texels. 0 gives the hardest edge.
bias : float
    World units, not negative: a caster nearer than this to a surface casts no shadow on it. The bias is
    added to a fraction of a texel that is always there.
near : float
    Point and spot lights: a caster nearer than this to the light casts no shadow. World units, above 0.
far : float or None
    Point and spot lights: a caster farther than this from the light casts no shadow. World units, above
    near. None: there is no such limit.
extent : float or None
    Directional lights: width and height of the area that the map covers, world units, around the middle of
    the bounds of all casters (except its outermost texels, which stay empty); everything outside is lit.
    None: the map covers all casters.

Raises
------
ValueError
    For a number out of its range.

Examples
--------
>>> import cubecam as cc
>>> lamp = cc.PointLight(position=(0, 3, 0), shadow=cc.Shadow(size=512, radius=2))
>>> lamp.shadow
Shadow(size=512, radius=2, bias=0, near=0.05, far=None, extent=None)
>>> lamp.shadow == cc.Shadow(size=512, radius=2)
True
)doc";

}  // namespace cubecam::docs
