// The share of unpolarised light that the surface of a dielectric reflects, without total reflection: M. Born, E. Wolf,
// "Principles of Optics", section 1.5.2. eta = n_outside / n_inside.
float dielectric_reflectance(float cos_i, float eta) {
    cos_i = clamp(cos_i, 0.0, 1.0);
    float cos_t = sqrt(max(1.0 - eta * eta * (1.0 - cos_i * cos_i), 0.0));
    float r_s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float r_p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (r_s * r_s + r_p * r_p);
}
