/// Mirrors and glass: the formulas of the shaders, for scalars of any precision.
///
/// `incident` points towards the surface, `normal` away from it, to the side that the light comes
/// from; both are unit vectors in one space. Results point away from the surface.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace cubecam {

/// I - 2 (N.I) N (GLSL 4.60 section 8.5). Either sign of the normal gives the same.
template <typename T>
glm::vec<3, T> reflect(const glm::vec<3, T>& incident, const glm::vec<3, T>& normal) {
    return incident - 2 * glm::dot(normal, incident) * normal;
}

/// Snell's law; eta = n_outside / n_inside, outside being the normal's side. (0, 0, 0) where all is
/// reflected (GLSL 4.60 section 8.5).
template <typename T>
glm::vec<3, T> refract(const glm::vec<3, T>& incident, const glm::vec<3, T>& normal, T eta) {
    const T cosine = glm::dot(normal, incident);  // negative: they face each other
    const T k = 1 - eta * eta * (1 - cosine * cosine);
    if (k < 0) return glm::vec<3, T>(0);
    return eta * incident - (eta * cosine + std::sqrt(k)) * normal;
}

/// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994: what a surface that
/// reflects `f0` head-on reflects at this cosine between the normal and the way back (-incident).
template <typename T>
T schlick(T cos_incident, T f0) {
    const T rest = 1 - cos_incident;
    return f0 + (1 - f0) * (rest * rest * rest * rest * rest);
}

/// The unpolarised reflectance of a smooth dielectric, by Fresnel's equations (Pharr, Jakob,
/// Humphreys, "Physically Based Rendering", 4th ed., section 9.3.5); 1 where all is reflected.
/// cos_incident = -N.I, 0 to 1; eta = n_outside / n_inside.
template <typename T>
T fresnel_dielectric(T cos_incident, T eta) {
    const T cos2_transmitted = 1 - eta * eta * (1 - cos_incident * cos_incident);
    if (cos2_transmitted <= 0) return 1;  // 0: grazing, where both amplitudes are 1 (or 0/0)
    const T cos_transmitted = std::sqrt(cos2_transmitted);
    const T rs = (eta * cos_incident - cos_transmitted) / (eta * cos_incident + cos_transmitted);
    const T rp = (cos_incident - eta * cos_transmitted) / (cos_incident + eta * cos_transmitted);
    return (rs * rs + rp * rp) / 2;
}

}  // namespace cubecam
