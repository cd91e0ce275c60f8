#include "cubecam/render/graph/dependencies.hpp"

#include "cubecam/render/graph/picture_order.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace cubecam {
namespace {

bool has(const std::vector<std::int32_t>& ids, std::int32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool uses(const NodeSnapshot& node, std::size_t probe) {
    const auto is_probe = [probe](const CubeSourceSnapshot& source) {
        const auto* index = std::get_if<std::size_t>(&source);
        return index != nullptr && *index == probe;
    };
    return is_probe(node.environment) ||
           std::any_of(node.textures.begin(), node.textures.end(),
                       [&is_probe](const TextureSourceSnapshot& texture) {
                           const auto* source = std::get_if<CubeSourceSnapshot>(&texture);
                           return source != nullptr && is_probe(*source);
                       });
}

}  // namespace

bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded) {
    if (excluded.empty()) return false;
    return has(excluded, node.id) ||
           std::any_of(node.ancestors.begin(), node.ancestors.end(),
                       [&excluded](std::int32_t id) { return has(excluded, id); });
}

const CubeSourceSnapshot& environment_of(const SceneSnapshot& scene, const NodeSnapshot& node) {
    static const CubeSourceSnapshot none;
    if (!node.material.value.traits().uses_environment) return none;
    return node.environment.index() == 0 ? scene.environment : node.environment;
}

bool moves_vertices(const NodeSnapshot& node) {
    return node.material.value.traits().moves_vertices();
}

bool receive_shadow(const NodeSnapshot& node) {
    return node.receive_shadow && node.material.value.traits().uses_lights;
}

bool has_shadows(const SceneSnapshot& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const LightSnapshot& light) { return light.value.shadow.has_value(); });
}

std::vector<std::size_t> vertex_textures(const NodeSnapshot& node) {
    std::vector<std::size_t> found;
    if (!moves_vertices(node)) return found;
    const MaterialTraits& traits = node.material.value.traits();
    for (std::size_t place = 0; place < traits.textures.size(); ++place) {
        if (mentions(traits.user_code->vertex->text, traits.textures[place].name)) {
            found.push_back(place);
        }
    }
    return found;
}

bool is_seen(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe) {
    return node.in_captures && !uses(node, probe) &&
           !is_excluded(node, scene.probes[probe].excluded);
}

bool is_seen(const RenderTextureSnapshot& texture, const NodeSnapshot& node) {
    return !is_excluded(node, texture.excluded);
}

PictureNumbers::PictureNumbers(const SceneSnapshot& asked_for) : first_{0} {
    for (std::size_t i = 0; i <= asked_for.others.size(); ++i) {
        first_.push_back(first_.back() + asked_for.scene(i).probes.size());
    }
    count_ = first_.back() + asked_for.textures.size();
}

PictureNumbers::Place PictureNumbers::place(std::size_t picture) const {
    if (picture >= first_.back()) return {std::nullopt, picture - first_.back()};
    // The last scene that starts at or before it: scenes without probes start where the next does.
    const auto after = std::upper_bound(first_.begin(), first_.end(), picture);
    const auto scene = static_cast<std::size_t>(after - first_.begin()) - 1;
    return {scene, picture - first_[scene]};
}

void PictureNumbers::add_needs(const SceneSnapshot& scene, std::size_t number,
                               const NodeSnapshot& node, std::vector<std::size_t>& to) const {
    add_needs(number, environment_of(scene, node), to);
    for (const TextureSourceSnapshot& texture : node.textures) add_needs(number, texture, to);
}

void PictureNumbers::add_shadow_needs(const SceneSnapshot& scene, std::size_t number,
                                      std::vector<std::size_t>& to) const {
    if (!has_shadows(scene)) return;
    for (const NodeSnapshot& node : scene.nodes) {
        if (!node.cast_shadow) continue;
        for (const std::size_t place : vertex_textures(node)) {
            add_needs(number, node.textures[place], to);
        }
    }
}

