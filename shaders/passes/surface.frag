// Every mesh: what is common here, what a material answers in its own file.
#define STAGE in
#include "include/draw.glsl"
#include "include/lights.glsl"
#include "include/surface.glsl"

struct Surface {
    vec3 from_origin;      // world, from u_origin
    vec3 position_object;  // with HAS_CUBE
    vec3 normal;           // world, unit length, towards the viewer on double-sided surfaces
    vec3 incident;         // world, unit length, from the eye to the surface
    vec3 tint;             // map times vertex colour
#ifdef MATERIAL_SHADER
    vec3 position;       // world
    vec3 normal_object;  // any length
    vec2 uv;
    vec4 color;  // the vertices', white where the mesh has none
#endif
};

#include "include/environment.glsl"
#include "include/shadows.glsl"
#include "materials/basic.glsl"
#include "materials/phong.glsl"
#include "materials/mirror.glsl"
#include "materials/glass.glsl"
#include "include/scene.glsl"

#ifdef HAS_MAP
layout(binding = 0) uniform sampler2D u_map;
#endif

layout(location = 0) out vec4 o_color;
#ifdef OUTPUTS
// `o_<name>` of each row of output_table (cpp/cubecam/render/resources/outputs.hpp): an output of the program where it
// is requested, else a variable.
OUTPUT_DECLARATIONS
#endif

void main() {
#ifdef OUTPUT_ZEROS
    OUTPUT_ZEROS  // of the outputs that users' sources declare
#endif
    Surface surface;
    surface.from_origin = v_position;
    surface.position_object = vec3(0.0);
#ifdef HAS_CUBE
    surface.position_object = v_position_object;
#endif
    // A mesh may bring normals of no length; they shall not become NaN.
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
    vec4 tint = vec4(1.0);
#ifdef HAS_MAP
    tint *= texture(u_map, v_uv);
#endif
#ifdef HAS_VERTEX_COLORS
    tint *= v_color;
#endif
    surface.tint = tint.rgb;

#ifdef MATERIAL_SHADER
    surface.position_object = v_position_object;
    surface.position = v_position + u_origin.xyz;
    surface.normal_object = v_normal_object;
    surface.uv = v_uv;
    surface.color = tint;
    vec4 shaded = with_alpha(shade(surface));
    o_color.rgb = shaded.rgb;
    tint.a = shaded.a;
#else
    o_color.rgb = shade(surface);
#endif
#ifdef TRANSLUCENT
    o_color.a = tint.a * v_alpha;
#else
    o_color.a = 1.0;
#endif
    // What the blending of blend.cpp wants of its source.
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
    o_id = v_node_id;
#endif
}
