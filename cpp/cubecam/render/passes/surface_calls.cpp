#include "cubecam/render/passes/surface_calls.hpp"

#include "cubecam/render/resources/sky_rays.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace cubecam {
namespace {

constexpr std::size_t dense_triangles = 4'000;

bool shows_in(const SurfaceItems& items, const SurfaceItem& item, std::size_t region) {
    const std::span<const std::uint32_t> regions(items.regions.data() + item.first_region,
                                                 item.region_count);
    return std::find(regions.begin(), regions.end(), region) != regions.end();
}

bool same_blend(const EnvironmentBlend& a, const EnvironmentBlend& b);

/// Whether surfaces of one material see the same environment in the same way.
bool same_look(const Environment& a, const Environment& b) {
    return a.cube.texture == b.cube.texture && a.placing == b.placing && a.filtered == b.filtered &&
           a.box_mipmaps.texture == b.box_mipmaps.texture &&
           a.planar.picture.texture == b.planar.picture.texture &&
           (a.blend == b.blend ||
            (a.blend != nullptr && b.blend != nullptr && same_blend(*a.blend, *b.blend)));
}

bool same_blend(const EnvironmentBlend& a, const EnvironmentBlend& b) {
    return a.has_rest == b.has_rest && a.influences == b.influences &&
           std::equal(a.others.begin(), a.others.end(), b.others.begin(), b.others.end(),
                      same_look);
}

bool is_drawn_alone(const NodeSnapshot& node) {
    return node.material.value.traits().user_code.has_value();
}

/// Whether one draw call may draw two nodes that follow each other.
bool join(const SurfaceItem& a, const SurfaceItem& b) {
    if (a.mesh != b.mesh || a.node->turned != b.node->turned) return false;
    // All backs of one call are drawn before its fronts, which is the order within one node alone.
    if (a.node->backs_first()) return false;
    const NodeSnapshot& left = *a.node;
    const NodeSnapshot& right = *b.node;
    const bool same_material = left.material.revision == right.material.revision;
    if (left.crowd != 0 && left.crowd == right.crowd) {
        return same_material || has_flat_constants(left);
    }
    return same_material && !is_drawn_alone(left) && left.receive_shadow == right.receive_shadow &&
           same_look(a.textures->environment, b.textures->environment);
}

}  // namespace

bool is_dense(const NodeSnapshot& node) {
    return node.mesh->triangles()->size() >= dense_triangles;
}

bool has_flat_constants(const NodeSnapshot& node) {
    const MaterialTraits& material = node.material.value.traits();
    return !material.user_code && material.constants <= most_flat_constants && !is_dense(node);
}

SurfaceItems find_items(const SurfaceInput& input, GpuCache& cache) {
    SurfaceItems items;
    const MeshData* last_mesh = nullptr;
    const GpuMesh* last_gpu_mesh = nullptr;
    const auto add = [&](const PlannedNode& planned, std::vector<SurfaceItem>& to) {
        const NodeSnapshot& node = input.scene.nodes[planned.node];
        const auto first = static_cast<std::uint32_t>(items.regions.size());
        const auto visibilities = input.plan.visible_in(planned);
        auto visibility = visibilities.begin();
        for (std::size_t r = 0; r < input.regions.size(); ++r) {
            const Region& region = input.regions[r];
            while (visibility != visibilities.end() && visibility->view < region.view) ++visibility;
            if (visibility == visibilities.end()) break;
            if (visibility->view != region.view || !visibility->bounds.overlaps(region.rect)) {
                continue;
            }
            items.regions.push_back(static_cast<std::uint32_t>(r));
        }
        const auto count = static_cast<std::uint32_t>(items.regions.size()) - first;
        if (count == 0) return;
        const MeshData* mesh = drawn_mesh(node, planned).get();
        if (mesh != last_mesh) {
            last_mesh = mesh;
            last_gpu_mesh = &cache.mesh(*mesh);
        }
        to.push_back({&node, mesh, last_gpu_mesh, &input.textures[planned.node], first, count});
    };
    for (const PlannedNode& planned : input.plan.opaque) add(planned, items.opaque);
    for (const PlannedNode& planned : input.plan.transparent) add(planned, items.transparent);
    return items;
}

std::size_t count_calls(const SurfaceItems& items, std::size_t regions) {
    std::size_t calls = 0;
    for (std::size_t region = 0; region < regions; ++region) {
        const SurfaceItem* last = nullptr;
        for (const SurfaceItem& item : items.opaque) {
            if (!shows_in(items, item, region)) continue;
            if (last == nullptr || !join(*last, item)) ++calls;
            last = &item;
        }
    }
    return calls;
}

SurfaceCallBuilder::SurfaceCallBuilder(const SurfaceInput& input, const SurfaceItems& items,
                                       const glm::ivec2& size, const glm::vec3& ambient,
                                       std::size_t alignment, TrianglePicker& picker)
    : input_(input), items_(items), size_(size), ambient_(ambient), alignment_(alignment),
      picker_(picker) {
    const glm::dvec3& origin = input.origin();
    for (const Region& region : input.regions) {
        const View& view = input.views[region.view];
        const glm::dmat4 from_origin = glm::translate(view.view_projection, origin);
        views_.push_back(
            make_view_record(view, reverse_depth(from_origin), origin, input.layer(region)));
    }
}

GLintptr SurfaceCallBuilder::append(const void* block, std::size_t size) {
    const std::size_t at = blocks_.size();
    blocks_.resize(at + (size + alignment_ - 1) / alignment_ * alignment_);
    std::memcpy(blocks_.data() + at, block, size);
    return static_cast<GLintptr>(at);
}

