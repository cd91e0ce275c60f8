#include "cubecam/scene/snapshot.hpp"

#include "cubecam/scene/crowds.hpp"
#include "cubecam/scene/deformer.hpp"
#include "cubecam/scene/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace cubecam {

namespace {

/// Whether a map makes a surface translucent. A render texture does not, since its contents are not
/// known yet.
bool shows_through(const MapSource& map) {
    const auto* image = std::get_if<std::shared_ptr<const Image>>(&map);
    return image && *image && (*image)->translucent();
}

/// Whether any alpha of a surface is below one.
bool shows_through(const MaterialValue& material, const MeshData& mesh) {
    if (translucent(material)) return true;
    const MaterialTraits& traits = material.traits();
    if (traits.alpha_mode) return *traits.alpha_mode == AlphaMode::blend;
    if (traits.vertex_colors == VertexColors::color_and_alpha && mesh.translucent_colors()) {
        return true;
    }
    return std::any_of(traits.textures.begin(), traits.textures.end(),
                       [](const NamedTexture& texture) {
                           const auto* map = std::get_if<const MapSource*>(&texture.source);
                           return texture.alpha_counts && map != nullptr && shows_through(**map);
                       });
}

/// The bounds of all possible positions of a mesh's vertices.
Bounds bounds_for(const MeshData& mesh, const MaterialTraits& traits) {
    Bounds bounds = mesh.bounds();
    if (traits.moves_vertices()) {
        const double reach = traits.user_code->displacement.value_or(0.0F);
        bounds.low -= reach;
        bounds.high += reach;
    }
    return bounds;
}

/// Places a node in the world.
void put(NodeSnapshot& node, const glm::dmat4& world) {
    node.world = world;
    node.world_bounds = transformed(node.bounds, world);
    node.turned = glm::determinant(glm::dmat3(world)) < 0.0;
    const glm::dvec3 local = glm::max(glm::abs(node.bounds.low), glm::abs(node.bounds.high));
    node.reach = glm::dvec3(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        node.reach += glm::abs(glm::dvec3(world[axis])) * local[axis];
    }
}

/// Returns the node with an id, or null. Nodes are in the order of their ids, and usually no id is
/// missing.
NodeSnapshot* find_node(std::vector<NodeSnapshot>& nodes, std::int32_t id) {
    if (nodes.empty()) return nullptr;
    const auto guess = static_cast<std::size_t>(id - nodes.front().id);
    if (guess < nodes.size() && nodes[guess].id == id) return &nodes[guess];
    const auto at = std::lower_bound(
        nodes.begin(), nodes.end(), id,
        [](const NodeSnapshot& node, std::int32_t wanted) { return node.id < wanted; });
    return at != nodes.end() && at->id == id ? &*at : nullptr;
}

}  // namespace

/// The objects that the scenes of one snapshot share. Each object is read once, so that all its
/// users see one moment, and is kept alive, so that no new object gets its address.
class SharedReads {
public:
    /// @param postpones whether form_of() leaves out the forms of large meshes that are not kept,
    ///     for make_postponed().
    SharedReads(const Scene* first, bool postpones) : postpones_(postpones) {
        numbers_.emplace(first, 0);
    }

    const Material::State& state_of(const std::shared_ptr<Material>& material) {
        const auto found = materials_.find(material);
        if (found != materials_.end()) return found->second;
        const Material::State& state =
            materials_.emplace(material, material->state()).first->second;
        seen_.push_back({&material->revision(), state.revision});
        return state;
    }

    const std::shared_ptr<const MeshData>& data_of(const std::shared_ptr<Mesh>& mesh) {
        auto& data = meshes_[mesh];
        if (!data) {
            data = mesh->data();
            seen_.push_back({&mesh->revision(), data->revision()});
        }
        return data;
    }

    /// The form of a mesh that a node draws: with flat faces or not, and with tangents if the
    /// material needs them and the mesh has only the uvs from which they are made.
    std::shared_ptr<const MeshData> form_of(const std::shared_ptr<Mesh>& mesh,
                                            const MaterialValue& material) {
        const auto& data = data_of(mesh);
        const MeshForm form = form_for(*data, material);
        if (!form.flat && form.tangents < 0) return data;
        auto& made = forms_[{mesh, form.tangents, form.flat}];
        if (made) return made;
        if (postpones_ && takes_long(*data) && !is_kept(*mesh, data, form)) {
            postponed_.push_back({mesh, data, form});
            return made = data;  // other nodes may have the same mesh
        }
        made = plain_form(*mesh, data, form);
        return made;
    }

