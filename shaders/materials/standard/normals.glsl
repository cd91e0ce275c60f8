// Normals of normal maps. A map's x runs along the tangent, where u grows, y along the bitangent, where v grows.
#ifdef USES_TANGENT
// glTF 2.0, section 3.9.3: `texel` is from 0 to 1, and `scale` changes x and y only.
vec3 mapped_normal(Surface surface, vec3 texel, float scale) {
    vec3 normal = (texel * 2.0 - 1.0) * vec3(scale, scale, 1.0);
    vec3 bitangent = surface.tangent.w * cross(surface.normal, surface.tangent.xyz);
    vec3 turned = normal.x * surface.tangent.xyz + normal.y * bitangent + normal.z * surface.normal;
    // A texel of the length 0 must not give NaN.
    float length_squared = dot(turned, turned);
    return length_squared > 0.0 ? turned * inversesqrt(length_squared) : surface.normal;
}
#endif
