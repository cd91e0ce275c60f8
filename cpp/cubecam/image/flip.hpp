#pragma once

#include <cstddef>
#include <cstring>

namespace cubecam {

/// Copies a picture with its rows in reverse order: between GL's 2D pictures, bottom row first, and
/// ours, top row first. This is the only flip in the library; cube faces are never flipped.
inline void flip_rows(const std::byte* from, std::byte* to, std::size_t row_bytes,
                      std::size_t rows) {
    for (std::size_t row = 0; row < rows; ++row) {
        std::memcpy(to + (rows - 1 - row) * row_bytes, from + row * row_bytes, row_bytes);
    }
}

}  // namespace cubecam
