#pragma once

#include <optional>

namespace cubecam {

/// How a light's shadow map is drawn and looked up; a plain value of a light.
struct Shadow {
    int size = 1024;            ///< texels a side of the map, of each of six for a point light
    double radius = 1.0;        ///< of the percentage-closer filter, texels; 0: hard shadows
    double bias = 0.0;          ///< world units, added to the bias derived from the map
    double near = 0.05;         ///< point and spot lights: nearer ones cast none, world units
    std::optional<double> far;  ///< point and spot lights: farther ones cast none; none: no limit
    std::optional<double> extent;  ///< directional lights: world units a side of what the map
                                   ///< covers, round the casters' center; none: all casters

    bool operator==(const Shadow&) const = default;
};

/// Throws std::invalid_argument for numbers out of their ranges.
void check(const Shadow& shadow);

/// The width in texels of the border of a point or spot light's map, which only the filter reads.
int border_of(const Shadow& shadow);

}  // namespace cubecam
