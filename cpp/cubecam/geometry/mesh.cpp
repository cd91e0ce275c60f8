#include "cubecam/geometry/mesh.hpp"

#include "cubecam/core/interrupts.hpp"

#include <utility>

namespace cubecam {

Mesh::Mesh(MeshData data) : data_(std::make_shared<const MeshData>(std::move(data).of_new_mesh())) {
    revision_.set(data_->revision());
}

std::shared_ptr<const MeshData> Mesh::data() const {
    const std::lock_guard lock(mutex_);
    return data_;
}

template <class Make>
std::shared_ptr<const MeshData> Mesh::kept(Form& form, std::uint64_t revision, Make&& make) const {
    const std::lock_guard lock(forms_mutex_);
    const UninterruptedScope uninterrupted;
    if (form.data && form.of == revision) return form.data;
    auto made = std::make_shared<const MeshData>(make(form.data.get()));
    // A snapshot that was begun before an update may still be read after it.
    if (revision > form.of) form = {made, revision};
    return made;
}

std::shared_ptr<const MeshData>
Mesh::flat_shaded(const std::shared_ptr<const MeshData>& data) const {
    return kept(flat_, data->revision(),
                [&data](const MeshData* before) { return data->flat_shaded(before); });
}

std::shared_ptr<const MeshData> Mesh::with_tangents(const std::shared_ptr<const MeshData>& data,
                                                    int uv_set, bool flat) const {
    Form& form = with_tangents_[static_cast<std::size_t>(uv_set + (flat ? 2 : 0))];
    return kept(form, data->revision(), [&data, uv_set](const MeshData* before) {
        return data->with_tangents(uv_set, before);
    });
}

void Mesh::update(MeshUpdate update) {
    if (update.empty()) return;
    const std::lock_guard one(updates_);
    const UninterruptedScope uninterrupted;
    auto next = std::make_shared<const MeshData>(data()->updated(std::move(update)));
    const std::uint64_t revision = next->revision();
    {
        const std::lock_guard lock(mutex_);
        data_.swap(next);
    }
    revision_.set(revision);
}

}  // namespace cubecam
