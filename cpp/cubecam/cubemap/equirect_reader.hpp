/// Rows of a panorama as floats. Only the .cpp files of cubemap/ include this header.
#pragma once

#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/resample_tile.hpp"

#include <numbers>

namespace cubecam {

/// The columns and rows of a panorama: the columns form a ring, and the rows continue beyond the
/// poles.
struct EquirectGrid {
    int width;
    int height;
    int period;     ///< columns in a full turn; a border-sampled picture repeats its first column
    double offset;  ///< column and row of an edge of the picture: -1/2; 0 with borders
    double rows;    ///< rows in half a turn

    EquirectGrid(int columns, int row_count, Sampling sampling)
        : width(columns), height(row_count),
          period(sampling == Sampling::borders ? columns - 1 : columns),
          offset(sampling == Sampling::borders ? 0.0 : -0.5),
          rows(sampling == Sampling::borders ? row_count - 1.0 : row_count) {}

    double column_of(double longitude) const {
        return period * (0.5 + longitude / (2 * std::numbers::pi)) + offset;
    }
    double row_of(double latitude) const {
        return rows * (0.5 - latitude / std::numbers::pi) + offset;
    }

    int wrap(int column) const {
        if (column >= 0 && column < period) return column;  // the usual case, without a division
        const int rest = column % period;
        return rest < 0 ? rest + period : rest;
    }

    /// Beyond a pole the rows continue on the other side, half a turn away.
    void turn_over(int& row, int& column) const {
        const int last = height - 1;
        const int mirror = offset < 0 ? 1 : 0;  // centres: row -1 is row 0 there; borders: row 1
        if (row < 0 || row > last) {
            row = row < 0 ? -mirror - row : 2 * last + mirror - row;
            row = std::clamp(row, 0, last);
            column += period / 2;
        }
    }
};

/// Reads rows of one panorama, and notes whether all numbers that it has read are finite.
class EquirectReader {
public:
    EquirectReader(const EquirectGrid& grid, const std::byte* pixels, int channels, DType dtype,
                   Buffer<float>& line)
        : grid_(grid), pixels_(pixels), channels_(static_cast<std::size_t>(channels)),
          dtype_(dtype), line_(line) {
        texel_ = channels_ * dtype_size(dtype);
        end_ = pixels + static_cast<std::size_t>(grid.width) *
                            static_cast<std::size_t>(grid.height) * texel_;
    }

    bool finite() const { return finite_; }

    const float* read(int row, int begin, int end) {
        if (const float* there = in_place(row, begin, end)) {
            finite_ &= all_finite_row(there, static_cast<std::size_t>(end - begin) * channels_);
            return there;
        }
        line_.resize(static_cast<std::size_t>(end - begin) * channels_ + spare_floats);
        int column = begin;
        grid_.turn_over(row, column);
        float* to = line_.data();
        for (int left = end - begin; left > 0;) {
            const int start = grid_.wrap(column);
            const int run = std::min(left, grid_.period - start);
            const std::size_t count = static_cast<std::size_t>(run) * channels_;
            const std::byte* from = at(row, start);
            if (row + 2 < grid_.height) prefetch(at(row + 2, start), count * dtype_size(dtype_));
            finite_ &= row_to_floats(dtype_, from, count, to);
            to += count;
            column += run;
            left -= run;
        }
        return line_.data();
    }

    /// Returns where a rectangle of the panorama lies if it lies there as floats, otherwise null.
    const float* in_place(const TapRange& rows, const TapRange& columns) {
        if (dtype_ != DType::float32 || rows.begin < 0 || rows.end > grid_.height) return nullptr;
        const float* first = in_place(rows.begin, columns.begin, columns.end);
        if (first == nullptr || !in_place(rows.end - 1, columns.begin, columns.end)) return nullptr;
        const float* line = first;
        for (int row = rows.begin; row < rows.end; ++row, line += row_floats()) {
            finite_ &= all_finite_row(line, columns.size() * channels_);
        }
        return first;
    }

    /// Floats from one row to the next, of a panorama of floats.
    std::size_t row_floats() const { return static_cast<std::size_t>(grid_.width) * channels_; }

    /// The average over a box of any size, without copying texels.
    Float4 box(const BoxTap& down, const BoxTap& across) {
        return apply_tap<Reach::far>(down, [&](int i) {
            int row = down.first + i;
            int column = across.first;
            grid_.turn_over(row, column);
            return apply_tap<Reach::far>(across, [&](int j) {
                float lanes[4] = {0, 0, 0, 0};
                finite_ &= row_to_floats(dtype_, at(row, grid_.wrap(column + j)), channels_, lanes);
                return Float4{lanes[0], lanes[1], lanes[2], lanes[3]};
            });
        });
    }

private:
    const std::byte* at(int row, int column) const {
        return pixels_ + (static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.width) +
                          static_cast<std::size_t>(column)) *
                             texel_;
    }

    const float* in_place(int row, int begin, int end) const {
        if (dtype_ != DType::float32) return nullptr;
        int column = begin;
        grid_.turn_over(row, column);
        column = grid_.wrap(column);
        const int length = end - begin;
        if (length > grid_.period - column) return nullptr;
        const std::byte* from = at(row, column);
        const std::size_t bytes = static_cast<std::size_t>(length) * texel_;
        if (static_cast<std::size_t>(end_ - from) < bytes + spare_floats * sizeof(float)) {
            return nullptr;
        }
        if (row + 2 < grid_.height) prefetch(at(row + 2, column), bytes);
        return reinterpret_cast<const float*>(from);
    }

    EquirectGrid grid_;
    const std::byte* pixels_;
    const std::byte* end_;
    std::size_t channels_;
    std::size_t texel_;
    DType dtype_;
    Buffer<float>& line_;
    bool finite_ = true;
};

}  // namespace cubecam
