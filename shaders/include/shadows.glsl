// Whether light reaches a point, from the shadow maps of the first SHADOW_COUNT lights. Percentage-closer filtering: W.
// Reeves, D. Salesin, R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987. Each texel under the
// filter is compared with the depth of the surface's own plane at that texel. A surface of any tilt then does not
// shadow itself, and needs no bias that would separate the shadow from its caster (receiver plane: J. Isidoro, "Shadow
// Mapping: GPU-based Tips and Techniques", GDC 2006).
#ifdef SHADOW_COUNT
struct ShadowMap {
    vec4 rows[3];  // from a position to the light's axes, z away from the light; for a cube, to the world's axes
    vec4 lens;     // the map contains x + y * z (parallel) or x + y / z; z: texels for a unit; w: texels of a side
    vec4 filter_;  // x: radius, texels; y: bias, world units
};

layout(std140, binding = 2) uniform Shadows {
    ShadowMap u_shadows[MAX_SHADOWS];
};
// The kind of a light, two bits of SHADOW_KINDS: 0: parallel rays, 1: one view, 2: six views. It is known at compile
// time, since llvmpipe runs both sides of a branch.
uint shadow_kind(int index) { return (SHADOW_KINDS >> (2 * index)) & 3u; }
layout(binding = SHADOW_UNIT) uniform sampler2DArray u_shadow_maps[SHADOW_COUNT];

// The triangle of the fragment. It is computed once, before any branch: derivatives need the values of neighbour
// fragments.
vec3 facet_normal;   // unit length, on the side of the shading normal
float facet_height;  // the height above it of the rounded surface that the shading normals describe

// `height` interpolates dot(position, normal) of the corners, `normal` is of any length.
void find_facet(vec3 position, vec3 normal, float height) {
    vec3 x = dFdx(position);
    vec3 y = dFdy(position);
    vec3 size = max(abs(x), abs(y));
    float scale = 1.0 / max(max(size.x, size.y), max(size.z, 1e-30));
    vec3 across = cross(x * scale, y * scale);
    float length_squared = dot(across, across);
    facet_normal = length_squared > 1e-12 ? across * inversesqrt(length_squared) : normalize(normal);
    if (dot(facet_normal, normal) < 0.0) facet_normal = -facet_normal;
    // The mean of the corners' tangent planes, as in T. Boubekeur and M. Alexa, "Phong Tessellation", 2008, minus the
    // error that rounding may cause.
    float size_squared = max(dot(normal, normal), 1e-36);
    facet_height = max((height - dot(position, normal)) * inversesqrt(size_squared) - 1e-6 * length(position), 0.0);
}

// Converts to the axes of a cube's face (cpp/cubecam/math/cube_face.hpp). `axis` is 0 to 2, `s` is the sign.
vec3 to_face(vec3 v, int axis, float s) {
    return axis == 0 ? vec3(-s * v.z, -v.y, s * v.x)
                     : axis == 1 ? vec3(v.x, s * v.z, s * v.y) : vec3(s * v.x, -v.y, s * v.z);
}
#endif

