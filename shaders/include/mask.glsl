// The holes of a caster, where its alpha is below a cutoff (cpp/cubecam/render/passes/shadow_pass.cpp).
layout(std140, binding = 3) uniform Mask {
    vec4 u_mask_rows[2];  // xyz: from (u, v, 1) to the place in the map
    vec4 u_mask;          // x: the alpha of the material, y: the cutoff
};
#ifdef UNIT_MASK
STAGE vec2 v_uv;
#endif
#ifdef HAS_VERTEX_COLORS
STAGE float v_alpha;
#endif
