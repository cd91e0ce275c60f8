#pragma once

#include <cstdint>
#include <vector>

namespace cubecam {

/// The work of the last call.
struct Stats {
    std::int64_t views_drawn =
        0;  ///< pictures drawn: frames, faces of captures and probes, textures
    std::int64_t views_skipped = 0;  ///< pictures that were still valid
    std::int64_t draw_calls = 0;
    std::int64_t triangles = 0;  ///< sent to the GPU, counted for each view
    /// Triangles of drawn meshes that were not sent, since they lie outside of what was drawn.
    std::int64_t triangles_skipped = 0;
    /// Triangles that the exact meshes have more than the levels of detail that were drawn.
    std::int64_t triangles_simplified = 0;
    std::int64_t probes_updated = 0;      ///< probes of which at least one face was drawn
    std::int64_t textures_updated = 0;    ///< render textures that were drawn
    std::int64_t shadow_views_drawn = 0;  ///< layers of shadow maps; a point light has six
    std::int64_t faces_filtered = 0;      ///< faces of environments, filtered by roughness
    std::int64_t pictures_not_kept = 0;   ///< too large for the cache, so every call draws them
    /// For each bounce of probes after the first: how much it changed what their mirrors show, as
    /// the root of the mean of squares (BounceChangePass); NaN if that is not known.
    std::vector<double> bounce_changes;
    double milliseconds = 0.0;  ///< of the whole call with reading back

    /// Adds the work of another picture of the same call.
    Stats& operator+=(const Stats& more) {
        views_drawn += more.views_drawn;
        views_skipped += more.views_skipped;
        draw_calls += more.draw_calls;
        triangles += more.triangles;
        triangles_skipped += more.triangles_skipped;
        triangles_simplified += more.triangles_simplified;
        probes_updated += more.probes_updated;
        textures_updated += more.textures_updated;
        shadow_views_drawn += more.shadow_views_drawn;
        faces_filtered += more.faces_filtered;
        bounce_changes = more.bounce_changes;
        return *this;
    }
};

}  // namespace cubecam
