#pragma once

#include "cubecam/render/graph/call.hpp"
#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/picture_order.hpp"

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace cubecam {

/// What one call of a renderer draws with: a Call for each of its scenes, and the render textures
/// by which they show each other.
class Session {
public:
    Session(RendererState& gpu, const SceneSnapshot& asked_for);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Of the scene that was asked for.
    Call& call() { return calls_.front(); }

    /// Brings these pictures up to date, and before each those that it needs. Once in a session:
    /// whatever counts calls counts this one.
    void update(const std::vector<std::size_t>& pictures);
    /// The order of that; edges back in it show the scene's environment.
    const PictureOrder& order() const { return order_; }

    /// The texture that shows a map, and the revision of what it holds. Render textures that a
    /// picture needs are up to date by then.
    BoundTexture look_up(const MapSnapshot& map);

    RendererState& gpu;
    const SceneSnapshot& asked_for;
    const PictureNumbers numbers;
    Stats stats;

private:
    /// A render texture as this session sees it.
    struct TextureWork {
        TextureState* state;
        View view;
        DrawPlan plan;
    };

    std::vector<std::size_t> find_work(std::size_t picture);
    std::vector<std::size_t> find_texture_work(std::size_t texture);
    void draw_texture(std::size_t texture);

    std::deque<Call> calls_;  // of each scene
    std::vector<std::optional<TextureWork>> textures_;
    PictureOrder order_;
};

}  // namespace cubecam
