/// Docstrings of cubecam.Light and the lights below it.
#pragma once

namespace cubecam::docs {

inline constexpr const char* light =
    R"doc(Base of the lights.

A light may be in several scenes; every scene shows a change of it.
)doc";

inline constexpr const char* point =
    R"doc(Light from one point, the same in all directions.

Parameters
----------
position : array_like (3,)
    World space, or with a parent its coordinates.
color : array_like (3,) or str
    Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
    decoded to linear. A light has no alpha: "transparent" raises ValueError.
intensity : float
    A factor of `color`, not negative.
decay : float
    The light falls with distance**-decay: 0 is no fall, 2 is the law of physics. Not negative.
range : float
    The light ends at this distance, world units, above 0: it is multiplied by max(min(1 - (distance /
    range)**4, 1), 0), the window of KHR_lights_punctual. Infinity: no end.
shadow : Shadow, bool or None
    None or False: the light casts no shadows. True: ``Shadow()``.
parent : Node, optional
    A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
    changes neither its strength nor its range. The light does not keep the node alive; when the node no
    longer exists, `parent` is None.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> lamp = cc.PointLight(position=(3, 4, 3))
>>> lamp.intensity = 2
>>> lamp
PointLight(position=(3, 4, 3), color=(1, 1, 1), intensity=2, decay=0)
)doc";

inline constexpr const char* spot =
    R"doc(Light from one point into a cone, by the formulas of glTF's KHR_lights_punctual.

Parameters
----------
position : array_like (3,)
    World space, or with a parent its coordinates.
direction : array_like (3,)
    The way the light travels along the cone's axis, in world space or with a parent in its
    coordinates, of any length except 0; it is kept normalised. Straight down by default.
angle : float
    Angle from the axis to the cone's edge, degrees: above 0, below 90. There is no light outside the cone.
penumbra : float
    Share of the angle, from the edge inwards, over which the light fades: with 0 the edge is sharp, with
    1 the light fades from the axis on. The fade is the square of the share between the cosines of the two
    angles, as KHR_lights_punctual recommends; three.js has GLSL's smoothstep there.
color : array_like (3,) or str
    Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
    decoded to linear. A light has no alpha: "transparent" raises ValueError.
intensity : float
    A factor of `color`, not negative.
decay : float
    The light falls with distance**-decay: 0 is no fall, 2 is the law of physics. Not negative.
range : float
    The light ends at this distance, world units, above 0: it is multiplied by max(min(1 - (distance /
    range)**4, 1), 0), the window of KHR_lights_punctual. Infinity: no end.
shadow : Shadow, bool or None
    None or False: the light casts no shadows. True: ``Shadow()``.
parent : Node, optional
    A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
    changes neither its strength nor its range. The light does not keep the node alive; when the node no
    longer exists, `parent` is None.

Raises
------
ValueError
    For a direction of no length, or a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.SpotLight(position=(0, 3, 0), angle=20, penumbra=.5)
SpotLight(position=(0, 3, 0), direction=(0, -1, 0), angle=20, penumbra=0.5, color=(1, 1, 1), intensity=1, decay=0)
)doc";

inline constexpr const char* directional =
    R"doc(Light from far away, such as the sun's.

Parameters
----------
direction : array_like (3,)
    The way the light travels, in world space or with a parent in its coordinates, of any length except 0; it
    is kept normalised. Straight down by default.
color : array_like (3,) or str
    Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
    decoded to linear. A light has no alpha: "transparent" raises ValueError.
intensity : float
    A factor of `color`, not negative.
shadow : Shadow, bool or None
    None or False: the light casts no shadows. True: ``Shadow()``.
parent : Node, optional
    A node, of any scene, that the light moves with. A scale of the node moves the light's position, but
    changes neither its strength nor its range. The light does not keep the node alive; when the node no
    longer exists, `parent` is None.

Raises
------
ValueError
    For a direction of no length, or a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.DirectionalLight(direction=(0, 0, -2)).direction.tolist()
[0.0, 0.0, -1.0]
)doc";

inline constexpr const char* ambient =
    R"doc(Light of the same strength from all directions.

Parameters
----------
color : array_like (3,) or str
    Linear RGB, not negative; or a CSS name or "#rrggbb", which are sRGB (IEC 61966-2-1) and are
    decoded to linear. A light has no alpha: "transparent" raises ValueError.
intensity : float
    A factor of `color`, not negative.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.AmbientLight(intensity=.5)
AmbientLight(color=(1, 1, 1), intensity=0.5)
)doc";

}  // namespace cubecam::docs
