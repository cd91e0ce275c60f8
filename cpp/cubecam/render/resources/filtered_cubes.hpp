#pragma once

#include "cubecam/render/resources/filtered_faces.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstdint>

namespace cubecam {

/// The filtered levels of the cubemaps that surfaces look up by roughness.
class FilteredCubes {
public:
    /// A cubemap with levels of its own keeps them; every other one is filtered, as far as its
    /// faces changed since the last time.
    const FilteredTexture& get(const gl::Context& context, const CubeSnapshot& cube, Stats& stats);

    void sweep() { cubes_.sweep(); }

private:
    struct Entry {
        FilteredFaces faces;
        FilteredTexture own;             ///< of a cubemap with levels of its own
        std::uint64_t own_revision = 0;  ///< CubeMapData::revision of `own`
    };

    WeakCache<CubeMap, Entry> cubes_;
};

}  // namespace cubecam
