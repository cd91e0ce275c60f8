/// Lists of taps, which the conversions make once for each tile of their result. Only the .cpp
/// files of cubemap/ include this header.
#pragma once

#include "cubecam/cubemap/box_filter.hpp"
#include "cubecam/image/pixels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cubecam {

/// Texels on an edge of a tile. The sources of such a tile fit into the cache of one core.
inline constexpr int tile_size = 64;

/// Range of texels [begin, end) that taps read.
struct TapRange {
    std::int32_t begin = std::numeric_limits<std::int32_t>::max();
    std::int32_t end = std::numeric_limits<std::int32_t>::min();

    void include(const BoxTap& tap) {
        begin = std::min(begin, tap.first);
        end = std::max(end, tap.end());
    }
    std::size_t size() const { return begin < end ? static_cast<std::size_t>(end - begin) : 0; }
    TapRange shifted(int by) const { return {begin + by, end + by}; }
};

/// The taps of a tile along one axis, with their common range and their largest width.
///
/// After `close`, a tap's `first` counts from the beginning of the range.
class TapList {
public:
    void resize(std::size_t count) {
        taps_.resize(count);
        range_ = {};
        widest_ = 0;
    }

    void set(std::size_t index, double center, const BoxWidth& width) {
        taps_[index] = box_tap(center, width);
        range_.include(taps_[index]);
        widest_ = std::max(widest_, width.texels);
    }

    /// Marks a texel that this list does not filter.
    void set_absent(std::size_t index) { taps_[index] = {0, -1, 0, 0}; }
    bool absent(std::size_t index) const { return taps_[index].inner < 0; }

    /// Takes the texel in which a place lies into the range, too.
    void cover(double center) { range_.include({floor_to_int(center + 0.5), -1, 0, 0}); }

    void close() {
        for (std::size_t i = 0; i < size(); ++i) {
            if (!absent(i)) taps_[i].first -= range_.begin;
        }
    }

    const BoxTap* data(std::size_t index = 0) const { return taps_.data() + index; }
    const BoxTap& operator[](std::size_t index) const { return taps_[index]; }
    /// The tap with its own first texel, also after `close`.
    BoxTap placed(std::size_t index) const {
        BoxTap tap = taps_[index];
        tap.first += range_.begin;
        return tap;
    }
    std::size_t size() const { return taps_.size(); }
    const TapRange& range() const { return range_; }
    double widest() const { return widest_; }
    Reach reach() const { return reach_of(widest_); }
    std::size_t bytes() const { return taps_.capacity() * sizeof(BoxTap); }

private:
    Buffer<BoxTap> taps_;
    TapRange range_;
    double widest_ = 0;
};

/// All taps of a tile. What each list means, the conversion knows.
struct TileTaps {
    std::vector<TapList> lists;
    Buffer<Reach> reaches;  ///< of each texel, where they differ within a tile

    std::size_t bytes() const {
        std::size_t sum = reaches.capacity() * sizeof(Reach);
        for (const TapList& list : lists) sum += list.bytes();
        return sum;
    }
};

}  // namespace cubecam
