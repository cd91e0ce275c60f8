#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

/// What glTF's extensions say of light in a body.
namespace cubecam {

/// By KHR_materials_volume, "Attenuation", white light becomes color^(x / distance) on a way of the
/// length x, which is exp(-x * extinction). Numbers end at 1e30, as that of black does, since
/// infinity times 0 would be NaN.
inline glm::vec3 extinction_of(const glm::vec3& color, float distance) {
    glm::vec3 extinction(0.0F);
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(distance)) continue;
        const float exact = color[i] > 0.0F ? -std::log(color[i]) / distance : 1e30F;
        extinction[i] = std::min(exact, 1e30F);
    }
    return extinction;
}

/// The ratio n_outside / n_inside for red, green and blue, by KHR_materials_dispersion,
/// "Implementation". An ior of 0 stands for infinity. Of a body that is thinner than what is around
/// it, which glTF does not have, the surroundings are dispersive.
inline glm::vec3 ratios_of_refraction(float ior, float dispersion) {
    if (ior == 0.0F) return glm::vec3(0.0F);
    const float denser = std::max(ior, 1.0F / ior);
    const float half_spread = (denser - 1.0F) * 0.025F * dispersion;
    const glm::vec3 iors =
        glm::max(glm::vec3(denser - half_spread, denser, denser + half_spread), glm::vec3(1.0F));
    return ior < 1.0F ? iors : 1.0F / iors;
}

}  // namespace cubecam
