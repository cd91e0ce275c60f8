#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/lighting/filtered_cube.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cubecam {

/// The largest number of levels of a filtered environment, with level 0: the length of
/// `u_environment_places` in shaders/include/environment.glsl.
inline constexpr std::size_t most_filtered_levels = 16;

/// The filtered levels of an environment, except level 0, and its irradiance, all in one 2D
/// texture. A mip chain of a cube texture would fix the sizes of the levels.
///
/// The faces of a level lie in three columns (x, y, z) and two rows (positive, negative). Each face
/// has a border of one texel, which belongs to the neighbour faces, so that plain bilinear lookups
/// are seamless (GL 4.6 section 8.14.2).
class FilteredTexture {
public:
    /// @throws std::invalid_argument for more levels than shaders can read, or for a texture that
    /// is larger than the driver allows.
    void upload(const gl::Context& context, std::span<const FilteredLevel> levels,
                const FilteredLevel& irradiance);

    GLuint id() const { return texture_.id(); }
    std::uint64_t revision() const { return revision_; }  ///< new with each upload
    /// With level 0.
    int level_count() const { return level_count_; }
    /// Whether level k is that of roughness k / (level_count() - 1).
    bool is_even() const { return even_; }
    /// Element 0: the irradiance; element k: level k. x, y: the first texel of face +x without the
    /// border; z: texels along an edge; w: the level's roughness, 0 in element 0.
    const std::array<glm::vec4, most_filtered_levels>& places() const { return places_; }
    /// Width and height of one texel, as a part of the texture.
    const glm::vec2& texel() const { return texel_; }

private:
    gl::Texture texture_;
    glm::ivec2 size_{0};
    std::uint64_t revision_ = 0;
    int level_count_ = 0;
    bool even_ = true;
    std::array<glm::vec4, most_filtered_levels> places_{};
    glm::vec2 texel_{0.0F};
};

}  // namespace cubecam
