// Applies exposure, tone mapping and the transfer function to a finished frame in linear float. Alpha does not change.
layout(binding = 0) uniform sampler2DArray u_frame;
layout(location = 0) uniform int u_layer;
layout(location = 1) uniform float u_gain;
layout(location = 0) out vec4 o_color;

#if defined(TONEMAP_REINHARD)
#define TONEMAP
// E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 3, per channel.
vec3 tonemap(vec3 c) { return c / (1.0 + c); }
#elif defined(TONEMAP_ACES)
#define TONEMAP
// K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: a fit of the reference curve.
vec3 tonemap(vec3 c) { return clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0); }
#elif defined(TONEMAP_NEUTRAL)
#define TONEMAP
// Khronos PBR Neutral Tone Mapper, specification of 2024.
vec3 tonemap(vec3 c) {
    const float start = 0.8 - 0.04;
    const float desaturation = 0.15;
    float x = min(c.r, min(c.g, c.b));
    c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < start) return c;
    float d = 1.0 - start;
    float new_peak = 1.0 - d * d / (peak + d - start);
    c *= new_peak / peak;
    float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(c, vec3(new_peak), g);
}
#else
vec3 tonemap(vec3 c) { return c; }
#endif

// The transfer function of IEC 61966-2-1.
vec3 encode_srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

vec3 decode_srgb(vec3 c) {
    return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

void main() {
    vec4 color = texelFetch(u_frame, ivec3(gl_FragCoord.xy, u_layer), 0);
#ifdef DECODE_SRGB
    color.rgb = decode_srgb(max(color.rgb, 0.0));
#endif
    color.rgb *= u_gain;
#if defined(TONEMAP) || defined(ENCODE_SRGB)
    // The colour of a lamp may be infinite, but its square must be finite.
    color.rgb = tonemap(clamp(color.rgb, 0.0, 1e18));
#endif
#ifdef ENCODE_SRGB
    color.rgb = encode_srgb(color.rgb);
#endif
    o_color = color;
}
