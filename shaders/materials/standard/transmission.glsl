// KHR_materials_transmission and KHR_materials_volume: the light that passes through the surface, from the scene behind.
#ifdef TRANSMISSION
#include "include/behind.glsl"

// The light from behind along the way that `eta` bends, with the attenuation of the volume (KHR_materials_volume,
// "Attenuation").
vec3 light_behind(Point point, float eta) {
    float roughness = point.roughness * TRANSMISSION_BLUR;
#ifdef VOLUME
    vec3 direction = point.thickness > 0.0 ? refract(-point.view, point.normal, eta) : -point.view;
    vec3 way = direction * point.thickness * v_scale;
    return scene_behind(point.from_origin + way, direction, roughness) * exp(-EXTINCTION * min(length(way), 1e30));
#else
    return scene_behind(point.from_origin, -point.view, roughness);
#endif
}

vec3 transmitted(Point point) {
#ifdef DISPERSION
    // KHR_materials_dispersion: each colour has its own index of refraction.
    vec3 etas = ETAS;
    return vec3(light_behind(point, etas.r).r, light_behind(point, etas.g).g, light_behind(point, etas.b).b);
#else
    return light_behind(point, ETAS.g);
#endif
}
#endif
