/// Tests the order of drawing: near to far, translucent nodes last and far to near, the id breaks
/// ties.

#include "check.hpp"

#include "cubecam/geometry/primitives.hpp"
#include "cubecam/materials/basic.hpp"
#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/scene/scene.hpp"

#include <algorithm>
#include <memory>
#include <string>

using namespace cubecam;

namespace {

std::shared_ptr<Node> add(Scene& scene, const std::shared_ptr<Mesh>& mesh, glm::dvec3 position,
                          float opacity = 1.0F, std::int32_t render_order = 0) {
    NodeValue node;
    node.mesh = mesh;
    const auto material = std::make_shared<BasicMaterial>();
    material->edit([&](auto& value) { value.surface.opacity = opacity; });
    node.material = material;
    node.placing = Transform{position};
    node.render_order = render_order;
    return scene.add(std::move(node));
}

std::string ids(const SceneSnapshot& scene, const std::vector<PlannedNode>& planned) {
    std::string text;
    for (const PlannedNode& node : planned) {
        text += (text.empty() ? "" : " ") + std::to_string(scene.nodes[node.node].id);
    }
    return text;
}

}  // namespace

int main() {
    Scene scene;
    const auto box = std::make_shared<Mesh>(primitives::box(glm::dvec3(1.0)));
    add(scene, box, {0, 0, -9});             // 1
    add(scene, box, {0, 0, -3});             // 2
    add(scene, box, {0, 0, 5});              // 3, behind the eye
    add(scene, box, {0, 0, -4}, 0.5F);       // 4
    add(scene, box, {0, 0, -7}, 0.5F);       // 5
    add(scene, box, {1, 0, -9});             // 6
    add(scene, box, {-1, 0, -9});            // 7, as far as the one before
    add(scene, box, {0, 0, -20}, 1.0F, -1);  // 8, first by its order

    const auto all = [](const NodeSnapshot&) { return true; };
    const std::vector<View> views = {cube_views({}, 0.1, 100.0)[face_index(Face::neg_z)]};
    const auto snapshot = scene.snapshot();
    const DrawPlan plan = make_plan(*snapshot, views, 64, 64, all);
    CHECK_EQUAL(ids(*snapshot, plan.opaque), "8 2 1 6 7");
    CHECK_EQUAL(ids(*snapshot, plan.transparent), "5 4");
    for (const PlannedNode& planned : plan.opaque) {
        for (const Visibility& seen : plan.visible_in(planned)) {
            CHECK_EQUAL(seen.view, 0U);
            CHECK(!seen.bounds.empty());
        }
    }

    // Without a depth buffer later nodes are drawn over earlier ones, in the order of render_order
    // and id.
    const DrawPlan painted = make_plan(*snapshot, views, 64, 64, all, DepthMode::by_order);
    CHECK_EQUAL(ids(*snapshot, painted.opaque), "8 1 2 4 5 6 7");
    CHECK(painted.transparent.empty());

    // Six views at one position share a sequence; a node behind the first view is in front of
    // another.
    const std::vector<View> six = cube_views({}, 0.1, 100.0);
    const DrawPlan around = make_plan(*snapshot, six, 64, 64, all);
    CHECK_EQUAL(ids(*snapshot, around.opaque), "8 2 3 1 6 7");
    CHECK(same_place(six[0], six[5]));
    CHECK(!same_place(six[0], cube_views({1, 0, 0}, 0.1, 100.0)[0]));

    const DrawPlan some =
        make_plan(*snapshot, views, 64, 64, [](const NodeSnapshot& node) { return node.id != 2; });
    CHECK_EQUAL(ids(*snapshot, some.opaque), "8 1 6 7");
    return test::result();
}