    /// Makes the forms that form_of() left out: no graph is locked, so a signal handler may run.
    /// The meshes keep them.
    void make_postponed() const {
        for (const auto& [mesh, data, form] : postponed_) plain_form(*mesh, data, form);
    }

    /// Whether forms were left out; what was read is then of no use.
    bool postponed() const { return !postponed_.empty(); }

    LightValue value_of(const Light& light) {
        Light::State state = light.state();
        seen_.push_back({&light.revision(), state.revision});
        return std::move(state.value);
    }

    ProbeValue value_of(const Probe& probe) {
        Probe::State state = probe.state();
        seen_.push_back({&probe.revision(), state.revision});
        return std::move(state.value);
    }

    std::shared_ptr<const ProbeGridSnapshot> snapshot_of(const std::shared_ptr<ProbeGrid>& grid) {
        if (!grid) return nullptr;
        ProbeGrid::State state = grid->state();
        seen_.push_back({&grid->revision(), state.revision});
        return std::make_shared<const ProbeGridSnapshot>(
            ProbeGridSnapshot{grid, std::move(state.value), state.revision});
    }

    PlanarMirrorValue value_of(const PlanarMirror& mirror) {
        const PlanarMirror::State state = mirror.state();
        seen_.push_back({&mirror.revision(), state.revision});
        return state.value;
    }

    CubeSnapshot snapshot_of(const std::shared_ptr<CubeMap>& cube) {
        auto& data = cubes_[cube];
        if (!data) {
            data = cube->data();
            seen_.push_back({&cube->revision(), data->revision});
        }
        return {cube, data};
    }

    MapSnapshot snapshot_of(const MapSource& source) {
        if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
            return *image ? MapSnapshot(*image) : MapSnapshot();
        }
        const auto* texture = std::get_if<std::shared_ptr<RenderTexture>>(&source);
        if (!texture || !*texture) return {};
        const auto [found, added] = indices_.try_emplace(texture->get(), textures.size());
        if (!added) return found->second;
        const std::size_t index = found->second;
        textures.push_back(read(*texture));
        // The effects may show further textures, so the list grows.
        std::vector<EffectSnapshot> effects;
        for (const auto& effect : textures[index].value.effects)
            effects.push_back(snapshot_of(*effect));
        textures[index].effects = std::move(effects);
        return index;
    }

    /// An effect belongs to no scene, so it shows no probe.
    EffectSnapshot snapshot_of(const ImageEffect& effect) {
        auto [value, revision] = effect.state();
        std::vector<TextureSourceSnapshot> frozen;
        for (const auto& [name, source] : value.inputs.textures) {
            if (const auto* map = std::get_if<MapSource>(&source)) {
                frozen.emplace_back(snapshot_of(*map));
            } else {
                const auto& cube = std::get<std::shared_ptr<CubeMap>>(std::get<CubeSource>(source));
                frozen.emplace_back(CubeSourceSnapshot(snapshot_of(cube)));
            }
        }
        return {std::move(value), revision, std::move(frozen)};
    }

    std::vector<SeenRevision> take_seen() { return std::move(seen_); }

    std::vector<RenderTextureSnapshot> textures;
    std::vector<std::shared_ptr<Scene>> others;  ///< scenes of textures, except the first

private:
    RenderTextureSnapshot read(const std::shared_ptr<RenderTexture>& texture) {
        RenderTextureValue value = texture->value();
        const auto [found, added] = numbers_.try_emplace(value.scene.get(), numbers_.size());
        if (added) others.push_back(value.scene);
        RenderTextureSnapshot snapshot{texture, std::move(value), {}, found->second, {}, {}};
        for (const auto& excluded : snapshot.value.exclude) {
            const auto node = excluded.lock();
            if (node && snapshot.value.scene->contains(*node)) {
                snapshot.excluded.push_back(node->id());
            }
        }
        return snapshot;
    }

    /// Whether the tangents or the flat faces of a mesh may take a tenth of a second.
    static bool takes_long(const MeshData& mesh) { return mesh.triangles()->size() > 20'000; }

    static bool is_kept(const Mesh& mesh, const std::shared_ptr<const MeshData>& data,
                        const MeshForm& form) {
        if (form.flat && !mesh.keeps_flat_shaded(*data)) return false;
        const auto plain = form.flat ? mesh.flat_shaded(data) : data;
        return form.tangents < 0 || mesh.keeps_tangents(*plain, form.tangents, form.flat);
    }

    struct Postponed {
        std::shared_ptr<Mesh> mesh;
        std::shared_ptr<const MeshData> data;
        MeshForm form;
    };

    const bool postpones_;
    std::vector<Postponed> postponed_;
    std::unordered_map<std::shared_ptr<Material>, Material::State> materials_;
    std::unordered_map<std::shared_ptr<Mesh>, std::shared_ptr<const MeshData>> meshes_;
    std::map<std::tuple<std::shared_ptr<Mesh>, int, bool>, std::shared_ptr<const MeshData>>
        forms_;  // by set of uvs (-1: no tangents are made) and flatness
    std::unordered_map<std::shared_ptr<CubeMap>, std::shared_ptr<const CubeMapData>> cubes_;
    std::unordered_map<const RenderTexture*, std::size_t> indices_;  // into `textures`
    std::unordered_map<const Scene*, std::size_t> numbers_;
    std::vector<SeenRevision> seen_;
};

