#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <cstdint>
#include <memory>
#include <mutex>

namespace cubecam {

/// A mesh that scenes share and whose vertices may be updated from any thread.
///
/// The renderer holds the data of one moment, which never change.
class Mesh {
public:
    explicit Mesh(MeshData data);

    /// The vertices and triangles of this moment.
    std::shared_ptr<const MeshData> data() const;

    /// The revision of the data; reading it never waits for another thread.
    const Revision& revision() const { return revision_; }

    /// The mesh with flat faces, as MeshData::flat_shaded makes it. `data` are the data of this
    /// mesh at some moment. The result is kept until the mesh changes, so that all users share it.
    std::shared_ptr<const MeshData> flat_shaded(const std::shared_ptr<const MeshData>& data) const;

    /// Replaces the vertex values that the update contains and keeps the others. An empty update
    /// changes nothing.
    /// @throws the exceptions of MeshData::updated; the mesh then stays as it was.
    void update(MeshUpdate update);

private:
    std::mutex updates_;        ///< updates run one after the other, so none is lost
    mutable std::mutex mutex_;  ///< of data_, held for a moment only
    std::shared_ptr<const MeshData> data_;
    Revision revision_;

    mutable std::mutex flat_mutex_;                 ///< of the next two
    mutable std::shared_ptr<const MeshData> flat_;  ///< null until it is needed
    mutable std::uint64_t flat_of_ = 0;             ///< the revision of the data of `flat_`
};

}  // namespace cubecam
