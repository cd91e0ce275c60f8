// Draws every mesh. This file has the common part; the part of a material is in its own file.
#define STAGE in
#ifdef USER_SOURCE
#include "include/node.glsl"
#endif
#if defined(USES_LIGHTS) || defined(USER_SOURCE)
#include "include/lights.glsl"
#endif
#include "include/constants.glsl"
#include "include/surface.glsl"

struct Surface {
    vec3 from_origin;      // world, relative to u_origin
    vec3 position_object;  // with USES_POSITION_OBJECT: for materials that show a cubemap
    vec3 normal;           // world, unit length, towards the viewer on double-sided surfaces
    vec3 incident;         // world, unit length, from the eye to the surface
    vec2 uv;               // with USES_UV: for materials that show a map
    vec4 color;            // the vertices' colour; white if the mesh has none or the material ignores it
#if defined(USES_UV1) || defined(USER_SOURCE)
    vec2 uv1;  // the second set
#endif
#if defined(USES_TANGENT) || defined(USER_SOURCE)
    vec4 tangent;  // xyz: world, unit length, along +u; w: 1 or -1, and w * cross(normal, xyz) is along +v
#endif
#ifdef USER_SOURCE
    vec3 position;       // world
    vec3 normal_object;  // any length
#endif
};

#if defined(USES_ENVIRONMENT) || defined(USER_SOURCE)
#include "include/environment.glsl"
#endif
#if defined(USES_LIGHTS) || defined(USER_SOURCE)
#include "include/shadows.glsl"
#endif
#include "include/material.glsl"

// shade() may return a colour, or a colour and an alpha.
vec4 with_alpha(vec3 color) { return vec4(color, 1.0); }
vec4 with_alpha(vec4 color) { return color; }

layout(location = 0) out vec4 o_color;
#ifdef OUTPUTS
// `o_<name>` of each row of output_table (cpp/cubecam/render/resources/outputs.hpp): an output of the program if it is
// requested, otherwise a variable.
OUTPUT_DECLARATIONS
#endif

void main() {
#ifdef USER_SOURCE
    cubecam_zeros();
#endif
#ifdef OUTPUT_ZEROS
    OUTPUT_ZEROS  // for the outputs that users' sources declare
#endif
    Surface surface;
    surface.from_origin = v_position;
    surface.position_object = vec3(0.0);
#if defined(USES_POSITION_OBJECT) || defined(USER_SOURCE)
    surface.position_object = v_position_object;
#endif
    // A mesh may have normals of length 0; they must not become NaN.
    float length_squared = dot(v_normal, v_normal);
    surface.normal = length_squared > 0.0 ? v_normal * inversesqrt(length_squared) : vec3(0.0);
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) surface.normal = -surface.normal;
#endif
#ifdef SHADOW_COUNT
    float side = dot(surface.normal, v_normal) < 0.0 ? -1.0 : 1.0;
    find_facet(v_position, side * v_normal, side * v_height);
#endif
    surface.incident = v_eye.w == 0.0 ? normalize(v_position - v_eye.xyz) : v_eye.xyz;
    surface.uv = vec2(0.0);
#if defined(USES_UV) || defined(USER_SOURCE)
    surface.uv = v_uv;
#endif
#ifdef USER_SOURCE
    surface.uv1 = vec2(0.0);
    surface.tangent = vec4(0.0);
#endif
#ifdef USES_UV1
    surface.uv1 = v_uv1;
#endif
#ifdef USES_TANGENT
    float tangent_squared = dot(v_tangent.xyz, v_tangent.xyz);
    surface.tangent.xyz = tangent_squared > 0.0 ? v_tangent.xyz * inversesqrt(tangent_squared) : vec3(0.0);
    surface.tangent.w = v_tangent.w < 0.0 ? -1.0 : 1.0;
#ifdef DOUBLE_SIDED
    // The whole frame is turned, so that a bump is a dent on the other side.
    if (!gl_FrontFacing) surface.tangent = -surface.tangent;
#endif
#endif
    surface.color = vec4(1.0);
#ifdef HAS_VERTEX_COLORS
    surface.color = v_color;
#endif
#ifdef USER_SOURCE
    surface.position = v_position + u_origin.xyz;
    surface.normal_object = v_normal_object;
#endif

#ifdef USER_SOURCE
    // The condition always holds, but compilers do not know it. Without it, all that follows a loop without an end is
    // dead code, and the outputs show what was in memory.
    vec4 shaded = vec4(0.0);
    if (u_node_id >= 0) shaded = with_alpha(shade(surface));
#else
    vec4 shaded = with_alpha(shade(surface));
#endif
    o_color.rgb = shaded.rgb;
#ifdef TRANSLUCENT
    o_color.a = shaded.a * v_alpha;
#else
    o_color.a = 1.0;
#endif
    // The changes of the colour that the blending in raster_state.cpp needs.
#if defined(BLEND_ADDITIVE)
    o_color.rgb *= o_color.a;
#elif defined(BLEND_MULTIPLY)
    o_color.rgb = mix(vec3(1.0), o_color.rgb, o_color.a);
#elif defined(BLEND_PREMULTIPLIED)
    o_color.rgb *= v_alpha;
#endif
#ifdef OUTPUTS
    vec3 from_view = v_position - v_view_position.xyz;
    float z = dot(from_view, v_view_forward);
    o_z = z;
    o_distance = v_eye.w == 0.0 ? length(from_view) : z - v_view_position.w;
    o_normal = surface.normal;
    o_position = v_position + v_origin;
    o_id = v_id_and_label.x;
    o_label = v_id_and_label.y;
#endif
}
