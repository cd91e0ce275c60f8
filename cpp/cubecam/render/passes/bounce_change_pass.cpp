#include "cubecam/render/passes/bounce_change_pass.hpp"

#include "cubecam/gl/pace.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cubecam {
namespace {

/// The directions are those of the texels of a cube of this size
/// (shaders/passes/bounce_change.frag). The faces lie side by side, the pairs above each other.
constexpr int size = 32;
constexpr int width = 6 * size;
constexpr std::size_t directions = std::size_t{width} * size;
constexpr std::size_t most_at_once = 16;

}  // namespace

void BounceChangePass::make() {
    const GladGLContext& gl = context_->gl();
    squares_ = gl::create_texture_2d(gl, GL_R32F, width, size * static_cast<int>(most_at_once));
    framebuffer_ = gl::create_framebuffer(gl);
    gl.NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, squares_.id(), 0);
    gl::check_framebuffer(gl, framebuffer_, "measuring bounces");
}

std::vector<double> BounceChangePass::sums_of_squares(std::span<const BouncePair> pairs,
                                                      Stats& stats) {
    const GladGLContext& gl = context_->gl();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        gl.Scissor(0, size * static_cast<int>(i), width, size);
        gl.Viewport(0, size * static_cast<int>(i), width, size);
        gl.BindTextureUnit(0, pairs[i].less);
        gl.BindTextureUnit(1, pairs[i].more);
        draw_full_screen(gl, *cache_, {}, stats);
        context_->pace().submitted(gl, static_cast<double>(directions));
    }
    std::vector<float> squares(pairs.size() * directions);
    gl.GetTextureSubImage(squares_.id(), 0, 0, 0, 0, width, size * static_cast<int>(pairs.size()),
                          1, GL_RED, GL_FLOAT, static_cast<GLsizei>(squares.size() * sizeof(float)),
                          squares.data());
    std::vector<double> sums;
    for (auto at = squares.cbegin(); at != squares.cend(); at += directions) {
        sums.push_back(std::accumulate(at, at + directions, 0.0));
    }
    return sums;
}

std::vector<double> BounceChangePass::measure(std::span<const BouncePair> pairs, Stats& stats) {
    const GladGLContext& gl = context_->gl();
    if (!squares_) make();
    set_full_screen_state(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    programs_->bounce_change().use();
    std::vector<double> sums, counts;
    while (!pairs.empty()) {
        const auto some = pairs.first(std::min(pairs.size(), most_at_once));
        pairs = pairs.subspan(some.size());
        const std::vector<double> found = sums_of_squares(some, stats);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const std::size_t bounce = some[i].bounce;
            sums.resize(std::max(sums.size(), bounce), 0.0);
            counts.resize(sums.size(), 0.0);
            sums[bounce - 1] += found[i];
            counts[bounce - 1] += 3.0 * static_cast<double>(directions);
        }
    }
    gl::check_gl(gl, "measuring bounces");
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = counts[i] == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                   : std::sqrt(sums[i] / counts[i]);
    }
    return sums;
}

}  // namespace cubecam
