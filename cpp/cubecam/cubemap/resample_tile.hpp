/// The parts of resampling, which works tile by tile: copied or filtered pieces of the source. Only
/// the .cpp files of cubemap/ include this header.
///
/// The source is a `read(row, begin, end)`, which returns the numbers of texels begin..end of a
/// row, also of those beyond the edges, with three more floats behind them that may be read. They
/// stay until the next call.
#pragma once

#include "cubecam/cubemap/box_kernels.hpp"
#include "cubecam/cubemap/cube_texels.hpp"
#include "cubecam/cubemap/pixel_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cubecam {

/// Floats that a kernel may read behind the last number.
inline constexpr std::size_t spare_floats = 3;

/// Prefetches `bytes` from an address that will be read soon. Rows of a picture lie on different
/// pages, and the processor does not prefetch from another page by itself.
inline void prefetch(const std::byte* address, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; i += 64) __builtin_prefetch(address + i);
}

/// A tile whose source columns depend on the destination's column alone: it is filtered along rows
/// once, then along columns.
class FilteredRows {
public:
    /// Filters source rows by `across`, which has one tap for each column of the tile.
    template <typename Read>
    void fill(const TapRange& rows, const TapList& across, int channels, const Read& read) {
        across_.set(across, channels * static_cast<std::ptrdiff_t>(sizeof(float)));
        texels_.resize(rows.size() * tile_size);
        Float4* to = texels_.data();
        for (int row = rows.begin; row < rows.end; ++row, to += tile_size) {
            filter_row(read(row, across.range().begin, across.range().end), across_, to);
        }
    }

    /// Filters along columns, by `count` taps of a closed list, for columns from `column` on.
    void filter(const TapList& down, std::size_t tap, std::size_t column, std::size_t count,
                Float4* to) const {
        filter_columns(down.reach(), texels_.data() + column, down.data(tap), count, to);
    }

private:
    RowTaps across_;
    Buffer<Float4> texels_;
};

/// A copy of a rectangle of the source as floats. Lookups in it need no care for seams and edges.
class SourceBlock {
public:
    template <typename Read>
    TexelGrid fill(const TapRange& rows, const TapRange& columns, int channels, const Read& read) {
        const std::size_t length = columns.size() * static_cast<std::size_t>(channels);
        numbers_.resize(rows.size() * length + spare_floats);
        float* to = numbers_.data();
        for (int row = rows.begin; row < rows.end; ++row, to += length) {
            std::memcpy(to, read(row, columns.begin, columns.end), length * sizeof(float));
        }
        return {numbers_.data(), static_cast<std::ptrdiff_t>(length * sizeof(float)),
                channels * static_cast<std::ptrdiff_t>(sizeof(float))};
    }

private:
    Buffer<float> numbers_;
};

/// A picture that is being written, of any type.
struct TexelTarget {
    std::byte* pixels;
    DType dtype;
    int channels;

    /// Writes texels one after another, or in the opposite order: step 1 or -1. The first of them
    /// is texel `index` of the picture.
    void store(const Float4* from, std::size_t count, int step, std::size_t index) const {
        const std::size_t texel = static_cast<std::size_t>(channels) * dtype_size(dtype);
        store_texels(from, count, channels, step, dtype, pixels + index * texel);
    }
};

/// Computes again, by exact(i), the channels of texels that are not finite.
template <typename Exact>
void mend_texels(Float4* texels, std::size_t count, int channels, const Exact& exact) {
    if (all_finite_texels(texels, count, channels)) [[likely]]
        return;
    for (std::size_t i = 0; i < count; ++i) {
        bool good = true;
        for (int c = 0; c < channels; ++c) good &= is_finite<1>(texels[i][c]);
        if (good) continue;
        const Float4 again = exact(i);
        for (int c = 0; c < channels; ++c) {
            if (!is_finite<1>(texels[i][c])) texels[i][c] = again[c];
        }
    }
}

/// Reads rows of faces, and of the neighbour faces beyond their edges.
class FaceReader {
public:
    explicit FaceReader(const CubePixels& cube) : cube_(cube) {
        const auto n = static_cast<std::size_t>(cube.size);
        end_ = cube.pixels + face_count * n * n * cube.texel_bytes();
    }

    const float* read(Face face, int row, int begin, int end) {
        if (const float* there = in_place(face, row, begin, end)) return there;
        const auto channels = static_cast<std::size_t>(cube_.channels);
        line_.resize(static_cast<std::size_t>(end - begin) * channels + spare_floats);
        float* to = line_.data();
        const int inner_begin = cube_.contains(row) ? std::clamp(begin, 0, cube_.size) : end;
        const int inner_end = cube_.contains(row) ? std::clamp(end, inner_begin, cube_.size) : end;
        const auto beyond = [&](int from, int until) {
            for (int column = from; column < until; ++column, to += channels) {
                const Float4 texel = cube_.seamless(face, row, column);
                std::memcpy(to, &texel, channels * sizeof(float));
            }
        };
        beyond(begin, std::min(inner_begin, end));
        if (inner_begin < inner_end) {
            const std::size_t count = static_cast<std::size_t>(inner_end - inner_begin) * channels;
            const std::byte* from = cube_.at(face, row, inner_begin);
            if (row + 2 < cube_.size) {
                prefetch(cube_.at(face, row + 2, inner_begin), count * dtype_size(cube_.dtype));
            }
            row_to_floats(cube_.dtype, from, count, to);
            to += count;
        }
        beyond(std::max(inner_end, begin), end);
        return line_.data();
    }

    /// Returns where a rectangle of a face lies if it lies there as floats, otherwise null.
    const float* in_place(Face face, const TapRange& rows, const TapRange& columns) const {
        if (rows.begin < 0) return nullptr;
        const float* first = in_place(face, rows.begin, columns.begin, columns.end);
        return first && in_place(face, rows.end - 1, columns.begin, columns.end) ? first : nullptr;
    }

private:
    const float* in_place(Face face, int row, int begin, int end) const {
        if (cube_.dtype != DType::float32 || !cube_.contains(row)) return nullptr;
        if (begin < 0 || end > cube_.size) return nullptr;
        const std::byte* from = cube_.at(face, row, begin);
        const std::size_t bytes = static_cast<std::size_t>(end - begin) * cube_.texel_bytes();
        if (static_cast<std::size_t>(end_ - from) < bytes + spare_floats * sizeof(float)) {
            return nullptr;
        }
        if (row + 2 < cube_.size) prefetch(cube_.at(face, row + 2, begin), bytes);
        return reinterpret_cast<const float*>(from);
    }

    CubePixels cube_;
    const std::byte* end_;
    Buffer<float> line_;
};

/// The average over a box on a face by sum_tap.
inline Float4 sum_box(const CubePixels& cube, Face face, const BoxTap& down, const BoxTap& across) {
    return sum_tap(down, [&](int i) {
        return sum_tap(
            across, [&](int j) { return cube.seamless(face, down.first + i, across.first + j); });
    });
}

}  // namespace cubecam
