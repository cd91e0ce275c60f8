#include "cubecam/render/resources/picture_key.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace cubecam {
namespace {

/// If the damage is more than this share, drawing the whole picture costs no more.
constexpr double most_of_it = 0.7;

/// merge() compares all pairs in each step, so it gets at most this many rectangles at a time.
constexpr std::size_t at_once = 32;

/// Unites rectangles until none overlap and at most max_damage are left. Each step unites the two
/// rectangles whose union wastes the least area.
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

/// Collects rectangles one by one; the result has none that overlap.
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

/// Compares nodes of two pictures whose common parts are equal.
struct Comparison {
    const PictureKey& before;
    const PictureKey& now;
    bool same_shadows;

    bool same(const NodeKey& a, const NodeKey& b) const {
        if (a.bounds != b.bounds || a.receive_shadow != b.receive_shadow) return false;
        if (a.receive_shadow && !same_shadows) return false;
        if (a.mesh != b.mesh) return false;  // a node may show another level of detail
        if (a.revision != b.revision &&
            (a.material != b.material || a.world != b.world || a.label != b.label)) {
            return false;
        }
        const auto textures_a = before.textures_of(a);
        const auto textures_b = now.textures_of(b);
        return std::equal(textures_a.begin(), textures_a.end(), textures_b.begin(),
                          textures_b.end());
    }
};

/// Finds the nodes of a list by their ids. A node occurs several times if views have several
/// positions: the result is then the first of equal ids that was not taken yet.
class NodesById {
public:
    explicit NodesById(std::span<const NodeKey> nodes) : next_(nodes.size(), none) {
        std::int32_t last = 0;
        for (const NodeKey& node : nodes) last = std::max(last, node.id);
        // Ids are usually dense, and a table needs no sorting. But when many nodes were removed,
        // the few remaining ones may have large ids.
        dense_ = static_cast<std::size_t>(last) < 8 * nodes.size() + 1024;
        if (dense_) first_.assign(static_cast<std::size_t>(last) + 1, none);
        for (std::size_t i = nodes.size(); i-- > 0;) {
            std::uint32_t& first = entry(nodes[i].id);
            next_[i] = first;
            first = static_cast<std::uint32_t>(i);
        }
    }

    /// Returns the index of a node and marks it as taken; `none` if there is no such node.
    std::uint32_t take(std::int32_t id) {
        if (dense_ && static_cast<std::size_t>(id) >= first_.size()) return none;
        std::uint32_t& first = entry(id);
        const std::uint32_t found = first;
        if (found != none) first = next_[found];
        return found;
    }

    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

private:
    std::uint32_t& entry(std::int32_t id) {
        if (dense_) return first_[static_cast<std::size_t>(id)];
        return sparse_.try_emplace(id, none).first->second;
    }

    bool dense_ = true;
    std::vector<std::uint32_t> first_;  // by id
    std::unordered_map<std::int32_t, std::uint32_t> sparse_;
    std::vector<std::uint32_t> next_;  // place of the next node of the same id
};

/// Adds the damage of nodes whose order differs between the two lists.
void compare_unordered(const Comparison& keys, std::span<const NodeKey> before,
                       std::span<const NodeKey> now, Damage& to) {
    NodesById known(before);
    std::vector<bool> found(before.size(), false);
    // Unchanged nodes must also be drawn in the same order as before.
    std::uint32_t last_same = 0;
    for (const NodeKey& node : now) {
        if (to.is_all()) return;
        const std::uint32_t place = known.take(node.id);
        if (place == NodesById::none) {
            to.add(node.bounds);
            continue;
        }
        found[place] = true;
        if (!keys.same(before[place], node)) {
            to.add(before[place].bounds);
            to.add(node.bounds);
        } else if (place < last_same) {
            return to.add_all();
        } else {
            last_same = place;
        }
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!found[i]) to.add(before[i].bounds);
    }
}

}  // namespace

void add_view(Key& key, const View& view) {
    key.add(view.view);
    key.add(view.view_projection);
    key.add(view.position);
    key.add(view.eye);
    key.add(view.near);
    key.add(view.clip.has_value());
    if (!view.clip) return;
    key.add(view.clip->point);
    key.add(view.clip->normal);
}

std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole) {
    if (!before || !(before->common == now.common)) return {whole};

    const Comparison keys{*before, now, before->shadows == now.shadows};
    std::span<const NodeKey> old_nodes = before->nodes;
    std::span<const NodeKey> new_nodes = now.nodes;
    Damage found(whole);
    // Usually only a few nodes change their order: the equal parts at both ends of the lists are
    // compared in place.
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
