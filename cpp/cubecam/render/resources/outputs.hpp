#pragma once

#include <compare>
#include <string>
#include <vector>

namespace cubecam {

/// What a picture holds besides its colour. Only opaque nodes write the shaded ones; depth and
/// stencil are what those buffers hold in the end.
struct Outputs {
    bool distance = false;  ///< length of the ray, world units
    bool z = false;         ///< along the camera's axis, world units
    bool normal = false;    ///< world shading normal, towards the viewer
    bool position = false;  ///< world
    bool id = false;        ///< Node::id
    bool depth = false;     ///< window-space z, 0 near to 1 far
    bool stencil = false;

    /// Whether fragment shaders write any.
    bool shaded() const { return distance || z || normal || position || id; }
    /// Whether any is read from the depth and stencil buffer.
    bool buffered() const { return depth || stencil; }
    bool any() const { return shaded() || buffered(); }
    auto operator<=>(const Outputs&) const = default;
};

/// @throws std::invalid_argument for a name it does not know, listing those it does.
Outputs parse_outputs(const std::vector<std::string>& names);

}  // namespace cubecam
