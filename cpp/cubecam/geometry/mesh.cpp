#include "cubecam/geometry/mesh.hpp"

#include <utility>

namespace cubecam {

Mesh::Mesh(MeshData data) : data_(std::make_shared<const MeshData>(std::move(data).of_new_mesh())) {
    revision_.set(data_->revision());
}

std::shared_ptr<const MeshData> Mesh::data() const {
    const std::lock_guard lock(mutex_);
    return data_;
}

std::shared_ptr<const MeshData>
Mesh::flat_shaded(const std::shared_ptr<const MeshData>& data) const {
    const std::lock_guard lock(flat_mutex_);
    if (flat_ && flat_of_ == data->revision()) return flat_;
    auto flat = std::make_shared<const MeshData>(data->flat_shaded(flat_.get()));
    // A snapshot that was begun before an update may still be read after it.
    if (data->revision() > flat_of_) {
        flat_ = flat;
        flat_of_ = data->revision();
    }
    return flat;
}

void Mesh::update(MeshUpdate update) {
    if (update.empty()) return;
    const std::lock_guard one(updates_);
    auto next = std::make_shared<const MeshData>(data()->updated(std::move(update)));
    const std::uint64_t revision = next->revision();
    {
        const std::lock_guard lock(mutex_);
        data_.swap(next);
    }
    revision_.set(revision);
}

}  // namespace cubecam
