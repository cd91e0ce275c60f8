// Reflections that the frame itself shows: a ray is followed through the depths of a picture of the same views
// (cpp/cubecam/render/graph/screen_picture.hpp, docs/adr/0032), and looked up in its colours. Where the picture does not show
// what the ray meets, there is the environment. M. McGuire and M. Mara, "Efficient GPU Screen-Space Ray Tracing", JCGT 3(4),
// 2014; python/cubecam/truth/shading/screen.py is the same in numpy, step by step.
#ifdef SCREEN_REFLECTIONS
layout(binding = 44) uniform sampler2DArray u_screen;  // colours without blended nodes
// Level 0: depth and node id of each pixel. Level n: the nearest and the farthest depth of cells of 2^n pixels.
layout(binding = 45) uniform sampler2DArray u_screen_depths;

const int SCREEN_CELLS = 160;        // how many cells a ray may visit
const float SCREEN_FADE = 0.05;      // of the picture's smaller side: how far from its border the environment fades in
const float SCREEN_THICKNESS = 0.01;  // of the picture's height where a surface lies: how thick surfaces are

vec4 screen_light = vec4(0.0);  // rgb: what the last ray met; a: its share

// A point in the picture: x and y in pixels, then the depth. All three are linear along a ray, and on a plane the depth is
// linear in x and y, for every projection.
struct ScreenRay {
    vec3 start;
    vec3 turn;     // for a step of one pixel along x or y, whichever is longer
    float last;    // the length of the ray in such steps: to infinity, or to the border
    float longer;  // steps over the ray's own measure t / w
    bool known;    // it starts in the picture
};

ScreenRay screen_ray(vec3 from_origin, vec3 direction_world) {
    vec4 from = vec4(from_origin, 1.0);
    vec2 size = vec2(textureSize(u_screen, 0).xy);
    // P + t R lies at C / w + t / (w + t w') (C' - C / w w'), where C is P in clip space and C' is R.
    float w = dot(v_clip_rows[2], from);
    float w_turn = dot(v_clip_rows[2].xyz, direction_world);
    vec3 clip = vec3(dot(v_clip_rows[0], from), dot(v_clip_rows[1], from), dot(v_clip_depth, from)) / w;
    vec3 turn = vec3(dot(v_clip_rows[0].xyz, direction_world), dot(v_clip_rows[1].xyz, direction_world),
                     dot(v_clip_depth.xyz, direction_world)) - clip * w_turn;
    turn.xy *= 0.5 * size;
    ScreenRay ray;
    ray.start = vec3((0.5 + 0.5 * clip.xy) * size, clip.z);
    ray.known = w > 0.0 && clamp(ray.start.xy, vec2(0.0), size) == ray.start.xy;
    ray.longer = max(max(abs(turn.x), abs(turn.y)), 1e-20);
    ray.turn = turn / ray.longer;
    ray.turn = mix(ray.turn, vec3(1e-20), lessThan(abs(ray.turn), vec3(1e-20)));  // a number over 0 may be NaN
    float infinity = w_turn > 0.0 ? ray.longer / w_turn : 1e20;
    // Half a pixel from the border the colours end, at the depths 0 and 1 the depths do.
    vec3 exit = max((vec3(0.5, 0.5, 0.0) - ray.start) / ray.turn, (vec3(size - 0.5, 1.0) - ray.start) / ray.turn);
    ray.last = ray.known ? min(infinity, min(min(exit.x, exit.y), exit.z)) : 0.0;
    return ray;
}

vec3 screen_place(ScreenRay ray, float s) { return ray.start + s * ray.turn; }

vec3 screen_texel(vec3 place) { return vec3(place.xy / vec2(textureSize(u_screen_depths, 0).xy), v_layer); }

// How far a place of the ray is before the surface that is seen there: below 0 behind it.
float before_screen(vec3 place) { return place.z - textureLod(u_screen_depths, screen_texel(place), 0.0).x; }

