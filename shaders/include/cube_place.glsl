// Places on the faces of a cube that lie in one 2D texture, in three columns (x, y, z) and two rows (positive, negative).

// The face that a direction meets: xy: its column and row; zw: the place on the face, from 0 to 1.
vec4 cube_place(vec3 direction) {
    vec3 size = abs(direction);
    bool x = size.x >= size.y && size.x >= size.z;
    bool y = !x && size.y >= size.z;
    float along = x ? direction.x : y ? direction.y : direction.z;
    float s = along >= 0.0 ? 1.0 : -1.0;
    vec2 place = x ? vec2(-s * direction.z, -direction.y)
                   : y ? vec2(direction.x, s * direction.z) : vec2(s * direction.x, -direction.y);
    return vec4(x ? 0.0 : y ? 1.0 : 2.0, 0.5 - 0.5 * s, 0.5 + 0.5 * place / max(abs(along), 1e-30));
}

// xy: where a texture whose faces have a border of one texel shows a direction, in texels; z: its greatest component.
vec3 bordered_place(vec3 direction, float texels) {
    vec4 on = cube_place(direction);
    vec3 size = abs(direction);
    return vec3(on.xy * (texels + 2.0) + 1.0 + on.zw * texels, max(max(size.x, size.y), size.z));
}

#ifdef DISTANCE_BLOCKS
// The direction of a place, of length 1 along the face's axis; places below 0 and above 1 lie beyond the face.
vec3 cube_direction(vec4 at) {
    vec2 place = 2.0 * at.zw - 1.0;
    float s = 1.0 - 2.0 * at.y;
    return at.x == 0.0 ? vec3(s, -place.y, -s * place.x)
                       : at.x == 1.0 ? vec3(place.x, s, s * place.y) : vec3(s * place.x, -place.y, s);
}

// The texel of a place in a texture with DISTANCE_BLOCKS texels along an edge of a face.
ivec2 cube_block(vec4 at) {
    ivec2 block = ivec2(at.zw * float(DISTANCE_BLOCKS));
    return ivec2(at.xy) * DISTANCE_BLOCKS + clamp(block, 0, DISTANCE_BLOCKS - 1);
}
#endif
