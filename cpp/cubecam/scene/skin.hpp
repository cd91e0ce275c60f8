#pragma once

#include "cubecam/scene/weak_nodes.hpp"

#include <glm/glm.hpp>

#include <memory>
#include <vector>

namespace cubecam {

/// The joints that bend a mesh: nodes of the mesh's scene (glTF 2.0, section 3.7.3). A skin never
/// changes, and does not keep its joints alive.
class Skin {
public:
    /// @param inverse_bind for each joint the matrix from the mesh's space to that of the joint;
    /// empty: unit matrices.
    /// @param skeleton the node above all joints, which no picture depends on; null: not known.
    /// @throws std::invalid_argument for no joint, another number of matrices, or a matrix that is
    /// not finite or whose last row is not (0, 0, 0, 1).
    Skin(WeakNodes joints, std::vector<glm::dmat4> inverse_bind,
         const std::shared_ptr<Node>& skeleton);

    const WeakNodes& joints() const { return joints_; }
    /// As many as joints.
    const std::vector<glm::dmat4>& inverse_bind() const { return inverse_bind_; }
    std::shared_ptr<Node> skeleton() const { return skeleton_.lock(); }

private:
    WeakNodes joints_;
    std::vector<glm::dmat4> inverse_bind_;
    std::weak_ptr<Node> skeleton_;
};

}  // namespace cubecam
