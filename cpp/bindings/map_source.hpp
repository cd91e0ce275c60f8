/// The picture that a surface shows at its uvs, from Python and back: an Image, a RenderTexture or
/// None.
#pragma once

#include "objects.hpp"

#include "cubecam/image/image.hpp"
#include "cubecam/materials/placed_map.hpp"
#include "cubecam/materials/texture_source.hpp"
#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"

#include <memory>

namespace cubecam::bindings {

using MapLike = OneOf<Image, RenderTexture, ArrayLike, py::none>;
using MapNow = OneOf<Image, RenderTexture, py::none>;

/// An array becomes an Image.
inline MapSource to_map_source(py::handle value, const char* name) {
    if (value.is_none()) return {};
    if (py::isinstance<RenderTexture>(value))
        return py::cast<std::shared_ptr<RenderTexture>>(value);
    // numpy would make an array of a Scene's nodes.
    if (py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value) ||
        py::isinstance<Scene>(value)) {
        refuse(value, name,
               "an Image, an array (H, W, C), a RenderTexture or None (see cubecam.load_image)");
    }
    // numpy would make an array of an object.
    if (py::isinstance<PlacedMap>(value)) {
        refuse(value, name,
               "an Image, an array (H, W, C), a RenderTexture or None, without a place");
    }
    if (!py::isinstance<Image>(value)) return to_map_source(py::type::of<Image>()(value), name);
    return std::shared_ptr<const Image>(py::cast<std::shared_ptr<Image>>(value));
}

inline MapNow from_map_source(const MapSource& source) {
    if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
        return py::cast(std::const_pointer_cast<Image>(*image));
    }
    if (const auto* texture = std::get_if<std::shared_ptr<RenderTexture>>(&source)) {
        return py::cast(*texture);
    }
    return py::none();
}

}  // namespace cubecam::bindings