void PictureNumbers::add_needs(std::size_t number, const TextureSourceSnapshot& texture,
                               std::vector<std::size_t>& to) const {
    const auto* source = std::get_if<CubeSourceSnapshot>(&texture);
    if (source == nullptr) return add_needs(std::get<MapSnapshot>(texture), to);
    if (const auto* probe = std::get_if<std::size_t>(source)) {
        to.push_back(of_probe(number, *probe));
    }
}

void PictureNumbers::add_needs(const MapSnapshot& map, std::vector<std::size_t>& to) const {
    if (const auto* texture = std::get_if<std::size_t>(&map)) to.push_back(of_texture(*texture));
}

void PictureNumbers::add_needs(const std::vector<EffectSnapshot>& effects,
                               std::vector<std::size_t>& to) const {
    for (const EffectSnapshot& effect : effects) {
        for (const TextureSourceSnapshot& texture : effect.textures) {
            if (const auto* map = std::get_if<MapSnapshot>(&texture)) add_needs(*map, to);
        }
    }
}

std::vector<std::size_t> unique(std::vector<std::size_t> pictures) {
    std::sort(pictures.begin(), pictures.end());
    pictures.erase(std::unique(pictures.begin(), pictures.end()), pictures.end());
    return pictures;
}

namespace {

/// All that pictures may ever show, whatever is in view and whatever is due.
class Contents {
public:
    Contents(const SceneSnapshot& asked_for, const PictureNumbers& numbers)
        : asked_for_(asked_for), numbers_(numbers), showing_(asked_for.others.size() + 1),
          casting_(showing_.size()), needs_(numbers.count()), found_(numbers.count(), false) {
        for (std::size_t s = 0; s < showing_.size(); ++s) {
            const SceneSnapshot& scene = asked_for.scene(s);
            for (const NodeSnapshot& node : scene.nodes) {
                std::vector<std::size_t> shown;
                numbers.add_needs(scene, s, node, shown);
                if (!shown.empty()) showing_[s].push_back({&node, std::move(shown)});
            }
            numbers.add_shadow_needs(scene, s, casting_[s]);
        }
    }

    /// What the shadows of any scene hang on.
    std::vector<std::size_t> casting() const {
        std::vector<std::size_t> all;
        for (const auto& pictures : casting_)
            all.insert(all.end(), pictures.begin(), pictures.end());
        return unique(std::move(all));
    }

    /// The needs of all that `roots` lead to.
    const std::vector<std::vector<std::size_t>>& follow(const std::vector<std::size_t>& roots) {
        std::vector<std::size_t> open = roots;
        while (!open.empty()) {
            const std::size_t picture = open.back();
            open.pop_back();
            if (found_[picture]) continue;
            found_[picture] = true;
            needs_[picture] = find(picture);
            open.insert(open.end(), needs_[picture].begin(), needs_[picture].end());
        }
        return needs_;
    }

private:
    struct Showing {
        const NodeSnapshot* node;
        std::vector<std::size_t> pictures;
    };

    std::vector<std::size_t> find(std::size_t picture) const {
        const PictureNumbers::Place place = numbers_.place(picture);
        std::vector<std::size_t> needs;
        const auto add = [&](std::size_t scene, const auto& seen) {
            const std::vector<NodeSnapshot>& nodes = asked_for_.scene(scene).nodes;
            if (std::any_of(nodes.begin(), nodes.end(), [&seen](const NodeSnapshot& node) {
                    return receive_shadow(node) && seen(node);
                })) {
                needs.insert(needs.end(), casting_[scene].begin(), casting_[scene].end());
            }
            for (const Showing& showing : showing_[scene]) {
                if (!seen(*showing.node)) continue;
                needs.insert(needs.end(), showing.pictures.begin(), showing.pictures.end());
            }
        };
        if (place.scene) {
            const SceneSnapshot& scene = asked_for_.scene(*place.scene);
            add(*place.scene,
                [&](const NodeSnapshot& node) { return is_seen(scene, node, place.index); });
        } else {
            const RenderTextureSnapshot& texture = asked_for_.textures[place.index];
            add(texture.scene, [&](const NodeSnapshot& node) { return is_seen(texture, node); });
            numbers_.add_needs(texture.effects, needs);
        }
        return unique(std::move(needs));
    }

