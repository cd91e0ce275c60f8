#include "cubecam/geometry/mesh.hpp"

#include "cubecam/core/interrupts.hpp"

#include <utility>

namespace cubecam {
namespace {

/// Which arrays an update has, all of them empty.
MeshUpdate parts_of(const MeshUpdate& update) {
    MeshUpdate parts;
    if (update.positions) parts.positions.emplace();
    if (update.normals) parts.normals.emplace();
    if (update.uvs) parts.uvs.emplace();
    if (update.colors) parts.colors.emplace();
    if (update.uvs1) parts.uvs1.emplace();
    if (update.tangents) parts.tangents.emplace();
    if (update.influences) parts.influences.emplace();
    if (update.targets) parts.targets.emplace();
    if (update.levels) parts.levels.emplace();
    return parts;
}

/// Gives an update the arrays that it had before it was applied.
void fill(MeshUpdate& parts, const MeshData& updated) {
    const auto copy = [](auto& to, const auto& from) {
        if (to && from) *to = *from;
    };
    copy(parts.positions, updated.positions());
    if (!updated.smooth()) copy(parts.normals, updated.normals());
    copy(parts.uvs, updated.uvs());
    copy(parts.colors, updated.colors());
    copy(parts.uvs1, updated.uvs1());
    copy(parts.tangents, updated.tangents());
    if (parts.influences) *parts.influences = updated.influences();
    copy(parts.targets, updated.targets());
    if (parts.levels && updated.levels()) {
        for (const DrawnLevel& level : *updated.levels()) {
            parts.levels->push_back({*level.triangles, level.error});
        }
    }
}

}  // namespace

Mesh::Mesh(MeshData data) : data_(std::make_shared<const MeshData>(std::move(data).of_new_mesh())) {
    revision_.set(data_->revision());
}

std::shared_ptr<const MeshData> Mesh::data() const {
    const std::lock_guard lock(mutex_);
    return data_;
}

/// While a form is made no lock is held, since a signal handler may draw the mesh. Two threads may
/// make one form at once; then both get the one that was ready first.
template <class Make>
std::shared_ptr<const MeshData> Mesh::kept(Form& form, const MeshData& data, Make&& make) const {
    std::shared_ptr<const MeshData> before;
    {
        const std::lock_guard lock(forms_mutex_);
        if (form.is_of(data)) return form.data;
        before = form.data;
    }
    auto made = std::make_shared<const MeshData>(make(before.get()));
    const std::lock_guard lock(forms_mutex_);
    if (form.is_of(data)) return form.data;
    // A snapshot that was begun before an update may still be read after it.
    if (data.revision() > form.of) form = {made, data.revision()};
    return made;
}

Mesh::Form& Mesh::tangent_form(int uv_set, bool flat) const {
    return with_tangents_[static_cast<std::size_t>(uv_set + (flat ? 2 : 0))];
}

std::shared_ptr<const MeshData>
Mesh::flat_shaded(const std::shared_ptr<const MeshData>& data) const {
    return kept(flat_, *data,
                [&data](const MeshData* before) { return data->flat_shaded(before); });
}

std::shared_ptr<const MeshData> Mesh::with_tangents(const std::shared_ptr<const MeshData>& data,
                                                    int uv_set, bool flat) const {
    return kept(tangent_form(uv_set, flat), *data, [&data, uv_set](const MeshData* before) {
        return data->with_tangents(uv_set, before);
    });
}

bool Mesh::keeps_flat_shaded(const MeshData& data) const {
    const std::lock_guard lock(forms_mutex_);
    return flat_.is_of(data);
}

bool Mesh::keeps_tangents(const MeshData& data, int uv_set, bool flat) const {
    const std::lock_guard lock(forms_mutex_);
    return tangent_form(uv_set, flat).is_of(data);
}

void Mesh::update(MeshUpdate update) {
    if (update.empty()) return;
    MeshUpdate again = parts_of(update);
    std::shared_ptr<const MeshData> base = data();
    // No lock is held: a signal handler may update this mesh.
    auto next = std::make_shared<const MeshData>(base->updated(std::move(update)));
    const std::lock_guard one(updates_);
    if (data() != base) {  // another thread or a handler was faster
        const UninterruptedScope uninterrupted;
        base = data();
        fill(again, *next);
        next = std::make_shared<const MeshData>(base->updated(std::move(again)));
    }
    const std::uint64_t revision = next->revision();
    {
        const std::lock_guard lock(mutex_);
        data_.swap(next);
    }
    revision_.set(revision);
}

}  // namespace cubecam
