// The microfacet model of glTF 2.0, appendix B.3: the distribution of T. Trowbridge and K. Reitz, "Average Irregularity
// Representation of a Rough Surface for Ray Reflection", 1975 (GGX), with the masking and shadowing of B. Smith, 1967,
// in its separable form; B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
const float PI = 3.14159265;

// A lamp of no size would be infinitely bright in a perfect mirror.
const float LEAST_ALPHA = 1.0 / 1024.0;

float max3(vec3 v) { return max(v.x, max(v.y, v.z)); }

// (1 - cosine)^5 of C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994.
float schlick_weight(float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    return (m * m) * (m * m) * m;
}

// D: 1 - (n.h)^2 comes from the cross product, since the difference of two numbers near 1 has few digits.
float facets(float alpha_squared, vec3 normal, vec3 half_way) {
    vec3 across = cross(normal, half_way);
    float cosine = dot(normal, half_way);
    float d = dot(across, across) + alpha_squared * cosine * cosine;
    return alpha_squared / (PI * d * d);
}

// The factor of one direction in V = G / (4 n.l n.v); V is the product of two.
float unmasked(float alpha_squared, float cosine) {
    return 1.0 / (cosine + sqrt(alpha_squared + (1.0 - alpha_squared) * cosine * cosine));
}
