#include "cubecam/lighting/spherical_harmonics.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/lighting/radiance_faces.hpp"
#include "cubecam/lighting/radiance_tree.hpp"
#include "cubecam/math/cube_face.hpp"

#include <cmath>
#include <numbers>

// The basis (P.-P. Sloan, "Stupid Spherical Harmonics (SH) Tricks", 2008, with the signs that make
// the functions of order 1 positive multiples of y, z and x):
//
//   Y(l, m) = sqrt(2) N(l, m)(z) Re (x + i y)^m  for m > 0,  Im (x + i y)^|m|  for m < 0,
//   Y(l, 0) = N(l, 0)(z)
//
// where N are Legendre's associated functions without the factor sin(theta)^m, normalised:
//
//   N(0, 0) = 1 / sqrt(4 pi),   N(m, m) = N(m - 1, m - 1) sqrt((2 m + 1) / (2 m)),
//   N(l, m) = sqrt((4 l^2 - 1) / (l^2 - m^2))
//             (z N(l - 1, m) - sqrt(((l - 1)^2 - m^2) / (4 (l - 1)^2 - 1)) N(l - 2, m))

namespace cubecam {

namespace {

glm::dvec3 texel_direction(Face face, int column, int row, int size) {
    return glm::normalize(
        face_uv_to_direction<double>(face, (column + 0.5) / size, (row + 0.5) / size));
}

}  // namespace

void sh_basis(const glm::dvec3& direction, int order, std::span<double> values) {
    const double z = direction.z;
    double cosine = 1;  // Re (x + i y)^m
    double sine = 0;
    double diagonal = 1 / std::sqrt(4 * std::numbers::pi);  // N(m, m)
    for (int m = 0; m <= order; ++m) {
        if (m > 0) {
            diagonal *= std::sqrt((2.0 * m + 1) / (2.0 * m));
            const double next = cosine * direction.x - sine * direction.y;
            sine = cosine * direction.y + sine * direction.x;
            cosine = next;
        }
        double before = 0;
        double current = diagonal;
        for (int l = m; l <= order; ++l) {
            if (l > m) {
                const double ll = static_cast<double>(l) * l;
                const double mm = static_cast<double>(m) * m;
                const double previous = static_cast<double>(l - 1) * (l - 1);
                const double next =
                    std::sqrt((4 * ll - 1) / (ll - mm)) *
                    (z * current - std::sqrt((previous - mm) / (4 * previous - 1)) * before);
                before = current;
                current = next;
            }
            const auto middle = static_cast<std::size_t>(l * (l + 1));
            const auto away = static_cast<std::size_t>(m);
            if (m == 0) {
                values[middle] = current;
            } else {
                values[middle + away] = std::numbers::sqrt2 * current * cosine;
                values[middle - away] = std::numbers::sqrt2 * current * sine;
            }
        }
    }
}

std::vector<double> cube_to_sh(const CubeMapData& cube, int order) {
    const auto channels = static_cast<std::size_t>(cube.channels);
    const std::size_t count = sh_count(order);
    const int n = cube.size;
    const std::vector<double> angles = texel_solid_angles(n);
    // One sum for each face, so that the result does not depend on the number of threads.
    std::vector<std::vector<double>> sums(face_count);
    parallel_for(0, face_count, 1, [&](std::size_t begin, std::size_t end) {
        std::vector<double> basis(count);
        for (std::size_t index = begin; index < end; ++index) {
            const Face face = all_faces[index];
            const std::vector<glm::vec4> texels = radiance_face(cube, face);
            std::vector<double> sum(count * channels);
            std::size_t texel = 0;
            for (int row = 0; row < n; ++row) {
                poll_interrupts();
                for (int column = 0; column < n; ++column, ++texel) {
                    const glm::dvec4 light =
                        angles[texel] * glm::dvec4(countable_radiance(texels[texel]));
                    sh_basis(texel_direction(face, column, row, n), order, basis);
                    for (std::size_t i = 0; i < count; ++i) {
                        for (std::size_t c = 0; c < channels; ++c) {
                            sum[i * channels + c] += basis[i] * light[static_cast<int>(c)];
                        }
                    }
                }
            }
            sums[index] = std::move(sum);
        }
    });
    std::vector<double> result(count * channels);
    for (const std::vector<double>& sum : sums) {
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += sum[i];
    }
    return result;
}

Buffer<float> sh_to_faces(std::span<const double> coefficients, int order, int channels, int size) {
    const auto width = static_cast<std::size_t>(channels);
    const auto n = static_cast<std::size_t>(size);
    const std::size_t count = sh_count(order);
    Buffer<float> faces(face_count * n * n * width);
    parallel_for(0, face_count * n, 4, [&](std::size_t begin, std::size_t end) {
        std::vector<double> basis(count);
        for (std::size_t row = begin; row < end; ++row) {
            const Face face = all_faces[row / n];
            float* to = faces.data() + row * n * width;
            for (int column = 0; column < size; ++column) {
                sh_basis(texel_direction(face, column, static_cast<int>(row % n), size), order,
                         basis);
                for (std::size_t c = 0; c < width; ++c) {
                    double sum = 0;
                    for (std::size_t i = 0; i < count; ++i) {
                        sum += basis[i] * coefficients[i * width + c];
                    }
                    *to++ = static_cast<float>(sum);
                }
            }
        }
    });
    return faces;
}

}  // namespace cubecam
