#include "cubecam/render/resources/environment.hpp"

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <bit>

namespace cubecam {

namespace {

/// Adds the values of one environment, without those that it is blended with.
void add_alone(const Environment& environment, std::vector<std::uint64_t>& key) {
    const BoundTexture& cube = environment.cube;
    const EnvironmentPlacing& placing = environment.placing;
    const std::optional<glm::dvec3>& position = environment.position;
    const LocalLookup& local = environment.local;
    const PlanarReflection& planar = environment.planar;
    const auto add_number = [&key](double value) {
        key.push_back(std::bit_cast<std::uint64_t>(value));
    };
    if (planar.picture.texture != 0) {
        key.push_back(planar.picture.revision);
        for (int axis = 0; axis < 3; ++axis) add_number(planar.normal[axis]);
        add_number(planar.distance);
    }
    key.push_back(cube.revision);
    if (cube.texture == 0) return;
    if (environment.filtered != nullptr) key.push_back(environment.filtered->revision());
    if (!placing.is_plain()) {
        for (int i = 0; i < 4; ++i) add_number(placing.rotation[i]);
        add_number(static_cast<double>(placing.intensity));
    }
    key.push_back(static_cast<std::uint64_t>(environment.levels));
    key.push_back(static_cast<std::uint64_t>(environment.level_count));
    key.push_back(position.has_value() ? 1 : 0);
    if (!position) return;
    for (int axis = 0; axis < 3; ++axis) add_number((*position)[axis]);
    key.push_back(static_cast<std::uint64_t>(local.method));
    if (local.by_proxy()) {
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) add_number(local.to_proxy[column][row]);
        }
    }
    if (local.by_distance()) {
        key.push_back(local.distances.revision);
        key.push_back(static_cast<std::uint64_t>(local.fetches));
    }
}

}  // namespace

void Environment::add_to(std::vector<std::uint64_t>& key) const {
    add_alone(*this, key);
    if (blend == nullptr) return;
    for (const Influence& influence : blend->influences) {
        key.push_back(influence.everywhere ? 2 : (influence.sphere ? 1 : 0));
        if (influence.everywhere) continue;
        key.push_back(std::bit_cast<std::uint64_t>(influence.blend_distance));
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                key.push_back(std::bit_cast<std::uint64_t>(influence.to_box[column][row]));
            }
        }
    }
    for (const Environment& other : blend->others) add_alone(other, key);
}

EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin) {
    EnvironmentBlock block;
    if (environment.position) block.position = glm::vec4(*environment.position - origin, 1.0F);
    block.levels.x = environment.cube.texture == 0 ? 0 : environment.level_count;
    const glm::mat3 to_world = glm::mat3(glm::mat3_cast(environment.placing.rotation));
    for (int row = 0; row < 3; ++row) block.turn[row] = glm::vec4(to_world[row], 0.0F);
    block.turn[0].w = environment.placing.intensity;
    block.planar = glm::vec4(environment.planar.normal, environment.planar.distance);
    if (environment.filtered != nullptr) {
        block.texel = glm::vec4(environment.filtered->texel(), 0.0F, 0.0F);
        block.places = environment.filtered->places();
    }
    const LocalLookup& local = environment.local;
    const glm::dmat4 to_proxy = glm::translate(local.to_proxy, origin);
    for (int row = 0; row < 3; ++row) block.proxy[row] = glm::vec4(glm::row(to_proxy, row));
    if (local.by_distance()) {
        block.distances = {1.0F / static_cast<float>(distances_width(local.size)),
                           1.0F / static_cast<float>(distances_height(local.size)),
                           static_cast<float>(local.size), 0.0F};
    }
    return block;
}

InfluencesBlock make_influences_block(const EnvironmentBlend& blend, const glm::dvec3& origin) {
    InfluencesBlock block;
    for (std::size_t i = 0; i < blend.influences.size(); ++i) {
        const Influence& influence = blend.influences[i];
        if (influence.everywhere) continue;  // zeros: the middle of the box is everywhere
        InfluencesBlock::One& one = block.influences[i];
        const glm::dmat4 to_box = glm::translate(influence.to_box, origin);
        for (int row = 0; row < 3; ++row) {
            one.to_box[row] = glm::vec4(glm::row(to_box, row));
            one.from_box[row] = glm::vec4(glm::dvec3(glm::row(influence.from_box, row)), 0.0);
        }
        one.from_box[0].w = static_cast<float>(1.0 / influence.blend_distance);
        one.from_box[1].w = influence.sphere ? 1.0F : 0.0F;
    }
    return block;
}

}  // namespace cubecam
