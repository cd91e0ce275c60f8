// The values that the vertex shader passes to the fragment shader; STAGE is `out` or `in`.
//
// Some lights are flat inputs, as the constants of a material are (constants.glsl). For meshes of many small triangles
// (DENSE) they stay in their blocks: every input has a cost for each triangle.
#if FLAT_LIGHT_COUNT > 0
flat STAGE vec4 v_light_position[FLAT_LIGHT_COUNT];
flat STAGE vec4 v_light_color[FLAT_LIGHT_COUNT];
#ifdef LIGHT_CONE
flat STAGE vec4 v_light_cone[FLAT_LIGHT_COUNT];
#endif
#endif

STAGE vec3 v_position;  // world, relative to u_origin
STAGE vec3 v_normal;    // world, any length
#ifdef SHADOW_COUNT
STAGE float v_height;  // dot(v_position, v_normal) at the corners
#endif
flat STAGE vec4 v_eye;  // see view.glsl
#if defined(USES_UV) || defined(USER_SOURCE)
STAGE vec2 v_uv;
#endif
#ifdef USES_UV1
STAGE vec2 v_uv1;
#endif
#ifdef USES_TANGENT
STAGE vec4 v_tangent;  // world, any length
#endif
#if (defined(SHOWS_BEHIND) && !defined(BEHIND_CUBE)) || (defined(PLANAR_MIRROR) && !defined(PLANAR_MIRROR_CUBE)) || \
    defined(SCREEN_REFLECTIONS)
flat STAGE vec4 v_clip_rows[3];  // from a position to x, y and w in the view's clip space
flat STAGE float v_layer;        // of the view
#endif
#ifdef SCREEN_REFLECTIONS
flat STAGE vec4 v_clip_depth;  // from a position to w times the depth
flat STAGE int v_node_id;
#endif
#ifdef HAS_VERTEX_COLORS
STAGE vec4 v_color;
#endif
#if defined(USES_POSITION_OBJECT) || defined(USER_SOURCE)
STAGE vec3 v_position_object;
#endif
#ifdef USER_SOURCE
STAGE vec3 v_normal_object;
#endif
#ifdef BODY
STAGE vec3 v_body;  // the place in the space of include/body.glsl
// xyz: columns of the matrix that brings normals from there to the world, of any size; its transpose brings directions
// there, times a number. [0].w: 1 / that number, [1].w: 1 if the middle of the mesh is outside of the body, else 0.
flat STAGE vec4 v_to_body[3];
#endif
#ifdef VOLUME
flat STAGE vec3 v_scale;  // the lengths of the columns of the node's matrix
#endif
#ifdef TRANSLUCENT
flat STAGE float v_alpha;
#endif
#ifdef OUTPUTS
flat STAGE vec4 v_view_position;
flat STAGE vec3 v_view_forward;
flat STAGE vec3 v_origin;
flat STAGE ivec2 v_id_and_label;
#endif
#if FLAT_LIGHT_COUNT > 0 && !defined(VERTEX_STAGE)

// Returns light `i`, which is below FLAT_LIGHT_COUNT.
Light flat_light(int i) {
#ifdef LIGHT_CONE
    return Light(v_light_position[i], v_light_color[i], v_light_cone[i]);
#else
    return Light(v_light_position[i], v_light_color[i], vec4(0.0, 0.0, 0.0, 1.0));
#endif
}
#endif
