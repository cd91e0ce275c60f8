/// The parts of resampling, which works tile by tile: lists of taps, and copied or filtered pieces
/// of the source. Only the .cpp files of cubemap/ include this header.
#pragma once

#include "cubecam/cubemap/box_filter.hpp"
#include "cubecam/cubemap/box_kernels.hpp"
#include "cubecam/cubemap/cube_texels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace cubecam {

/// Range of texels [begin, end) that taps read.
struct TapRange {
    std::int32_t begin = std::numeric_limits<std::int32_t>::max();
    std::int32_t end = std::numeric_limits<std::int32_t>::min();

    void include(const BoxTap& tap) {
        begin = std::min(begin, tap.first);
        end = std::max(end, tap.end());
    }
    std::size_t size() const { return begin < end ? static_cast<std::size_t>(end - begin) : 0; }
};

/// The taps of a tile, with their common range and their largest width.
class TapList {
public:
    void resize(std::size_t count) {
        taps_.resize(count);
        range_ = {};
        widest_ = 0;
        bound_stride_ = 0;
    }

    void set(std::size_t index, double center, const BoxWidth& width) {
        taps_[index] = box_tap(center, width);
        range_.include(taps_[index]);
        widest_ = std::max(widest_, width.texels);
    }

    /// Marks a texel that this list does not filter.
    void set_absent(std::size_t index) { taps_[index] = {0, -1, 0, 0}; }
    bool absent(std::size_t index) const { return taps_[index].inner < 0; }

    const BoxTap& operator[](std::size_t index) const { return taps_[index]; }
    std::size_t size() const { return taps_.size(); }
    const TapRange& range() const { return range_; }
    double widest() const { return widest_; }

    /// Binds the taps to texels that lie `stride` texels apart; the list's range begins at address
    /// 0. Tap i belongs to column i % columns, and neighbour columns are one texel apart. A second
    /// call with the same stride does nothing.
    void bind(std::size_t stride, std::size_t columns = 1) {
        bind_bytes(stride * sizeof(Float4), columns);
    }

    /// Like bind, with a stride in bytes.
    void bind_bytes(std::size_t stride, std::size_t columns = 1) {
        if (stride == bound_stride_) return;
        bound_stride_ = stride;
        constexpr auto bytes = static_cast<std::int64_t>(sizeof(Float4));
        const auto step = static_cast<std::int64_t>(stride);
        bound_.resize(taps_.size());
        std::size_t column = 0;
        for (std::size_t i = 0; i < taps_.size(); ++i) {
            const BoxTap& tap = taps_[i];
            bound_[i] = {static_cast<std::int32_t>((tap.first - range_.begin) * step +
                                                   static_cast<std::int64_t>(column) * bytes),
                         static_cast<std::int32_t>((tap.inner + 1) * step), tap.near, tap.last};
            if (++column == columns) column = 0;
        }
    }
    const BoundTap* bound(std::size_t index) const { return bound_.data() + index; }

private:
    Buffer<BoxTap> taps_;
    Buffer<BoundTap> bound_;
    TapRange range_;
    double widest_ = 0;
    std::size_t bound_stride_ = 0;  ///< in bytes; 0 before the first call of bind
};

/// A copy of a rectangle of the source. The copy is made in order of memory, and lookups in it need
/// no care for seams and edges.
template <int Channels>
class SourceBlock {
public:
    using Texel = Lane<Channels>;

    /// Copies the rectangle and binds both lists to it. `read(row, begin, end, to)` writes texels
    /// begin..end of a source row, also those beyond the edges.
    template <typename Read>
    void fill(TapList& down, TapList& across, const Read& read) {
        rows_ = down.range();
        columns_ = across.range();
        stride_ = (columns_.size() + 15) / 16 * 16;  // often that of the next block, too
        down.bind(stride_);
        across.bind(1);
        texels_.resize(rows_.size() * stride_);
        Texel* to = texels_.data();
        for (int row = rows_.begin; row < rows_.end; ++row, to += stride_) {
            read(row, columns_.begin, columns_.end, to);
        }
    }

    /// Computes the averages over `count` boxes, from down[index] by across[index] on.
    void filter(Reach reach, const TapList& down, const TapList& across, std::size_t index,
                std::size_t count, Texel* to) const {
        if constexpr (Channels > 1) {
            const auto stride = static_cast<std::ptrdiff_t>(stride_ * sizeof(Float4));
            const auto kernel = reach == Reach::linear ? filter_boxes_linear
                                : reach == Reach::near ? filter_boxes_near
                                                       : nullptr;
            if (kernel) {
                return kernel(texels_.data(), stride, down.bound(index), across.bound(index), count,
                              to);
            }
        }
        with_reach(reach, [&](auto constant) {
            for (std::size_t i = index; i < index + count; ++i) {
                *to++ = at<constant()>(down[i], across[i]);
            }
        });
    }

private:
    template <Reach reach>
    Texel at(const BoxTap& down, const BoxTap& across) const {
        const std::size_t stride = stride_;
        const Texel* corner = texels_.data() +
                              static_cast<std::size_t>(down.first - rows_.begin) * stride +
                              static_cast<std::size_t>(across.first - columns_.begin);
        return apply_tap<reach>(down, [&](int i) {
            const Texel* from = corner + static_cast<std::size_t>(i) * stride;
            return apply_tap<reach>(across, [from](int j) { return from[j]; });
        });
    }

