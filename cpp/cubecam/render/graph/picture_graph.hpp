#pragma once

#include "cubecam/render/graph/picture.hpp"
#include "cubecam/render/graph/picture_order.hpp"

#include <cstddef>
#include <cstdint>
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

    /// Brings `roots` and the companions of all pictures up to date, and before each picture those
    /// that it depends on. It may be called once for each graph.
    /// @throws std::logic_error if pictures depend on each other in a circle.
    void update(const std::vector<PictureId>& roots);

    /// The pictures that `update` brought up to date, in this order.
    const std::vector<PictureId>& order() const { return order_; }

private:
    /// The dependencies between pictures. A picture is an index into `ids`, which are sorted, so
    /// that the same pictures have the same order wherever the walk began.
    struct Edges {
        std::vector<PictureId> ids;
        std::vector<std::vector<std::size_t>> of;

        std::size_t place(const PictureId& id) const;
        std::vector<std::size_t> places(const std::vector<PictureId>& some) const;
    };

    enum class Question : std::uint8_t { possible, planned };

    /// Finds all pictures that `roots` may ever depend on, or do depend on as planned.
    Edges walk(const std::vector<PictureId>& roots, Question question);
    std::string message(const Edges& edges, std::size_t start);

    PictureSource source_;
    std::map<PictureId, std::unique_ptr<Picture>> pictures_;
    std::vector<PictureId> order_;
};

}  // namespace cubecam
