/// Calls of a renderer that a thread of Python draws later (python/cubecam/_futures.py).
#pragma once

#include "frame.hpp"
#include "notices.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/notices.hpp"
#include "cubecam/render/renderer.hpp"

#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam::bindings {

/// The arguments of Renderer.render, with the scene at the moment of the call.
struct FrameRequest {
    std::shared_ptr<const SceneSnapshot> scene;
    std::variant<CameraValue, StereoValue> camera;
    FrameOptions options;

    std::size_t check(const RendererInfo& info) const {
        return std::visit([&](const auto& seen) { return check_call(info, *scene, seen, options); },
                          camera);
    }
    Frame draw(Renderer& renderer) const {
        return std::visit([&](const auto& seen) { return renderer.render(*scene, seen, options); },
                          camera);
    }
    Pending<Frame> begin(Renderer& renderer) const {
        return std::visit(
            [&](const auto& seen) { return renderer.begin_render(*scene, seen, options); }, camera);
    }
};

/// The arguments of Renderer.capture, with the scene at the moment of the call.
struct CaptureRequest {
    std::shared_ptr<const SceneSnapshot> scene;
    CaptureOptions options;

    std::size_t check(const RendererInfo& info) const { return check_call(info, *scene, options); }
    std::shared_ptr<CubeMap> draw(Renderer& renderer) const {
        return renderer.capture(*scene, options);
    }
    Pending<std::shared_ptr<CubeMap>> begin(Renderer& renderer) const {
        return renderer.begin_capture(*scene, options);
    }
};

inline PyFrame to_python(Frame frame) { return PyFrame(std::move(frame)); }
inline std::shared_ptr<CubeMap> to_python(std::shared_ptr<CubeMap> cube) { return cube; }

/// Draws a request now.
template <class Request>
auto draw_now(Renderer& renderer, const Request& request) {
    return to_python(with_notices([&] { return request.draw(renderer); }));
}

/// A call that waits to be drawn. Its functions are called with the GIL.
class LaterCall {
public:
    virtual ~LaterCall() = default;

    /// Takes a place in the line of the renderer's calls. Calls take places in the order in which
    /// they are drawn.
    virtual void join_line() = 0;
    /// Leaves it: the call will not be drawn. Nothing if it is being drawn.
    virtual void leave_line() = 0;
    /// Draws, on the thread that serves the renderer. Returns whether the pixels are there; if not,
    /// the next call can be drawn while they travel.
    virtual bool draw() = 0;
    /// Waits for the pixels, and gives the result.
    virtual pybind11::object result() = 0;

    /// What the last of the two functions before had to tell, also if it threw.
    std::vector<std::string> notices;

protected:
    /// Works without the GIL, and keeps the notices of this thread.
    template <class Work>
    auto work(Work&& work) {
        const struct Keeper {
            std::vector<std::string>& notices;
            ~Keeper() { notices = take_notices(); }
        } keeper{notices};
        const Unlocked unlocked;
        return work();
    }
};

template <class Request>
class LaterCallOf : public LaterCall {
public:
    LaterCallOf(std::shared_ptr<Renderer> renderer, Request request)
        : renderer_(std::move(renderer)), request_(std::move(request)) {}

    void join_line() override { place_ = std::make_unique<CallLine::Place>(renderer_->line()); }

    void leave_line() override { place_.reset(); }

    bool draw() override {
        std::unique_ptr<CallLine::Place> taken = std::move(place_);
        if (taken == nullptr) throw Error("expected a call that stands in the line");
        return work([&] {
            const auto place = std::move(taken);  // left without the GIL
            renderer_->line().serve_here();
            place->wait();
            pending_ = request_.begin(*renderer_);
            return pending_->reading.pixels == nullptr;
        });
    }

    pybind11::object result() override {
        return pybind11::cast(to_python(work([&] {
            auto arrived = renderer_->finish(*std::exchange(pending_, std::nullopt));
            return arrived ? *std::move(arrived) : request_.draw(*renderer_);
        })));
    }

private:
    using Begun = decltype(std::declval<const Request&>().begin(std::declval<Renderer&>()));

    std::shared_ptr<Renderer> renderer_;
    Request request_;
    std::unique_ptr<CallLine::Place> place_;  ///< in the line of the renderer's calls
    std::optional<Begun> pending_;
};

/// The cubecam.PictureFuture of a call whose result takes so many bytes.
pybind11::object submit(const std::shared_ptr<Renderer>& renderer, std::size_t bytes,
                        std::shared_ptr<LaterCall> call);

/// Checks a request, and lets it be drawn later.
template <class Request>
pybind11::object draw_later(const std::shared_ptr<Renderer>& renderer, Request request) {
    renderer->check_open();
    const std::size_t bytes = request.check(renderer->info());
    return submit(renderer, bytes,
                  std::make_shared<LaterCallOf<Request>>(renderer, std::move(request)));
}

/// For close(): waits until the calls that were submitted before are done. `drop`: those that have
/// not begun are cancelled.
void end_submitted(const std::shared_ptr<Renderer>& renderer, bool drop);

void bind_later_call(pybind11::module_& module);

}  // namespace cubecam::bindings
