#include "cubecam/render/resources/environment.hpp"

#include <bit>

namespace cubecam {

void Environment::add_to(std::vector<std::uint64_t>& key) const {
    key.push_back(cube.revision);
    if (cube.texture == 0) return;
    key.push_back(static_cast<std::uint64_t>(levels));
    key.push_back(static_cast<std::uint64_t>(level_count));
    key.push_back(position.has_value() ? 1 : 0);
    if (!position) return;
    for (int axis = 0; axis < 3; ++axis) {
        key.push_back(std::bit_cast<std::uint64_t>((*position)[axis]));
    }
}

EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin) {
    EnvironmentBlock block;
    if (environment.position) block.position = glm::vec4(*environment.position - origin, 1.0F);
    block.levels.x = environment.cube.texture == 0 ? 0 : environment.level_count;
    return block;
}

}  // namespace cubecam