// The first place from `s` on that may be at a surface: the end of cells in which the ray is before, or behind, all that they
// show. Returns where the last cell begins and ends; x >= ray.last: there is none. `in_front` becomes whether the ray is
// before all where that cell begins.
vec2 screen_search(ScreenRay ray, float s, inout int visited, inout bool in_front) {
    int level = 1;
    float next = s;
    bool at_surface = false;
    while (!at_surface && s < ray.last && visited < SCREEN_CELLS) {
        ++visited;
        float side = float(1 << level);
        // A little further, since the ray is at the edge of the cell that it leaves.
        vec2 cell = floor(screen_place(ray, s + 0.01).xy / side);
        vec2 to_edge = ((cell + step(0.0, ray.turn.xy)) * side - ray.start.xy) / ray.turn.xy;
        next = min(max(min(to_edge.x, to_edge.y), s + 0.01), ray.last);
        vec2 range = texelFetch(u_screen_depths, ivec3(cell, v_layer), level).xy;
        float a = ray.start.z + s * ray.turn.z;
        float b = ray.start.z + next * ray.turn.z;
        bool before = min(a, b) > range.x;
        bool away = before || max(a, b) < range.y;
        in_front = away ? before : in_front;
        at_surface = !away && level == 1;
        s = away ? next : s;
        level = away ? min(level + 1, SCREEN_DEPTH_LEVELS - 1) : max(level - 1, 1);
    }
    return vec2(at_surface ? s : ray.last, next);
}

// Where a ray passes from before to behind, between two places: false position, twice.
float screen_root(ScreenRay ray, vec2 ends) {
    float root = ends.x;
    vec2 before = vec2(before_screen(screen_place(ray, ends.x)), before_screen(screen_place(ray, ends.y)));
    for (int i = 0; i < 2; ++i) {
        root = mix(ends.x, ends.y, clamp(before.x / max(before.x - before.y, 1e-30), 0.0, 1.0));
        float now = before_screen(screen_place(ray, root));
        ends = now > 0.0 ? vec2(root, ends.y) : vec2(ends.x, root);
        before = now > 0.0 ? vec2(now, before.y) : vec2(before.x, now);
    }
    return root;
}

// The surfaces of other nodes in the four texels round `at`, along the view's axis, in pixels as large as there: x: how far
// the next one is from the place; y: how far the nearest one is before it. Between the texels of two surfaces a lookup is the
// mean of both, where there is none; zw: where the light of the next one is seen.
vec4 screen_surface(vec3 place, vec3 at, float thick) {
    vec4 depths = textureGather(u_screen_depths, screen_texel(at), 0);
    vec4 ids = textureGather(u_screen_depths, screen_texel(at), 1);
    // What a depth changes by for a step along the view's axis, times w: the axis is that of w, or of the depth for parallel rays.
    float w = length(v_clip_rows[2].xyz);
    float z = w > 0.0 ? dot(v_clip_depth.xyz, v_clip_rows[2].xyz) / w : length(v_clip_depth.xyz);
    // The picture is 2 w / |row of y| high.
    float pixel = 2.0 / (length(v_clip_rows[1].xyz) * float(textureSize(u_screen, 0).y)) * abs(z - place.z * w);
    vec4 before = (depths - place.z) / max(pixel, 1e-30);
    vec4 none = 1e9 * vec4(equal(ids, vec4(v_node_id))) + 1e9 * vec4(equal(ids, vec4(0.0)));
    vec4 off = abs(before) + none;
    before -= none;
    float next = min(min(off.x, off.y), min(off.z, off.w));
    vec2 texel = next == off.w ? vec2(0.0) : next == off.z ? vec2(1.0, 0.0) : next == off.x ? vec2(0.0, 1.0) : vec2(1.0);
    bool all_on = max(max(off.x, off.y), max(off.z, off.w)) <= thick;
    return vec4(next, max(max(before.x, before.y), max(before.z, before.w)),
                all_on ? place.xy : floor(at.xy - 0.5) + texel + 0.5);
}

