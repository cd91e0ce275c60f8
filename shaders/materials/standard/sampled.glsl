// Light from the environment by samples of the whole reflection model: directions by importance, J. Dupuy and A. Benyoub,
// "Sampling Visible GGX Normals with Spherical Caps", HPG 2023, with lookups in box mipmaps, J. Krivanek and M. Colbert,
// "Real-time Shading with Filtered Importance Sampling", EGSR 2008.
#ifdef SAMPLED
const float LEVEL_BIAS = 0.25;  // trades noise for blur; measured against path-traced spheres

// The axes of the samples: without a tangent those of T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT
// 6(1), 2017.
void sample_axes(Point point, out vec3 x, out vec3 y) {
#ifdef ANISOTROPY
    x = point.tangent;
    y = point.bitangent;
#else
    vec3 n = point.normal;
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    x = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    y = vec3(b, s + n.y * n.y * a, -n.y);
#endif
}

// The environment's light times the two factors of a reflectance F0 + (F90 - F0) * weight: the answer of a lobe is
// f0 * scale + f90 * bias.
void add_samples(Point point, out vec3 scale, out vec3 bias) {
    vec3 x;
    vec3 y;
    sample_axes(point, x, y);
    float across = max(point.alpha, 1e-6);
#ifdef ANISOTROPY
    float along = max(point.alpha_along, 1e-6);
#else
    float along = across;
#endif
    int count = int(SPECULAR_SAMPLES);
    float texels = 6.0 * environment_size() * environment_size();
    // The frame of the facets, in which both roughnesses are 1 and the facets are half a sphere.
    vec3 stretch = vec3(along, across, 1.0);
    vec3 view = vec3(dot(x, point.view), dot(y, point.view), point.n_dot_v);
    vec3 warped = normalize(view * stretch);
    // The density of a direction is D G1(v) / (4 n.v), and G1(v) / n.v is 2 of these.
    float seen = 1.0 / (view.z + length(view * stretch));
    scale = vec3(0.0);
    bias = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        // Hammersley's points: i / count, and the bits of i after the point in reverse; both in the middle of a cell.
        float turn = 2.0 * PI * (float(i) + 0.5) / float(count);
        float share = float(bitfieldReverse(uint(i))) * 2.3283064365386963e-10 + 0.5 / float(count);
        // A point of the cap of directions into which the half sphere reflects the view, and the facet between both.
        float z = (1.0 - share) * (1.0 + warped.z) - warped.z;
        float sine = sqrt(max(1.0 - z * z, 0.0));
        vec3 cap = vec3(sine * cos(turn), sine * sin(turn), z) + warped;
        vec3 h = vec3(cap.xy * stretch.xy, max(cap.z, 0.0));
        h *= inversesqrt(max(dot(h, h), 1e-36));

        float v_dot_h = dot(view, h);
        vec3 light = 2.0 * v_dot_h * h - view;
        // D from the components over both alphas, which lose no digits where the facets are nearly flat.
        vec3 f = vec3(h.xy / stretch.xy, h.z);
        float d = 1.0 / (PI * along * across * dot(f, f) * dot(f, f));
        float density = 0.5 * d * seen;
        float level = max(0.5 * log2(texels / (4.0 * PI * float(count) * density)) + LEVEL_BIAS, 0.0);
        float unshadowed = light.z > 0.0 ? 2.0 * light.z / (light.z + length(light * stretch)) : 0.0;  // G1(l)
        vec3 radiance = environment_mip(light.x * x + light.y * y + light.z * point.normal, level) + AMBIENT;
        float weight = schlick_weight(v_dot_h);
        scale += (1.0 - weight) * unshadowed * radiance;
        bias += weight * unshadowed * radiance;
    }
    scale /= float(count);
    bias /= float(count);
}
#endif
