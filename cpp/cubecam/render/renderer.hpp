#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/render/call_line.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/render/pending.hpp"
#include "cubecam/render/readback.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"
#include "cubecam/scene/stereo_camera.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace cubecam {

class ContextLost;
struct LostPicture;
struct RendererState;

/// The device and the driver of a renderer.
struct RendererInfo {
    std::string vendor;        ///< GL_VENDOR
    std::string renderer;      ///< GL_RENDERER
    std::string version;       ///< GL_VERSION
    std::string glsl_version;  ///< GL_SHADING_LANGUAGE_VERSION
    std::string egl_version;
    std::string platform;  ///< "device", "surfaceless" or "default"
    gl::DeviceInfo device;
    gl::Limits limits;
    bool software = false;
    bool layered = false;  ///< one draw call can draw all views of a mesh
};

/// The distances of the casters from a light.
struct ShadowDistances {
    int size = 0;
    int layers = 0;
    Buffer<float> distances;
};

/// Draws scenes into frames, captures and probes. It owns an OpenGL context and everything on the
/// GPU.
///
/// Any thread may call it; calls on one renderer run one after the other in the order in which they
/// were made (`line`), several renderers run in parallel. Between calls its context is current on
/// no thread. After close(), and in a process forked after EGL was opened, every call throws
/// ContextError. A call polls for interrupts (core/interrupts.hpp); an interrupted picture counts
/// as not drawn. Inside a poll, the same renderer draws nothing (Error), and close() takes effect
/// when the call ends.
///
/// If the context is lost, since another library ended its display or the GPU was reset, the call
/// makes a new one, adds a notice (core/notices.hpp) and is done again: everything on the GPU is
/// derived from scenes. If the new context is lost in the same call, or none can be made, the call
/// throws ContextError, and the next call tries again.
class Renderer {
public:
    /// @throws ContextError that lists every attempt, if no OpenGL 4.5 context can be created.
    explicit Renderer(RendererOptions options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Frame render(const SceneSnapshot& scene, const CameraValue& camera,
                 const FrameOptions& options);
    Frame render(const Scene& scene, const Camera& camera, const FrameOptions& options) {
        return render(*scene.snapshot(), camera.world_value(), options);
    }

    /// Draws the pictures of both eyes as one; each eye has the `aspect` of its part.
    Frame render(const SceneSnapshot& scene, const StereoValue& camera,
                 const FrameOptions& options);
    Frame render(const Scene& scene, const StereoCamera& camera, const FrameOptions& options) {
        return render(*scene.snapshot(), camera.value(), options);
    }

    std::shared_ptr<CubeMap> capture(const SceneSnapshot& scene, const CaptureOptions& options);
    std::shared_ptr<CubeMap> capture(const Scene& scene, const CaptureOptions& options) {
        return capture(*scene.snapshot(), options);
    }

    /// render() and capture() in two steps. The first draws, and the pixels begin to travel;
    /// `finish` waits for them. Meanwhile the renderer draws other calls. With a software driver
    /// the pixels are there after the first step.
    Pending<Frame> begin_render(const SceneSnapshot& scene, const CameraValue& camera,
                                const FrameOptions& options);
    Pending<Frame> begin_render(const SceneSnapshot& scene, const StereoValue& camera,
                                const FrameOptions& options);
    Pending<std::shared_ptr<CubeMap>> begin_capture(const SceneSnapshot& scene,
                                                    const CaptureOptions& options);
    /// None: the context was lost meanwhile, and the pixels with it; the call must be made again.
    std::optional<Frame> finish(Pending<Frame> pending);
    std::optional<std::shared_ptr<CubeMap>> finish(Pending<std::shared_ptr<CubeMap>> pending);

    /// The line in which all calls stand. A thread that draws calls of others takes a place for
    /// each when the call is made.
    CallLine& line() { return line_; }
    /// @throws ContextError after close(), and in a forked child.
    void check_open() const;

    /// The number of cubes that capture_batch draws at once, and what it writes.
    struct BatchShape {
        int most_cubes = 1;
        std::vector<OutputKind> outputs;
        Encoding encoding = Encoding::linear;  ///< of the colours
        ClearTexels clear;
    };
    /// Checks the options of a batch. @throws std::invalid_argument as capture() does.
    BatchShape batch_shape(const SceneSnapshot& scene, const CaptureOptions& options);

    /// Memory with undefined contents for a result: that of an earlier one, if it was given back.
    std::shared_ptr<PixelBuffer> result_memory(std::size_t bytes);

    /// Draws captures from several places, and writes them into `to` one after the other. Each is
    /// the same bit for bit as capture() from there: the scene is drawn for one place after the
    /// other, but the driver is waited for once. Its stats are sums.
    /// At most BatchShape::most_cubes places; the position and rotation of `options` do not count.
    void capture_batch(const SceneSnapshot& scene, const CaptureOptions& options,
                       std::span<const CapturePlace> places, const ClearTexels& clear,
                       const LayerMemory& to);

    /// Draws probes now, whatever their policy is: the given ones or, if `probes` is empty, all
    /// that the scene's visible nodes use.
    /// @throws std::invalid_argument for a probe that no visible node of the scene uses.
    void update_probes(const SceneSnapshot& scene,
                       const std::vector<std::shared_ptr<Probe>>& probes);

    /// Returns the current cube of a probe. @throws std::invalid_argument if it was not drawn yet.
    std::shared_ptr<CubeMap> read_probe(const std::shared_ptr<Probe>& probe);

    /// Returns the current picture of a render texture. @throws std::invalid_argument if it was not
    /// drawn yet.
    Frame read_texture(const std::shared_ptr<RenderTexture>& texture);
    /// Returns distances along the axis of each view of a light's map; the six views of a point
    /// light are in the order of a cube's faces. Distances count from the light, for a directional
    /// light from the beginning of the casters' bounds; they are infinite where there is no caster.
    /// Row 0 is on top; for a cube's faces it is t = 0.
    /// @throws std::invalid_argument for a light that is not in the scene or has no shadow.
    ShadowDistances shadow_map(const SceneSnapshot& scene, const std::shared_ptr<Light>& light);

    Stats stats() const;
    /// A new context after a lost one may be on another device.
    RendererInfo info() const;

    /// Frees everything on the GPU; further calls throw. Closing twice is allowed.
    void close() noexcept;
    bool closed() const;

private:
    struct Gpu;  // the context and everything made in it
    struct Running;
    struct Drawing;

    /// Whether a call of this thread is drawing: a signal handler runs inside it.
    bool draws_here() const;
    void free_gpu() noexcept;

    std::unique_ptr<Gpu> make_gpu();
    /// Makes a new context in place of the lost one. @throws ContextError if there is none.
    void rebuild(const ContextLost& lost);
    template <class Work>
    auto run(Work&& work);
    /// Does the work of a call. @throws ContextLost if the context is lost.
    template <class Work>
    auto attempt(Work&& work);
    /// Draws a picture again that was lost with its context. `kind` names it in the error.
    template <class Object>
    void draw_again(RendererState& gpu, const Object& object, const LostPicture& last,
                    const char* kind);
    /// Draws the cameras' pictures, each with the size of the options, one below the other. Returns
    /// what `read` makes of the Reading, with the context still current.
    template <class Read>
    auto render_views(const SceneSnapshot& scene, std::span<const CameraValue> cameras,
                      const FrameOptions& options, Read&& read);
    template <class Read>
    auto capture_views(const SceneSnapshot& scene, const CaptureOptions& options, Read&& read);
    /// Makes a Reading, of a call that has just drawn, pending.
    template <class Result>
    Pending<Result> pending(Reading<Result> reading) const;
    template <class Result>
    std::optional<Result> arrived(Pending<Result> pending);

    const RendererOptions options_;
    CallLine line_;
    mutable std::mutex info_mutex_;
    RendererInfo info_;
    mutable std::mutex mutex_;
    std::unique_ptr<Gpu> gpu_;         // null: closed
    std::atomic<bool> closed_{false};  // read without waiting for a call of another thread
    Stats stats_;
    std::atomic<std::thread::id> drawing_{};  ///< the thread whose call is drawing
    bool close_after_call_ = false;           ///< used by that thread alone
};

}  // namespace cubecam
