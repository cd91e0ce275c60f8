// The squared difference of two cubes in the directions of the texels of a cube of 32 texels an edge. The faces lie side
// by side, in columns of 32; their order and orientation do not matter, since these directions are symmetric.
layout(binding = 0) uniform samplerCube u_less;
layout(binding = 1) uniform samplerCube u_more;
layout(location = 0) out float o_square;

void main() {
    int face = int(gl_FragCoord.x) / 32;
    vec2 place = mod(gl_FragCoord.xy, 32.0) / 16.0 - 1.0;
    vec3 direction = vec3(face % 2 == 0 ? 1.0 : -1.0, place);
    if (face / 2 == 1) direction = direction.yxz;
    if (face / 2 == 2) direction = direction.yzx;
    vec3 change = textureLod(u_more, direction, 0.0).rgb - textureLod(u_less, direction, 0.0).rgb;
    o_square = dot(change, change);
}