// The share of light `index` that reaches a point, from 0 to 1. `position` has the fragment's origin of positions;
// `normal` has unit length and lies on the lit side.
float light_visibility(int index, vec3 position, vec3 normal) {
#ifndef SHADOW_COUNT
    return 1.0;
#else
    if (index >= SHADOW_COUNT) return 1.0;
    ShadowMap map = u_shadows[index];
    bool parallel = shadow_kind(index) == 0u;
    mat3 turn = transpose(mat3(map.rows[0].xyz, map.rows[1].xyz, map.rows[2].xyz));
    vec3 place = turn * position + vec3(map.rows[0].w, map.rows[1].w, map.rows[2].w);

    // A facet may face away from a light that its shading normals still face, as on a coarse sphere along the
    // terminator. The rounded surface then replaces the facet: otherwise each facet would be visible.
    vec3 plane = turn * facet_normal;
    vec3 ray = parallel ? vec3(0.0, 0.0, 1.0) : place;
    if (dot(plane, ray) >= 0.0 && facet_height > 0.0) {
        plane = turn * normal;
        place += facet_height * plane;
        if (!parallel) ray = place;
    }

    int layer = 0;
    if (shadow_kind(index) == 2u) {
        vec3 size = abs(place);
        int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        float s = place[axis] >= 0.0 ? 1.0 : -1.0;
        layer = 2 * axis + (s < 0.0 ? 1 : 0);
        place = to_face(place, axis, s);
        plane = to_face(plane, axis, s);
        ray = place;
    }
    float z = place.z;
    if (!parallel && z < 1e-30) return 1.0;

    // The depth here, and its increase along the plane for a texel to the right and for a texel up.
    float inverse_z = parallel ? 1.0 : 1.0 / z;
    vec2 texel = place.xy * inverse_z * map.lens.z + 0.5 * map.lens.w;
    float scale = abs(map.lens.y);
    float depth = map.lens.x + map.lens.y * (parallel ? z : inverse_z);
    float towards = dot(plane, ray);
    towards = (towards > 0.0 ? 1.0 : -1.0) * max(abs(towards), 0.02 * length(ray));
    vec2 slope = scale * plane.xy / (towards * map.lens.z);

    // The bias is a part of a texel's width, since the neighbour triangle has another plane, plus the errors of float
    // arithmetic and of vertices snapped to 1/256 texel.
    float width = 1.0 / (map.lens.z * inverse_z);
    float half_width = map.filter_.x + 0.5;
    float bias = (0.25 + 0.25 * half_width) * width / (abs(towards) * inverse_z);
    bias += map.filter_.y + 1e-6 * (length(place) + length(position));
    float bias_depth = scale * bias * (parallel ? 1.0 : inverse_z / max(z - bias, 0.1 * z));
    bias_depth += (abs(slope.x) + abs(slope.y)) / 128.0;

    // The filter is a box, 2 * radius + 1 texels wide, so the share is a continuous function of the position. Texels
    // count from the first one of the box: small numbers keep the weights precise. Lookups beyond the map read its
    // border, which is empty.
    texel = clamp(texel, -half_width - 1.0, map.lens.w + half_width + 1.0);
    vec2 first = floor(texel - half_width);
    vec2 start = texel - half_width - first;
    vec2 end = start + 2.0 * half_width;
    vec4 to_corners = 0.5 * vec4(slope.y - slope.x, slope.x + slope.y, slope.x - slope.y, -slope.x - slope.y);
    int count = int(ceil(2.0 * map.filter_.x)) + 2;
    float lit = 0.0;
    for (int j = 0; j < count; j += 2) {
        for (int i = 0; i < count; i += 2) {
            // Four texels round a corner, in the order of the GLSL specification, section 8.9.4: upper left, upper
            // right, lower right, lower left.
            vec2 corner = vec2(i, j) + 1.0;
            vec4 held = textureGather(u_shadow_maps[index], vec3((first + corner) / map.lens.w, float(layer)));
            // If the plane falls away from the light, the depth here is used: a wall that meets the surface there would
            // shadow it.
            vec4 there = dot(corner - start - half_width, slope) + to_corners;
            vec4 reached = vec4(lessThanEqual(held, max(depth + max(there, 0.0) + bias_depth, 0.0)));
            vec2 x = max(min(corner.xx + vec2(0.0, 1.0), end.xx) - max(corner.xx - vec2(1.0, 0.0), start.xx), 0.0);
            vec2 y = max(min(corner.yy + vec2(0.0, 1.0), end.yy) - max(corner.yy - vec2(1.0, 0.0), start.yy), 0.0);
            lit += y.y * dot(reached.xy, x) + y.x * dot(reached.wz, x);
        }
    }
    return min(lit / (4.0 * half_width * half_width), 1.0);
#endif
}
