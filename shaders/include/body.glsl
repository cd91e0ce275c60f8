// The way of light through a body to its far side. A texture has the inner side of the mesh as its middle sees it
// (cpp/cubecam/render/passes/body_pass.hpp), in a space in which the mesh fills the cube from -1 to 1: a ray is straight in
// any such space, whatever the node's matrix is. python/cubecam/truth/shading/bodies.py is the same in numpy.

// 1 / z of a surface, where z is the distance along the axis of its face; 0 where there is none. x: the nearest back of a
// surface, where rays from the middle leave the body; y: the nearest front, where they enter it if the middle is outside.
layout(binding = 46) uniform sampler2D u_body_nearness;
layout(binding = 47) uniform sampler2DArray u_body_normals;  // of both, outwards

const int BODY_STEPS = 6;  // places of the ray that are looked up until it is outside
const int BODY_ROOTS = 3;  // how often the place of the exit is improved
const int BODY_MEETS = 4;  // how often a ray meets the inner side; the last time it leaves the body in any case

// How light leaves a body.
struct Passage {
    vec3 from_origin;  // where, relative to u_origin
    vec3 direction;    // world, unit length
    float way;         // its length in the body, world units
    int met;           // how often it met the inner side; 0: the far side is not known
};

vec3 body_place(vec3 place) {
    vec3 at = bordered_place(place, float(BODY_SIZE));
    return vec3(at.xy / (vec2(3.0, 2.0) * float(BODY_SIZE + 2)), at.z);
}

// How far a place is behind the far side of the body, and how far before its near side: above 0 outside.
vec2 beyond_sides(vec3 place) {
    vec3 at = body_place(place);
    vec2 nearness = textureLod(u_body_nearness, at.xy, 0.0).xy;
    return vec2(at.z * nearness.x - 1.0, v_to_body[1].w > 0.0 ? 1.0 - at.z * nearness.y : -1.0);
}

float beyond_body(vec3 place) {
    vec2 beyond = beyond_sides(place);
    return max(beyond.x, beyond.y);
}

// How far from a place in the body a ray leaves it; below 0: the body has no far side there, or the place is in a part of
// it that its middle does not see.
float body_exit(vec3 place, vec3 direction) {
    // Where the ray leaves a box that is a little larger than the mesh.
    vec3 along = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 sides = (1.02 * sign(along) - place) / along;
    float end = max(min(min(sides.x, sides.y), sides.z), 0.0);
    float before = 0.0;
    float at_before = beyond_body(place);
    float last = 0.0;
    float at_last = at_before;
    bool known = at_before < 0.05;
    int i = 0;
    while (i < BODY_STEPS && (i == 0 || at_last < 0.0)) {
        before = last;
        at_before = at_last;
        ++i;
        last = end * float(i) / float(BODY_STEPS);
        at_last = beyond_body(place + last * direction);
    }
    if (!(known && at_last >= 0.0)) return -1.0;
    // The ray starts on the surface, where the number is 0 but for rounding: the middle is the first guess.
    if (i == 1) at_before = -at_last;
    Crossing crossing = Crossing(before, last, min(at_before, -1e-6), at_last);
    for (int k = 0; k < BODY_ROOTS; ++k) {
        float guess = crossing_guess(crossing);
        crossing = crossing_closer(crossing, guess, beyond_body(place + guess * direction));
    }
    return crossing_guess(crossing);
}

// The outward normal where a ray leaves the body; world, unit length.
vec3 body_normal(vec3 place, vec3 direction_world) {
    vec2 beyond = beyond_sides(place);
    vec3 own = textureLod(u_body_normals, vec3(body_place(place).xy, beyond.x >= beyond.y ? 0.0 : 1.0), 0.0).xyz;
    vec3 normal = own.x * v_to_body[0].xyz + own.y * v_to_body[1].xyz + own.z * v_to_body[2].xyz;
    float size = dot(normal, normal);
    normal = size > 0.0 ? normal * inversesqrt(size) : direction_world;
    // Shading normals may lean back from a ray that leaves.
    return dot(normal, direction_world) < 0.0 ? -normal : normal;
}

// Follows light that goes into the body from the fragment, with the index of refraction inside over that outside. Where
// the far side is not known, it is taken to come from where the ray has got to, along its way: at the first surface that
// is the rule for one surface. What the far side reflects in part leaves the body elsewhere, and is taken to
// be as bright as what leaves here.
Passage through_body(vec3 from_origin, vec3 direction_world, float ior) {
    Passage passage = Passage(from_origin, direction_world, 0.0, 0);
    vec3 place = v_body;
    bool inside = true;
#ifdef DOUBLE_SIDED
    inside = gl_FrontFacing;
#endif
    while (inside && passage.met < BODY_MEETS) {
        vec3 along = vec3(dot(v_to_body[0].xyz, passage.direction), dot(v_to_body[1].xyz, passage.direction),
                          dot(v_to_body[2].xyz, passage.direction));
        float size = max(length(along), 1e-30);
        along /= size;
        float exit = body_exit(place, along);
        if (exit < 0.0) break;
        ++passage.met;
        place += exit * along;
        float way = exit * v_to_body[0].w / size;
        passage.from_origin += way * passage.direction;
        passage.way += way;
        vec3 normal = body_normal(place, passage.direction);
        vec3 leaving = refract(passage.direction, -normal, ior);
        inside = dot(leaving, leaving) == 0.0;
        passage.direction = inside ? reflect(passage.direction, normal) : leaving;
    }
    return passage;
}
