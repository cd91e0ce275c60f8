// Light from all around, of a grid of places at which it was captured (cpp/cubecam/scene/probe_grid.hpp,
// docs/adr/0031-probe-grids.md). Z. Majercik et al., "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance
// Fields", JCGT 8(2), 2019. python/cubecam/truth/shading/probe_grid.py is the same in numpy.
#ifdef PROBE_GRID
layout(binding = 64) uniform sampler2D u_grid_light;      // nine texels for each node; [0].a: it is active
layout(binding = 65) uniform sampler2D u_grid_distances;  // an octahedral map for each node, with a border of one texel
layout(std140, binding = 13) uniform ProbeGrid {
    vec4 u_grid_first;   // xyz: the first node, relative to u_origin; w: normal bias, world units
    vec4 u_grid_step;    // xyz: from node to node; w: view bias, world units
    ivec4 u_grid_counts;  // xyz: nodes; w: texels along an edge of an octahedral map
};

// Irradiance over pi round a normal: spherical harmonics, whose factors are in the texels. Below 0 counts as 0.
vec3 grid_node_light(ivec3 node, vec3 n) {
    ivec2 at = ivec2(9 * node.x, node.y + u_grid_counts.y * node.z);
    vec3 light = texelFetch(u_grid_light, at, 0).rgb;
    light += n.y * texelFetch(u_grid_light, at + ivec2(1, 0), 0).rgb;
    light += n.z * texelFetch(u_grid_light, at + ivec2(2, 0), 0).rgb;
    light += n.x * texelFetch(u_grid_light, at + ivec2(3, 0), 0).rgb;
    light += n.x * n.y * texelFetch(u_grid_light, at + ivec2(4, 0), 0).rgb;
    light += n.y * n.z * texelFetch(u_grid_light, at + ivec2(5, 0), 0).rgb;
    light += (3.0 * n.z * n.z - 1.0) * texelFetch(u_grid_light, at + ivec2(6, 0), 0).rgb;
    light += n.x * n.z * texelFetch(u_grid_light, at + ivec2(7, 0), 0).rgb;
    light += (n.x * n.x - n.y * n.y) * texelFetch(u_grid_light, at + ivec2(8, 0), 0).rgb;
    return max(light, vec3(0.0));
}

#ifdef PROBE_GRID_VISIBILITY
// The place of a direction in an octahedral map, from -1 to 1: Z. Cigolle et al., "A Survey of Efficient Representations
// for Independent Unit Vectors", JCGT 3(2), 2014.
vec2 octahedral(vec3 d) {
    vec2 p = d.xy / (abs(d.x) + abs(d.y) + abs(d.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return d.z < 0.0 ? folded : p;
}

// How much a node counts at a place: by the side of the surface on which it lies, and by whether it sees the place.
float grid_weight(ivec3 node, vec3 to_node, vec3 normal, vec3 bias) {
    float facing = 0.5 * (dot(to_node * inversesqrt(max(dot(to_node, to_node), 1e-20)), normal) + 1.0);
    float weight = facing * facing + 0.2;
    vec3 from_node = bias - to_node;
    float way = length(from_node);
    float edge = float(u_grid_counts.w);
    vec2 at = (0.5 * octahedral(from_node / max(way, 1e-10)) + 0.5) * edge + 1.0;
    at += (edge + 2.0) * vec2(node.x, node.y + u_grid_counts.y * node.z);
    vec2 moments = textureLod(u_grid_distances, at / vec2(textureSize(u_grid_distances, 0)), 0.0).rg;
    // Chebyshev's inequality: the share of what lies farther away than the place.
    float variance = abs(moments.x * moments.x - moments.y);
    float behind = max(way - moments.x, 0.0);
    float seen = variance / max(variance + behind * behind, 1e-20);
    weight *= way <= moments.x ? 1.0 : seen * seen * seen;
    weight = max(weight, 1e-6);
    // Little light is seen well: small weights become smaller.
    return weight < 0.2 ? weight * weight * weight / 0.04 : weight;
}
#endif

// The light of the grid in the place of that of the environment: in the grid and up to one cell outside of it, since nodes
// stand before walls. From there to the second cell it fades to the latter.
vec3 or_probe_grid(vec3 light, vec3 normal_world) {
    vec3 normal = normal_world * inversesqrt(max(dot(normal_world, normal_world), 1e-20));
    vec3 place = (v_position - u_grid_first.xyz) / u_grid_step.xyz;
    vec3 within = clamp(place, vec3(0.0), vec3(u_grid_counts.xyz - 1));
    float outside = length(place - within);  // in cells
    ivec3 first = min(ivec3(within), u_grid_counts.xyz - 2);
    vec3 alpha = within - vec3(first);
    vec3 incident = v_eye.w == 0.0 ? normalize(v_position - v_eye.xyz) : v_eye.xyz;
    vec3 bias = u_grid_first.w * normal - u_grid_step.w * incident;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i, i >> 1, i >> 2) & 1;
        ivec3 node = first + corner;
        vec3 parts = mix(1.0 - alpha, alpha, vec3(corner));
        float weight = parts.x * parts.y * parts.z;
        bool awake = texelFetch(u_grid_light, ivec2(9 * node.x, node.y + u_grid_counts.y * node.z), 0).a > 0.5;
#ifdef PROBE_GRID_VISIBILITY
        vec3 to_node = u_grid_first.xyz + vec3(node) * u_grid_step.xyz - v_position;
        weight *= awake ? grid_weight(node, to_node, normal, bias) : 2.5e-17;
#else
        weight *= awake ? 1.0 : 2.5e-17;
#endif
        sum += weight * grid_node_light(node, normal);
        weights += weight;
    }
    return mix(sum / max(weights, 1e-30), light, smoothstep(1.0, 2.0, outside));
}
#else
#define or_probe_grid(light, normal_world) light
#endif
