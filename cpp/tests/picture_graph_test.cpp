/// Tests the graph of pictures alone, with pictures that draw nothing. Some of their kinds have no
/// class yet: a cube filtered from another picture, several bounces of one probe, a mirror that
/// depends on its viewer.

#include "check.hpp"

#include "cubecam/render/graph/picture_graph.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace cubecam;

namespace {

constexpr auto probe = static_cast<PictureKind>(0);
constexpr auto texture = static_cast<PictureKind>(1);
constexpr auto filtered = static_cast<PictureKind>(10);
constexpr auto mirror = static_cast<PictureKind>(11);
constexpr auto frame = static_cast<PictureKind>(12);

using Ids = std::vector<PictureId>;

PictureId make_id(PictureKind kind, std::size_t object, std::size_t bounce = 0) {
    return {kind, 0, object, bounce, nullptr};
}

PictureId mirror_in(std::size_t object, const PictureId& viewer) {
    return {mirror, 0, object, 0, std::make_shared<const PictureId>(viewer)};
}

std::string name(const PictureId& id) {
    const std::string object = std::to_string(id.object);
    if (id.kind == probe) {
        return "probe" + object + (id.bounce > 0 ? "." + std::to_string(id.bounce) : "");
    }
    if (id.kind == texture) return "texture" + object;
    if (id.kind == filtered) return "filtered" + object;
    if (id.kind == mirror) return "mirror" + object + "(" + name(*id.viewer) + ")";
    return "frame" + object;
}

std::string names(const Ids& ids) {
    std::string text;
    for (const PictureId& id : ids) text += (text.empty() ? "" : " ") + name(id);
    return text;
}

/// The dependencies of the pictures of one test, and a record of the calls.
struct World {
    std::function<Ids(const PictureId&)> shown = [](const PictureId&) { return Ids(); };
    std::function<Ids(const PictureId&)> possible = shown;
    std::function<Ids(const PictureId&)> companions = shown;
    std::function<bool(const PictureId&)> labelled = [](const PictureId&) { return true; };
    Ids made, planned, updated;
};

class Fake final : public Picture {
public:
    Fake(World& world, PictureId id) : world_(world), id_(std::move(id)) {}

    Ids possible_dependencies() override { return world_.possible(id_); }
    Ids dependencies() override {
        world_.planned.push_back(id_);
        return world_.shown(id_);
    }
    Ids companions() override { return world_.companions(id_); }
    void update() override { world_.updated.push_back(id_); }
    bool strict() const override { return id_.kind != probe; }
    std::string label(std::size_t place) const override {
        if (!world_.labelled(id_)) return "";
        return place == 0 ? "The " + name(id_) : name(id_) + "#" + std::to_string(place);
    }

private:
    World& world_;
    PictureId id_;
};

PictureGraph graph_of(World& world) {
    return PictureGraph([&world](const PictureId& id) {
        world.made.push_back(id);
        return std::make_unique<Fake>(world, id);
    });
}

std::string drawn(World& world, const Ids& roots) {
    world.made = world.planned = world.updated = {};
    PictureGraph graph = graph_of(world);
    graph.update(roots);
    CHECK_EQUAL(names(graph.order()), names(world.updated));
    return names(world.updated);
}

/// The message of refuse_circles, empty if it refuses nothing.
std::string refusal(World& world, const Ids& roots) {
    PictureGraph graph = graph_of(world);
    try {
        graph.refuse_circles(roots, "; advice");
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

void test_identity() {
    const PictureId viewer = make_id(frame, 0);
    CHECK(make_id(probe, 1) == make_id(probe, 1));
    CHECK(make_id(probe, 1) != make_id(probe, 2));
    CHECK(make_id(probe, 1) != make_id(texture, 1));
    CHECK(make_id(probe, 1) != make_id(probe, 1, 1));
    CHECK((PictureId{probe, 0, 1, 0, nullptr} != PictureId{probe, 1, 1, 0, nullptr}));
    // Viewers are compared by value: equal viewers are the same.
    CHECK(mirror_in(1, viewer) == mirror_in(1, make_id(frame, 0)));
    CHECK(mirror_in(1, viewer) != mirror_in(1, make_id(frame, 1)));
    CHECK(mirror_in(1, viewer) != make_id(mirror, 1));
    CHECK(mirror_in(1, mirror_in(2, viewer)) != mirror_in(1, mirror_in(3, viewer)));
    CHECK(make_id(mirror, 1) < mirror_in(1, viewer));
    CHECK(mirror_in(1, make_id(frame, 0)) < mirror_in(1, make_id(frame, 1)));
    CHECK(make_id(probe, 9) < make_id(texture, 0));
    // Bounces are rounds: the first one of all objects comes before the second one of any.
    CHECK(make_id(probe, 9) < make_id(probe, 0, 1));
}

void test_a_diamond_draws_its_shared_part_once() {
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(texture, 1), make_id(texture, 0)};
        if (id.kind == texture) return {make_id(probe, 3), make_id(probe, 3)};
        return {};
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0)}), "probe3 texture0 texture1 frame0");
    CHECK_EQUAL(world.made.size(), 4U);
    CHECK_EQUAL(world.planned.size(), 4U);
}

