// Where the ray of a reflection meets what a probe captured: the parallax of an environment that is not infinitely far
// away. python/cubecam/truth/shading/parallax.py is the same in numpy.

// The roughness whose lobe covers, from the place of the capture, what the lobe of `roughness` covers on a surface that is
// `spread` times as far from the reflecting point. Half of the light of a lobe of GGX lies within the angle 2 atan(alpha)
// from the middle: B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, equation 35,
// with half of the random numbers. The tangent of that angle is 2 alpha / (1 - alpha^2).
float roughness_from_there(float roughness, float spread) {
    float alpha = roughness * roughness;
    float tangent = 2.0 * alpha * spread;
    float one = max(1.0 - alpha * alpha, 0.0);
    return sqrt(clamp(tangent / max(one + sqrt(one * one + tangent * tangent), 1e-30), 0.0, 1.0));
}

#if defined(ENVIRONMENT_BOX) || defined(ENVIRONMENT_SPHERE)
// S. Lagarde and A. Zanuttini, "Local Image-based Lighting with Parallax-corrected Cubemaps", SIGGRAPH 2012: the scene
// lies on the inside of a box, or of an ellipsoid. A ray that misses it, or has it behind, sees the cube as if it were
// infinitely far away.
EnvironmentHit environment_met(vec3 from_origin, vec3 direction_world) {
    vec4 from = vec4(from_origin, 1.0);
    vec3 p = vec3(dot(u_environment_proxy[0], from), dot(u_environment_proxy[1], from), dot(u_environment_proxy[2], from));
    vec3 r = vec3(dot(u_environment_proxy[0].xyz, direction_world), dot(u_environment_proxy[1].xyz, direction_world),
                  dot(u_environment_proxy[2].xyz, direction_world));
#ifdef ENVIRONMENT_BOX
    r = mix(r, vec3(1e-20), lessThan(abs(r), vec3(1e-20)));  // a number over 0 may be NaN
    vec3 a = (-1.0 - p) / r;
    vec3 b = (1.0 - p) / r;
    vec3 first = min(a, b);
    vec3 last = max(a, b);
    float exit = min(min(last.x, last.y), last.z);
    bool meets = exit > max(max(max(first.x, first.y), first.z), 0.0);
#else
    float rr = max(dot(r, r), 1e-36);
    float pr = dot(p, r);
    float root = pr * pr - rr * (dot(p, p) - 1.0);
    float exit = (sqrt(max(root, 0.0)) - pr) / rr;
    bool meets = root >= 0.0 && exit > 0.0;
#endif
    vec3 way = exit * direction_world;
    vec3 seen = from_origin + way - u_environment_position.xyz;
    float spread = length(way) * inversesqrt(max(dot(seen, seen), 1e-36));
    return meets ? EnvironmentHit(seen, spread, false) : EnvironmentHit(direction_world, 1.0, false);
}
#else
// A march through the distances that were captured with the cube. L. Szirmay-Kalos et al., "Approximate Ray-Tracing on the
// GPU with Distance Impostors", Eurographics 2005, has the idea; the search for a sign is safer than their secant. The
// layer of the farthest surfaces has what the nearest ones hide.
layout(binding = 6) uniform sampler2D u_distances;
#ifdef ENVIRONMENT_LAYERS
layout(binding = 7) uniform samplerCube u_farthest;
#endif

// How many parts of the ray are looked up in blocks, how many places of the rest are looked up, and how often the place of a
// hit is improved.
#if ENVIRONMENT_FETCHES == 6
const int MARCH_PARTS = 4;
const int MARCH_STEPS = 4;
const int MARCH_ROOTS = 1;
#elif ENVIRONMENT_FETCHES == 14
const int MARCH_PARTS = 8;
const int MARCH_STEPS = 8;
const int MARCH_ROOTS = 2;
#else
const int MARCH_PARTS = 16;
const int MARCH_STEPS = 22;
const int MARCH_ROOTS = 4;
#endif

// xy: where u_distances has a direction; z: its greatest component.
vec3 distances_place(vec3 direction) {
    vec3 at = bordered_place(direction, u_environment_distances.z);
    return vec3(at.xy * u_environment_distances.xy, at.z);
}

// How far a place of the ray is behind the nearest and the farthest surface in its direction: below 0 before it. A place is
// the point X + t R from the capture, with t = |X| s / (1 - s), times 1 - s, so that s = 1 is infinitely far away.
vec2 behind_surfaces(vec3 place, float s) {
    vec3 at = distances_place(place);
    return at.z * textureLod(u_distances, at.xy, 0.0).xy - (1.0 - s);
}

float greatest_part(vec3 v) {
    v = abs(v);
    return max(max(v.x, v.y), v.z);
}

