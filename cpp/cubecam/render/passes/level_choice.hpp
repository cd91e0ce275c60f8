#pragma once

#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cubecam {

struct Visibility;

/// Chooses levels of detail by the error that they have in a picture (docs/adr/0038).
///
/// The choice is the coarsest level of which every point that a view shows lies at most
/// `max_error` pixels from a point of the mesh, and the other way round. All views at one position
/// show the same level, so that the edges of a cube's faces fit.
class LevelChoice {
public:
    /// @param size of the pictures in pixels.
    /// @param max_error in pixels; 0: nothing but whole meshes.
    LevelChoice(const SceneSnapshot& scene, std::span<const View> views, const glm::ivec2& size,
                double max_error);

    /// The level of a node that views at one position may show: 0 for its mesh, i for its level
    /// number i - 1.
    std::uint32_t of(const NodeSnapshot& node, std::span<const Visibility> seen) const;

private:
    /// What a view's matrices say of the lengths in its picture.
    struct Scale {
        double pixels;       ///< of a unit across at depth 1; of a parallel view at any depth
        double widest;       ///< the greatest squared tangent of an angle to the axis
        bool known = false;  ///< of other matrices nothing is known
    };
    static Scale scale_of(const View& view, const glm::ivec2& size);
    bool may_simplify(const NodeSnapshot& node) const;
    /// The pixels by which a view shows a point of a node elsewhere that is moved by `error`, at
    /// most; infinite if there is no bound.
    double pixels(std::size_t view, const NodeSnapshot& node, double error) const;

    std::span<const View> views_;
    double max_error_;
    bool shadows_;
    std::vector<Scale> scales_;  ///< of each view
};

/// An upper bound for the length to which a matrix stretches a unit vector, exact for turns with
/// scales along the axes: the root of the largest sum of a row of |M^T M| (S. Gershgorin, 1931).
double largest_scale(const glm::dmat3& matrix);

}  // namespace cubecam