/// For every subset of the roots, in every order, the shared pictures have one order.
void test_the_order_does_not_depend_on_where_the_search_began() {
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind != texture) return {};
        switch (id.object) {
            case 0: return {make_id(texture, 3), make_id(probe, 1)};
            case 1: return {make_id(texture, 2)};
            case 2: return {make_id(probe, 0), make_id(texture, 3)};
            default: return {make_id(probe, 2)};
        }
    };
    Ids roots{make_id(texture, 0), make_id(texture, 1), make_id(texture, 2)};
    const std::string expected = "probe0 probe1 probe2 texture3 texture0 texture2 texture1";
    do {
        CHECK_EQUAL(drawn(world, roots), expected);
    } while (std::next_permutation(roots.begin(), roots.end()));
    CHECK_EQUAL(drawn(world, {make_id(texture, 1)}), "probe0 probe2 texture3 texture2 texture1");
}

void test_a_picture_derived_from_a_picture() {
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(filtered, 4), make_id(probe, 5)};
        if (id.kind == filtered) return {make_id(probe, id.object)};
        return {};
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0)}), "probe4 probe5 filtered4 frame0");
}

void test_bounces_are_pictures_of_their_own() {
    // Two mirrors that see each other: bounce k shows the other's bounce k - 1, and bounce 0 the
    // environment.
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(probe, 0, 2), make_id(probe, 1, 2)};
        if (id.bounce == 0) return {};
        return {make_id(probe, 1 - id.object, id.bounce - 1)};
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0)}),
                "probe0 probe1 probe0.1 probe1.1 probe0.2 probe1.2 frame0");
    CHECK_EQUAL(world.made.size(), 2U * 3U + 1U);
}

void test_rounds_of_bounces() {
    // Three mirrors of one circle, of which the frame shows the last one alone. The other bounces
    // of mirror 2 are not needed, and of the others the first two.
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(probe, 2, 2)};
        Ids others;
        for (std::size_t object = 0; object < 3 && id.bounce > 0; ++object) {
            if (object != id.object) others.push_back(make_id(probe, object, id.bounce - 1));
        }
        return others;
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0)}),
                "probe0 probe1 probe2 probe0.1 probe1.1 probe2.2 frame0");
    // With companions, the bounces of one picture come along, and what these show.
    world.companions = [](const PictureId& id) -> Ids {
        if (id.kind != probe || id.object != 2) return {};
        return {make_id(probe, 2), make_id(probe, 2, 1), make_id(probe, 2, 2)};
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0)}),
                "probe0 probe1 probe2 probe0.1 probe1.1 probe2.1 probe2.2 frame0");
    CHECK_EQUAL(world.planned.size(), 8U);
}

void test_companions_are_brought_along_in_the_order_of_what_they_show() {
    // Texture 0 brings texture 1 along, which shows texture 0 and probe 0.
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id == make_id(texture, 1)) return {make_id(texture, 0), make_id(probe, 0)};
        return {};
    };
    world.companions = [](const PictureId& id) -> Ids {
        if (id == make_id(texture, 0)) return {make_id(texture, 1)};
        return {};
    };
    CHECK_EQUAL(drawn(world, {make_id(texture, 0)}), "probe0 texture0 texture1");
    // It shows nothing of them, so it is no circle.
    world.possible = world.shown;
    CHECK_EQUAL(refusal(world, {make_id(texture, 0)}), "");
}

void test_a_picture_that_depends_on_who_looks() {
    // Two frames look into mirror 0, in which mirror 1 is seen, which shows probe 0.
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {mirror_in(0, id)};
        if (id.kind == mirror && id.object == 0) return {mirror_in(1, id)};
        if (id.kind == mirror) return {make_id(probe, 0)};
        return {};
    };
    CHECK_EQUAL(drawn(world, {make_id(frame, 0), make_id(frame, 1)}),
                "probe0 mirror1(mirror0(frame0)) mirror0(frame0) frame0 mirror1(mirror0(frame1)) "
                "mirror0(frame1) frame1");
    // A mirror is made when its viewer is planned, so not before the viewer.
    const auto place = [&world](const PictureId& id) {
        return std::find(world.made.begin(), world.made.end(), id) - world.made.begin();
    };
    CHECK(place(make_id(frame, 0)) < place(mirror_in(0, make_id(frame, 0))));
    CHECK_EQUAL(world.made.size(), 7U);
}