/// Reads the nodes of one scene; the scene's graph is locked.
class SnapshotBuilder {
public:
    SnapshotBuilder(const std::vector<std::shared_ptr<Node>>& nodes, const NodeGraph* graph,
                    SharedReads& shared, SceneSnapshot& to)
        : graph_(graph), shared_(shared), to_(to),
          deformer_(*graph, [this](const Node& node) { return resolve(index_of(node)).world; }) {
        nodes_.reserve(nodes.size());
        for (const auto& node : nodes) {
            if (node) nodes_.push_back(node.get());
        }
        places_.resize(nodes_.size());
    }

    void build() {
        to_.nodes.reserve(nodes_.size());
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const Place& place = resolve(i);
            if (place.visible && nodes_[i]->value_.mesh) add(*nodes_[i], place);
        }
        for (std::size_t i = 0; i < to_.probes.size(); ++i) place_probe(i);
        std::sort(to_.joints.begin(), to_.joints.end());
        to_.joints.erase(std::unique(to_.joints.begin(), to_.joints.end()), to_.joints.end());
        find_crowds(to_.nodes);
    }

    /// Probes whose parents are not in this scene, so that their own graphs must be locked.
    using Elsewhere = std::vector<std::pair<std::size_t, std::shared_ptr<Node>>>;
    Elsewhere take_elsewhere() { return std::move(elsewhere_); }