    Buffer<Texel> texels_;
    std::size_t stride_ = 0;
    TapRange rows_;
    TapRange columns_;
};

/// A tile whose source columns depend on the destination's column alone: it is filtered along rows
/// once, then along columns.
template <int Channels>
class FilteredRows {
public:
    using Texel = Lane<Channels>;

    /// Filters the source rows that `down` needs by `across`, which has one tap for each column.
    /// `down` has a tap for each texel of the destination, [row][column], and is bound to the
    /// result. `in_place(row, begin, end)` may return a pointer to the texels as floats with
    /// another texel behind them; then `read` is not called.
    template <typename Read, typename InPlace>
    void fill(TapList& down, TapList& across, const Read& read, const InPlace& in_place) {
        rows_ = down.range();
        columns_ = across.size();
        down.bind(columns_, columns_);
        refill(across, read, in_place);
    }

    /// Repeats fill for the same rows and the same `down`, with other columns.
    template <typename Read, typename InPlace>
    void refill(TapList& across, const Read& read, const InPlace& in_place) {
        const TapRange range = across.range();
        line_.resize(range.size());
        texels_.resize(rows_.size() * columns_);
        const Reach reach = reach_of(across.widest());
        const bool direct = Channels > 1 && reach != Reach::far;
        Texel* to = texels_.data();
        for (int row = rows_.begin; row < rows_.end; ++row, to += columns_) {
            if (const float* from = direct ? in_place(row, range.begin, range.end) : nullptr) {
                filter_near_line(reach, from, Channels * sizeof(float), across, to);
            } else {
                read(row, range.begin, range.end, line_.data());
                filter_line(reach, across, to);
            }
        }
    }

    /// Filters along columns, by taps from down[index] on, for columns from `column` on.
    void filter(Reach reach, const TapList& down, std::size_t index, std::size_t column,
                std::size_t count, Texel* to) const {
        if constexpr (Channels > 1) {
            const auto step = static_cast<std::ptrdiff_t>(columns_ * sizeof(Float4));
            if (reach == Reach::linear) {
                return filter_linear(texels_.data(), step, down.bound(index), count, to);
            }
            if (reach == Reach::near) {
                return filter_near(texels_.data(), step, down.bound(index), count, to);
            }
        }
        with_reach(reach, [&](auto constant) {
            const std::size_t stride = columns_;
            for (std::size_t i = 0; i < count; ++i) {
                const BoxTap& tap = down[index + i];
                const Texel* from = texels_.data() +
                                    static_cast<std::size_t>(tap.first - rows_.begin) * stride +
                                    column + i;
                *to++ = apply_tap<constant()>(tap, [from, stride](int j) {
                    return from[static_cast<std::size_t>(j) * stride];
                });
            }
        });
    }

private:
    /// Filters texels that lie `step` bytes apart, for every reach except far.
    void filter_near_line([[maybe_unused]] Reach reach, [[maybe_unused]] const void* from,
                          [[maybe_unused]] std::size_t step, [[maybe_unused]] TapList& across,
                          [[maybe_unused]] Texel* to) const {
        if constexpr (Channels > 1) {
            across.bind_bytes(step);
            const auto kernel = reach == Reach::linear ? filter_linear : filter_near;
            kernel(from, static_cast<std::ptrdiff_t>(step), across.bound(0), columns_, to);
        }
    }

    void filter_line(Reach reach, TapList& across, Texel* to) const {
        if (Channels > 1 && reach != Reach::far) {
            return filter_near_line(reach, line_.data(), sizeof(Texel), across, to);
        }
        with_reach(reach, [&](auto constant) {
            const Texel* line = line_.data();
            for (std::size_t i = 0; i < columns_; ++i) {
                const Texel* from = line + (across[i].first - across.range().begin);
                to[i] = apply_tap<constant()>(across[i], [from](int j) { return from[j]; });
            }
        });
    }

    Buffer<Texel> line_;
    Buffer<Texel> texels_;
    std::size_t columns_ = 0;
    TapRange rows_;
};

