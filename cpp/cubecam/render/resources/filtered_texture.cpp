#include "cubecam/render/resources/filtered_texture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/lighting/radiance_faces.hpp"
#include "cubecam/render/resources/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace cubecam {
namespace {

constexpr int face_columns = 3;
constexpr int face_rows = 2;

/// Where the levels lie: one after the other in rows, each row as high as its first level.
struct Shelves {
    glm::ivec2 add(const glm::ivec2& block) {
        if (at.x > 0 && (at.x + block.x > size.x || block.y > height)) {
            at = {0, at.y + height};
            height = 0;
        }
        const glm::ivec2 place = at;
        height = std::max(height, block.y);
        at.x += block.x;
        size = glm::max(size, glm::ivec2(at.x, at.y + height));
        return place;
    }

    glm::ivec2 size{0};
    glm::ivec2 at{0};
    int height = 0;
};

glm::ivec2 block_of(const FilteredLevel& level) {
    return glm::ivec2(face_columns, face_rows) * (level.size + 2);
}

void write_block(const FilteredLevel& level, const glm::ivec2& place, int width,
                 std::vector<glm::vec4>& to) {
    const int side = level.size + 2;
    const std::vector<glm::vec4> texels = bordered_faces(level);
    auto from = texels.begin();
    for (const Face face : all_faces) {
        const int index = static_cast<int>(face);
        const glm::ivec2 corner = place + side * glm::ivec2(index / 2, index % 2);
        for (int row = 0; row < side; ++row, from += side) {
            std::copy_n(from, side, to.begin() + (corner.y + row) * width + corner.x);
        }
    }
}

}  // namespace

void FilteredTexture::upload(const gl::Context& context, std::span<const FilteredLevel> levels,
                             const FilteredLevel& irradiance) {
    const GladGLContext& gl = context.gl();
    if (levels.size() >= most_filtered_levels) {
        throw std::invalid_argument("environment: expected at most " +
                                    std::to_string(most_filtered_levels) + " levels, got " +
                                    std::to_string(levels.size() + 1));
    }
    Shelves shelves;
    std::vector<glm::ivec2> corners;
    for (const FilteredLevel& level : levels) corners.push_back(shelves.add(block_of(level)));
    corners.push_back(shelves.add(block_of(irradiance)));
    const int largest = std::max(shelves.size.x, shelves.size.y);
    if (largest > context.limits().max_texture_size) {
        throw std::invalid_argument(
            "environment: expected filtered levels that fit into a texture of " +
            std::to_string(context.limits().max_texture_size) +
            " pixels a side (GL_MAX_TEXTURE_SIZE of " + context.renderer() + "), got " +
            std::to_string(largest));
    }

    std::vector<glm::vec4> texels(static_cast<std::size_t>(shelves.size.x) *
                                  static_cast<std::size_t>(shelves.size.y));
    places_ = {};
    const auto write = [&](const FilteredLevel& level, const glm::ivec2& corner) {
        write_block(level, corner, shelves.size.x, texels);
        return glm::vec4(glm::vec2(corner + 1), static_cast<float>(level.size), level.roughness);
    };
    level_count_ = static_cast<int>(levels.size()) + 1;
    even_ = true;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        places_[i + 1] = write(levels[i], corners[i]);
        const float even = level_roughness(static_cast<int>(i) + 1, level_count_);
        even_ = even_ && std::abs(levels[i].roughness - even) < 1e-6F;
    }
    places_[0] = write(irradiance, corners.back());
    places_[0].w = 0.0F;
    if (levels.empty()) places_[1] = places_[0];  // its weight is 0
    texel_ = 1.0F / glm::vec2(shelves.size);

    if (size_ != shelves.size) {
        size_ = shelves.size;
        texture_ = gl::create_texture_2d(gl, GL_RGBA32F, size_.x, size_.y);
        set_sampler(gl, texture_.id(), clamped_linear);
    }
    gl.TextureSubImage2D(texture_.id(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT,
                         texels.data());
    gl::check_gl(gl, "uploading a filtered environment");
    revision_ = next_revision();
}

}  // namespace cubecam
