/// Checks of the arrays of a mesh's vertices.
#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/core/interrupts.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace cubecam {

/// Blocks of this size have no branch, so that compilers use SIMD.
inline constexpr std::size_t vertex_block = 1024;

/// @throws std::invalid_argument that names the first vertex with NaN or an infinity.
template <class Vector>
void check_finite(const std::vector<Vector>& values, const char* name) {
    const float* floats = values.empty() ? nullptr : &values.front()[0];
    const std::size_t count = values.size() * Vector::length();
    for (std::size_t begin = 0; begin < count; begin += vertex_block) {
        poll_interrupts();
        const std::size_t end = std::min(count, begin + vertex_block);
        bool finite = true;
        for (std::size_t i = begin; i < end; ++i) {
            finite &= std::abs(floats[i]) <= std::numeric_limits<float>::max();
        }
        for (std::size_t i = begin; i < end && !finite; ++i) {
            if (std::isfinite(floats[i])) continue;
            throw std::invalid_argument(std::string("expected finite ") + name + ", got " +
                                        describe(floats[i]) + " at vertex " +
                                        std::to_string(i / Vector::length()));
        }
    }
}

/// @throws std::invalid_argument unless there are no values or as many as vertices.
inline void check_length(std::size_t values, std::size_t vertices, const char* name) {
    if (values == 0 || values == vertices) return;
    throw std::invalid_argument("expected as many " + std::string(name) + " as positions, " +
                                std::to_string(vertices) + ", got " + std::to_string(values));
}

template <class Vector>
void check_length(const std::vector<Vector>& values, std::size_t vertices, const char* name) {
    check_length(values.size(), vertices, name);
}

}  // namespace cubecam
