#pragma once

#include "cubecam/math/cube_face.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cubecam {

struct CubeMapData;
class TreeShape;
struct FilterTile;
struct TileSums;

/// Texels (RGBA, linear) of a cube: six faces of size * size, laid out as cube_face.hpp says.
struct FilteredLevel {
    int size = 0;
    float roughness = 0.0F;
    std::vector<glm::vec4> texels;

    std::span<const glm::vec4> face(std::size_t index) const {
        const std::size_t count = texels.size() / face_count;
        return {texels.data() + index * count, count};
    }
};

/// What is made of a cube.
struct FilterRule {
    int size = 256;            ///< texels along an edge of the cube
    int levels = 6;            ///< with level 0, which is the cube itself
    int irradiance_size = 32;  ///< 0: no irradiance

    bool operator==(const FilterRule&) const = default;
};

/// The roughness of level k of `levels`: k / (levels - 1), 0 for a single level.
float level_roughness(int level, int levels);
/// The texels along an edge of a level of a cube with `size`: the power of two that is nearest, in
/// ratio, to 25.6 / roughness, at least 32, and at most `size`; `size` itself for roughness 0. So
/// bilinear lookups of the level are true: 128 for .2, 64 for .4, 32 from .6 on.
int level_size(int size, float roughness);

/// A cube of radiance, filtered for each roughness by the lobe of GGX, and its irradiance.
///
/// The contents depend only on the rule and on the faces: filtering the faces that changed gives
/// the same bits as filtering all of them.
class FilteredCube {
public:
    /// Gets the share that is done, from 0 to 1, on the calling thread; false cancels the work.
    using Progress = std::function<bool(double)>;
    /// rule.size * rule.size texels of each face, GL's layout.
    using Faces = std::array<std::span<const glm::vec4>, face_count>;

    /// @throws std::invalid_argument unless the size and the number of levels are at least 1.
    explicit FilteredCube(const FilterRule& rule);
    ~FilteredCube();
    FilteredCube(FilteredCube&&) noexcept;
    FilteredCube& operator=(FilteredCube&&) noexcept;

    const FilterRule& rule() const { return rule_; }

    /// Filters again what depends on the faces with `changed`; the first time, all of them. The
    /// texels of other faces are not read. NaN counts as 0, infinity as 65504 (the largest
    /// float16), and finite numbers are clamped to 1e30, so that no result is NaN.
    /// Returns false if it was cancelled; levels() is then unchanged, and the next call does
    /// everything, so it needs all faces.
    /// @throws std::invalid_argument if a face that is read has another number of texels.
    bool update(const Faces& faces, const std::array<bool, face_count>& changed,
                const Progress& progress = {});
    /// The same for a cube of rule.size, whose faces are converted one by one, which takes less
    /// memory.
    bool update(const CubeMapData& cube, const std::array<bool, face_count>& changed,
                const Progress& progress = {});

    /// Levels 1, 2, ...: without level 0, which is the cube itself.
    const std::vector<FilteredLevel>& levels() const { return levels_; }
    /// The cosine-weighted mean of the radiance around each direction (irradiance / pi).
    const FilteredLevel& irradiance() const { return irradiance_; }

private:
    /// Returns the texels of a face, which may lie in the vector.
    using FaceReader =
        std::function<std::span<const glm::vec4>(std::size_t, std::vector<glm::vec4>&)>;

    bool update_from(const FaceReader& read, const std::array<bool, face_count>& changed,
                     const Progress& progress);
    bool copies_last_level() const;
    void combine();
    void combine(std::size_t tile);

    FilterRule rule_;
    std::vector<FilteredLevel> levels_;
    FilteredLevel irradiance_;
    std::shared_ptr<const TreeShape> shape_;
    std::vector<FilterTile> tiles_;
    /// For each tile, six sums, one for the light of each face.
    std::vector<TileSums> sums_;
    bool complete_ = false;
};

}  // namespace cubecam
