#pragma once

#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/math/plane.hpp"
#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace cubecam {

/// The planar mirrors of one scene, with their planes in the world. Nodes with one PlanarMirror in
/// one plane, as the tiles of a floor, are one mirror.
class PlanarMirrors {
public:
    struct Mirror {
        Target::Mirrors::Name name;
        PlanarMirrorValue value;
        Plane plane;
        double size;                      ///< of its first node
        bool looked_up_by_level = false;  ///< some node's material looks it up by roughness
    };

    /// `planes` keeps the planes of meshes from call to call.
    /// @throws std::invalid_argument for a mesh that is not flat.
    PlanarMirrors(const SceneSnapshot& scene, WeakCache<const MeshData, Plane>& planes);

    const std::vector<Mirror>& all() const { return all_; }
    /// The place of a node's mirror in all(); none: it has no planar mirror.
    std::optional<std::size_t> of(const NodeSnapshot& node) const;

private:
    std::size_t place(const SceneSnapshot& scene, const NodeSnapshot& node, const Plane& plane);

    const NodeSnapshot* first_ = nullptr;  // of the scene
    std::vector<Mirror> all_;
    std::vector<std::optional<std::size_t>> places_;  // of each node; empty: no node has a mirror
};

/// The pixels of a picture of `width` x `height` that a node's box, in its own space, may cover;
/// empty: the node is out of view. For a flat node it is narrower than the bounds of its box in the
/// world, which is thick where the node is turned and then reaches beside the eye: each mirror that
/// seems to be in view costs a picture.
Rect bounds_in_view(const View& view, const NodeSnapshot& node, int width, int height);

}  // namespace cubecam
