#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <memory>
#include <mutex>

namespace cubecam {

/// A mesh that scenes share and whose vertices may be set anew, from any thread.
///
/// Whoever draws it holds its data of one moment, which stays as it is.
class Mesh {
public:
    explicit Mesh(MeshData data);

    /// The vertices and triangles of this moment.
    std::shared_ptr<const MeshData> data() const;

    /// That of the data, readable without waiting for anyone.
    const Revision& revision() const { return revision_; }

    /// Sets vertices anew; what the update leaves out stays. Without any value nothing changes.
    /// @throws as MeshData::updated does; the mesh then stays as it was.
    void update(MeshUpdate update);

private:
    std::mutex updates_;        ///< one update follows another: none is lost
    mutable std::mutex mutex_;  ///< of data_, held for a moment only
    std::shared_ptr<const MeshData> data_;
    Revision revision_;
};

}  // namespace cubecam
