#pragma once

#include <span>
#include <string_view>

namespace cubecam::gl {

/// One GLSL file: its name relative to shaders/ ("mesh.vert") and its text.
struct ShaderSource {
    std::string_view name;
    std::string_view text;
    std::string_view title = {};  ///< what messages call it; empty: its name

    std::string_view shown() const { return title.empty() ? name : title; }
};

/// Every file of shaders/, sorted by name. The table is generated at build by cubecam_embed_shaders
/// (cmake/embed_shaders.cmake).
std::span<const ShaderSource> embedded_shaders();

}  // namespace cubecam::gl
