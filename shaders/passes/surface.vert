// Draws every mesh for every view.
#define STAGE out
#define VERTEX_STAGE
#include "include/view.glsl"
#include "include/node.glsl"
#if FLAT_LIGHT_COUNT > 0
#include "include/lights.glsl"
#endif
#include "include/constants.glsl"
#include "include/surface.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_uv;
layout(location = 3) in vec4 a_color;
#ifdef USES_TANGENT
layout(location = 14) in vec4 a_tangent;
#endif
#ifdef USES_UV1
layout(location = 15) in vec2 a_uv1;
#endif

#ifdef CLIPPED
// Only what lies on one side of a plane is drawn (View::clip).
layout(std140, binding = 6) uniform Clip {
    vec4 u_clip_plane;  // xyz: its normal, w: the height of u_origin above it
};
#endif

// Variants of this source draw the same node: layered or view by view, alone or as an instance, with outputs or without.
// What they compute for a vertex must be equal bit for bit: `invariant` and `precise` keep a compiler from changing the
// order of the operations, and from joining some of them, in one variant and not in another. The other values are copies.
invariant gl_Position;
invariant v_position;
invariant v_normal;
#ifdef SHADOW_COUNT
invariant v_height;
#endif
#ifdef USES_TANGENT
invariant v_tangent;
#endif
#ifdef VOLUME
invariant v_scale;
#endif
#ifdef SCREEN_REFLECTIONS
invariant v_clip_depth;
#endif
#ifdef BODY
invariant v_body;
invariant v_to_body;

// cpp/cubecam/render/resources/body_lookup.hpp
layout(location = 2) uniform vec4 u_body_middle;  // xyz: in the mesh's space; w: 1 if it is outside of the body
layout(location = 3) uniform vec3 u_body_half;    // half of the mesh's extent
#endif

#include "include/scene.glsl"

void main() {
#ifdef USER_SOURCE
    vec4 color = vec4(1.0);
#ifdef HAS_VERTEX_COLORS
    color = a_color;
#endif
    Vertex own = Vertex(a_position, a_normal, a_uv, color);
#ifdef HAS_USER_VERTEX
    cubecam_zeros();
    if (u_node_id >= 0) vertex(own);  // always: see surface.frag
#endif
#define a_position own.position
#define a_normal own.normal
#define a_uv own.uv
#define a_color own.color
#endif
    precise vec4 position_world = u_model * vec4(a_position, 1.0);
    gl_Position = a_view_matrix * position_world;
    route_to_layer();
#ifdef CLIPPED
    gl_ClipDistance[0] = dot(u_clip_plane.xyz, position_world.xyz) + u_clip_plane.w;
#endif
    v_position = position_world.xyz;
    v_normal = mat3(u_normal_matrix) * a_normal;
#ifdef SHADOW_COUNT
    v_height = dot(v_position, v_normal);
#endif
    v_eye = a_view_eye;
#ifdef FLAT_MATERIAL
    v_material = u_material;
#endif
#if defined(USES_UV) || defined(USER_SOURCE)
    v_uv = a_uv;
#endif
#ifdef USES_UV1
    v_uv1 = a_uv1;
#endif
#ifdef USES_TANGENT
    // A matrix that mirrors turns the cross product of normal and tangent round.
    v_tangent = vec4(mat3(u_model) * a_tangent.xyz, determinant(mat3(u_model)) < 0.0 ? -a_tangent.w : a_tangent.w);
#endif
#if (defined(SHOWS_BEHIND) && !defined(BEHIND_CUBE)) || (defined(PLANAR_MIRROR) && !defined(PLANAR_MIRROR_CUBE)) || \
    defined(SCREEN_REFLECTIONS)
    v_layer = a_view_forward.w;
    mat4 rows = transpose(a_view_matrix);
    v_clip_rows[0] = rows[0];
    v_clip_rows[1] = rows[1];
    v_clip_rows[2] = rows[3];
#endif
#ifdef SCREEN_REFLECTIONS
    v_clip_depth = transpose(a_view_matrix)[2];
    v_node_id = u_node_id;
#endif
#ifdef HAS_VERTEX_COLORS
    v_color = a_color;
#endif
#if defined(USES_POSITION_OBJECT) || defined(USER_SOURCE)
    v_position_object = a_position;
#endif
#ifdef USER_SOURCE
    v_normal_object = a_normal;
#endif
#ifdef BODY
    v_body = (a_position - u_body_middle.xyz) / u_body_half;
    // u_model times the transpose of u_normal_matrix is the unit matrix times a number: the lengths of directions there.
    float scale = 0.0;
    for (int i = 0; i < 3; ++i) {
        scale += dot(u_model[i].xyz, u_normal_matrix[i].xyz) / 3.0;
        v_to_body[i] = vec4(u_normal_matrix[i].xyz / u_body_half[i], 0.0);
    }
    v_to_body[0].w = scale;
    v_to_body[1].w = u_body_middle.w;
#endif
#ifdef VOLUME
    v_scale = vec3(length(u_model[0].xyz), length(u_model[1].xyz), length(u_model[2].xyz));
#endif
#ifdef TRANSLUCENT
    v_alpha = u_alpha;
#endif
#if FLAT_LIGHT_COUNT > 0
    for (int i = 0; i < FLAT_LIGHT_COUNT; ++i) {
        v_light_position[i] = u_lights[i].position;
        v_light_color[i] = u_lights[i].color;
#ifdef LIGHT_CONE
        v_light_cone[i] = u_lights[i].cone;
#endif
    }
#endif
#ifdef OUTPUTS
    v_view_position = a_view_position;
    v_view_forward = a_view_forward.xyz;
    v_id_and_label = ivec2(u_node_id, u_label);
    v_origin = u_origin.xyz;
#endif
}
