/// A map with its place on a surface, from Python and back: a Texture, or the map itself if it lies
/// by the mesh's uvs as they are.
#pragma once

#include "map_source.hpp"
#include "objects.hpp"

#include "cubecam/materials/placed_map.hpp"

#include <memory>

namespace cubecam::bindings {

using PlacedMapLike = OneOf<PlacedMap, Image, RenderTexture, ArrayLike, py::none>;
using PlacedMapNow = OneOf<PlacedMap, Image, RenderTexture, py::none>;

inline PlacedMap to_placed_map(py::handle value, const char* name) {
    if (py::isinstance<PlacedMap>(value)) return *py::cast<std::shared_ptr<PlacedMap>>(value);
    return {to_map_source(value, name), {}};
}

inline PlacedMapNow from_placed_map(const PlacedMap& map) {
    if (map.placing == MapPlacing{}) return from_map_source(map.source);
    return py::cast(std::make_shared<PlacedMap>(map));
}

}  // namespace cubecam::bindings
