// Light from the environment by samples of the whole reflection model: importance sampling of GGX with lookups in box
// mipmaps, J. Krivanek and M. Colbert, "Real-time Shading with Filtered Importance Sampling", EGSR 2008.
#ifdef SAMPLED
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
    float seen = unmasked_of(point, point.view, point.n_dot_v);
    scale = vec3(0.0);
    bias = vec3(0.0);
    for (int i = 0; i < count; ++i) {
        // Hammersley's points: i / count, and the bits of i after the point in reverse; both in the middle of a cell.
        float turn = 2.0 * PI * (float(i) + 0.5) / float(count);
        float share = float(bitfieldReverse(uint(i))) * 2.3283064365386963e-10 + 0.5 / float(count);
        // The half-way vector has the density D n.h (B. Walter et al., 2007, equation 35).
        float slope = sqrt(share / (1.0 - share));
        vec3 h = vec3(slope * along * cos(turn), slope * across * sin(turn), 1.0);
        float length_squared = dot(h, h);
        h *= inversesqrt(length_squared);
        float s = length_squared / (1.0 + slope * slope);
        float d = s * s / (PI * along * across);
        vec3 half_way = h.x * x + h.y * y + h.z * point.normal;
        float v_dot_h = dot(point.view, half_way);
        vec3 to_light = 2.0 * v_dot_h * half_way - point.view;
        float n_dot_l = dot(point.normal, to_light);
        bool lit = n_dot_l > 0.0 && v_dot_h > 0.0;
        float density = d * h.z / (4.0 * max(v_dot_h, 1e-6));
        float level = max(0.5 * log2(texels / (4.0 * PI * float(count) * density)), 0.0);
        float answer = lit ? seen * unmasked_of(point, to_light, n_dot_l) * 4.0 * v_dot_h * n_dot_l / h.z : 0.0;
        vec3 light = answer * (environment_mip(to_light, level) + AMBIENT);
        float weight = schlick_weight(v_dot_h);
        scale += (1.0 - weight) * light;
        bias += weight * light;
    }
    scale /= float(count);
    bias /= float(count);
}
#endif
