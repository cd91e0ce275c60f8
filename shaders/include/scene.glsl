// The functions that the GLSL of a ShaderMaterial can use. The documentation of cubecam.ShaderMaterial lists these
// names: they are an interface and must not change.
#ifdef USER_SOURCE

// The node's matrix, from the mesh's space to the world, and the matrix that turns its normals there (to any length).
mat4 model_matrix() {
    mat4 model = u_model;
    model[3].xyz += u_origin.xyz;
    return model;
}
mat3 normal_matrix() { return mat3(u_normal_matrix); }

#ifdef VERTEX_STAGE
// The viewpoint of the picture, in the world.
vec3 eye_position() { return a_view_eye.xyz + u_origin.xyz; }

struct Vertex {
    vec3 position;  // in the mesh's space
    vec3 normal;
    vec2 uv;
    vec4 color;
};
#include "include/user_vertex.glsl"
#else
vec3 eye_position() { return v_eye.xyz + u_origin.xyz; }

// The light that reaches a world position from a direction: `environment` for another place than the surface. What a planar
// mirror shows belongs to its surface.
vec3 environment_at(vec3 position_world, vec3 direction_world) {
    look_at_screen(position_world - u_origin.xyz, direction_world, 0.0);
    return or_screen(environment_from(position_world - u_origin.xyz, direction_world));
}

#ifdef USES_FILTERED_ENVIRONMENT
// Scale and bias of F0: the reflectance of a GGX surface under uniform light is F0 * x + y.
vec2 brdf(float n_dot_v, float roughness) { return brdf_terms(n_dot_v, roughness).xy; }
#endif

// The sum of the scene's ambient lights.
vec3 ambient_light() { return u_ambient.rgb; }

int light_count() { return u_counts.x; }

struct LightSample {
    vec3 direction;  // world, unit length, from the surface to the light
    vec3 radiance;   // linear: colour, intensity, falloff, the cone of a spot light, shadows
};

// The light that light number `index` sends to a surface; the surface's angle to it is not included.
LightSample sample_light(int index, Surface surface) {
    Light light = u_lights[index];
    vec3 to_light = light.position.xyz - surface.from_origin * is_at_place(light.position);
    float distance_squared = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(max(distance_squared, 1e-36));
    float share = light.position.w == 0.0 ? 1.0 : pow(distance_squared, -0.5 * light.color.a);
    share *= range_share(light.position, distance_squared);
    share *= cone_share(light.cone, -direction) * light_visibility(index, surface.from_origin, surface.normal);
    return LightSample(direction, light.color.rgb * share);
}

// The reflection model of PhongMaterial.
vec3 phong(Surface surface, vec3 color, float ka, float kd, float ks, float shininess) {
    vec3 result = ka * color * (1.0 + ambient_light());  // the model has its own ambient light of 1
    for (int i = 0; i < light_count(); ++i) {
        LightSample light = sample_light(i, surface);
        float n_dot_l = dot(surface.normal, light.direction);
        if (n_dot_l <= 0.0) continue;
        float r_dot_v = dot(reflect(-light.direction, surface.normal), -surface.incident);
        result += (kd * color * n_dot_l + ks * pow(clamp(r_dot_v, 0.0, 1.0), shininess)) * light.radiance;
    }
    return result;
}

// F0 + (1 - F0) (1 - cos)^5, from a surface's normal and the direction of view (Schlick, 1994).
float schlick(Surface surface, float f0) {
    float m = 1.0 - clamp(-dot(surface.incident, surface.normal), 0.0, 1.0);
    return f0 + (1.0 - f0) * (m * m) * (m * m) * m;
}

#include "include/user_fragment.glsl"
#endif
#endif
