// Light from the environment by samples of the whole reflection model: importance sampling of GGX with lookups in box
// mipmaps, J. Krivanek and M. Colbert, "Real-time Shading with Filtered Importance Sampling", EGSR 2008.
#ifdef SAMPLED
// The axes of the samples.
void sample_axes(Point point, out vec3 x, out vec3 y) {
#ifdef ANISOTROPY
    x = normalize(point.tangent - dot(point.tangent, point.normal) * point.normal);
    y = cross(point.normal, x);
#else
    vec3 up = abs(point.normal.z) < 0.999 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
    x = normalize(cross(up, point.normal));
    y = cross(point.normal, x);
#endif
}

// The environment's light times the two factors of a reflectance F0 + (F90 - F0) * weight: the answer of a lobe is
// f0 * scale + f90 * bias.
void add_samples(Point point, out vec3 scale, out vec3 bias) {
    vec3 x;
    vec3 y;
    sample_axes(point, x, y);
    float across = max(point.alpha, LEAST_ALPHA);
#ifdef ANISOTROPY
    float along = max(point.alpha_along, LEAST_ALPHA);
#else
    float along = across;
#endif
    float count = SPECULAR_SAMPLES;
    float texels = 6.0 * environment_size() * environment_size();
    float seen = unmasked_of(point, point.view, point.n_dot_v);
    scale = vec3(0.0);
    bias = vec3(0.0);
    for (int i = 0; i < int(count); ++i) {
        // Hammersley's points: i / count, and the bits of i after the point in reverse.
        float turn = 2.0 * PI * float(i) / count;
        float share = float(bitfieldReverse(uint(i))) * 2.3283064365386963e-10;
        float slope = sqrt(share / (1.0 - share));
        vec3 half_way = normalize(slope * (along * cos(turn) * x + across * sin(turn) * y) + point.normal);
        float v_dot_h = dot(point.view, half_way);
        vec3 to_light = 2.0 * v_dot_h * half_way - point.view;
        float n_dot_l = dot(point.normal, to_light);
        float n_dot_h = dot(point.normal, half_way);
        bool lit = n_dot_l > 0.0 && v_dot_h > 0.0;
        float density = facets_of(point, half_way) * n_dot_h / (4.0 * max(v_dot_h, 1e-6));
        float level = max(0.5 * log2(texels / (count * 4.0 * PI * density)), 0.0);
        float answer = lit ? seen * unmasked_of(point, to_light, n_dot_l) * 4.0 * v_dot_h * n_dot_l / n_dot_h : 0.0;
        vec3 light = answer * (environment_mip(to_light, level) + AMBIENT);
        float weight = schlick_weight(v_dot_h);
        scale += (1.0 - weight) * light;
        bias += weight * light;
    }
    scale /= count;
    bias /= count;
}
#endif
