#include "cubecam/render/graph/batch_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/render/passes/clear.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace cubecam {

BatchPicture::BatchPicture(FrameContext& context, std::vector<View> views, BatchTarget& batch,
                           std::size_t cube, std::function<bool(const NodeSnapshot&)> wanted)
    : ScenePicture(context, frame_id(), 0), given_views_(std::move(views)), batch_(batch),
      first_layer_(given_views_.size() * cube), wanted_(std::move(wanted)) {}

TargetDescription BatchPicture::describe() const {
    TargetDescription description = batch_.target.description();
    description.shape = TargetShape::cube();
    return description;
}

std::vector<PictureId> BatchPicture::dependencies() {
    return plan(std::move(given_views_), describe());
}

std::vector<bool> BatchPicture::shows_something() const {
    const bool sky = !std::holds_alternative<glm::vec4>(scene_.background);
    std::vector<bool> shows(views().size(), sky || batch_.target.multisampled());
    for (const Visibility& visibility : planned().visibilities) shows[visibility.view] = true;
    return shows;
}

void BatchPicture::update() {
    const std::vector<bool> shows = shows_something();
    std::copy(shows.begin(), shows.end(),
              batch_.drawn.begin() + static_cast<std::ptrdiff_t>(first_layer_));
    if (std::find(shows.begin(), shows.end(), true) == shows.end()) return;
    if (!batch_.cleared) {
        clear_all(context_.gpu.context.gl(), batch_.target, scene_);
        batch_.cleared = true;
    }
    draw_shared(batch_.target, first_layer_, shows);
}

std::string BatchPicture::label(std::size_t /*place*/) const { return "the capture"; }

}  // namespace cubecam
