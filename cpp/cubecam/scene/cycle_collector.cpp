#include "cubecam/scene/cycle_collector.hpp"

#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"

#include <cstddef>
#include <map>
#include <utility>
#include <variant>

namespace cubecam {

namespace {

/// Objects of one kind, each with one reference from here, and the number of references from other
/// objects of the search.
template <class Object>
struct Held {
    struct Entry {
        std::shared_ptr<Object> object;
        long inside = 0;
        bool reached = false;
    };
    std::map<const Object*, Entry> entries;

    /// Adds an object; returns whether it is new.
    bool add(const std::shared_ptr<Object>& object) {
        return entries.try_emplace(object.get(), Entry{object}).second;
    }
    void count(const Object* object) {
        const auto found = entries.find(object);
        if (found != entries.end()) ++found->second.inside;
    }
    /// Marks an object as reached; returns whether it is here and was not marked before.
    bool reach(const Object* object) {
        const auto found = entries.find(object);
        return found != entries.end() && !std::exchange(found->second.reached, true);
    }
    /// Calls `visit` for each object with a reference from outside the search.
    template <class Visit>
    void for_each_root(Visit&& visit) const {
        for (const auto& [object, entry] : entries) {
            if (entry.object.use_count() > entry.inside + 1) visit(object);
        }
    }
};

std::vector<std::shared_ptr<RenderTexture>> textures_of(const Material& material) {
    const MaterialValue value = material.value();
    std::vector<std::shared_ptr<RenderTexture>> textures;
    for (const NamedTexture& shown : value.traits().textures) {
        const auto* map = std::get_if<const MapSource*>(&shown.source);
        if (map == nullptr) continue;
        const auto* texture = std::get_if<std::shared_ptr<RenderTexture>>(*map);
        if (texture && *texture) textures.push_back(*texture);
    }
    return textures;
}

/// The materials that a node holds, each as often as the node holds it.
std::vector<std::shared_ptr<Material>> materials_of(const Node& node) {
    const NodeValue value = node.value();
    std::vector<std::shared_ptr<Material>> materials{value.material};
    for (const auto& [name, material] : value.variants) materials.push_back(material);
    if (value.own_material) materials.push_back(*value.own_material);
    std::erase(materials, nullptr);
    return materials;
}

/// An object with more references than those from the other objects of the search is held from
/// outside. Everything that it leads to is held, too; the rest is not (T. W. Christopher,
/// "Reference Count Garbage Collection", Software: Practice and Experience 14(6), 1984).
class Search {
public:
    explicit Search(const std::vector<std::weak_ptr<RenderTexture>>& textures) {
        for (const auto& weak : textures) {
            if (const auto texture = weak.lock()) textures_.add(texture);
        }
        for (const auto& [texture, entry] : textures_.entries) scenes_.add(texture->value().scene);
        for (const auto& [scene, entry] : scenes_.entries) {
            for (const auto& node : scene->nodes()) {
                nodes_.add(node);
                for (const auto& material : materials_of(*node)) materials_.add(material);
            }
        }
        for (const auto& [texture, entry] : textures_.entries) {
            scenes_.count(texture->value().scene.get());
        }
        for (const auto& [node, entry] : nodes_.entries) {
            nodes_.count(node);  // the reference of its scene
            nodes_.count(node->parent().get());
            for (const auto& material : materials_of(*node)) materials_.count(material.get());
        }
        for (const auto& [material, entry] : materials_.entries) {
            for (const auto& texture : textures_of(*material)) textures_.count(texture.get());
        }
    }

    void free() {
        scenes_.for_each_root([this](const Scene* scene) { reach(scene); });
        nodes_.for_each_root([this](const Node* node) { reach(node); });
        materials_.for_each_root([this](const Material* material) { reach(material); });
        textures_.for_each_root([this](const RenderTexture* texture) { reach(texture); });
        while (!open_.empty()) {
            const Any next = open_.back();
            open_.pop_back();
            std::visit([this](const auto* object) { follow(object); }, next);
        }
        for (auto& [texture, entry] : textures_.entries) {
            if (!entry.reached) entry.object->let_go();
        }
    }

private:
    using Any = std::variant<const Scene*, const Node*, const Material*, const RenderTexture*>;

    void reach(const Scene* scene) {
        if (scenes_.reach(scene)) open_.emplace_back(scene);
    }
    void reach(const Node* node) {
        if (nodes_.reach(node)) open_.emplace_back(node);
    }
    void reach(const Material* material) {
        if (materials_.reach(material)) open_.emplace_back(material);
    }
    void reach(const RenderTexture* texture) {
        if (textures_.reach(texture)) open_.emplace_back(texture);
    }

    void follow(const Scene* scene) {
        for (const auto& node : scene->nodes()) reach(node.get());
    }
    void follow(const Node* node) {
        reach(node->parent().get());
        for (const auto& material : materials_of(*node)) reach(material.get());
    }
    void follow(const Material* material) {
        for (const auto& texture : textures_of(*material)) reach(texture.get());
    }
    void follow(const RenderTexture* texture) { reach(texture->value().scene.get()); }

    Held<Scene> scenes_;
    Held<Node> nodes_;
    Held<Material> materials_;
    Held<RenderTexture> textures_;
    std::vector<Any> open_;
};

}  // namespace

void collect_cycles(const std::vector<std::weak_ptr<RenderTexture>>& textures) {
    Search(textures).free();
}

}  // namespace cubecam
