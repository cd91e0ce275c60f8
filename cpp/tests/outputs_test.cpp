/// Tests the slots of outputs, the adaptation of a user's declarations, and the conversion of
/// texels for a caller.

#include "check.hpp"

#include "cubecam/image/result_pool.hpp"
#include "cubecam/render/passes/output_declarations.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/repack.hpp"

#include <cstdint>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace cubecam;

namespace {

void test_slots() {
    const RequestedOutputs requested = parse_outputs({"id", "color", "heat", "z", "depth"});
    CHECK(requested.others == std::vector<std::string>{"heat"});
    Outputs outputs = requested.outputs;
    outputs.add({"heat", 4});
    outputs.add({"area", 1});
    outputs.add({"heat", 4});
    std::string order;
    for (const ShadedOutput& output : outputs.by_slot()) {
        order += std::string(output.name) + std::to_string(output.slot) + " ";
    }
    CHECK_EQUAL(order, "z1 id2 area3 heat4 ");
    CHECK(outputs.buffered());
    CHECK(!outputs.without_buffered().buffered());
    CHECK(outputs.without_buffered().by_slot().size() == 4);
    CHECK(!parse_outputs({"depth"}).outputs.shaded());
    CHECK(!parse_outputs({"color"}).any());
}

std::string placed(const std::string& text, const Outputs& outputs) {
    return place_outputs({text, ""}, outputs).text;
}

void test_placing() {
    Outputs outputs = parse_outputs({"z"}).outputs;
    outputs.add({"heat", 4});
    CHECK_EQUAL(placed("out vec4 heat;", outputs), "layout(location = 2) out vec4 heat;");
    CHECK_EQUAL(placed("out vec4 heat;", {}), "vec4 heat;");
    CHECK_EQUAL(placed("int a; out highp\nvec4 other,\nheat ; b", outputs),
                "int a; vec4 other;layout(location = 2) out vec4 heat;\n\n b");
    for (const std::string same :
         {"void f(out float x) {}", "// out vec4 heat;\n", "/* out vec4\nheat; */", "vec4 outer;",
          "#define X out vec4 heat;\n", "void f() { int out_ = 1; }",
          "struct A { float layout_; };"}) {
        CHECK_EQUAL(placed(same, outputs), same);
    }
    CHECK(declared_outputs({"void f(out vec2 x) { }\nout vec2 a;\n out float b , c;", ""}) ==
          (std::vector<NamedOutput>{{"a", 2}, {"b", 1}, {"c", 1}}));
}

void test_refusals() {
    for (const std::string bad :
         {"out int a;", "out vec4;", "out vec4 a,;", "out vec4 a = vec4(1);", "out vec4 a[2];",
          "layout(location = 1) out vec4 a;", "flat out vec4 a;", "out B { vec4 a; };",
          "out vec4 color;", "out vec4 stencil;"}) {
        bool refused = false;
        try {
            declared_outputs({bad, ""});
        } catch (const std::invalid_argument&) {
            refused = true;
        }
        if (!refused) CHECK_EQUAL(bad, "refused");
    }
}

void test_defines() {
    Outputs outputs = parse_outputs({"id"}).outputs;
    outputs.add({"heat", 2});
    std::string text;
    for (const auto& [name, value] : output_defines(outputs)) text += name + ": " + value + "\n";
    CHECK(text.find("layout(location = 1) out int o_id;") != std::string::npos);
    CHECK(text.find(";vec3 o_normal;") != std::string::npos);
    CHECK(text.find("layout(location = 2) out vec2 o_other_2;") != std::string::npos);
    CHECK(text.find("OUTPUT_ZEROS: o_other_2 = vec2(0.0);") != std::string::npos);
    CHECK(output_defines({}).empty());
}

void test_repacking() {
    std::vector<std::uint16_t> packed(65536);
    std::iota(packed.begin(), packed.end(), std::uint16_t{0});
    std::vector<std::uint32_t> wide(packed.size());
    widen_565(packed.data(), packed.size(), wide.data());
    std::size_t wrong = 0;
    for (std::uint32_t p = 0; p < packed.size(); ++p) {
        const std::uint32_t red = ((p >> 11) * 255 + 15) / 31;
        const std::uint32_t green = ((p >> 5 & 63) * 255 + 31) / 63;
        const std::uint32_t blue = ((p & 31) * 255 + 15) / 31;
        if (wide[p] != (red | green << 8 | blue << 16 | 255U << 24)) ++wrong;
    }
    CHECK_EQUAL(wrong, 0U);

    for (const std::size_t texels : {0U, 1U, 2U, 7U}) {
        std::vector<float> four(4 * texels);
        std::iota(four.begin(), four.end(), 1.0F);
        std::vector<float> three(3 * texels + 1, -1.0F);
        drop_fourth(four.data(), texels, three.data());
        bool equal = three.back() == -1.0F;
        for (std::size_t i = 0; i < 3 * texels; ++i) {
            equal = equal && three[i] == four[i / 3 * 4 + i % 3];
        }
        CHECK(equal);
    }

    std::vector<float> depth = {0.0F, 0.25F, 1.0F};
    turn_depth(depth.data(), depth.size(), 0.0F);
    CHECK(depth == (std::vector<float>{1.0F, 0.75F, 0.0F}));
    depth = {0.0F, 0.25F, 1.0F};
    turn_depth(depth.data(), depth.size(), 1.0F);
    CHECK(depth == (std::vector<float>{1.0F, 0.75F, 1.0F}));
}

void test_pool() {
    constexpr std::size_t bytes = std::size_t{1} << 20;
    auto pool = std::make_shared<ResultPool>(2 * bytes);
    auto a = pool->take(bytes);
    auto b = pool->take(bytes);
    auto c = pool->take(bytes);
    const PixelBuffer* places[] = {a.get(), b.get(), c.get()};
    CHECK(places[0] != places[1]);
    a.reset();
    b.reset();
    c.reset();  // the first one does not fit any more
    a = pool->take(bytes);
    b = pool->take(bytes);
    CHECK((a.get() == places[2] && b.get() == places[1]));  // the last one released comes first
    CHECK(pool->take(bytes / 2)->size() == bytes / 2);
    pool.reset();
    a.reset();  // to no pool
    CHECK(b->size() == bytes);
}

}  // namespace

int main() {
    test_slots();
    test_placing();
    test_refusals();
    test_defines();
    test_repacking();
    test_pool();
    return test::result();
}