// Sets screen_light to what a ray meets. `spread` is the tangent of half the angle from which a rough surface gathers light.
void look_at_screen(vec3 from_origin, vec3 direction_world, float spread) {
    ScreenRay ray = screen_ray(from_origin, direction_world);
    float thick = SCREEN_THICKNESS * float(textureSize(u_screen, 0).y) + 2.0;
    float s = 0.0;
    vec3 place = ray.start;
    vec2 seen = ray.start.xy;
    bool found = false;
    int visited = 0;
    bool in_front = true;  // of its own surface, which the ray starts at
    // Where the ray went behind a body, and how far behind its front, in pixels.
    float hidden_from = 0.0;
    float behind = 1e9;
    // The lanes of a processor search together, and find what they hit together.
    while (!found && s < ray.last && visited < SCREEN_CELLS) {
        bool crossed = false;
        float first = 0.0;
        while (!crossed && s < ray.last && visited < SCREEN_CELLS) {
            vec2 cell = screen_search(ray, s, visited, in_front);
            first = cell.x;
            s = cell.x < ray.last ? cell.y : ray.last;
            bool was_in_front = in_front;
            in_front = before_screen(screen_place(ray, s)) > 0.0;
            crossed = first < ray.last && was_in_front && !in_front;
            // A body may reach half as far behind its outline as it is wide, as a ball does: what a ray meets there is not known.
            if (in_front) {
                s = 0.5 * (s - hidden_from) > behind ? ray.last : s;
                behind = 1e9;
            }
        }
        if (crossed) {
            float root = screen_root(ray, vec2(first, s));
            place = screen_place(ray, root);
            vec4 surface = screen_surface(place, place + 0.25 * ray.turn, thick);
            found = surface.x <= thick;
            seen = surface.zw;
            if (!found && surface.y > 0.0) {
                hidden_from = root;
                behind = surface.y;
            }
        }
    }
    vec2 size = vec2(textureSize(u_screen, 0).xy);
    // The width of the lobe where it meets something, in pixels: its distance over w is the ray's own measure.
    vec2 way = abs(place.xy - ray.start.xy);
    float wide = spread * max(way.x, way.y) / ray.longer * length(direction_world) * length(v_clip_rows[1].xyz) * size.y;
    vec2 inside = min(place.xy, size - place.xy) - 0.5;
    float share = clamp(min(inside.x, inside.y) / (SCREEN_FADE * min(size.x, size.y) + wide), 0.0, 1.0);
    // What is far beside the middle of a wide lobe may be hidden.
    share *= clamp(2.0 - 16.0 * wide / size.y, 0.0, 1.0);
    vec3 light = textureLod(u_screen, vec3(seen / size, v_layer), log2(1.0 + wide)).rgb;
    screen_light = vec4(light, found ? share : 0.0);
}

// Whether the last ray needs no environment.
bool screen_knows() { return screen_light.a >= 1.0; }

// What the last ray met, or `light`, the environment.
vec3 or_screen(vec3 light) {
    vec4 met = screen_light;
    screen_light = vec4(0.0);
    return met.a >= 1.0 ? met.rgb : met.a > 0.0 ? mix(light, met.rgb, met.a) : light;
}

// The same for a ray from the surface. Rays that go into the body are not followed.
void look_from_surface(vec3 direction_world, float spread) {
    vec3 incident = v_eye.w == 0.0 ? v_position - v_eye.xyz : v_eye.xyz;
    vec3 normal = v_normal;
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) normal = -normal;
#endif
    if (dot(direction_world, normal) > 0.0 && dot(incident, normal) < 0.0) {
        look_at_screen(v_position, direction_world, spread);
    }
}

// For a roughness: half of the light of a lobe of GGX lies within 2 atan(alpha) from the middle (see parallax.glsl).
float screen_spread(float roughness) {
    float alpha = roughness * roughness;
    return 2.0 * alpha / max(1.0 - alpha * alpha, 0.1);
}
#else
#define look_at_screen(from_origin, direction_world, spread)
#define look_from_surface(direction_world, spread)
#define screen_spread(roughness) 0.0
#define screen_knows() false
#define or_screen(light) light
#endif
