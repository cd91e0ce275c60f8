// A point of the surface, with all maps looked up.
struct Point {
    vec3 from_origin;        // world, relative to u_origin
    vec3 normal;             // unit length, of the normal map
    vec3 geometric_normal;   // unit length, of the mesh
    vec3 view;               // unit length, from the surface to the eye
    float n_dot_v;           // from LEAST_COSINE to 1
    vec3 color;              // base colour
    float metallic;
    float roughness;
    float alpha;             // the square of the roughness
    vec3 f0;                 // of the dielectric
    float f90;
    float occlusion;         // the factor of light from all around
    vec3 emission;
#ifdef ANISOTROPY
    vec3 tangent;            // unit length, the direction in which highlights are stretched
    vec3 bitangent;
    float anisotropy;
    float alpha_along;       // the alpha along the tangent
#endif
#ifdef CLEARCOAT
    vec3 coat_normal;
    float coat_n_dot_v;
    float coat_roughness;
    float coat;              // the share of what the coat reflects
#endif
#ifdef SHEEN
    vec3 sheen_color;
    float sheen_roughness;
    float sheen_albedo;      // of white sheen in the direction of the eye
#endif
#ifdef IRIDESCENCE
    float iridescence;
    float film_thickness;    // nanometres
#endif
#ifdef TRANSMISSION
    float transmission;
    float thickness;
#endif
};

const float LEAST_COSINE = 1e-4;

float cosine_to_eye(vec3 normal, vec3 view) { return clamp(dot(normal, view), LEAST_COSINE, 1.0); }

#ifdef SHEEN
void read_sheen(Surface surface, inout Point point) {
    point.sheen_color = SHEEN_COLOR;
#ifdef HAS_SHEEN_COLOR_MAP
    point.sheen_color *= looked_up(u_sheen_color_map, SHEEN_COLOR_MAP).rgb;
#endif
    point.sheen_roughness = SHEEN_ROUGHNESS;
#ifdef HAS_SHEEN_ROUGHNESS_MAP
    point.sheen_roughness *= looked_up(u_sheen_roughness_map, SHEEN_ROUGHNESS_MAP).a;
#endif
    point.sheen_albedo = brdf_terms(point.n_dot_v, point.sheen_roughness).z;
}
#endif

#ifdef CLEARCOAT
// KHR_materials_clearcoat, "Layering", with an index of refraction of 1.5.
void read_coat(Surface surface, inout Point point) {
    point.coat_normal = surface.normal;
#ifdef HAS_CLEARCOAT_NORMAL_MAP
    vec3 texel = looked_up(u_clearcoat_normal_map, CLEARCOAT_NORMAL_MAP).xyz;
    point.coat_normal = mapped_normal(surface, texel, COAT_NORMAL_SCALE);
#endif
    point.coat_n_dot_v = cosine_to_eye(point.coat_normal, point.view);
    point.coat_roughness = COAT_ROUGHNESS;
#ifdef HAS_CLEARCOAT_ROUGHNESS_MAP
    point.coat_roughness *= looked_up(u_clearcoat_roughness_map, CLEARCOAT_ROUGHNESS_MAP).g;
#endif
    point.coat = COAT * (0.04 + 0.96 * schlick_weight(point.coat_n_dot_v));
#ifdef HAS_CLEARCOAT_MAP
    point.coat *= looked_up(u_clearcoat_map, CLEARCOAT_MAP).r;
#endif
}
#endif

