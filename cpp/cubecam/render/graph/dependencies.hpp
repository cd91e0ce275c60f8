#pragma once

#include "cubecam/render/graph/picture.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <vector>

/// The pictures that parts of a scene look up.
namespace cubecam {

/// A picture depends on each of these; one may come several times.
using Dependencies = std::vector<PictureId>;

/// Adds the pictures that a node shows. `number` is that of its scene.
void add_dependencies(const SceneSnapshot& scene, std::size_t number, const NodeSnapshot& node,
                      Dependencies& to);

/// Adds those that effects show.
void add_dependencies(const std::vector<EffectSnapshot>& effects, Dependencies& to);

/// Adds the shadow maps of a scene.
void add_shadows(const SceneSnapshot& scene, std::size_t number, Dependencies& to);

/// Adds the pictures by which a scene's casters move their vertices, in view or not, and shown
/// elsewhere or not: its shadow maps depend on them. None where no light has a shadow.
void add_caster_dependencies(const SceneSnapshot& scene, std::size_t number, Dependencies& to);

/// Each once, ascending.
Dependencies unique(Dependencies pictures);

/// What the pictures of one scene may show, whatever is in view and whatever is due.
class SceneContents {
public:
    /// `number` is the scene's in the call.
    SceneContents(const SceneSnapshot& scene, std::size_t number);

    /// The pictures that the nodes for which `wanted` is true show, and the scene's shadow maps if
    /// one of these nodes receives shadows.
    Dependencies shown(const std::function<bool(const NodeSnapshot&)>& wanted) const;

private:
    struct Showing {
        const NodeSnapshot* node;
        Dependencies pictures;
    };

    std::vector<Showing> showing_;
    std::vector<const NodeSnapshot*> receivers_;
    Dependencies shadows_;
};

}  // namespace cubecam
