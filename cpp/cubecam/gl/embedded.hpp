#pragma once

#include <span>
#include <string_view>

namespace cubecam::gl {

/// One GLSL file: its name relative to shaders/ ("passes/surface.vert") and its text.
struct ShaderSource {
    std::string_view name;
    std::string_view text;
    std::string_view title = {};  ///< its name in messages; empty: `name`
    /// Whether a user wrote it. Then messages are about this text alone.
    bool user = false;
    /// The text as the user wrote it, with the same lines; empty: `text`. Messages show it.
    std::string_view written = {};
    /// Text that follows; messages count it to the last line of `text`.
    std::string_view after = {};

    std::string_view shown() const { return title.empty() ? name : title; }
    std::string_view shown_text() const { return written.empty() ? text : written; }
};

/// Every file of shaders/, sorted by name. cubecam_embed_shaders (cmake/embed_shaders.cmake)
/// generates the table at build.
std::span<const ShaderSource> embedded_shaders();

}  // namespace cubecam::gl