private:
    struct Place {
        glm::dmat4 world;
        bool visible;
        bool in_captures;
        bool cast_shadow;
        bool known = false;
    };

    /// Nodes are sorted by id, and usually no id is missing.
    std::size_t index_of(const Node& node) const {
        const auto guess = static_cast<std::size_t>(node.id() - nodes_.front()->id());
        if (guess < nodes_.size() && nodes_[guess] == &node) return guess;
        const auto at =
            std::lower_bound(nodes_.begin(), nodes_.end(), node.id(),
                             [](const auto& other, std::int32_t id) { return other->id() < id; });
        return static_cast<std::size_t>(at - nodes_.begin());
    }

    /// Computes a node's place without recursion: a long chain of parents would overflow the stack.
    const Place& resolve(std::size_t index) {
        std::size_t at = index;
        while (!places_[at].known) {
            waiting_.push_back(at);
            const Node* parent = nodes_[at]->parent_.get();
            if (!parent) break;
            at = index_of(*parent);
        }
        while (!waiting_.empty()) {
            const std::size_t next = waiting_.back();
            waiting_.pop_back();
            const Node& node = *nodes_[next];
            const NodeValue& value = node.value_;
            Place place{matrix_of(value.placing), value.visible, value.in_captures,
                        value.cast_shadow, true};
            if (node.parent_) {
                const Place& above = places_[index_of(*node.parent_)];
                place.world = above.world * place.world;
                place.visible = place.visible && above.visible;
                place.in_captures = place.in_captures && above.in_captures;
                place.cast_shadow = place.cast_shadow && above.cast_shadow;
            }
            places_[next] = place;
        }
        return places_[index];
    }

    void add(const Node& node, const Place& place) {
        const NodeValue& value = node.value_;
        const Material::State& material = shared_.state_of(value.material);
        const MaterialTraits& traits = material.value.traits();
        const SurfaceOptions& surface = material.value.surface;
        const auto& base = shared_.data_of(value.mesh);
        const bool deforms = may_deform(value, *base);
        std::shared_ptr<const MeshData> mesh;
        glm::dmat4 world = place.world;
        if (deforms) {
            DeformedMesh made = deformer_.deform(node, base, material.value);
            mesh = std::move(made.mesh);
            world = made.world;
            add_joints(node);
        } else {
            node.deformation_.reset();
            mesh = shared_.form_of(value.mesh, material.value);
        }
        const Blend blend = surface.blend.value_or(
            shows_through(material.value, *mesh) ? Blend::alpha : Blend::opaque);
        const bool moved = traits.moves_vertices();
        NodeSnapshot snapshot{
            node.id(),
            next_revision(),
            world,
            bounds_for(*mesh, traits),
            {},
            {},
            mesh,
            material,
            environment_of(value.environment),
            traits.textured ? snapshot_of(traits.textures, *mesh)
                            : std::vector<TextureSourceSnapshot>(),
            moved && !traits.user_code->displacement,
            place.in_captures,
            blend != Blend::opaque,
            blend,
            surface.depth_write.value_or(blend == Blend::opaque),
            {},
            place.cast_shadow,
            value.receive_shadow,
        };
        put(snapshot, world);
        snapshot.deforms = deforms;
        for (const Node* above = node.parent_.get(); above; above = above->parent_.get()) {
            snapshot.ancestors.push_back(above->id());
        }
        snapshot.render_order = value.render_order;
        snapshot.label = value.label;
        to_.nodes.push_back(std::move(snapshot));
    }

    void add_joints(const Node& node) {
        if (!node.value_.skin) return;
        for (const auto& weak : node.value_.skin->joints()) {
            if (const auto joint = weak.lock()) to_.joints.push_back(joint->id());
        }
    }

    CubeSourceSnapshot snapshot_of(const CubeSource& source) {
        if (const auto* cube = std::get_if<std::shared_ptr<CubeMap>>(&source); cube && *cube) {
            return shared_.snapshot_of(*cube);
        }
        if (const auto* probe = std::get_if<std::shared_ptr<Probe>>(&source); probe && *probe) {
            return place_of(*probe);
        }
        return {};
    }

    std::size_t place_of(const std::shared_ptr<Probe>& probe) {
        const auto [found, added] = probes_.try_emplace(probe.get(), to_.probes.size());
        if (added) to_.probes.push_back({probe, shared_.value_of(*probe), {}, {}});
        return found->second;
    }

    /// The environment of a node, which may also be a planar mirror or several probes.
    CubeSourceSnapshot environment_of(const CubeSource& source) {
        if (const auto* blend = std::get_if<std::shared_ptr<ProbeBlend>>(&source)) {
            auto& probes = blends_[blend->get()];
            if (!probes) {
                std::vector<std::size_t> places;
                for (const auto& probe : (*blend)->probes()) places.push_back(place_of(probe));
                probes = std::make_shared<const std::vector<std::size_t>>(std::move(places));
            }
            return ProbeBlendSnapshot{*blend, probes};
        }
        const auto* mirror = std::get_if<std::shared_ptr<PlanarMirror>>(&source);
        if (mirror == nullptr || !*mirror) return snapshot_of(source);
        const auto [found, added] = mirrors_.try_emplace(mirror->get(), to_.planar_mirrors.size());
        if (added) to_.planar_mirrors.push_back({*mirror, shared_.value_of(**mirror)});
        return PlanarMirrorIndex{found->second};
    }

    std::vector<TextureSourceSnapshot> snapshot_of(const std::vector<NamedTexture>& textures,
                                                   const MeshData& mesh) {
        std::vector<TextureSourceSnapshot> frozen;
        frozen.reserve(textures.size());
        for (const NamedTexture& texture : textures) {
            if (const auto* cube = std::get_if<const CubeSource*>(&texture.source)) {
                frozen.emplace_back(snapshot_of(**cube));
            } else {
                const bool shown = !texture.placed_by_uv || mesh.uvs(uv_set_of(texture));
                frozen.emplace_back(
                    shown ? shared_.snapshot_of(*std::get<const MapSource*>(texture.source))
                          : MapSnapshot());
            }
        }
        return frozen;
    }

    /// A probe follows the position of its parent, but not its rotation or scale.
    void place_probe(std::size_t index) {
        ProbeSnapshot& probe = to_.probes[index];
        probe.position = probe.value.position;
        if (auto parent = probe.value.parent.lock(); parent && is_here(*parent)) {
            probe.position += glm::dvec3(resolve(index_of(*parent)).world[3]);
        } else if (parent) {
            elsewhere_.emplace_back(index, std::move(parent));
        }
        for (const auto& excluded : probe.value.exclude) {
            if (const auto node = excluded.lock(); node && is_here(*node)) {
                probe.excluded.push_back(node->id());
            }
        }
    }

    bool is_here(const Node& node) const { return node.graph().get() == graph_; }

    std::vector<const Node*> nodes_;  // in the order of their ids
    const NodeGraph* graph_;
    SharedReads& shared_;
    SceneSnapshot& to_;
    Deformer deformer_;
    std::vector<Place> places_;
    std::vector<std::size_t> waiting_;
    std::unordered_map<const Probe*, std::size_t> probes_;
    std::unordered_map<const PlanarMirror*, std::size_t> mirrors_;
    std::unordered_map<const ProbeBlend*, std::shared_ptr<const std::vector<std::size_t>>> blends_;
    Elsewhere elsewhere_;
};

