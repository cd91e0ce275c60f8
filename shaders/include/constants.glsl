// The numbers of the material: constants() in its C++ file writes them, its GLSL file reads them as material[i].
//
// The fragment shader gets few numbers as flat inputs, which llvmpipe loads once a triangle, while it reads a uniform
// block anew for every eight pixels (docs/adr/0004). The block is declared in the stage that reads it.
#if MATERIAL_SIZE > 0
#ifdef FLAT_MATERIAL
flat STAGE vec4 v_material[MATERIAL_SIZE];
#define material v_material
#else
#define material u_material
#endif
// Of nodes that are drawn together each has flat numbers of its own, in its record (node.glsl).
#if (defined(FLAT_MATERIAL) && defined(VERTEX_STAGE) && !defined(INSTANCED)) || \
    !(defined(FLAT_MATERIAL) || defined(VERTEX_STAGE))
layout(std140, binding = 3) uniform Material {
    vec4 u_material[MATERIAL_SIZE];
};
#endif
#endif