void test_a_circle_of_planned_pictures_is_never_drawn() {
    // Probes 0, 1 and 2 form a circle, 2 also shows 3. No bounces tell them apart.
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(probe, id.object)};
        if (id.object == 2) return {make_id(probe, 0), make_id(probe, 3)};
        if (id.object == 3) return {};
        return {make_id(probe, id.object + 1)};
    };
    for (const std::size_t start : {0U, 1U, 2U}) {
        PictureGraph graph = graph_of(world);
        std::string text;
        try {
            graph.update({make_id(frame, start)});
        } catch (const std::logic_error& error) {
            text = error.what();
        }
        CHECK_EQUAL(text, "expected pictures that do not depend on each other, got a circle");
        CHECK(world.updated.empty());
    }
    CHECK_EQUAL(drawn(world, {make_id(frame, 3)}), "probe3 frame3");
    // Such a circle is not refused by name, since probes are not strict.
    world.possible = world.shown;
    CHECK_EQUAL(refusal(world, {make_id(frame, 0)}), "");
}

void test_circles_of_strict_pictures_are_refused_by_name() {
    World world;
    world.possible = [](const PictureId& id) -> Ids {
        if (id.kind == frame) return {make_id(texture, 0)};
        if (id.kind == probe) return {make_id(texture, 2), make_id(probe, id.object)};
        // Texture 0 shows 1, 1 shows 2 directly and in a probe, 2 shows 0; 5 shows itself.
        switch (id.object) {
            case 0: return {make_id(texture, 1)};
            case 1: return {make_id(probe, 7), make_id(texture, 2)};
            case 2: return {make_id(texture, 0)};
            case 5: return {make_id(texture, 5)};
            default: return {};
        }
    };
    // The message names the shortest path, from the first strict picture on.
    const std::string text =
        "The texture0 shows itself: texture0#1 -> texture1#2 -> texture2#3 -> texture0#1; advice";
    CHECK_EQUAL(refusal(world, {make_id(frame, 0)}), text);
    CHECK_EQUAL(refusal(world, {make_id(texture, 2)}), text);
    CHECK_EQUAL(refusal(world, {make_id(texture, 5)}),
                "The texture5 shows itself: texture5#1 -> texture5#1; advice");
    CHECK_EQUAL(refusal(world, {make_id(texture, 3)}), "");
    CHECK(world.planned.empty());
    CHECK(world.updated.empty());
    // A picture without a label is skipped, also at the beginning.
    world.labelled = [](const PictureId& id) { return id.object != 0; };
    CHECK_EQUAL(refusal(world, {make_id(frame, 0)}),
                "The texture1 shows itself: texture1#1 -> texture2#2 -> texture1#1; advice");
    // The path has the fewest names: it goes through two probes without a label rather than through
    // one texture.
    world.possible = [](const PictureId& id) -> Ids {
        if (id == make_id(texture, 1)) return {make_id(probe, 7), make_id(texture, 2)};
        if (id == make_id(probe, 7)) return {make_id(probe, 8)};
        return {make_id(texture, 1)};
    };
    CHECK_EQUAL(refusal(world, {make_id(texture, 1)}),
                "The texture1 shows itself: texture1#1 -> texture2#2 -> texture1#1; advice");
    world.labelled = [](const PictureId& id) { return id.kind != probe; };
    CHECK_EQUAL(refusal(world, {make_id(texture, 1)}),
                "The texture1 shows itself: texture1#1 -> texture1#1; advice");
    world.labelled = [](const PictureId&) { return false; };
    CHECK_EQUAL(refusal(world, {make_id(texture, 1)}), "a picture shows itself; advice");
}

void test_what_is_possible_decides_and_not_what_is_planned() {
    World world;
    world.possible = [](const PictureId& id) -> Ids { return {id}; };
    CHECK_EQUAL(drawn(world, {make_id(texture, 0)}), "texture0");
    CHECK(!refusal(world, {make_id(texture, 0)}).empty());
}

void test_long_chains() {
    constexpr std::size_t count = 100'000;
    World world;
    world.shown = [](const PictureId& id) -> Ids {
        return id.object + 1 < count ? Ids{make_id(texture, id.object + 1)} : Ids();
    };
    world.possible = [](const PictureId& id) -> Ids {
        return {make_id(texture, (id.object + 1) % count)};
    };
    PictureGraph graph = graph_of(world);
    graph.update({make_id(texture, 0)});
    CHECK_EQUAL(world.updated.size(), count);
    CHECK_EQUAL(name(world.updated.front()), "texture" + std::to_string(count - 1));
    const std::string text = refusal(world, {make_id(texture, 0)});
    CHECK(text.ends_with("-> texture11#12 -> 99988 more -> texture0#1; advice"));
}

}  // namespace

int main() {
    test_identity();
    test_a_diamond_draws_its_shared_part_once();
    test_the_order_does_not_depend_on_where_the_search_began();
    test_a_picture_derived_from_a_picture();
    test_bounces_are_pictures_of_their_own();
    test_rounds_of_bounces();
    test_companions_are_brought_along_in_the_order_of_what_they_show();
    test_a_picture_that_depends_on_who_looks();
    test_a_circle_of_planned_pictures_is_never_drawn();
    test_circles_of_strict_pictures_are_refused_by_name();
    test_what_is_possible_decides_and_not_what_is_planned();
    test_long_chains();
    return test::result();
}
