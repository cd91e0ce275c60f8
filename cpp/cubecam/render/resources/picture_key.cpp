#include "cubecam/render/resources/picture_key.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

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

/// Rectangles that do not overlap, gathered one by one.
class Damage {
public:
    explicit Damage(const Rect& whole) : whole_(whole) {}

    void add(const Rect& rect) {
        if (rect.empty() || all_) return;
        for (const Rect& known : rects_) {
            if (known.united(rect) == known) return;
        }
        rects_.push_back(rect);
        if (rects_.size() < at_once) return;
        merge(rects_);
        all_ = is_most();
    }

    void add_all() { all_ = true; }
    bool is_all() const { return all_; }

    std::vector<Rect> take() {
        if (all_) return {whole_};
        merge(rects_);
        if (is_most()) return {whole_};
        return std::move(rects_);
    }

private:
    bool is_most() const {
        std::int64_t area = 0;
        for (const Rect& rect : rects_) area += rect.area();
        return static_cast<double>(area) > most_of_it * static_cast<double>(whole_.area());
    }

    const Rect& whole_;
    std::vector<Rect> rects_;
    bool all_ = false;
};

/// Two pictures whose common parts are equal.
struct Comparison {
    const PictureKey& before;
    const PictureKey& now;
    bool same_shadows;

    bool same(const NodeKey& a, const NodeKey& b) const {
        if (a.bounds != b.bounds || a.receive_shadow != b.receive_shadow) return false;
        if (a.receive_shadow && !same_shadows) return false;
        if (a.revision != b.revision &&
            (a.mesh != b.mesh || a.material != b.material || a.world != b.world)) {
            return false;
        }
        const auto textures_a = before.textures_of(a);
        const auto textures_b = now.textures_of(b);
        return std::equal(textures_a.begin(), textures_a.end(), textures_b.begin(),
                          textures_b.end());
    }
};

/// Indices into a part of a list of nodes, by id; of equal ids, by place.
std::vector<std::uint32_t> by_id(std::span<const NodeKey> nodes) {
    std::vector<std::uint32_t> order(nodes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return nodes[a].id != nodes[b].id ? nodes[a].id < nodes[b].id : a < b;
    });
    return order;
}

/// Adds the damage of nodes that do not stand in the same order in both lists.
void compare_unordered(const Comparison& keys, std::span<const NodeKey> before,
                       std::span<const NodeKey> now, Damage& to) {
    const std::vector<std::uint32_t> old_order = by_id(before);
    const std::vector<std::uint32_t> new_order = by_id(now);
    std::vector<std::uint32_t> place_before(now.size());  // of those that did not change
    std::vector<bool> same(now.size(), false);
    std::size_t o = 0;
    std::size_t n = 0;
    while (o < old_order.size() || n < new_order.size()) {
        const NodeKey* old_node = o < old_order.size() ? &before[old_order[o]] : nullptr;
        const NodeKey* new_node = n < new_order.size() ? &now[new_order[n]] : nullptr;
        if (new_node == nullptr || (old_node != nullptr && old_node->id < new_node->id)) {
            to.add(old_node->bounds);
            ++o;
        } else if (old_node == nullptr || new_node->id < old_node->id) {
            to.add(new_node->bounds);
            ++n;
        } else {
            if (keys.same(*old_node, *new_node)) {
                same[new_order[n]] = true;
                place_before[new_order[n]] = old_order[o];
            } else {
                to.add(old_node->bounds);
                to.add(new_node->bounds);
            }
            ++o;
            ++n;
        }
    }
    // What did not change must also be drawn in the order it was.
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!same[i]) continue;
        if (place_before[i] < last) return to.add_all();
        last = place_before[i];
    }
}

}  // namespace

void add_view(Key& key, const View& view) {
    key.add(view.view);
    key.add(view.view_projection);
    key.add(view.position);
    key.add(view.eye);
    key.add(view.near);
}

std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole) {
    if (!before || !(before->common == now.common)) return {whole};

    const Comparison keys{*before, now, before->shadows == now.shadows};
    std::span<const NodeKey> old_nodes = before->nodes;
    std::span<const NodeKey> new_nodes = now.nodes;
    Damage found(whole);
    // Mostly the order is the same, but for a few: what stands alike from both ends is compared in
    // place.
    const auto compare = [&](const NodeKey& a, const NodeKey& b) {
        if (keys.same(a, b)) return;
        found.add(a.bounds);
        found.add(b.bounds);
    };
    while (!old_nodes.empty() && !new_nodes.empty() &&
           old_nodes.front().id == new_nodes.front().id && !found.is_all()) {
        compare(old_nodes.front(), new_nodes.front());
        old_nodes = old_nodes.subspan(1);
        new_nodes = new_nodes.subspan(1);
    }
    while (!old_nodes.empty() && !new_nodes.empty() && old_nodes.back().id == new_nodes.back().id &&
           !found.is_all()) {
        compare(old_nodes.back(), new_nodes.back());
        old_nodes = old_nodes.first(old_nodes.size() - 1);
        new_nodes = new_nodes.first(new_nodes.size() - 1);
    }
    if (!found.is_all()) compare_unordered(keys, old_nodes, new_nodes, found);
    return found.take();
}

}  // namespace cubecam