#ifdef ANISOTROPY
// KHR_materials_anisotropy, "Anisotropy" and "Individual lights".
void read_anisotropy(Surface surface, inout Point point) {
    vec2 direction = ANISOTROPY_TURN;
    point.anisotropy = ANISOTROPY_STRENGTH;
#ifdef HAS_ANISOTROPY_MAP
    vec3 texel = looked_up(u_anisotropy_map, ANISOTROPY_MAP).rgb;
    vec2 along = texel.rg * 2.0 - 1.0;
    float length_squared = dot(along, along);
    along = length_squared > 0.0 ? along * inversesqrt(length_squared) : vec2(1.0, 0.0);
    direction = vec2(direction.x * along.x - direction.y * along.y, direction.y * along.x + direction.x * along.y);
    point.anisotropy *= texel.b;
#endif
    vec3 bitangent = surface.tangent.w * cross(surface.normal, surface.tangent.xyz);
    vec3 tangent = direction.x * surface.tangent.xyz + direction.y * bitangent;
    tangent -= dot(tangent, point.normal) * point.normal;
    point.tangent = tangent * inversesqrt(max(dot(tangent, tangent), 1e-36));
    point.bitangent = cross(point.normal, point.tangent);
    point.alpha_along = mix(point.alpha, 1.0, point.anisotropy * point.anisotropy);
}
#endif

Point point_of(Surface surface, vec3 color) {
    Point point;
    point.from_origin = surface.from_origin;
    point.geometric_normal = surface.normal;
    point.view = -surface.incident;
    point.normal = surface.normal;
#ifdef HAS_NORMAL_MAP
    point.normal = mapped_normal(surface, looked_up(u_normal_map, NORMAL_MAP).xyz, NORMAL_SCALE);
#endif
    point.n_dot_v = cosine_to_eye(point.normal, point.view);
    point.color = color;
    point.metallic = METALLIC;
    point.roughness = ROUGHNESS;
#ifdef HAS_METALLIC_ROUGHNESS_MAP
    vec3 texel = looked_up(u_metallic_roughness_map, METALLIC_ROUGHNESS_MAP).rgb;
    point.roughness *= texel.g;
    point.metallic *= texel.b;
#endif
    point.roughness = clamp(point.roughness, 0.0, 1.0);
    point.alpha = point.roughness * point.roughness;

    // KHR_materials_specular, "Implementation".
    point.f90 = SPECULAR_WEIGHT;
#ifdef HAS_SPECULAR_MAP
    point.f90 *= looked_up(u_specular_map, SPECULAR_MAP).a;
#endif
    point.f0 = DIELECTRIC_F0;
#ifdef HAS_SPECULAR_COLOR_MAP
    point.f0 *= looked_up(u_specular_color_map, SPECULAR_COLOR_MAP).rgb;
#endif
    point.f0 = min(point.f0, 1.0) * point.f90;

    point.occlusion = 1.0;
#ifdef HAS_OCCLUSION_MAP
    point.occlusion = 1.0 + OCCLUSION_STRENGTH * (looked_up(u_occlusion_map, OCCLUSION_MAP).r - 1.0);
#endif
    point.emission = vec3(0.0);
#ifdef EMISSION
    point.emission = EMISSIVE;
#ifdef HAS_EMISSIVE_MAP
    point.emission *= looked_up(u_emissive_map, EMISSIVE_MAP).rgb;
#endif
#endif
#ifdef ANISOTROPY
    read_anisotropy(surface, point);
#endif
#ifdef CLEARCOAT
    read_coat(surface, point);
#endif
#ifdef SHEEN
    read_sheen(surface, point);
#endif
#ifdef IRIDESCENCE
    point.iridescence = IRIDESCENCE_SHARE;
#ifdef HAS_IRIDESCENCE_MAP
    point.iridescence *= looked_up(u_iridescence_map, IRIDESCENCE_MAP).r;
#endif
    point.film_thickness = IRIDESCENCE_THICKNESS.y;
#ifdef HAS_IRIDESCENCE_THICKNESS_MAP
    float share = looked_up(u_iridescence_thickness_map, IRIDESCENCE_THICKNESS_MAP).g;
    point.film_thickness = mix(IRIDESCENCE_THICKNESS.x, IRIDESCENCE_THICKNESS.y, share);
#endif
#endif
#ifdef TRANSMISSION
    point.transmission = TRANSMISSION_SHARE;
#ifdef HAS_TRANSMISSION_MAP
    point.transmission *= looked_up(u_transmission_map, TRANSMISSION_MAP).r;
#endif
    point.thickness = THICKNESS;
#ifdef HAS_THICKNESS_MAP
    point.thickness *= looked_up(u_thickness_map, THICKNESS_MAP).g;
#endif
#endif
    return point;
}
