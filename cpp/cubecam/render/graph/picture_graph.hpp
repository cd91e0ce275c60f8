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

/// The pictures of one call of a renderer, which are found while they are planned, and their
/// dependencies. The graph does not use scenes or OpenGL; it works on the interface `Picture`.
class PictureGraph {
public:
    /// Makes a picture when something depends on it for the first time.
    using PictureSource = std::function<std::unique_ptr<Picture>(const PictureId&)>;

    explicit PictureGraph(PictureSource source) : source_(std::move(source)) {}

    /// Returns the picture with this id, and makes it first if necessary.
    Picture& at(const PictureId& id);

    /// Adds a picture that the source does not make.
    void add(const PictureId& id, std::unique_ptr<Picture> picture);

    /// Refuses strict pictures that show themselves, directly or through others, among all that
    /// `roots` may ever depend on. `advice`, the end of the message, says how to break such a
    /// circle.
    /// @throws std::invalid_argument that names the chain.
    void refuse_circles(const std::vector<PictureId>& roots, const std::string& advice);

    /// Brings `roots` up to date, and before each picture those that it depends on. It may be
    /// called once for each graph.
    void update(const std::vector<PictureId>& roots);

    /// Whether `from` must not look at `to`; see PictureOrder. False if the update did not reach
    /// one of them.
    bool is_edge_back(const PictureId& from, const PictureId& to) const;

    /// The pictures that `update` draws, in this order.
    std::vector<PictureId> order() const;

private:
    /// The dependencies between pictures. A picture is an index into `ids`, which are sorted, so
    /// that the same pictures have the same order wherever the walk began.
    struct Edges {
        std::vector<PictureId> ids;
        std::vector<std::vector<std::size_t>> of;

        std::size_t place(const PictureId& id) const;
        std::vector<std::size_t> places(const std::vector<PictureId>& some) const;
    };

    using Question = std::vector<PictureId> (Picture::*)();

    /// Finds all pictures that `roots` depend on; `dependencies` is the function that reports them.
    Edges walk(const std::vector<PictureId>& roots, Question dependencies);
    std::string message(const Edges& edges, std::size_t start);

    PictureSource source_;
    std::map<PictureId, std::unique_ptr<Picture>> pictures_;
    Edges edges_;  // of the update
    PictureOrder order_;
};

}  // namespace cubecam
