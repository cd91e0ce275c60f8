#include "cubecam/render/resources/picture_key.hpp"

#include <algorithm>
#include <limits>
#include <map>

namespace cubecam {
namespace {

/// Beyond this share of the picture, drawing all of it costs no more.
constexpr double most_of_it = 0.7;

/// merge() weighs all pairs again and again: of many rectangles it gets so many at a time.
constexpr std::size_t at_once = 32;

/// Unites rectangles until none overlap and no more than max_damage are left, always the two whose
/// union wastes least.
void merge(std::vector<Rect>& rects) {
    while (rects.size() > 1) {
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        std::size_t first = 0;
        std::size_t second = 0;
        for (std::size_t a = 0; a < rects.size(); ++a) {
            for (std::size_t b = a + 1; b < rects.size(); ++b) {
                const std::int64_t waste =
                    rects[a].overlaps(rects[b])
                        ? std::numeric_limits<std::int64_t>::min()
                        : rects[a].united(rects[b]).area() - rects[a].area() - rects[b].area();
                if (waste >= least) continue;
                least = waste;
                first = a;
                second = b;
            }
        }
        if (least > 0 && rects.size() <= max_damage) return;
        rects[first] = rects[first].united(rects[second]);
        rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(second));
    }
}

}  // namespace

std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole) {
    if (!before || !(before->common == now.common)) return {whole};

    std::map<std::int32_t, const NodeKey*> old;
    for (const NodeKey& node : before->nodes) old.emplace(node.id, &node);
    std::vector<Rect> rects;
    const auto add = [&rects](const Rect& rect) {
        if (rect.empty()) return;
        rects.push_back(rect);
        if (rects.size() == at_once) merge(rects);
    };
    std::vector<std::int32_t> same;
    for (const NodeKey& node : now.nodes) {
        const auto found = old.find(node.id);
        if (found != old.end() && *found->second == node) {
            same.push_back(node.id);
        } else {
            add(node.bounds);
            if (found != old.end()) add(found->second->bounds);
        }
        if (found != old.end()) old.erase(found);
    }
    for (const auto& [id, node] : old) add(node->bounds);

    // What did not change must also be drawn in the order it was.
    auto next = same.begin();
    for (const NodeKey& node : before->nodes) {
        if (next != same.end() && *next == node.id) ++next;
    }
    if (next != same.end()) return {whole};

    merge(rects);
    std::int64_t area = 0;
    for (const Rect& rect : rects) area += rect.area();
    if (static_cast<double>(area) > most_of_it * static_cast<double>(whole.area())) return {whole};
    return rects;
}

}  // namespace cubecam
