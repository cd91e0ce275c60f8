#include "cubecam/render/passes/shadow_block.hpp"

namespace cubecam {

ShadowBlock make_shadow_block(const ShadowUse& use, const glm::dvec3& origin) {
    const ShadowView& view = use.view;
    ShadowBlock block;
    for (int row = 0; row < 3; ++row) {
        const glm::dvec3 axis(view.to_light[0][row], view.to_light[1][row], view.to_light[2][row]);
        const glm::dvec3& place = view.views.front().position;
        // The position counts from the light, not from the world's origin, so that no large numbers
        // cancel. A parallel view lies on the near plane, where z is also 0.
        block.rows[row] = glm::vec4(axis, glm::dot(axis, origin - place));
    }
    block.lens = glm::vec4(view.offset, view.scale, view.texels, use.shadow.size);
    block.filter = glm::vec4(use.shadow.radius, use.shadow.bias, 0.0F, 0.0F);
    return block;
}

}  // namespace cubecam
