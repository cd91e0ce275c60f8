#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"
#include "cubecam/scene/stereo_camera.hpp"

#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace cubecam {

/// What a renderer runs on.
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
    bool layered = false;  ///< all views of a mesh in one draw call
};

/// What a light sees of what casts shadows.
struct ShadowDistances {
    int size = 0;
    int layers = 0;
    Buffer<float> distances;
};

/// Draws scenes, into frames, captures and probes. It owns an OpenGL context and everything on the
/// GPU.
///
/// Any thread may call it; calls on one renderer follow each other, several renderers work in
/// parallel. Between calls its context is current nowhere. After close(), and in a process forked
/// after EGL was opened, every call throws ContextError.
class Renderer {
public:
    /// @throws ContextError with every attempt, if no OpenGL 4.5 context can be had.
    explicit Renderer(RendererOptions options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    Frame render(const SceneSnapshot& scene, const CameraValue& camera,
                 const FrameOptions& options);
    Frame render(const Scene& scene, const Camera& camera, const FrameOptions& options) {
        return render(*scene.snapshot(), camera.value(), options);
    }

    /// Both eyes' pictures as one; each eye's `aspect` is that of its part.
    Frame render(const SceneSnapshot& scene, const StereoValue& camera,
                 const FrameOptions& options);
    Frame render(const Scene& scene, const StereoCamera& camera, const FrameOptions& options) {
        return render(*scene.snapshot(), camera.value(), options);
    }

    std::shared_ptr<CubeMap> capture(const SceneSnapshot& scene, const CaptureOptions& options);
    std::shared_ptr<CubeMap> capture(const Scene& scene, const CaptureOptions& options) {
        return capture(*scene.snapshot(), options);
    }

    /// Draws probes now, whatever their policy says: those given, or all that the scene's visible
    /// nodes use.
    /// @throws std::invalid_argument for a probe that no visible node of the scene uses.
    void update_probes(const SceneSnapshot& scene,
                       const std::vector<std::shared_ptr<Probe>>& probes);

    /// What a probe holds now. @throws std::invalid_argument if it was not drawn yet.
    std::shared_ptr<CubeMap> read_probe(const std::shared_ptr<Probe>& probe);

    /// What a render texture holds now. @throws std::invalid_argument if it was not drawn yet.
    Frame read_texture(const std::shared_ptr<RenderTexture>& texture);
    /// Distances along the axis of each view of a light's map, all six of a point light in the
    /// order of a cube's faces: from the light, for a directional one from where the casters'
    /// bounds begin; infinite where nothing casts. Row 0 is on top, of a cube's faces t = 0.
    /// @throws std::invalid_argument for a light that is not in the scene or has no shadow.
    ShadowDistances shadow_map(const SceneSnapshot& scene, const std::shared_ptr<Light>& light);

    Stats stats() const;
    const RendererInfo& info() const { return info_; }

    /// Frees everything on the GPU; further calls throw. Closing twice is no mistake.
    void close() noexcept;
    bool closed() const;

private:
    struct Gpu;  // what lives as long as the context

    template <class Work>
    auto run(Work&& work);
    /// The cameras' pictures, each of the size that the options say, one below the other.
    Frame render_views(const SceneSnapshot& scene, std::span<const CameraValue> cameras,
                       const FrameOptions& options);

    RendererInfo info_;
    mutable std::mutex mutex_;
    std::unique_ptr<Gpu> gpu_;
    Stats stats_;
};

}  // namespace cubecam
