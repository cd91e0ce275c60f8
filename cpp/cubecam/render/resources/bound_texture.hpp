#pragma once

#include <glad/gl.h>

#include <cstdint>

namespace cubecam {

/// A texture that a node looks up in one picture.
struct BoundTexture {
    GLuint texture = 0;          ///< 0: none
    std::uint64_t revision = 0;  ///< of its contents; 0: none
};

}  // namespace cubecam
