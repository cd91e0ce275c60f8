#pragma once

#include <algorithm>
#include <cstdint>

namespace cubecam {

/// The pixels from (x0, y0) up to (x1, y1), which is excluded.
struct Rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    std::int64_t area() const { return empty() ? 0 : std::int64_t{width()} * height(); }

    bool overlaps(const Rect& other) const {
        return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
    }

    /// The smallest rectangle that contains both; neither may be empty.
    Rect united(const Rect& other) const {
        return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1),
                std::max(y1, other.y1)};
    }

    /// The pixels that both contain.
    Rect intersected(const Rect& other) const {
        return {std::max(x0, other.x0), std::max(y0, other.y0), std::min(x1, other.x1),
                std::min(y1, other.y1)};
    }

    bool operator==(const Rect&) const = default;
};

}  // namespace cubecam
