#pragma once

#include "cubecam/core/interrupts.hpp"
#include "cubecam/geometry/deformation.hpp"
#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/scene/node.hpp"

#include <glm/glm.hpp>

#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace cubecam {

/// The form in which a material draws a mesh.
struct MeshForm {
    bool flat = false;
    int tangents = -1;  ///< the set of uvs from which tangents are made; -1: none are made

    bool operator==(const MeshForm&) const = default;
};

/// Tangents are made if the material needs them and the mesh has only the uvs for them.
MeshForm form_for(const MeshData& mesh, const MaterialValue& material);

/// The form of a mesh without weights, which the mesh itself keeps.
/// @param base the vertices of the mesh at some moment.
std::shared_ptr<const MeshData>
plain_form(const Mesh& mesh, const std::shared_ptr<const MeshData>& base, const MeshForm& form);

/// What morph targets and joints made of a mesh. Nodes keep it, so that equal weights and joints
/// give the same data again, and others become an update of the same mesh on the GPU.
struct Deformation {
    std::shared_ptr<const MeshData> base;
    MeshForm form;
    std::vector<float> weights;                ///< of `morphed`
    std::shared_ptr<const MeshData> morphed;   ///< null: not yet
    std::shared_ptr<const MeshData> flat;      ///< of `morphed`
    std::shared_ptr<const MeshData> tangents;  ///< of `flat` or `morphed`
    std::vector<JointMatrix> joints;           ///< of `skinned`
    std::shared_ptr<const MeshData> unskinned;
    std::shared_ptr<const MeshData> skinned;  ///< null: not yet
};

/// A node's mesh as it is drawn, and the matrix to the world.
struct DeformedMesh {
    std::shared_ptr<const MeshData> mesh;
    glm::dmat4 world;
};

/// Whether a node's mesh may change with weights or joints.
bool may_deform(const NodeValue& value, const MeshData& mesh);

/// Finds world matrices of nodes of one graph, which is locked, each once. The bits are those of
/// Node::world_matrix.
class WorldMatrices {
public:
    const glm::dmat4& of(const Node& node);

private:
    std::unordered_map<const Node*, glm::dmat4> known_;
    std::vector<const Node*> waiting_;
};

/// Deforms the meshes of nodes whose graph is locked, each once: nodes with the same mesh, skin,
/// weights and form share the result.
class Deformer {
public:
    /// @param world_of finds the world matrix of a node of the graph.
    Deformer(const NodeGraph& graph, std::function<glm::dmat4(const Node&)> world_of);

    /// @param base the vertices of the node's mesh at some moment.
    DeformedMesh deform(const Node& node, const std::shared_ptr<const MeshData>& base,
                        const MaterialValue& material);

private:
    using Look = std::tuple<const MeshData*, const Skin*, std::vector<float>, bool, int>;

    std::vector<JointMatrix> joint_matrices(const Skin& skin, const glm::dvec3& origin) const;
    /// The joints, if the skin fits: all are in the graph, and the mesh names no others.
    bool fits(const Skin& skin, const MeshData& mesh) const;

    const NodeGraph& graph_;
    const UninterruptedScope uninterrupted_;  ///< a handler may need the graph, which is locked
    std::function<glm::dmat4(const Node&)> world_of_;
    std::map<Look, std::shared_ptr<Deformation>> made_;
};

}  // namespace cubecam
