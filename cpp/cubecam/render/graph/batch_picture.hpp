#pragma once

#include "cubecam/render/graph/scene_picture.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cubecam {

/// The target of a batch of captures: a cube for each.
struct BatchTarget {
    Target& target;
    /// Of each layer: whether it was drawn. The others show nothing but the background's colour,
    /// and are neither cleared nor read.
    std::vector<bool> drawn;
    bool cleared = false;
};

/// One capture of a batch. Its views are drawn whole, since captures of a batch rarely repeat.
class BatchPicture final : public ScenePicture {
public:
    BatchPicture(FrameContext& context, std::vector<View> views, BatchTarget& batch,
                 std::size_t cube, std::function<bool(const NodeSnapshot&)> wanted);

    bool sees(const NodeSnapshot& node) const override { return wanted_(node); }
    /// As if the target had this one cube.
    TargetDescription describe() const override;
    Target::Behind& kept_behind() override { return batch_.target.behind; }
    Target::Mirrors& kept_mirrors() override { return batch_.target.mirrors; }

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    std::string label(std::size_t place) const override;

private:
    /// Of each view: whether it shows more than a colour.
    std::vector<bool> shows_something() const;

    std::vector<View> given_views_;  // until they are planned
    BatchTarget& batch_;
    const std::size_t first_layer_;
    const std::function<bool(const NodeSnapshot&)> wanted_;
};

}  // namespace cubecam