// From where on the ray may meet something: the end of its first parts that have no surface in reach. What a block says
// counts for all directions within 0.1 of it.
float first_in_reach(vec3 start, vec3 end) {
    float free = 0.0;
    int below = 2 * (int(u_environment_distances.z) + 2);
    vec3 before = start;
    for (int i = 1; i <= (screen_knows() ? 0 : MARCH_PARTS); ++i) {
        float s = float(i) / float(MARCH_PARTS);
        vec3 after = mix(start, end, s);
        vec3 middle = normalize(before + after);
        vec3 turn = normalize(before) - middle;
        vec3 turn_after = normalize(after) - middle;
        bool within = max(dot(turn, turn), dot(turn_after, turn_after)) < 0.01;
        float nearness = texelFetch(u_distances, cube_block(cube_place(middle)) + ivec2(0, below), 0).r;
        // The greatest part of a place between two is at most that of one of them.
        float reach = max(greatest_part(before), greatest_part(after)) * nearness;
        if (!(within && reach < 1.0 - s)) break;
        free = s;
        before = after;
    }
    return free;
}

// Whether one of the four texels round a place is a surface that goes through the place. Between the texels of two
// surfaces a lookup is the mean of both, where there is none.
bool on_surface(vec3 place, float s, bool farthest) {
    vec3 at = distances_place(place);
    vec4 nearness = farthest ? textureGather(u_distances, at.xy, 1) : textureGather(u_distances, at.xy, 0);
    vec4 off = abs(at.z * nearness - (1.0 - s));
    return min(min(off.x, off.y), min(off.z, off.w)) < (0.02 + 3.0 / u_environment_distances.z) * max(1.0 - s, 1e-4);
}

// The place between two, one before and one behind a surface, where the ray meets it.
float root_between(vec3 start, vec3 end, float a, float b, float at_a, float at_b, bool farthest) {
    Crossing crossing = Crossing(a, b, at_a, at_b);
    for (int i = 0; i < MARCH_ROOTS; ++i) {
        float s = crossing_guess(crossing);
        vec2 behind = behind_surfaces(mix(start, end, s), s);
        crossing = crossing_closer(crossing, s, farthest ? behind.y : behind.x);
    }
    return crossing_guess(crossing);
}

EnvironmentHit hit_at(vec3 place, float s, float size, bool farthest) {
    return EnvironmentHit(place, size * s * inversesqrt(max(dot(place, place), 1e-36)), farthest);
}

EnvironmentHit environment_met(vec3 from_origin, vec3 direction_world) {
    vec3 start = from_origin - u_environment_position.xyz;
    float size = max(length(start), 1e-6);
    vec3 end = direction_world * (size * inversesqrt(max(dot(direction_world, direction_world), 1e-36)));
    EnvironmentHit hit = EnvironmentHit(end, 1.0, false);
    float free = first_in_reach(start, end);
    vec2 before = behind_surfaces(mix(start, end, free), free);
    float last = free;
    bool found = screen_knows();
    int step = 0;
    while (!found && step < MARCH_STEPS) {
        bool near_one = false;
        bool far_one = false;
        float first = last;
        vec2 at_first = before;
        // The lanes of a processor search together, and find what they hit together.
        while (!near_one && !far_one && step < MARCH_STEPS) {
            first = last;
            at_first = before;
            ++step;
            last = mix(free, 1.0, float(step) / float(MARCH_STEPS));
            before = behind_surfaces(mix(start, end, last), last);
            near_one = at_first.x < 0.0 && before.x >= 0.0;
#ifdef ENVIRONMENT_LAYERS
            far_one = (at_first.y < 0.0) != (before.y < 0.0);
#endif
        }
        if (near_one) {
            float s = root_between(start, end, first, last, at_first.x, before.x, false);
            vec3 place = mix(start, end, s);
            // What no test accepts is better than nothing.
            hit = hit_at(place, s, size, false);
            found = on_surface(place, s, false);
        }
#ifdef ENVIRONMENT_LAYERS
        if (far_one) {
            float s = root_between(start, end, first, last, at_first.y, before.y, true);
            vec3 place = mix(start, end, s);
            if (!found && on_surface(place, s, true)) {
                hit = hit_at(place, s, size, true);
                found = true;
            }
        }
#endif
    }
    return hit;
}
#endif

#ifdef ENVIRONMENT_LAYERS
// The level of the farthest surfaces, whose levels are averages of boxes of texels, for a lobe: a box as wide as the angle
// that half of the light is within, 4 atan(alpha). At 2 / pi texels for a radian, seen at the middle of a face.
float farthest_level(float roughness) {
    float texels = float(textureSize(u_farthest, 0).x);
    return max(log2(max(4.0 * atan(roughness * roughness) * texels * 0.6366, 1e-30)), 0.0);
}
#endif
