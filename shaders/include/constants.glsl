// The numbers of the material: constants() in its C++ file writes them, and its GLSL file reads them as material[i].
//
// If there are few numbers, the fragment shader gets them as flat inputs: llvmpipe loads these once for each triangle,
// but reads a uniform block again for every eight pixels (docs/adr/0004). The block is declared in the stage that reads
// it.
#if MATERIAL_SIZE > 0
#ifdef FLAT_MATERIAL
flat STAGE vec4 v_material[MATERIAL_SIZE];
#define material v_material
#else
#define material u_material
#endif
// If nodes are drawn together, each has its own flat numbers in its record (node.glsl).
#if (defined(FLAT_MATERIAL) && defined(VERTEX_STAGE) && !defined(INSTANCED)) || \
    !(defined(FLAT_MATERIAL) || defined(VERTEX_STAGE))
layout(std140, binding = 3) uniform Material {
    vec4 u_material[MATERIAL_SIZE];
};
#endif
#endif
