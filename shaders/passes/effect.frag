// An ImageEffect: one pass over a finished picture in linear float. The documentation of cubecam.ImageEffect lists
// these names: they are an interface and must not change.
layout(binding = 0) uniform sampler2DArray u_frame;
layout(location = 1023) uniform int u_layer;  // a user's uniforms may have the low locations
layout(location = 0) out vec4 o_color;

// Width and height in pixels.
ivec2 frame_size() { return textureSize(u_frame, 0).xy; }

// The picture at uv, where (0, 0) is its bottom-left corner and (1, 1) its top-right one. The lookup is bilinear;
// beyond the picture its border is repeated.
vec4 frame(vec2 uv) { return textureLod(u_frame, vec3(uv, u_layer), 0.0); }

// One pixel without a filter, where (0, 0) is the bottom-left one; beyond the picture its border is repeated.
vec4 frame_pixel(ivec2 pixel) { return texelFetch(u_frame, ivec3(clamp(pixel, ivec2(0), frame_size() - 1), u_layer), 0); }

#include "include/user_fragment.glsl"

// effect() may return a colour with an alpha, or only a colour, which keeps the picture's alpha.
vec4 with_alpha(vec4 color) { return color; }
vec4 with_alpha(vec3 color) { return vec4(color, frame_pixel(ivec2(gl_FragCoord.xy)).a); }

void main() {
    cubecam_zeros();
    o_color = vec4(0.0);
    if (u_layer >= 0) o_color = with_alpha(effect(gl_FragCoord.xy / vec2(frame_size())));  // always: see surface.frag
}
