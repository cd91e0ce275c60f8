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

/// All of them.
struct NodeTextures {
    BoundTexture cube;                   ///< what a mirror reflects or a basic material shows
    BoundTexture map;                    ///< a picture placed by the uvs
    std::vector<BoundTexture> textures;  ///< of a ShaderMaterial, in the order of its inputs
};

}  // namespace cubecam
