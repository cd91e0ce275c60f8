#include "cubecam/cubemap/cubemap_nearest.hpp"

#include "cubecam/core/parallel.hpp"
#include "cubecam/math/cube_face.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace cubecam {

namespace {

/// Copies texels; the number of bytes is a constant for the compiler.
template <std::size_t bytes>
class TexelMover {
public:
    TexelMover(const TexelBytes& cube, std::byte* to)
        : from_(cube.texels), to_(to), size_(static_cast<std::size_t>(cube.size)) {}

    /// Copies the texel that a direction meets to place `index` of the result.
    void along(const glm::dvec3& direction, std::size_t index) const {
        const FaceUv<double> uv = direction_to_face_uv(direction);
        copy(face_index(uv.face), texel_at(uv.t), texel_at(uv.s), index);
    }

    void copy(std::size_t face, std::size_t row, std::size_t column, std::size_t index) const {
        std::memcpy(to_ + index * bytes, from_ + ((face * size_ + row) * size_ + column) * bytes,
                    bytes);
    }

private:
    std::size_t texel_at(double coordinate) const {
        const double place = coordinate * static_cast<double>(size_);
        return std::min(static_cast<std::size_t>(std::max(place, 0.0)), size_ - 1);
    }

    const std::byte* from_;
    std::byte* to_;
    std::size_t size_;
};

/// Returns the result of `count` texels that body(mover) fills.
template <typename Body>
PixelBuffer move_texels(const TexelBytes& cube, std::size_t count, const Body& body) {
    PixelBuffer result(count * cube.bytes);
    switch (cube.bytes) {
        case 1: body(TexelMover<1>(cube, result.data())); break;
        case 4: body(TexelMover<4>(cube, result.data())); break;
        case 8: body(TexelMover<8>(cube, result.data())); break;
        case 12: body(TexelMover<12>(cube, result.data())); break;
        case 16: body(TexelMover<16>(cube, result.data())); break;
        default:
            throw std::invalid_argument("texels: expected 1, 4, 8, 12 or 16 bytes, got " +
                                        std::to_string(cube.bytes));
    }
    return result;
}

}  // namespace

PixelBuffer nearest_equirect(const TexelBytes& cube, int width, Center center, Sampling sampling) {
    check_equirect_width(width);
    const EquirectAngles angles(width, center, sampling);
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t rows = columns / 2;
    return move_texels(cube, rows * columns, [&](const auto& mover) {
        parallel_for(0, rows, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t row = begin; row < end; ++row) {
                const double latitude = angles.latitudes[row];
                const double level = std::cos(latitude);
                const double up = std::sin(latitude);
                for (std::size_t column = 0; column < columns; ++column) {
                    const glm::dvec3& d = angles.directions[column];
                    mover.along({level * d.x, up, level * d.z}, row * columns + column);
                }
            }
        });
    });
}

PixelBuffer nearest_faces(const TexelBytes& cube, int size) {
    if (size < 1) {
        throw std::invalid_argument("size: expected at least 1, got " + std::to_string(size));
    }
    const auto n = static_cast<std::size_t>(size);
    // The center of texel i is at (i + 1/2) / n of the edge.
    std::vector<std::size_t> places(n);
    for (std::size_t i = 0; i < n; ++i) {
        places[i] = (2 * i + 1) * static_cast<std::size_t>(cube.size) / (2 * n);
    }
    return move_texels(cube, face_count * n * n, [&](const auto& mover) {
        parallel_for(0, face_count * n, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t line = begin; line < end; ++line) {
                for (std::size_t column = 0; column < n; ++column) {
                    mover.copy(line / n, places[line % n], places[column], line * n + column);
                }
            }
        });
    });
}

PixelBuffer nearest_lookup(const TexelBytes& cube, const float* directions, std::size_t count) {
    return move_texels(cube, count, [&](const auto& mover) {
        parallel_for(0, count, std::size_t{1} << 14, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const float* d = directions + 3 * i;
                mover.along({d[0], d[1], d[2]}, i);
            }
        });
    });
}

}  // namespace cubecam
