// What the vertex shader hands to the fragment shader; STAGE is `out` or `in`.
// Constants of a draw call travel as flat inputs, see draw.glsl.
STAGE vec3 v_position;  // world
STAGE vec3 v_normal;    // world, any length
flat STAGE vec4 v_eye;  // see view.glsl
flat STAGE vec4 v_material[2];
#ifdef HAS_MAP
STAGE vec2 v_uv;
#endif
#ifdef HAS_VERTEX_COLORS
STAGE vec4 v_color;
#endif
#ifdef HAS_CUBE
STAGE vec3 v_position_object;
#endif
#ifdef TRANSLUCENT
flat STAGE float v_alpha;
#endif
#ifdef LIGHT_COUNT
#if LIGHT_COUNT > 0
flat STAGE vec4 v_light_position[LIGHT_COUNT];
flat STAGE vec4 v_light_color[LIGHT_COUNT];
#endif
#endif
#ifdef OUTPUTS
flat STAGE vec4 v_view_position;
flat STAGE vec3 v_view_forward;
flat STAGE int v_node_id;
#endif