std::optional<GLintptr> SurfaceCallBuilder::append_constants(const NodeSnapshot& node) {
    const MaterialModel& material = *node.material.value.model;
    constants_.resize(material.traits().constants);
    if (constants_.empty()) return std::nullopt;
    material.write_constants(ambient_, constants_);
    return append(constants_.data(), constants_.size() * sizeof(glm::vec4));
}

std::optional<GLintptr> SurfaceCallBuilder::append_environment(const SurfaceItem& item) {
    const MaterialTraits& material = item.node->material.value.traits();
    const Environment& environment = item.textures->environment;
    if (!material.uses_environment || !needs_block(environment, material.user_code.has_value())) {
        return std::nullopt;
    }
    const EnvironmentBlock block = make_environment_block(environment, input_.origin());
    return append(&block, sizeof(block));
}

std::vector<GLintptr> SurfaceCallBuilder::append_blend(const SurfaceItem& item) {
    const EnvironmentBlend* blend = item.textures->environment.blend.get();
    if (blend == nullptr) return {};
    const InfluencesBlock influences = make_influences_block(*blend, input_.origin());
    std::vector<GLintptr> places{append(&influences, sizeof(influences))};
    for (const Environment& other : blend->others) {
        const EnvironmentBlock block = make_environment_block(other, input_.origin());
        places.push_back(append(&block, sizeof(block)));
    }
    return places;
}

/// The caller adds the view records.
SurfaceCall SurfaceCallBuilder::alone(const SurfaceItem& item) {
    const NodeBlock block = make_node_block(*item.node, input_.origin());
    return {&item,
            static_cast<GLuint>(view_records_.size()),
            0,
            append(&block, sizeof(block)),
            append_constants(*item.node),
            append_environment(item),
            append_blend(item)};
}

std::optional<IndexRange> SurfaceCallBuilder::pick(const SurfaceItem& item, std::size_t region) {
    const Region& part = input_.regions[region];
    return picker_.pick(*item.node, *item.data, *item.mesh, input_.views[part.view], part.rect,
                        size_);
}

void SurfaceCallBuilder::add_together(const SurfaceItem& item, std::optional<IndexRange> indices,
                                      std::vector<SurfaceCall>& to) {
    const auto place = static_cast<GLuint>(node_records_.size());
    node_records_.push_back(make_node_record(*item.node, input_.origin(), ambient_));
    // Nodes of one call draw the same triangles.
    if (!to.empty() && !to.back().node_block && !to.back().indices && !indices &&
        join(*to.back().item, item)) {
        ++to.back().count;
        return;
    }
    to.push_back({&item, place, 1, std::nullopt,
                  has_flat_constants(*item.node) ? std::nullopt : append_constants(*item.node),
                  append_environment(item), append_blend(item), indices});
}

void SurfaceCallBuilder::add_sky(std::size_t first_region, std::size_t count, SurfaceCalls& to) {
    to.first_sky = static_cast<GLuint>(view_records_.size());
    to.sky_count = static_cast<GLsizei>(count);
    const auto* sky = std::get_if<Environment>(&input_.background);
    if (sky == nullptr) return;
    if (!sky->placing.is_plain()) {
        const EnvironmentBlock block = make_environment_block(*sky, input_.origin());
        to.sky_environment = append(&block, sizeof(block));
    }
    for (std::size_t r = first_region; r < first_region + count; ++r) {
        const Region& region = input_.regions[r];
        const View& view = input_.views[region.view];
        view_records_.push_back(make_view_record(view, sky_rays(view, size_.x, size_.y),
                                                 input_.origin(), input_.layer(region)));
    }
}

SurfaceCalls SurfaceCallBuilder::layered() {
    SurfaceCalls calls;
    const auto add = [this](const SurfaceItem& item, std::vector<SurfaceCall>& to) {
        SurfaceCall call = alone(item);
        std::vector<SurfaceCall> parts;  // views that show a part of the mesh, one by one
        for (std::uint32_t i = 0; i < item.region_count; ++i) {
            const std::uint32_t region = items_.regions[item.first_region + i];
            const std::optional<IndexRange> indices = pick(item, region);
            if (indices) {
                SurfaceCall part = call;
                part.first = region;  // until it is known which record it reads
                part.count = 1;
                part.indices = indices;
                parts.push_back(std::move(part));
            } else {
                view_records_.push_back(views_[region]);
                ++call.count;
            }
        }
        if (call.count > 0) to.push_back(std::move(call));
        for (SurfaceCall& part : parts) {
            view_records_.push_back(views_[part.first]);
            part.first = static_cast<GLuint>(view_records_.size() - 1);
            to.push_back(std::move(part));
        }
    };
    for (const SurfaceItem& item : items_.opaque) add(item, calls.opaque);
    for (const SurfaceItem& item : items_.transparent) add(item, calls.transparent);
    add_sky(0, input_.regions.size(), calls);
    return calls;
}

SurfaceCalls SurfaceCallBuilder::of_region(std::size_t region) {
    SurfaceCalls calls;
    const ViewBlock block{views_[region], glm::vec4(input_.origin(), 0.0F)};
    calls.view_block = append(&block, sizeof(block));
    const auto add = [&](const SurfaceItem& item, std::vector<SurfaceCall>& to) {
        if (!shows_in(items_, item, region)) return;
        const std::optional<IndexRange> indices = pick(item, region);
        if (!is_drawn_alone(*item.node)) return add_together(item, indices, to);
        SurfaceCall call = alone(item);
        call.count = 1;
        call.indices = indices;
        view_records_.push_back(views_[region]);
        to.push_back(call);
    };
    for (const SurfaceItem& item : items_.opaque) add(item, calls.opaque);
    for (const SurfaceItem& item : items_.transparent) add(item, calls.transparent);
    add_sky(region, 1, calls);
    return calls;
}

}  // namespace cubecam
