/// Tests which rectangles of a picture are drawn again when nodes are added, removed, moved or
/// reordered.

#include "check.hpp"

#include "cubecam/render/resources/picture_key.hpp"

using namespace cubecam;

namespace {

constexpr Rect whole{0, 0, 100, 100};

NodeKey node(std::int32_t id, Rect bounds, std::uint64_t revision = 1) {
    NodeKey key{};
    key.id = id;
    key.bounds = bounds;
    key.revision = revision;
    key.world = glm::dmat4(static_cast<double>(revision));
    key.mesh = 1;
    key.material = 1;
    return key;
}

PictureKey picture(std::vector<NodeKey> nodes, int common = 0) {
    PictureKey key;
    key.common.add(common);
    key.nodes = std::move(nodes);
    return key;
}

using Rects = std::vector<Rect>;

bool covers(const Rects& rects, const Rect& wanted) {
    for (const Rect& rect : rects) {
        if (rect.united(wanted) == rect) return true;
    }
    return false;
}

}  // namespace

int main() {
    const Rect left{0, 0, 10, 10};
    const Rect right{50, 50, 60, 60};
    const PictureKey one = picture({node(1, left), node(2, right)});

    CHECK(damage(std::nullopt, one, whole) == Rects{whole});
    CHECK(damage(one, one, whole).empty());
    CHECK(damage(one, picture({node(1, left), node(2, right)}, 1), whole) == Rects{whole});

    // A changed node damages its old and its new rectangle, a removed node its old one.
    const Rects moved = damage(one, picture({node(1, {20, 0, 30, 10}, 2), node(2, right)}), whole);
    CHECK(covers(moved, left));
    CHECK(covers(moved, {20, 0, 30, 10}));
    CHECK(!covers(moved, right));
    CHECK(damage(one, picture({node(2, right)}), whole) == Rects{left});
    CHECK(damage(picture({node(2, right)}), one, whole) == Rects{left});

    // Unchanged nodes in another order may change the picture everywhere.
    CHECK(damage(one, picture({node(2, right), node(1, left)}), whole) == Rects{whole});

    // Damage of most of the picture becomes the whole; a node that touches no pixel causes none.
    CHECK(damage(one, picture({node(1, {0, 0, 90, 90}, 2), node(2, right)}), whole) ==
          Rects{whole});
    CHECK(damage(one, picture({node(1, left), node(2, right), node(3, {})}), whole).empty());

    // There are at most max_damage rectangles, and they do not overlap.
    std::vector<NodeKey> many;
    for (std::int32_t i = 0; i < 40; ++i) {
        const int x = 10 * (i % 10);
        const int y = 25 * (i / 10);
        many.push_back(node(i + 1, {x, y, x + 2, y + 2}));
    }
    const Rects few = damage(picture({}), picture(many), whole);
    CHECK(few.size() <= max_damage);
    for (const NodeKey& each : many) CHECK(covers(few, each.bounds));
    for (std::size_t a = 0; a < few.size(); ++a) {
        for (std::size_t b = a + 1; b < few.size(); ++b) CHECK(!few[a].overlaps(few[b]));
    }
    return test::result();
}
