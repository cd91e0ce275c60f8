#pragma once

#include <optional>

namespace cubecam {

/// How a light's shadow map is made and looked up. A plain value of a light.
struct Shadow {
    int size = 1024;               ///< texels a side of the map, of each of six for a point light
    double radius = 1.0;           ///< of the percentage-closer filter, texels; 0: hard
    double bias = 0.0;             ///< world units, on top of what is derived from the map
    double near = 0.05;            ///< point and spot lights: nothing nearer casts, world units
    std::optional<double> far;     ///< point and spot lights: nothing farther casts; none: all does
    std::optional<double> extent;  ///< directional lights: world units a side of what the map
                                   ///< covers, round the casters' center; none: all casters

    bool operator==(const Shadow&) const = default;
};

/// Throws std::invalid_argument for numbers out of their ranges.
void check(const Shadow& shadow);

/// Texels along the border of a point or spot light's map that only the filter reaches.
int border_of(const Shadow& shadow);

}  // namespace cubecam
