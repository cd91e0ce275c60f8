#pragma once

#include "cubecam/render/graph/picture.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <vector>

/// The pictures that parts of a scene look up.
namespace cubecam {

/// The pictures that a picture depends on; the list may contain one several times.
using Dependencies = std::vector<PictureId>;

/// Adds the pictures that a node shows. `number` is the number of its scene.
void add_dependencies(const SceneSnapshot& scene, std::size_t number, const NodeSnapshot& node,
                      Dependencies& to);

/// Adds the pictures that effects show.
void add_dependencies(const std::vector<EffectSnapshot>& effects, Dependencies& to);

/// Adds the shadow maps of a scene.
void add_shadows(const SceneSnapshot& scene, std::size_t number, Dependencies& to);

/// Adds the pictures that a scene's casters look up to move their vertices or to find their holes,
/// whether these casters are in view or not: the scene's shadow maps depend on these pictures. Adds
/// none if no light has a shadow.
void add_caster_dependencies(const SceneSnapshot& scene, std::size_t number, Dependencies& to);

/// Returns the pictures sorted, each once.
Dependencies unique(Dependencies pictures);

/// What the pictures of one scene may ever show, regardless of the view and of the update policies.
class SceneContents {
public:
    /// `number` is the number of the scene in the call.
    SceneContents(const SceneSnapshot& scene, std::size_t number);

    /// The pictures that the nodes for which `wanted` is true show, and the scene's shadow maps if
    /// one of these nodes receives shadows.
    Dependencies shown(const std::function<bool(const NodeSnapshot&)>& wanted) const;

    /// Whether the scene behind shows through one of the nodes for which `wanted` is true.
    bool shows_behind(const std::function<bool(const NodeSnapshot&)>& wanted) const;

private:
    struct Showing {
        const NodeSnapshot* node;
        Dependencies pictures;
    };

    std::vector<Showing> showing_;
    std::vector<const NodeSnapshot*> receivers_;
    std::vector<const NodeSnapshot*> transmissive_;
    Dependencies shadows_;
};

}  // namespace cubecam