    const SceneSnapshot& asked_for_;
    const PictureNumbers& numbers_;
    std::vector<std::vector<Showing>> showing_;      // of each scene
    std::vector<std::vector<std::size_t>> casting_;  // the same: what its shadows hang on
    std::vector<std::vector<std::size_t>> needs_;
    std::vector<bool> found_;
};

/// The shortest way from a picture back to itself, both ends included; nothing if there is none.
std::vector<std::size_t> circle(const std::vector<std::vector<std::size_t>>& needs,
                                std::size_t start) {
    constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> from(needs.size(), unseen);
    std::vector<std::size_t> reached{start};
    for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const std::size_t needed : needs[reached[i]]) {
            if (needed == start) {
                std::vector<std::size_t> way{start};
                for (std::size_t at = reached[i]; at != start; at = from[at]) way.push_back(at);
                way.push_back(start);
                std::reverse(way.begin(), way.end());
                return way;
            }
            if (from[needed] != unseen) continue;
            from[needed] = reached[i];
            reached.push_back(needed);
        }
    }
    return {};
}

/// What a message calls a picture that is the `position`-th of its chain.
std::string label(const SceneSnapshot& asked_for, const PictureNumbers& numbers,
                  std::size_t picture, std::size_t position) {
    const PictureNumbers::Place place = numbers.place(picture);
    if (!place.scene) {
        const std::string& name = asked_for.textures[place.index].value.name;
        return name.empty() ? "RenderTexture " + std::to_string(position) : '"' + name + '"';
    }
    const std::vector<NodeSnapshot>& nodes = asked_for.scene(*place.scene).nodes;
    const auto user = std::find_if(nodes.begin(), nodes.end(), [&](const NodeSnapshot& node) {
        return uses(node, place.index);
    });
    return "the probe of node " + std::to_string(user == nodes.end() ? 0 : user->id);
}

}  // namespace

bool may_have_circles(const SceneSnapshot& asked_for, const PictureNumbers& numbers) {
    std::vector<std::size_t> casting;
    for (std::size_t s = 0; s <= asked_for.others.size(); ++s) {
        numbers.add_shadow_needs(asked_for.scene(s), s, casting);
    }
    return !asked_for.textures.empty() || !casting.empty();
}

void refuse_circles(const SceneSnapshot& asked_for, const PictureNumbers& numbers,
                    const std::vector<std::size_t>& roots) {
    Contents contents(asked_for, numbers);
    const auto& needs = contents.follow(roots);
    const std::vector<std::size_t> components = order_pictures(needs, roots).components;
    std::vector<std::size_t> members(numbers.count(), 0);
    for (const std::size_t component : components) {
        if (component < members.size()) ++members[component];
    }
    // Other probes may go in circles: what comes too late shows the environment.
    std::vector<std::size_t> strict = contents.casting();
    for (std::size_t t = 0; t < asked_for.textures.size(); ++t) {
        strict.push_back(numbers.of_texture(t));
    }
    for (const std::size_t picture : strict) {
        const bool by_others =
            components[picture] < members.size() && members[components[picture]] > 1;
        const bool directly =
            std::binary_search(needs[picture].begin(), needs[picture].end(), picture);
        if (!by_others && !directly) continue;

        constexpr std::size_t most_named = 12;
        const std::vector<std::size_t> way = circle(needs, picture);
        const std::string first = label(asked_for, numbers, picture, 1);
        std::string text =
            (first.front() == '"' ? "RenderTexture " : "") + first + " shows itself: " + first;
        for (std::size_t i = 1; i + 1 < way.size(); ++i) {
            if (i == most_named) {
                text += " -> " + std::to_string(way.size() - 1 - i) + " more";
                break;
            }
            text += " -> " + label(asked_for, numbers, way[i], i + 1);
        }
        text += " -> " + first + "; leave the nodes that show it out with exclude=";
        if (!contents.casting().empty()) text += ", those that cast by it with cast_shadow=False";
        throw std::invalid_argument(text);
    }
}

}  // namespace cubecam
