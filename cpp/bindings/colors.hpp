/// Colours by name.
#pragma once

#include <glm/vec4.hpp>

#include <string>
#include <string_view>

namespace cubecam::bindings {

/// Linear RGBA of a CSS name (Color Module Level 4, section 6, in any case) or of "#rgb", "#rgba",
/// "#rrggbb" or "#rrggbbaa", which are sRGB.
/// @throws std::invalid_argument with a message that begins with `argument` and suggests the
/// nearest name.
glm::dvec4 parse_color(std::string_view text, const char* argument);

}  // namespace cubecam::bindings
