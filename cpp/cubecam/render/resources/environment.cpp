#include "cubecam/render/resources/environment.hpp"

#include <bit>

namespace cubecam {

void Environment::add_to(std::vector<std::uint64_t>& key) const {
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
    if (filtered != nullptr) key.push_back(filtered->revision());
    if (!placing.is_plain()) {
        for (int i = 0; i < 4; ++i) add_number(placing.rotation[i]);
        add_number(static_cast<double>(placing.intensity));
    }
    key.push_back(static_cast<std::uint64_t>(levels));
    key.push_back(static_cast<std::uint64_t>(level_count));
    key.push_back(position.has_value() ? 1 : 0);
    if (!position) return;
    for (int axis = 0; axis < 3; ++axis) add_number((*position)[axis]);
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
    return block;
}

}  // namespace cubecam
