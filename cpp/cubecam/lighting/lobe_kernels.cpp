#include "cubecam/lighting/lobe_kernels.hpp"

#include <cstring>

// As in cubemap/box_kernels.cpp: the loader takes the version that the processor can run, and all
// versions give the same bits.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CUBECAM_LOBE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CUBECAM_LOBE_CLONES
#endif

namespace cubecam {

namespace {

constexpr std::size_t lane_count = 8;
static_assert(tile_texels % lane_count == 0);
typedef float Lanes __attribute__((vector_size(lane_count * sizeof(float))));
typedef std::int32_t LaneBits __attribute__((vector_size(lane_count * sizeof(float))));

/// The mean of the lobe f(x) = (1 - x) / (1 + k x)^2 over a node, for 8 texels; x = 1 - N.L.
///
/// The mean of x is |N - c|^2 / 2 + w, w = (1 - |c|^2) / 2: squares, since for sharp lobes the
/// relative error of x counts. Around it, f's first derivative cancels. With q = 1 / (1 + k x) its
/// second one is f'' = 2 k q^3 (2 + 3 k q (1 - x)), and the variance of x, for light that spreads
/// evenly in all directions within the node, is (1 - (N.L)^2) w. Half their product is added.
[[gnu::always_inline]] inline void weigh_lobe(const Lanes& x, const Lanes& y, const Lanes& z,
                                              const glm::vec4& center, float sharpness,
                                              Lanes& lobe) {
    const Lanes dx = x - center.x;
    const Lanes dy = y - center.y;
    const Lanes dz = z - center.z;
    const Lanes away = (dx * dx + dy * dy + dz * dz) * 0.5F + center.w;
    const Lanes near = 1.0F / (away * sharpness + 1.0F);
    const Lanes cosine = 1.0F - away;
    const LaneBits above = cosine > 0.0F;
    const Lanes clamped = reinterpret_cast<Lanes>(reinterpret_cast<LaneBits>(cosine) & above);
    const Lanes share = near * sharpness;
    const Lanes curvature = share * (share * clamped * 3.0F + 2.0F);
    lobe = near * near * (clamped + curvature * ((1.0F - cosine * cosine) * center.w));
}

}  // namespace

CUBECAM_LOBE_CLONES void filter_tile(const TileNormals& normals, float sharpness,
                                     const RadianceNode* const* nodes, std::size_t count,
                                     TileSums& sums) {
    for (std::size_t first = 0; first < tile_texels; first += lane_count) {
        Lanes x;
        Lanes y;
        Lanes z;
        std::memcpy(&x, normals.x + first, sizeof x);
        std::memcpy(&y, normals.y + first, sizeof y);
        std::memcpy(&z, normals.z + first, sizeof z);
        Lanes red{};
        Lanes green{};
        Lanes blue{};
        Lanes alpha{};
        Lanes weight{};
        for (std::size_t i = 0; i < count; ++i) {
            const RadianceNode& node = *nodes[i];
            Lanes lobe;
            weigh_lobe(x, y, z, node.light_centers[0], sharpness, lobe);
            red += lobe * node.radiance.x;
            weigh_lobe(x, y, z, node.light_centers[1], sharpness, lobe);
            green += lobe * node.radiance.y;
            weigh_lobe(x, y, z, node.light_centers[2], sharpness, lobe);
            blue += lobe * node.radiance.z;
            weigh_lobe(x, y, z, node.center, sharpness, lobe);
            alpha += lobe * node.radiance.w;
            weight += lobe * node.solid_angle;
        }
        std::memcpy(sums.red + first, &red, sizeof red);
        std::memcpy(sums.green + first, &green, sizeof green);
        std::memcpy(sums.blue + first, &blue, sizeof blue);
        std::memcpy(sums.alpha + first, &alpha, sizeof alpha);
        std::memcpy(sums.weight + first, &weight, sizeof weight);
    }
}

}  // namespace cubecam
