#pragma once

#include "cubecam/math/cube_face.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

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
/// The texels along an edge of a level: enough for bilinear lookups, at most `size`.
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

    explicit FilteredCube(const FilterRule& rule);

    const FilterRule& rule() const { return rule_; }

    /// Filters again what depends on the faces with `changed`; the first time, all of them.
    /// Returns false if it was cancelled; the next call then does everything.
    bool update(const Faces& faces, const std::array<bool, face_count>& changed,
                const Progress& progress = {});

    /// Levels 1, 2, ...: without level 0, which is the cube itself.
    const std::vector<FilteredLevel>& levels() const { return levels_; }
    /// The cosine-weighted mean of the radiance around each direction (irradiance / pi).
    const FilteredLevel& irradiance() const { return irradiance_; }

private:
    FilterRule rule_;
    std::vector<FilteredLevel> levels_;
    FilteredLevel irradiance_;
};

}  // namespace cubecam