std::shared_ptr<const SceneSnapshot> Scene::snapshot(const Effects& effects,
                                                     const AroundWork& around) const {
    if (effects.empty()) {
        if (auto kept = kept_snapshot()) return kept;
    }
    {
        SharedReads shared(this, /*postpones=*/true);
        if (auto made = read_snapshot(effects, shared)) return made;
        const auto work = [&shared] { shared.make_postponed(); };
        around ? around(work) : work();
    }
    // Now all is made at once: a handler or a thread that updates meshes again and again cannot
    // keep this call from its end.
    SharedReads shared(this, /*postpones=*/false);
    return read_snapshot(effects, shared);
}

std::shared_ptr<const SceneSnapshot> Scene::read_snapshot(const Effects& effects,
                                                          SharedReads& shared) const {
    const std::uint64_t newest = newest_revision();  // before anything is read
    std::uint64_t changes = 0;
    auto snapshot = std::make_shared<SceneSnapshot>(snapshot_alone(shared, &changes));
    for (const auto& effect : effects) {
        snapshot->effects.push_back(shared.snapshot_of(*effect));
    }
    // Each scene is read under its own mutex alone: otherwise two scenes that show each other could
    // wait for each other.
    for (std::size_t i = 0; i < shared.others.size(); ++i) {
        const std::shared_ptr<const Scene> next = shared.others[i];  // the vector may grow
        snapshot->others.push_back(next->snapshot_alone(shared));
    }
    if (shared.postponed()) return nullptr;
    snapshot->textures = std::move(shared.textures);
    // The parents of cameras may be in any scene, so no scene is locked here.
    for (RenderTextureSnapshot& texture : snapshot->textures) {
        texture.camera = texture.value.camera->world_value();
    }
    snapshot->seen = shared.take_seen();
    snapshot->revision = next_revision();
    snapshot->origin = weak_from_this();
    // Render textures refer to scenes, and scenes to them: a kept snapshot must not keep them
    // alive.
    if (effects.empty() && snapshot->textures.empty() && !snapshot->follows_others) {
        const std::lock_guard lock(graph_->mutex);
        if (graph_->changes == changes) {
            graph_->snapshot = snapshot;
            graph_->newest_seen = newest;
        }
    }
    return snapshot;
}

std::shared_ptr<const SceneSnapshot> Scene::kept_snapshot() const {
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (!graph_->snapshot) return nullptr;
    const std::uint64_t newest = newest_revision();
    if (newest == graph_->newest_seen) return graph_->snapshot;
    const auto& seen = graph_->snapshot->seen;
    if (std::any_of(seen.begin(), seen.end(), [](const SeenRevision& s) { return s.outdated(); })) {
        outdated = graph_->changed();
        return nullptr;
    }
    if (!graph_->moved.empty()) {
        if (graph_->snapshot.use_count() > 1) {  // its other owners keep it unchanged
            outdated =
                std::exchange(graph_->snapshot, std::make_shared<SceneSnapshot>(*graph_->snapshot));
        }
        if (!follow_moves(*graph_->snapshot)) {
            outdated = graph_->changed();
            return nullptr;
        }
    }
    graph_->newest_seen = newest;
    return graph_->snapshot;
}

