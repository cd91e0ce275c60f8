#pragma once

#include "cubecam/materials/texture_source.hpp"

#include <glm/glm.hpp>

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

/// A map of a material that has several maps, with its place.
struct PlacedMap {
    MapSource source;
    MapPlacing placing;

    bool operator==(const PlacedMap&) const = default;
};

}  // namespace cubecam
