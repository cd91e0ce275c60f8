const vec3 v_position = vec3(0.0);  // the sky is seen alike from everywhere
#include "include/environment.glsl"

flat in mat3 v_rays;    // the direction at v_centre, and its steps from pixel to pixel along x and y
flat in vec2 v_centre;  // in pixels
layout(location = 0) out vec4 o_color;

void main() {
    // Each pixel computes its direction from whole numbers: interpolated directions would be too coarse for wide views.
    // Multisamples do not matter, since a driver may place gl_FragCoord on any of them.
    vec2 place = floor(gl_FragCoord.xy) + 0.5 - v_centre;
    precise vec3 direction = v_rays[0] + place.x * v_rays[1] + place.y * v_rays[2];
    o_color = vec4(environment(normalize(direction)), 1.0);
}
