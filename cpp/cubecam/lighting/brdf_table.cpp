#include "cubecam/lighting/brdf_table.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cubecam {

namespace {

/// Nodes and weights of Gauss and Legendre on [0, 1].
template <std::size_t count>
struct GaussRule {
    std::array<float, count> nodes;
    std::array<float, count> weights;

    GaussRule() {
        constexpr auto n = static_cast<double>(count);
        for (std::size_t i = 0; i < count; ++i) {
            double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
            double slope = 1;
            for (int step = 0; step < 8; ++step) {  // Newton's method on Legendre's polynomial
                double before = 1;
                double value = x;
                for (std::size_t k = 2; k <= count; ++k) {
                    const auto d = static_cast<double>(k);
                    const double next = ((2 * d - 1) * x * value - (d - 1) * before) / d;
                    before = value;
                    value = next;
                }
                slope = n * (x * value - before) / (x * x - 1);
                x -= value / slope;
            }
            nodes[i] = static_cast<float>((x + 1) / 2);
            weights[i] = static_cast<float>(1 / ((1 - x * x) * slope * slope));
        }
    }
};

/// Cosines and sines of angles in the middle of `count` equal parts of the half circle; the other
/// half is its mirror image.
template <std::size_t count>
struct HalfCircle {
    std::array<float, count> cosines;
    std::array<float, count> sines;

    HalfCircle() {
        for (std::size_t i = 0; i < count; ++i) {
            const double angle =
                std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
            cosines[i] = static_cast<float>(std::cos(angle));
            sines[i] = static_cast<float>(std::sin(angle));
        }
    }
};

/// The integral of the specular term of glTF 2.0, appendix B, under uniform light,
///
///   int V D F (n.l) dl = F0 * scale + bias,   F = F0 + (1 - F0) (1 - v.h)^5,
///   V = G1(l) G1(v) / (4 n.l n.v),   G1(x) = 2 n.x / (n.x + sqrt(a^2 + (1 - a^2) (n.x)^2))
///
/// (the form with scale and bias: B. Karis, 2013). In coordinates in which the visible normals are
/// spread evenly (J. Dupuy and A. Benyoub, "Sampling visible GGX normals with spherical caps",
/// 2023; there D G1(v) v.h / n.v is constant), it is the mean of G1(l) F over a cap of the sphere:
/// the points c = (cos(phi) sqrt(1 - z^2), sin(phi) sqrt(1 - z^2), z) with -p.z < z < 1, where
/// p = normalize(a v.x, a v.y, v.z), and h = normalize(a (c + p).x, a (c + p).y, (c + p).z).
/// With z + p.z = (1 + p.z) t^2, points are dense where h is close to the horizon.
glm::vec2 integrate_ggx(float n_dot_v, float roughness) {
    static const GaussRule<48> rule;
    static const HalfCircle<16> circle;
    const float a = roughness * roughness;
    const float vx = std::sqrt(1 - n_dot_v * n_dot_v);
    const float length = std::sqrt(a * a * vx * vx + n_dot_v * n_dot_v);
    const float px = a * vx / length;
    const float pz = n_dot_v / length;
    const float below = px * px / (1 + pz);  // 1 - p.z
    float scale = 0;
    float bias = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const float t = rule.nodes[i];
        const float hz = (1 + pz) * t * t;
        const float sine = std::sqrt((1 + pz) * (1 - t * t) * (below + hz));
        float scale_here = 0;
        float bias_here = 0;
        for (std::size_t j = 0; j < circle.cosines.size(); ++j) {
            const float hx = a * (sine * circle.cosines[j] + px);
            const float hy = a * sine * circle.sines[j];
            const float inverse = 1 / std::sqrt(hx * hx + hy * hy + hz * hz);
            const float vh = std::min((hx * vx + hz * n_dot_v) * inverse, 1.0F);
            const float nl = std::max(2 * vh * hz * inverse - n_dot_v, 0.0F);
            const float g = 2 * nl / (nl + std::sqrt(a * a + (1 - a * a) * nl * nl));
            const float m = std::max(1 - vh, 0.0F);
            const float fresnel = g * (m * m) * (m * m) * m;
            scale_here += g - fresnel;
            bias_here += fresnel;
        }
        scale += scale_here * rule.weights[i] * 2 * t;
        bias += bias_here * rule.weights[i] * 2 * t;
    }
    return glm::vec2(scale, bias) / static_cast<float>(circle.cosines.size());
}