bool Scene::follow_moves(SceneSnapshot& snapshot) const {
    bool deformed = false;
    const auto follow = [&](const Node& node) {
        deformed = deformed ||
                   std::binary_search(snapshot.joints.begin(), snapshot.joints.end(), node.id());
        NodeSnapshot* moved = find_node(snapshot.nodes, node.id());
        if (moved == nullptr) return;  // a group or an invisible node
        if (moved->deforms) {
            deformed = true;
            return;
        }
        put(*moved, node.locked_world_matrix());
        moved->revision = next_revision();
    };
    // Each node is visited once: the joints of a chain would otherwise be visited for each joint
    // above them.
    const std::unordered_set<const Node*> all(graph_->moved.begin(), graph_->moved.end());
    std::unordered_set<const Node*> seen;
    const auto is_below_another = [&all](const Node& node) {
        const Node* above = node.parent_.get();
        while (above != nullptr && !all.contains(above)) above = above->parent_.get();
        return above != nullptr;
    };
    for (Node* moved : graph_->moved) {
        if (!seen.insert(moved).second || is_below_another(*moved)) continue;
        follow(*moved);
        if (moved->children_.empty()) continue;
        for (const auto& below : moved->subtree()) follow(*below);
    }
    graph_->moved.clear();
    if (deformed && !follow_deformations(snapshot)) return false;
    for (ProbeSnapshot& probe : snapshot.probes) {
        probe.position = probe.value.position;
        if (const auto parent = probe.value.parent.lock()) {
            probe.position += glm::dvec3(parent->locked_world_matrix()[3]);
        }
    }
    for (LightSnapshot& light : snapshot.lights) {
        if (const auto parent = light.value.parent.lock()) {
            light.value.parameters = transformed(light.own, parent->locked_world_matrix());
        }
    }
    snapshot.revision = next_revision();
    return true;
}

bool Scene::follow_deformations(SceneSnapshot& snapshot) const {
    WorldMatrices worlds;
    Deformer deformer(*graph_, [&worlds](const Node& node) { return worlds.of(node); });
    for (NodeSnapshot& node : snapshot.nodes) {
        if (!node.deforms) continue;
        const Node& source = *nodes_[place_of(node.id)];
        // The vertices of the snapshot's moment: the mesh may have been updated since.
        const auto base = source.deformation_->base;
        DeformedMesh made = deformer.deform(source, base, node.material.value);
        if (made.mesh == node.mesh && made.world == node.world) continue;
        if (made.mesh->translucent_colors() != node.mesh->translucent_colors()) return false;
        node.mesh = std::move(made.mesh);
        node.bounds = bounds_for(*node.mesh, node.material.value.traits());
        put(node, made.world);
        node.revision = next_revision();
    }
    return true;
}

SceneSnapshot Scene::snapshot_alone(SharedReads& shared, std::uint64_t* changes) const {
    SceneSnapshot snapshot;
    SnapshotBuilder::Elsewhere elsewhere;
    std::vector<std::pair<LightSnapshot*, std::shared_ptr<Node>>> lights_elsewhere;
    {
        const std::lock_guard lock(graph_->mutex);
        if (changes != nullptr) *changes = graph_->changes;
        SnapshotBuilder builder(nodes_, graph_.get(), shared, snapshot);
        if (environment_) snapshot.environment = shared.snapshot_of(environment_);
        snapshot.environment_placing = environment_placing_;
        snapshot.probe_grid = shared.snapshot_of(probe_grid_);
        if (const auto* color = std::get_if<glm::vec4>(&background_)) {
            snapshot.background = *color;
        } else if (const auto* cube = std::get_if<std::shared_ptr<CubeMap>>(&background_)) {
            snapshot.background = shared.snapshot_of(*cube);
        } else if (environment_) {
            snapshot.background = shared.snapshot_of(environment_);
            snapshot.shows_environment = true;
        } else {
            snapshot.background = glm::vec4(0.0F);
        }
        builder.build();
        elsewhere = builder.take_elsewhere();
        snapshot.lights.reserve(lights_.size());
        for (const auto& light : lights_) {
            snapshot.lights.push_back({light, shared.value_of(*light)});
            LightSnapshot& added = snapshot.lights.back();
            added.own = added.value.parameters;
            auto parent = added.value.parent.lock();
            if (parent && contains(*parent)) {
                added.value.parameters = transformed(added.own, parent->locked_world_matrix());
            } else if (parent) {
                lights_elsewhere.emplace_back(&added, std::move(parent));
            }
        }
    }
    // The lock is released here: otherwise two scenes whose probes follow each other's nodes could
    // wait for each other.
    snapshot.follows_others = !elsewhere.empty() || !lights_elsewhere.empty();
    for (const auto& [light, parent] : lights_elsewhere) {
        light->value.parameters = transformed(light->own, parent->world_matrix());
    }
    for (const auto& [index, parent] : elsewhere) {
        snapshot.probes[index].position += glm::dvec3(parent->world_matrix()[3]);
    }
    return snapshot;
}

}  // namespace cubecam
