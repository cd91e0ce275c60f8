#include "cubecam/lighting/radiance_faces.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/math/cube_edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace cubecam {

namespace {

std::vector<glm::vec4> to_radiance(const std::byte* pixels, std::size_t texels, int channels,
                                   DType dtype) {
    std::vector<glm::vec4> result(texels);
    const auto stride = static_cast<std::size_t>(channels);
    parallel_for(0, texels, std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t block = 256;
        std::array<float, block * 4> values;
        for (std::size_t at = begin; at < end; at += block) {
            const std::size_t count = std::min(block, end - at);
            pixels_to_floats(dtype, pixels + at * stride * dtype_size(dtype), count * stride,
                             values.data());
            for (std::size_t i = 0; i < count; ++i) {
                const float* v = values.data() + i * stride;
                result[at + i] = channels == 1   ? glm::vec4(v[0], v[0], v[0], 1.0F)
                                 : channels == 3 ? glm::vec4(v[0], v[1], v[2], 1.0F)
                                                 : glm::vec4(v[0], v[1], v[2], v[3]);
            }
        }
    });
    return result;
}

}  // namespace

std::vector<glm::vec4> radiance_face(const CubeMapData& cube, Face face) {
    return to_radiance(cube.face_pixels(face).data(),
                       static_cast<std::size_t>(cube.size) * static_cast<std::size_t>(cube.size),
                       cube.channels, cube.dtype);
}

std::vector<FilteredLevel> own_levels(const CubeMapData& cube) {
    std::vector<FilteredLevel> levels;
    if (!cube.levels) return levels;
    for (const CubeLevel& level : *cube.levels) {
        const auto size = static_cast<std::size_t>(level.size);
        levels.push_back({level.size, level.roughness,
                          to_radiance(level.pixels->data(), face_count * size * size, cube.channels,
                                      cube.dtype)});
    }
    return levels;
}

std::vector<glm::vec4> bordered_faces(const FilteredLevel& level) {
    const int n = level.size;
    const auto side = static_cast<std::size_t>(n) + 2;
    std::vector<glm::vec4> result(face_count * side * side);
    for (const Face face : all_faces) {
        const auto texel = [&](int row, int column) {
            const bool inside = row >= 0 && row < n && column >= 0 && column < n;
            const TexelPlace place =
                inside ? TexelPlace{face, row, column} : texel_beyond_edge(face, row, column, n);
            return level.face(
                face_index(place.face))[static_cast<std::size_t>(place.row * n + place.column)];
        };
        glm::vec4* to = result.data() + face_index(face) * side * side;
        for (int row = -1; row <= n; ++row) {
            poll_interrupts();
            for (int column = -1; column <= n; ++column, ++to) {
                const bool corner = (row < 0 || row == n) && (column < 0 || column == n);
                if (!corner) {
                    *to = texel(row, column);
                    continue;
                }
                const int near_row = row < 0 ? 0 : n - 1;
                const int near_column = column < 0 ? 0 : n - 1;
                *to = (texel(near_row, near_column) + texel(near_row, column) +
                       texel(row, near_column)) /
                      3.0F;
            }
        }
    }
    return result;
}

}  // namespace cubecam
