#pragma once

#include "cubecam/materials/texture_source.hpp"

#include <glm/glm.hpp>

#include <cmath>

namespace cubecam {

/// Where a map lies on a surface: one of the mesh's sets of texture coordinates, scaled, then
/// turned, then moved. This is KHR_texture_transform of glTF, with the origin of uvs at the
/// picture's bottom-left.
struct MapPlacing {
    int uv_set = 0;  ///< 0: the mesh's uvs, 1: its uvs1
    glm::vec2 offset{0.0F};
    float rotation = 0.0F;  ///< degrees, counter-clockwise in the plane of u and v
    glm::vec2 scale{1.0F};

    bool operator==(const MapPlacing&) const = default;
};

/// The matrix of a placing: a map is looked up at matrix * (u, v, 1). It is T * R * S of
/// KHR_texture_transform ("Overview"), which counts v downwards; the same matrix holds for v
/// upwards, where a positive angle also turns counter-clockwise.
inline glm::mat3x2 matrix(const MapPlacing& placing) {
    // remquo() subtracts whole quarter turns exactly, so that these have a sine of exactly 0 or 1.
    int quarters = 0;
    const double rest = std::remquo(static_cast<double>(placing.rotation), 90.0, &quarters);
    const double angle = glm::radians(rest);
    glm::dvec2 turned(std::cos(angle), std::sin(angle));
    for (int i = 0; i < (quarters & 3); ++i) turned = {-turned.y, turned.x};
    const glm::dvec2 scale(placing.scale);
    return {glm::vec2(turned * scale.x), glm::vec2(glm::dvec2(-turned.y, turned.x) * scale.y),
            placing.offset};
}

/// Throws std::invalid_argument for a set that is neither 0 nor 1, or a number that is not finite.
void check(const MapPlacing& placing);

/// A map of a material that has several maps, with its place.
struct PlacedMap {
    MapSource source;
    MapPlacing placing;

    bool operator==(const PlacedMap&) const = default;
};

}  // namespace cubecam
