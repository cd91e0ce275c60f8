#pragma once

#include "cubecam/render/graph/picture.hpp"
#include "cubecam/render/graph/picture_order.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace cubecam {

/// The pictures of one call of a renderer, found while they are planned, and how they depend on
/// each other. It knows nothing of scenes or OpenGL: what a picture is, `Picture` says.
class PictureGraph {
public:
    /// Makes a picture the first time that something depends on it.
    using PictureSource = std::function<std::unique_ptr<Picture>(const PictureId&)>;

    explicit PictureGraph(PictureSource source) : source_(std::move(source)) {}

    /// The picture that is meant, made if it was not there.
    Picture& at(const PictureId& id);

    /// Adds a picture that the source does not make.
    void add(const PictureId& id, std::unique_ptr<Picture> picture);

    /// Refuses strict pictures that show themselves, directly or by others, among those that
    /// `roots` may ever lead to. `advice` ends the message: how to break such a circle.
    /// @throws std::invalid_argument naming the chain.
    void refuse_circles(const std::vector<PictureId>& roots, const std::string& advice);

    /// Brings `roots` up to date, and before each picture those that it depends on. Once in the
    /// life of a graph.
    void update(const std::vector<PictureId>& roots);

    /// Whether `from` must not look at `to`; see PictureOrder. Never so if the update met one of
    /// them not at all.
    bool is_edge_back(const PictureId& from, const PictureId& to) const;

    /// What `update` draws, in this order.
    std::vector<PictureId> order() const;

private:
    /// Which of some pictures depends on which. A picture is known by its place in `ids`, which are
    /// sorted, so that the same pictures have the same order wherever a walk began.
    struct Edges {
        std::vector<PictureId> ids;
        std::vector<std::vector<std::size_t>> of;

        std::size_t place(const PictureId& id) const;
        std::vector<std::size_t> places(const std::vector<PictureId>& some) const;
    };

    using Question = std::vector<PictureId> (Picture::*)();

    /// All pictures that `roots` lead to, by what the pictures answer.
    Edges walk(const std::vector<PictureId>& roots, Question dependencies);
    std::string message(const Edges& edges, std::size_t start);

    PictureSource source_;
    std::map<PictureId, std::unique_ptr<Picture>> pictures_;
    Edges edges_;  // of the update
    PictureOrder order_;
};

}  // namespace cubecam
