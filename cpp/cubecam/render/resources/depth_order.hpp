#pragma once

#include "cubecam/core/parse_name.hpp"

#include <glad/gl.h>

#include <cstdint>
#include <string_view>

namespace cubecam {

/// Which of the surfaces along a ray a picture shows.
enum class DepthOrder : std::uint8_t { nearest, farthest };

inline constexpr NameTable<DepthOrder, 2> depth_order_names{
    {{"nearest", DepthOrder::nearest}, {"farthest", DepthOrder::farthest}}};

/// @throws std::invalid_argument for every name except "nearest" and "farthest".
DepthOrder parse_depth_order(std::string_view name);

/// An order as OpenGL state. The depth buffer is reversed (docs/adr/0001): it is 1 at the near
/// plane and 0 at the far plane.
struct DepthState {
    GLenum closer;     ///< the test for a surface that replaces the one before
    GLenum untouched;  ///< the test that a quad at depth `clear` passes where nothing was drawn
    GLfloat clear;     ///< behind every surface in this order
};

constexpr DepthState depth_state(DepthOrder order) {
    return order == DepthOrder::nearest ? DepthState{GL_GREATER, GL_GEQUAL, 0.0F}
                                        : DepthState{GL_LESS, GL_LEQUAL, 1.0F};
}

}  // namespace cubecam
