#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <vector>

namespace cubecam {

/// A texture that a node looks up in one picture.
struct BoundTexture {
    GLuint texture = 0;          ///< 0: none
    std::uint64_t revision = 0;  ///< of its contents; 0: none
};

/// All textures that a node looks up.
struct NodeTextures {
    BoundTexture environment;            ///< the cube that mirrors reflect
    std::vector<BoundTexture> textures;  ///< in the order of the material's textures
};

}  // namespace cubecam
