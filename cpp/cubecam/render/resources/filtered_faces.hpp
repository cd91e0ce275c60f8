#pragma once

#include "cubecam/lighting/filtered_cube.hpp"
#include "cubecam/render/resources/filtered_texture.hpp"
#include "cubecam/render/resources/stats.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cubecam {

/// The filtered levels of a cube whose faces change one by one. Only the faces that changed since
/// the last update are read and filtered again.
class FilteredFaces {
public:
    using Texels = std::vector<glm::vec4>;
    using Revisions = std::array<std::uint64_t, face_count>;

    /// Follows a cube of `size` texels along an edge. `revisions` name the contents of its faces,
    /// and `read` returns the texels of a face (RGBA, linear, GL's layout).
    const FilteredTexture& update(const gl::Context& context, int size, const Revisions& revisions,
                                  const std::function<Texels(Face)>& read, Stats& stats);

private:
    std::optional<FilteredCube> filter_;
    Revisions revisions_{};
    FilteredTexture texture_;
};

}  // namespace cubecam
