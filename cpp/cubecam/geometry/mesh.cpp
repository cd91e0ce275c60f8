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
