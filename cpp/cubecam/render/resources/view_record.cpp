#include "cubecam/render/resources/view_record.hpp"

namespace cubecam {

ViewRecord make_view_record(const View& view, const glm::dmat4& matrix, const glm::dvec3& origin,
                            std::size_t layer) {
    ViewRecord instance;
    instance.matrix = glm::mat4(matrix);
    instance.eye =
        view.parallel ? glm::vec4(view.forward, 1.0F) : glm::vec4(view.eye - origin, 0.0F);
    instance.position = glm::vec4(view.position - origin, view.near);
    instance.forward = glm::vec4(view.forward, static_cast<float>(layer));
    return instance;
}

glm::dmat4 reverse_depth(glm::dmat4 to_clip) {
    for (int column = 0; column < 4; ++column) {
        glm::dvec4& c = to_clip[column];
        c.z = 0.5 * (c.w - c.z);
    }
    return to_clip;
}

}  // namespace cubecam
