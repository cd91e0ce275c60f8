/// The shared half of resampling between cubes and panoramas: a tile whose columns depend on the
/// destination's column alone. For the .cpp files of cubemaps only.
#pragma once

#include "cubecam/scene/box_filter.hpp"
#include "cubecam/scene/cube_texels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace cubecam {

/// Floats of any pixels: the same memory where they are floats, else converted into `kept`.
const float* as_floats(DType dtype, const std::byte* pixels, std::size_t count,
                       Buffer<float>& kept);

/// Range of texels [begin, end) that taps read.
struct TapRange {
    std::int32_t begin = std::numeric_limits<std::int32_t>::max();
    std::int32_t end = std::numeric_limits<std::int32_t>::min();

    void include(const BoxTap& tap) {
        begin = std::min(begin, tap.first);
        end = std::max(end, tap.end());
    }
    bool empty() const { return begin >= end; }
    std::size_t size() const { return empty() ? 0 : static_cast<std::size_t>(end - begin); }
};

/// Taps of a tile, with what they have in common.
struct TapList {
    Buffer<BoxTap> taps;
    TapRange range;
    double widest = 0;

    void resize(std::size_t count) {
        taps.resize(count);
        range = {};
        widest = 0;
    }
    void set(std::size_t index, double center, const BoxWidth& width) {
        taps[index] = box_tap(center, width);
        range.include(taps[index]);
        widest = std::max(widest, width.texels);
    }
    const BoxTap& operator[](std::size_t index) const { return taps[index]; }
};

/// A tile of the source, filtered along rows, then along columns.
template <int Channels>
class FilteredRows {
public:
    using Texel = Lane<Channels>;

    /// Source rows `rows`, filtered by `across`. `read(row, begin, end, to)` gives texels
    /// begin..end of a source row, whatever lies there.
    template <typename Read>
    void filter(const TapRange& rows, const TapList& across, const Read& read) {
        rows_ = rows;
        columns_ = across.taps.size();
        line_.resize(across.range.size());
        texels_.resize(rows.size() * columns_);
        with_reach(reach_of(across.widest), [&](auto reach) {
            Texel* to = texels_.data();
            for (int row = rows.begin; row < rows.end; ++row) {
                read(row, across.range.begin, across.range.end, line_.data());
                const Texel* line = line_.data() - across.range.begin;
                for (const BoxTap& tap : across.taps) {
                    const Texel* at = line + tap.first;
                    *to++ = apply_tap<reach()>(tap, [at](int i) { return at[i]; });
                }
            }
        });
    }

    template <Reach reach>
    Texel at(const BoxTap& down, std::size_t column) const {
        const Texel* from =
            texels_.data() + static_cast<std::size_t>(down.first - rows_.begin) * columns_ + column;
        const std::size_t stride = columns_;
        return apply_tap<reach>(
            down, [from, stride](int i) { return from[static_cast<std::size_t>(i) * stride]; });
    }

private:
    Buffer<Texel> line_;
    Buffer<Texel> texels_;
    std::size_t columns_ = 0;
    TapRange rows_;
};

/// A rectangle of the source, copied together: read in order of memory, and looked up without a
/// thought for seams and edges.
template <int Channels>
class SourceBlock {
public:
    using Texel = Lane<Channels>;

    template <typename Read>
    void fill(const TapRange& rows, const TapRange& columns, const Read& read) {
        rows_ = rows;
        columns_ = columns;
        texels_.resize(rows.size() * columns.size());
        Texel* to = texels_.data();
        for (int row = rows.begin; row < rows.end; ++row, to += columns.size()) {
            read(row, columns.begin, columns.end, to);
        }
    }

    /// The average over a box.
    template <Reach reach>
    Texel at(const BoxTap& down, const BoxTap& across) const {
        const std::size_t stride = columns_.size();
        const Texel* corner = texels_.data() +
                              static_cast<std::size_t>(down.first - rows_.begin) * stride +
                              static_cast<std::size_t>(across.first - columns_.begin);
        return apply_tap<reach>(down, [&](int i) {
            const Texel* from = corner + static_cast<std::size_t>(i) * stride;
            return apply_tap<reach>(across, [from](int j) { return from[j]; });
        });
    }

private:
    Buffer<Texel> texels_;
    TapRange rows_;
    TapRange columns_;
};

/// Asks for `bytes` from an address that will be read soon. Rows of a picture lie on different
/// pages, where the processor does not look ahead by itself.
inline void prefetch(const void* address, std::size_t bytes) {
    const auto* from = static_cast<const char*>(address);
    for (std::size_t i = 0; i < bytes; i += 64) __builtin_prefetch(from + i);
}

/// Texels begin..end of one row of a face, neighbours beyond its edges.
template <int Channels>
void read_face_row(const CubeTexels<float, Channels>& cube, Face face, int row, int begin, int end,
                   Lane<Channels>* to) {
    if (!cube.contains(row)) {
        for (int column = begin; column < end; ++column) *to++ = cube.seamless(face, row, column);
        return;
    }
    int column = begin;
    for (; column < std::min(end, 0); ++column) *to++ = cube.seamless(face, row, column);
    if (column < cube.size) {
        const float* from = cube.at(face, row, column);
        if (row + 2 < cube.size) {
            prefetch(cube.at(face, row + 2, column),
                     static_cast<std::size_t>(std::max(end - column, 0)) * Channels *
                         sizeof(float));
        }
        for (; column < std::min(end, cube.size - 1); ++column, from += Channels) {
            *to++ = load_texel_before_another<Channels>(from);
        }
        if (column < std::min(end, cube.size)) {
            *to++ = load_texel<Channels>(from);
            ++column;
        }
    }
    for (; column < end; ++column) *to++ = cube.seamless(face, row, column);
}

}  // namespace cubecam
