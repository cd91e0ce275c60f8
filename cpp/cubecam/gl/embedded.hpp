#pragma once

#include <span>
#include <string_view>

namespace cubecam::gl {

/// One GLSL file: its name relative to shaders/ ("passes/surface.vert") and its text.
struct ShaderSource {
    std::string_view name;
    std::string_view text;
    std::string_view title = {};  ///< its name in messages; empty: `name`

    std::string_view shown() const { return title.empty() ? name : title; }
};

/// Every file of shaders/, sorted by name. cubecam_embed_shaders (cmake/embed_shaders.cmake)
/// generates the table at build.
std::span<const ShaderSource> embedded_shaders();

}  // namespace cubecam::gl
