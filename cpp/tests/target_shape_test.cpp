/// Tests targets of every shape on a driver: an array of cubes has the contents of single cubes, on
/// both paths of drawing and with several samples.

#include "check.hpp"

#include "cubecam/geometry/primitives.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/scene/scene.hpp"

#include <glad/gl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace cubecam;

namespace {

constexpr int size = 24;
constexpr glm::dvec3 places[] = {{0.0, 0.0, 0.0}, {0.7, 0.4, -0.3}};

struct Layer {
    std::vector<float> color;
    std::vector<std::int32_t> ids;

    bool operator==(const Layer&) const = default;
};

Layer read_layer(const GladGLContext& gl, Target& target, int layer) {
    Layer read{std::vector<float>(size * size * 4), std::vector<std::int32_t>(size * size)};
    Layers& color = target.multisampled() ? target.resolved() : target.color_pass();
    gl.NamedFramebufferReadBuffer(color.one(layer), attachment(0));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, color.one(layer));
    gl.ReadPixels(0, 0, size, size, GL_RGBA, GL_FLOAT, read.color.data());
    gl.NamedFramebufferReadBuffer(target.outputs().one(layer), attachment(1));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.outputs().one(layer));
    gl.ReadPixels(0, 0, size, size, GL_RED_INTEGER, GL_INT, read.ids.data());
    gl::check_gl(gl, "reading a layer");
    return read;
}

std::vector<Layer> draw(RendererState& gpu, const SceneSnapshot& scene, TargetShape shape,
                        const std::vector<View>& views, int samples) {
    const TargetDescription description =
        describe_target(gpu.context, {.shape = shape,
                                      .width = size,
                                      .height = size,
                                      .samples = samples,
                                      .format = Format::rgba32f,
                                      .outputs = parse_outputs({"id"}).outputs});
    CHECK_EQUAL(description.layers(), static_cast<int>(views.size()));
    Target target(gpu.context, description);
    GLint kind = 0;
    gpu.context.gl().GetTextureParameteriv(target.color().id(), GL_TEXTURE_TARGET, &kind);
    const bool cubes = shape.kind == TargetShape::Kind::cube_array;
    CHECK_EQUAL(kind == GL_TEXTURE_CUBE_MAP_ARRAY, cubes);
    FrameContext frame(gpu, scene);
    frame.draw(views, target, [](const NodeSnapshot&) { return true; }, Key());
    std::vector<Layer> layers;
    for (int layer = 0; layer < description.layers(); ++layer) {
        layers.push_back(read_layer(gpu.context.gl(), target, layer));
    }
    return layers;
}

std::shared_ptr<Scene> make_scene() {
    auto scene = std::make_shared<Scene>();
    scene->set_background(glm::vec4(0.1F, 0.2F, 0.3F, 1.0F));
    for (int i = 0; i < 6; ++i) {
        NodeValue node;
        node.mesh = std::make_shared<Mesh>(primitives::box(glm::dvec3(0.8)));
        const double side = i % 2 == 0 ? 2.5 : -2.5;
        glm::dvec3 position(0.1 * i, 0.2, -0.1 * i);
        position[i / 2] = side;
        node.placing = Transform{position};
        scene->add(std::move(node));
    }
    return scene;
}

void test_cubes(gl::Context& context, Layering layering, int samples) {
    RendererState gpu(context, layering, std::size_t{1} << 26);
    const auto scene = make_scene();
    const auto snapshot = scene->snapshot();
    std::vector<View> all;
    std::vector<Layer> expected;
    for (const glm::dvec3& place : places) {
        const std::vector<View> views = cube_views(place, 0.05, 100.0);
        all.insert(all.end(), views.begin(), views.end());
        for (Layer& layer : draw(gpu, *snapshot, TargetShape::cube(), views, samples)) {
            expected.push_back(std::move(layer));
        }
    }
    CHECK(draw(gpu, *snapshot, TargetShape::cube_array(2), all, samples) == expected);
    CHECK(draw(gpu, *snapshot, TargetShape::array(12), all, samples) == expected);
    std::size_t seen = 0;
    for (const Layer& layer : expected) {
        for (const std::int32_t id : layer.ids) seen += id > 0 ? 1 : 0;
    }
    CHECK(seen > 12 * size * size / 40);
    CHECK(expected[0] != expected[6]);
    CHECK(draw(gpu, *snapshot, TargetShape::flat(), {all[7]}, samples) ==
          std::vector<Layer>{expected[7]});
}

void test_limits(const gl::Context& context) {
    for (const TargetShape shape : {TargetShape::cube_array(100000), TargetShape::array(0)}) {
        bool refused = false;
        try {
            describe_target(context, {.shape = shape, .width = 4, .height = 4});
        } catch (const std::invalid_argument&) {
            refused = true;
        }
        CHECK(refused);
    }
}

}  // namespace

int main() {
    gl::Context context({"software", true});
    const gl::CurrentScope scope(context);
    test_limits(context);
    for (const int samples : {1, 4}) {
        test_cubes(context, Layering::never, samples);
        if (context.has_extension("GL_ARB_shader_viewport_layer_array")) {
            test_cubes(context, Layering::always, samples);
        }
    }
    return test::result();
}
