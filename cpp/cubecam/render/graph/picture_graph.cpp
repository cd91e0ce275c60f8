#include "cubecam/render/graph/picture_graph.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <stdexcept>
#include <utility>

namespace cubecam {
namespace {

/// The path from a picture back to itself that contains the fewest pictures with a name. It
/// contains `start` once, at the front.
std::vector<std::size_t> shortest_circle(const std::vector<std::vector<std::size_t>>& edges,
                                         const std::vector<std::string>& names, std::size_t start) {
    constexpr std::size_t not_reached = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> from(edges.size(), not_reached);
    std::deque<std::size_t> open{start};
    while (!open.empty()) {
        const std::size_t next = open.front();
        open.pop_front();
        for (const std::size_t shown : edges[next]) {
            if (shown == start) {
                std::vector<std::size_t> way;
                for (std::size_t at = next; at != start; at = from[at]) way.push_back(at);
                way.push_back(start);
                std::reverse(way.begin(), way.end());
                return way;
            }
            if (from[shown] != not_reached) continue;
            from[shown] = next;
            if (names[shown].empty()) {
                open.push_front(shown);  // a picture without a name adds no step to the message
            } else {
                open.push_back(shown);
            }
        }
    }
    return {};
}

}  // namespace

std::strong_ordering PictureId::operator<=>(const PictureId& other) const {
    if (viewer != nullptr || other.viewer != nullptr) {
        const PictureId& mine = viewer != nullptr ? *viewer : *this;
        const PictureId& its = other.viewer != nullptr ? *other.viewer : other;
        if (const auto order = mine <=> its; order != 0) return order;
        if (viewer == nullptr || other.viewer == nullptr) {
            return (viewer != nullptr) <=> (other.viewer != nullptr);
        }
    }
    if (const auto order = kind <=> other.kind; order != 0) return order;
    if (const auto order = scene <=> other.scene; order != 0) return order;
    // Bounces are drawn in rounds.
    if (const auto order = bounce <=> other.bounce; order != 0) return order;
    return object <=> other.object;
}

Picture& PictureGraph::at(const PictureId& id) {
    const auto found = pictures_.find(id);
    if (found != pictures_.end()) return *found->second;
    return *pictures_.emplace(id, source_(id)).first->second;
}

void PictureGraph::add(const PictureId& id, std::unique_ptr<Picture> picture) {
    pictures_.insert_or_assign(id, std::move(picture));
}

std::size_t PictureGraph::Edges::place(const PictureId& id) const {
    return static_cast<std::size_t>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

std::vector<std::size_t> PictureGraph::Edges::places(const std::vector<PictureId>& some) const {
    std::vector<std::size_t> found;
    found.reserve(some.size());
    for (const PictureId& id : some) found.push_back(place(id));
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

PictureGraph::Edges PictureGraph::walk(const std::vector<PictureId>& roots, Question question) {
    std::map<PictureId, std::vector<PictureId>> found;
    std::vector<PictureId> open = roots;
    while (!open.empty()) {
        const auto [place, added] = found.try_emplace(std::move(open.back()));
        open.pop_back();
        if (!added) continue;
        Picture& picture = at(place->first);
        place->second = question == Question::planned ? picture.dependencies()
                                                      : picture.possible_dependencies();
        open.insert(open.end(), place->second.begin(), place->second.end());
        if (question == Question::possible) continue;
        for (PictureId& companion : picture.companions()) open.push_back(std::move(companion));
    }
    Edges edges;
    for (const auto& [id, shown] : found) edges.ids.push_back(id);
    for (const auto& [id, shown] : found) edges.of.push_back(edges.places(shown));
    return edges;
}

void PictureGraph::refuse_circles(const std::vector<PictureId>& roots, const std::string& advice) {
    const Edges edges = walk(roots, Question::possible);
    const PictureComponents components = find_components(edges.of);
    for (std::size_t p = 0; p < edges.ids.size(); ++p) {
        if (!components.in_circle(p, edges.of) || !at(edges.ids[p]).strict()) continue;
        throw std::invalid_argument(message(edges, p) + advice);
    }
}

std::string PictureGraph::message(const Edges& edges, std::size_t start) {
    constexpr std::size_t most_named = 12;
    std::vector<std::string> names;
    for (const PictureId& id : edges.ids) names.push_back(at(id).label(1));
    std::vector<const Picture*> named;
    for (const std::size_t place : shortest_circle(edges.of, names, start)) {
        if (!names[place].empty()) named.push_back(&at(edges.ids[place]));
    }
    if (named.empty()) return "a picture shows itself";
    const std::string first = named.front()->label(1);
    std::string text = named.front()->label(0) + " shows itself: " + first;
    for (std::size_t i = 1; i < named.size(); ++i) {
        if (i == most_named) {
            text += " -> " + std::to_string(named.size() - i) + " more";
            break;
        }
        text += " -> " + named[i]->label(i + 1);
    }
    return text + " -> " + first;
}

void PictureGraph::update(const std::vector<PictureId>& roots) {
    const Edges edges = walk(roots, Question::planned);
    for (const std::size_t place : order_pictures(edges.of)) order_.push_back(edges.ids[place]);
    if (order_.size() != edges.ids.size()) {
        throw std::logic_error("expected pictures that do not depend on each other, got a circle");
    }
    for (const PictureId& id : order_) at(id).update();
}

}  // namespace cubecam