/// The fit of lambda in KHR_materials_sheen, after A. Estevez and C. Kulla, "Production friendly
/// microfacet sheen BRDF", 2017.
float sheen_lambda(float cosine, float a) {
    const float m = (1 - a) * (1 - a);
    const auto fit = [&](float x) {
        return std::lerp(21.5473F, 25.3245F, m) /
                   (1 + std::lerp(3.82987F, 3.32435F, m) *
                            std::pow(x, std::lerp(0.19823F, 0.16801F, m))) +
               std::lerp(-1.97760F, -1.27393F, m) * x + std::lerp(-4.32054F, -4.85967F, m);
    };
    return cosine < 0.5F ? std::exp(fit(cosine)) : std::exp(2 * fit(0.5F) - fit(1 - cosine));
}

/// The integral of the sheen lobe of KHR_materials_sheen with a white colour under uniform light,
///
///   int D V (n.l) dl,   D = (2 + 1/a) sin(n, h)^(1/a) / (2 pi),
///   V = 1 / ((1 + lambda(n.v) + lambda(n.l)) 4 n.v n.l), at most 1,
///
/// over n.l = t^2 and the angle around the normal, a = roughness^2. Close to the horizon the fit
/// reflects more than arrives, up to twice as much for n.v below .05; this gives at most 1.
float integrate_sheen(float n_dot_v, float roughness) {
    static const GaussRule<48> rule;
    static const HalfCircle<16> circle;
    const float a = roughness * roughness;
    const float lambda_v = sheen_lambda(n_dot_v, a);
    const float vx = std::sqrt(1 - n_dot_v * n_dot_v);
    float sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const float t = rule.nodes[i];
        const float nl = t * t;
        const float lx = std::sqrt(1 - nl * nl);
        float lobe = 0;
        for (const float cosine : circle.cosines) {
            const float vl = n_dot_v * nl + vx * lx * cosine;
            const float nh = n_dot_v + nl;
            const float sine_squared = 1 - nh * nh / (2 + 2 * vl);
            if (sine_squared > 0) lobe += std::exp(std::log(sine_squared) * (0.5F / a));
        }
        const float smith = (1 + lambda_v + sheen_lambda(nl, a)) * 4 * n_dot_v * nl;
        sum += lobe / std::max(smith, 1.0F) * nl * rule.weights[i] * 2 * t;
    }
    const float albedo = sum * (2 + 1 / a) / static_cast<float>(circle.cosines.size());
    return std::min(albedo, 1.0F);
}

/// Lookups clamp n.v to this number: below, the fit of lambda grows without bounds.
constexpr float least_n_dot_v = 1e-4F;

/// A mirror reflects F; a sheen of roughness 0 has no lobe.
glm::vec4 table_node(int row, int column) {
    constexpr auto last = static_cast<float>(brdf_table_size - 1);
    const float n_dot_v = static_cast<float>(column) / last;
    if (row == 0) {
        const float fresnel = std::pow(1 - n_dot_v, 5.0F);
        return {1 - fresnel, fresnel, 0, 0};
    }
    const float roughness = static_cast<float>(row) / last;
    const float cosine = std::max(n_dot_v, least_n_dot_v);
    return {integrate_ggx(cosine, roughness), integrate_sheen(cosine, roughness), 0};
}

std::vector<glm::vec4> make_brdf_table() {
    const UninterruptedScope uninterrupted;  // it initialises a static variable
    std::vector<glm::vec4> table(static_cast<std::size_t>(brdf_table_size) * brdf_table_size);
    parallel_for(0, table.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            table[i] = table_node(static_cast<int>(i) / brdf_table_size,
                                  static_cast<int>(i) % brdf_table_size);
        }
    });
    return table;
}

}  // namespace

std::span<const glm::vec4> brdf_table() {
    static const std::vector<glm::vec4> table = make_brdf_table();
    return table;
}

glm::vec2 brdf(float n_dot_v, float roughness) {
    constexpr int last = brdf_table_size - 1;
    const std::span<const glm::vec4> table = brdf_table();
    const float x = std::clamp(n_dot_v, 0.0F, 1.0F) * static_cast<float>(last);
    const float y = std::clamp(roughness, 0.0F, 1.0F) * static_cast<float>(last);
    const int column = std::min(static_cast<int>(x), last - 1);
    const int row = std::min(static_cast<int>(y), last - 1);
    const float s = x - static_cast<float>(column);
    const float t = y - static_cast<float>(row);
    const auto node = [&](int down, int right) {
        return glm::vec2(
            table[static_cast<std::size_t>((row + down) * brdf_table_size + column + right)]);
    };
    return glm::mix(glm::mix(node(0, 0), node(0, 1), s), glm::mix(node(1, 0), node(1, 1), s), t);
}

}  // namespace cubecam
