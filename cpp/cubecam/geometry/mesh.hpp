#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <array>
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

    /// The mesh with tangents, as MeshData::with_tangents makes it. `data` are the data of this
    /// mesh at some moment, or its flat-shaded form; the latter is `flat`. The result is kept, too.
    std::shared_ptr<const MeshData> with_tangents(const std::shared_ptr<const MeshData>& data,
                                                  int uv_set, bool flat) const;

    /// Whether flat_shaded() and with_tangents() need not make the form of these data.
    bool keeps_flat_shaded(const MeshData& data) const;
    bool keeps_tangents(const MeshData& data, int uv_set, bool flat) const;

    /// Replaces the vertex values that the update contains and keeps the others. An empty update
    /// changes nothing.
    /// @throws the exceptions of MeshData::updated; the mesh then stays as it was.
    void update(MeshUpdate update);

private:
    std::mutex updates_;        ///< updates run one after the other, so none is lost
    mutable std::mutex mutex_;  ///< of data_, held for a moment only
    std::shared_ptr<const MeshData> data_;
    Revision revision_;

    /// Another form of this mesh, made from its data at some moment.
    struct Form {
        std::shared_ptr<const MeshData> data;  ///< null until it is needed
        std::uint64_t of = 0;                  ///< the revision of the data from which it was made

        bool is_of(const MeshData& plain) const { return data && of == plain.revision(); }
    };
    Form& tangent_form(int uv_set, bool flat) const;
    template <class Make>
    std::shared_ptr<const MeshData> kept(Form& form, const MeshData& data, Make&& make) const;

    mutable std::mutex forms_mutex_;  ///< of the next two
    mutable Form flat_;
    mutable std::array<Form, 4> with_tangents_;  ///< by set of uvs, then of the flat-shaded form
};

}  // namespace cubecam
