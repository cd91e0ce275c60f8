/// Tests that a filtered cube does not depend on how its faces came: all at once or one by one.

#include "check.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/lighting/filtered_cube.hpp"
#include "cubecam/lighting/radiance_faces.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

using namespace cubecam;

namespace {

constexpr std::array<bool, face_count> every_face = {true, true, true, true, true, true};
constexpr std::array<bool, face_count> no_face = {};

using Texels = std::array<std::vector<glm::vec4>, face_count>;

Texels noise(int size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> light(0.0F, 1.0F);
    Texels faces;
    for (auto& face : faces) {
        for (int i = 0; i < size * size; ++i) {
            const float lamp = light(generator) > 0.99F ? 500.0F : 1.0F;
            face.emplace_back(lamp * light(generator), lamp * light(generator), light(generator),
                              light(generator));
        }
    }
    return faces;
}

FilteredCube::Faces spans(const Texels& texels) {
    FilteredCube::Faces faces;
    for (std::size_t i = 0; i < face_count; ++i) faces[i] = texels[i];
    return faces;
}

bool same_bits(const FilteredLevel& a, const FilteredLevel& b) {
    return a.size == b.size && a.roughness == b.roughness && a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(glm::vec4)) == 0;
}

bool same_bits(const FilteredCube& a, const FilteredCube& b) {
    if (a.levels().size() != b.levels().size()) return false;
    for (std::size_t i = 0; i < a.levels().size(); ++i) {
        if (!same_bits(a.levels()[i], b.levels()[i])) return false;
    }
    return same_bits(a.irradiance(), b.irradiance());
}

void test_changed_faces(const FilterRule& rule) {
    Texels texels = noise(rule.size, 1);
    FilteredCube kept(rule);
    CHECK(kept.update(spans(texels), no_face));  // the first call does everything
    for (const std::size_t changed : {std::size_t{3}, std::size_t{0}}) {
        texels[changed] = noise(rule.size, 7)[changed];
        std::array<bool, face_count> marks = no_face;
        marks[changed] = true;
        FilteredCube::Faces faces;  // the other faces are not read
        faces[changed] = texels[changed];
        CHECK(kept.update(faces, marks));
        FilteredCube fresh(rule);
        CHECK(fresh.update(spans(texels), every_face));
        CHECK(same_bits(kept, fresh));
    }
}

void test_cancelled_work() {
    const FilterRule rule{.size = 64, .levels = 4, .irradiance_size = 16};
    const Texels first = noise(rule.size, 2);
    const Texels second = noise(rule.size, 3);
    FilteredCube kept(rule);
    FilteredCube before(rule);
    CHECK(kept.update(spans(first), every_face));
    CHECK(before.update(spans(first), every_face));
    CHECK(!kept.update(spans(second), every_face, [](double) { return false; }));
    CHECK(same_bits(kept, before));
    CHECK(kept.update(spans(second), no_face));
    FilteredCube fresh(rule);
    CHECK(fresh.update(spans(second), every_face));
    CHECK(same_bits(kept, fresh));
}

void test_wrong_faces() {
    FilteredCube cube({.size = 4, .levels = 3});
    bool refused = false;
    try {
        cube.update(spans(noise(5, 1)), every_face);
    } catch (const std::invalid_argument&) {
        refused = true;
    }
    CHECK(refused);
}

/// A plain bilinear lookup of a face with its border.
glm::vec4 look_up(std::span<const glm::vec4> bordered, int size, float s, float t) {
    const float x = s * static_cast<float>(size) + 0.5F;
    const float y = t * static_cast<float>(size) + 0.5F;
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const std::size_t side = static_cast<std::size_t>(size) + 2;
    const auto at = [&](std::size_t r, std::size_t c) { return bordered[r * side + c]; };
    const float along = x - static_cast<float>(column);
    const float down = y - static_cast<float>(row);
    return glm::mix(glm::mix(at(row, column), at(row, column + 1), along),
                    glm::mix(at(row + 1, column), at(row + 1, column + 1), along), down);
}

/// Lookups within borders are seamless: CubeMap::sample gives the same.
void test_borders(int size) {
    const Texels texels = noise(size, 4);
    FilteredLevel level{size, 0.5F, {}};
    for (const auto& face : texels) {
        level.texels.insert(level.texels.end(), face.begin(), face.end());
    }
    PixelBuffer pixels(level.texels.size() * sizeof(glm::vec4));
    std::memcpy(pixels.data(), level.texels.data(), pixels.size());
    const CubeMap cube(size, 4, DType::float32, std::move(pixels));
    const std::vector<glm::vec4> bordered = bordered_faces(level);
    const std::size_t side = static_cast<std::size_t>(size) + 2;
    CHECK_EQUAL(bordered.size(), face_count * side * side);
    for (const Face face : all_faces) {
        const std::span<const glm::vec4> own(bordered.data() + face_index(face) * side * side,
                                             side * side);
        for (const float s : {0.001F, 0.3F, 0.6F, 0.998F}) {
            for (const float t : {0.002F, 0.5F, 0.999F}) {
                const glm::vec3 direction = face_uv_to_direction<float>(face, s, t);
                glm::vec4 expected;
                cube.sample(&direction.x, 1, nullptr, 0, &expected.x);
                const glm::vec4 got = look_up(own, size, s, t);
                CHECK(glm::distance(got, expected) < 1e-3F * (1.0F + glm::length(expected)));
            }
        }
    }
}

}  // namespace

int main() {
    test_changed_faces({.size = 48, .levels = 6, .irradiance_size = 32});
    test_changed_faces({.size = 33, .levels = 3, .irradiance_size = 5});
    test_changed_faces({.size = 1, .levels = 2, .irradiance_size = 1});
    test_changed_faces({.size = 150, .levels = 2, .irradiance_size = 0});  // leaves of many texels
    test_cancelled_work();
    test_wrong_faces();
    for (const int size : {1, 2, 9}) test_borders(size);
    return test::result();
}