/// Writes texels one after another, or in the opposite order: step 1 or -1. The first of them goes
/// to `to`. Returns whether all are finite.
template <int Channels>
bool store_texels(const Lane<Channels>* from, std::size_t count, int step, float* to) {
    if (Channels == 1 && step > 0) {
        std::memcpy(to, from, count * sizeof(float));
        return all_finite(to, count);
    }
    auto bad = from[0] - from[0] != 0.0f;
    // The loop runs in order of memory: each store may also write over the beginning of the next
    // texel.
    const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(count) - 1;
    if (step < 0) {
        from += last;
        to -= last * Channels;
    }
    for (std::ptrdiff_t i = 0; i < last; ++i, from += step, to += Channels) {
        bad |= *from - *from != 0.0f;
        std::memcpy(to, from, sizeof *from);
    }
    bad |= *from - *from != 0.0f;
    store_texel<Channels>(*from, to);
    if constexpr (Channels == 1) {
        return !bad;
    } else {
        return !(bad[0] || bad[1] || bad[2] || (Channels == 4 && bad[3]));
    }
}

/// A picture that is being written, of any type.
template <int Channels>
struct TexelTarget {
    std::byte* pixels;
    DType dtype;

    /// Writes texels one after another, or in the opposite order: step 1 or -1. The first of them
    /// is texel `index` of the picture. Returns whether all are finite.
    bool store(const Lane<Channels>* from, std::size_t count, int step, std::size_t index) const {
        if (dtype == DType::float32) {
            return store_texels<Channels>(from, count, step,
                                          reinterpret_cast<float*>(pixels) + index * Channels);
        }
        constexpr std::size_t piece = 64;
        float line[piece * Channels];
        bool numbers = true;
        for (std::size_t begin = 0; begin < count; begin += piece) {
            const std::size_t length = std::min(piece, count - begin);
            float* const start = step > 0 ? line : line + (length - 1) * Channels;
            numbers &= store_texels<Channels>(from + begin, length, step, start);
            const std::size_t first = step > 0 ? index + begin : index - begin - (length - 1);
            floats_to_pixels(dtype, line, length * Channels,
                             pixels + first * Channels * dtype_size(dtype));
        }
        return numbers;
    }
};

/// Computes again, by exact(i), the channels of texels that are not finite.
template <int Channels, typename Exact>
void mend_texels(Lane<Channels>* texels, std::size_t count, const Exact& exact) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!is_finite<Channels>(texels[i])) {
            texels[i] = finite_or<Channels>(texels[i], exact(i));
        }
    }
}

/// Prefetches `bytes` from an address that will be read soon. Rows of a picture lie on different
/// pages, and the processor does not prefetch from another page by itself.
inline void prefetch(const void* address, std::size_t bytes) {
    const auto* from = static_cast<const char*>(address);
    for (std::size_t i = 0; i < bytes; i += 64) __builtin_prefetch(from + i);
}

/// Returns where texels begin..end of one row of a face lie if the face holds them with another
/// texel behind them, otherwise null.
template <typename Pixel, int Channels>
const float* face_row_in_place([[maybe_unused]] const CubeTexels<Pixel, Channels>& cube,
                               [[maybe_unused]] Face face, [[maybe_unused]] int row,
                               [[maybe_unused]] int begin, [[maybe_unused]] int end) {
    if constexpr (std::is_same_v<Pixel, float>) {
        if (!cube.contains(row) || begin < 0 || end >= cube.size) return nullptr;
        if (row + 2 < cube.size) {
            prefetch(cube.at(face, row + 2, begin),
                     static_cast<std::size_t>(end - begin) * Channels * sizeof(float));
        }
        return cube.at(face, row, begin);
    } else {
        return nullptr;
    }
}

/// Reads texels begin..end of one row of a face; beyond its edges those of the neighbour faces.
template <typename Pixel, int Channels>
void read_face_row(const CubeTexels<Pixel, Channels>& cube, Face face, int row, int begin, int end,
                   Lane<Channels>* to) {
    if (!cube.contains(row)) {
        for (int column = begin; column < end; ++column) *to++ = cube.seamless(face, row, column);
        return;
    }
    int column = begin;
    for (; column < std::min(end, 0); ++column) *to++ = cube.seamless(face, row, column);
    if (column < cube.size) {
        const Pixel* from = cube.at(face, row, column);
        if (row + 2 < cube.size) {
            prefetch(cube.at(face, row + 2, column),
                     static_cast<std::size_t>(std::max(end - column, 0)) * Channels *
                         sizeof(Pixel));
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

/// The average over a box on a face by sum_tap.
template <typename Pixel, int Channels>
Lane<Channels> sum_box(const CubeTexels<Pixel, Channels>& cube, Face face, const BoxTap& down,
                       const BoxTap& across) {
    return sum_tap(down, [&](int i) {
        return sum_tap(
            across, [&](int j) { return cube.seamless(face, down.first + i, across.first + j); });
    });
}

}  // namespace cubecam
