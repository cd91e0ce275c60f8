#include "cubecam/render/resources/environment.hpp"

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

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

}  // namespace cubecam
