#include "cubecam/render/renderer.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/notices.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/render/graph/batch_picture.hpp"
#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/passes/clear.hpp"
#include "cubecam/render/passes/raster_state.hpp"
#include "cubecam/render/readback.hpp"
#include "cubecam/render/requested_outputs.hpp"
#include "cubecam/render/stereo.hpp"
#include "cubecam/scene/scene_encoding.hpp"
#include "cubecam/scene/snapshot_queries.hpp"
#include "cubecam/trial/trial.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>

namespace cubecam {
namespace {

constexpr const char* forked = "this renderer belongs to the parent process: OpenGL does not "
                               "survive a fork. Expected a Renderer made in a process "
                               "of its own; start workers with multiprocessing's \"spawn\" method";

constexpr const char* is_closed = "the renderer is closed: expected an open Renderer";

constexpr const char* layer_extension = "GL_ARB_shader_viewport_layer_array";

/// llvmpipe frees the memory of a frame's triangles after each frame, and glibc returns it to the
/// kernel, which causes a thousand page faults in each frame with large meshes. Freeing one large
/// block raises glibc's threshold for this (dynamic M_MMAP_THRESHOLD, mallopt(3)). The result is
/// 1.8 times the speed, measured with Mesa 22.3.
void keep_freed_memory() {
    void* volatile block = std::malloc(std::size_t{32} * 1000 * 1000);
    std::free(block);
}

Layering layering(const gl::Context& context, const RendererOptions& options) {
    const bool possible = context.has_extension(layer_extension);
    if (!options.layered) return possible ? Layering::where_faster : Layering::never;
    if (!*options.layered) return Layering::never;
    if (possible) return Layering::always;
    throw std::invalid_argument(std::string("layered: expected None or False, since ") +
                                context.renderer() + " lacks " + layer_extension + ", got True");
}

/// The encoding of the target's picture; for an unchanged call, that of the last one.
template <class Find>
Encoding kept_encoding(Target& target, Find&& find) {
    std::optional<UnchangedCall>& call = target.unchanged;
    if (call && call->encoding) return *call->encoding;
    const Encoding found = find();
    if (call) call->encoding = found;
    return found;
}

/// Whether a capture shows a node.
auto seen_by(const CaptureOptions& options) {
    return [exclude = options.exclude](const NodeSnapshot& node) {
        return node.in_captures && !is_excluded(node, exclude);
    };
}

bool seen_by_all(const NodeSnapshot&) { return true; }

/// What the options ask for after drawing. A picture that is sRGB-encoded as drawn holds no
/// highlights for a tone curve and needs no second encoding; only exposure changes it, in linear
/// light. `drawn` finds the encoding of the picture as drawn.
template <class Find>
PostProcess post_process_of(const SceneSnapshot& scene, const FrameOptions& options,
                            const Find& drawn) {
    PostProcess made{scene.effects, static_cast<float>(std::exp2(options.exposure)),
                     options.tonemap, options.encode};
    const bool graded =
        made.gain != 1.0F || made.tonemap != Tonemap::none || made.encode != Encode::none;
    if (graded && drawn() == Encoding::srgb) {
        made.tonemap = Tonemap::none;
        made.decode = made.gain != 1.0F;
        made.encode = made.decode ? Encode::srgb : Encode::none;
    }
    return made;
}

template <class Find>
Encoding frame_encoding(const PostProcess& post_process, const Find& drawn) {
    if (post_process.encode == Encode::srgb) return Encoding::srgb;
    if (post_process.tonemap != Tonemap::none) return Encoding::linear;
    return drawn();
}

/// For render_views and capture_views: the result itself.
constexpr auto read_at_once = [](auto&& reading) { return std::move(reading).finished(); };

std::uint64_t next_context() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

FrameShape frame_shape(const SceneSnapshot& scene, const FrameOptions& options) {
    const auto drawn = [&] { return scene_encoding(scene, 0, seen_by_all); };
    return {output_kinds(resolve_outputs(options.outputs, scene)),
            frame_encoding(post_process_of(scene, options, drawn), drawn)};
}

/// The context outlives the objects that were made in it.
struct Renderer::Gpu {
    Gpu(gl::Context made, const RendererOptions& options)
        : number(next_context()), context(std::move(made)) {
        const gl::CurrentScope scope(context);
        if (context.software()) keep_freed_memory();
        state.emplace(context, layering(context, options), options.cache_bytes);
        if (options.trust_shaders) return;
        state->surface.programs().set_trial(std::make_unique<trial::Trial>(context));
    }

    const std::uint64_t number;  ///< of the context, in the process
    gl::Context context;
    std::optional<RendererState> state;
};

Renderer::Renderer(RendererOptions options) : options_(std::move(options)) { gpu_ = make_gpu(); }

std::unique_ptr<Renderer::Gpu> Renderer::make_gpu() {
    gl::Context context({options_.device, options_.debug});
    RendererInfo info{context.vendor(),      context.renderer(),
                      context.version(),     context.glsl_version(),
                      context.egl_version(), context.platform(),
                      context.device(),      context.limits(),
                      context.software(),    layering(context, options_) != Layering::never};
    auto made = std::make_unique<Gpu>(std::move(context), options_);
    const std::lock_guard lock(info_mutex_);
    info_ = std::move(info);
    return made;
}

RendererInfo Renderer::info() const {
    // In a forked child a thread that does not exist there may hold the lock; nobody writes there.
    std::unique_lock lock(info_mutex_, std::defer_lock);
    if (!gl::in_forked_child()) lock.lock();
    return info_;
}

Renderer::~Renderer() { close(); }

void Renderer::close() noexcept {
    if (gl::in_forked_child()) {
        // A thread that does not exist in this process may hold the lock, and the objects belong to
        // the parent.
        (void)gpu_.release();
        return;
    }
    closed_ = true;
    if (draws_here()) {
        close_after_call_ = true;
        return;
    }
    const std::lock_guard lock(mutex_);
    free_gpu();
}

void Renderer::free_gpu() noexcept {
    if (gpu_ == nullptr) return;
    try {
        const gl::CurrentScope scope(gpu_->context);
        gpu_->state.reset();
    } catch (...) {
        gpu_->context.abandon();  // the context is lost
    }
    gpu_.reset();
}

bool Renderer::closed() const { return gl::in_forked_child() || closed_; }

Stats Renderer::stats() const {
    if (gl::in_forked_child()) throw ContextError(forked);
    if (draws_here()) return stats_;
    const std::lock_guard lock(mutex_);
    return stats_;
}

void Renderer::rebuild(const ContextLost& lost) {
    const std::string reason = std::string("the OpenGL context was lost (") + lost.what() + ")";
    const std::string device_before = info_.renderer;  // only this thread writes it
    std::unique_ptr<Gpu> made;
    try {
        made = make_gpu();
    } catch (const Error& error) {
        throw ContextError(reason + ", and no new one can be made: " + error.what());
    } catch (const std::invalid_argument& error) {
        throw ContextError(reason + ", and no new one can be made: " + error.what());
    }
    made->state->take_over(*gpu_->state);
    gpu_->context.abandon();
    gpu_ = std::move(made);
    const bool same = info_.renderer == device_before;
    add_notice(reason + ". The renderer made a new one" +
               (same ? std::string() : " on " + info_.renderer + " in place of " + device_before) +
               " and draws everything again; probes with update=\"manual\" show what is there now");
}

bool Renderer::draws_here() const { return drawing_.load() == std::this_thread::get_id(); }

/// A call of a renderer: the mutex is held while it lives.
struct Renderer::Running {
    explicit Running(Renderer& its_renderer) : renderer(its_renderer) {
        renderer.drawing_ = std::this_thread::get_id();
    }
    ~Running() {
        renderer.drawing_ = std::thread::id();
        if (renderer.close_after_call_) renderer.free_gpu();
        renderer.close_after_call_ = false;
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    Renderer& renderer;
};

/// The work of a call: the context is current while it lives.
struct Renderer::Drawing {
    explicit Drawing(const gl::Context& its_context) : context(its_context), scope(its_context) {}
    ~Drawing() {
        if (std::uncaught_exceptions() == exceptions) return;
        // A draw may have been left in the middle, and passes depend on this state.
        reset_raster_state(context.gl(), depth_state(DepthOrder::nearest));
    }
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    const int exceptions = std::uncaught_exceptions();
    const gl::Context& context;
    const gl::CurrentScope scope;
};

void Renderer::check_open() const {
    if (gl::in_forked_child()) throw ContextError(forked);
    if (closed_) throw ContextError(is_closed);
}

template <class Work>
auto Renderer::run(Work&& work) {
    if (gl::in_forked_child()) throw ContextError(forked);
    if (draws_here()) {
        throw Error("this renderer is drawing, and a signal handler interrupted it: expected a "
                    "call after the drawing has ended, got one from the handler");
    }
    const CallLine::Turn turn(line_);
    const std::lock_guard lock(mutex_);
    if (gpu_ == nullptr) throw ContextError(is_closed);
    const Running running(*this);
    ++gpu_->state->call;
    try {
        return attempt(work);
    } catch (const ContextLost& lost) {
        rebuild(lost);
    }
    try {
        return attempt(work);
    } catch (const ContextLost& lost) {
        throw ContextError(
            std::string("the OpenGL context was lost, and the new one was lost at once: ") +
            lost.what() +
            (lost.reset() ? ". Expected a picture that the GPU can draw in a few "
                            "seconds: with a smaller size, or simpler shaders"
                          : ""));
    }
}

template <class Work>
auto Renderer::attempt(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    const Drawing drawing(gpu_->context);
    RendererState& state = *gpu_->state;
    state.cache.sweep();
    state.probes.sweep();
    state.textures.sweep();
    state.shadow_maps.sweep();
    state.filtered_cubes.sweep();
    state.planes.sweep();
    state.bodies.sweep();
    state.results->next_call();
    stats_ = {};
    gpu_->context.take_debug_messages();  // drops those of earlier calls
    try {
        auto result = work(state);
        gpu_->context.check_reset();
        stats_.pictures_not_kept = state.targets.trim();
        const std::chrono::duration<double, std::milli> taken =
            std::chrono::steady_clock::now() - start;
        stats_.milliseconds = taken.count();
        return result;
    } catch (const ContextLost&) {
        throw;
    } catch (const GlError& error) {
        gpu_->context.check_reset();
        std::string text = error.what();
        for (const std::string& message : gpu_->context.take_debug_messages()) {
            text += "\n" + message;
        }
        if (error.code() == GL_CONTEXT_LOST) throw ContextLost(text, true);
        throw GlError(text, error.code());
    } catch (const Error&) {
        gpu_->context.check_reset();  // after a reset nothing that the driver reports is true
        throw;
    } catch (const std::invalid_argument&) {
        gpu_->context.check_reset();
        throw;
    }
}

template <class Object>
void Renderer::draw_again(RendererState& gpu, const Object& object, const LostPicture& last,
                          const char* kind) {
    const std::shared_ptr<const Scene> scene = last.scene.lock();
    bool drawn = false;
    if (scene != nullptr) {
        const std::shared_ptr<const SceneSnapshot> snapshot = scene->snapshot();
        FrameContext frame(gpu, *snapshot);
        drawn = frame.draw_again(object);
        stats_ = frame.stats;
    }
    if (drawn) return;
    throw ContextError(std::string(kind) +
                       ": its picture was lost with the OpenGL context, and the scene that showed "
                       "it does not show it any more. Expected one that this renderer has drawn "
                       "since: render a frame that shows it");
}

template <class Read>
auto Renderer::render_views(const SceneSnapshot& scene, std::span<const CameraValue> cameras,
                            const FrameOptions& options, Read&& read) {
    check_buffers(options);
    check_effects(scene, options);
    return run([&](RendererState& gpu) {
        TargetDescription description =
            describe_target(gpu.context, frame_request(scene, options, cameras.size()));
        std::optional<Encoding> known;
        const auto encoding_as_drawn = [&] {
            if (!known) known = scene_encoding(scene, 0, seen_by_all);
            return *known;
        };
        const PostProcess post_process = post_process_of(scene, options, encoding_as_drawn);
        set_post_process(description, post_process.effects.size(), post_process.any());
        Target& target = gpu.targets.get(gpu.context, description, result_bytes(description));
        const double aspect =
            static_cast<double>(options.width) / static_cast<double>(options.height);
        std::vector<View> views;
        for (const CameraValue& camera : cameras) {
            views.push_back(camera_view(matrices(camera, aspect)));
        }
        FrameContext frame(gpu, scene, options.max_lod_error);
        frame.draw(std::move(views), target, seen_by_all, {}, post_process,
                   options.screen_reflections);
        stats_ = frame.stats;
        Reading<Frame> drawn = start_frame(gpu.context, target, *gpu.results, gpu.read_ring);
        drawn.result.tonemapped = post_process.tonemap != Tonemap::none;
        drawn.result.encoding =
            kept_encoding(target, [&] { return frame_encoding(post_process, encoding_as_drawn); });
        return read(std::move(drawn));
    });
}

template <class Read>
auto Renderer::capture_views(const SceneSnapshot& scene, const CaptureOptions& options,
                             Read&& read) {
    check(options);
    check_buffers(options);
    return run([&](RendererState& gpu) {
        const TargetDescription description =
            describe_target(gpu.context, capture_request(scene, options, TargetShape::cube()));
        Target& target = gpu.targets.get(gpu.context, description, result_bytes(description));
        std::vector<View> views =
            cube_views(options.position, options.near, options.far, options.eye, options.rotation);
        FrameContext frame(gpu, scene, options.max_lod_error);
        Key wanted;
        wanted.add(true);  // a capture
        for (const std::int32_t id : options.exclude) wanted.add(id);
        const auto seen = seen_by(options);
        frame.draw(std::move(views), target, seen, std::move(wanted));
        stats_ = frame.stats;
        return read(
            start_cube(gpu.context, target, *gpu.results, gpu.read_ring,
                       kept_encoding(target, [&] { return scene_encoding(scene, 0, seen); })));
    });
}

Frame Renderer::render(const SceneSnapshot& scene, const CameraValue& camera,
                       const FrameOptions& options) {
    return render_views(scene, {&camera, 1}, options, read_at_once);
}

Frame Renderer::render(const SceneSnapshot& scene, const StereoValue& camera,
                       const FrameOptions& options) {
    const CameraValue eyes[] = {camera.eyes.left, camera.eyes.right};
    return combine_eyes(
        render_views(scene, eyes, eye_options(options, camera.layout), read_at_once),
        camera.layout);
}

std::shared_ptr<CubeMap> Renderer::capture(const SceneSnapshot& scene,
                                           const CaptureOptions& options) {
    return capture_views(scene, options, read_at_once);
}

template <class Result>
Pending<Result> Renderer::pending(Reading<Result> reading) const {
    return {std::move(reading), gpu_->number, std::nullopt};
}

Pending<Frame> Renderer::begin_render(const SceneSnapshot& scene, const CameraValue& camera,
                                      const FrameOptions& options) {
    return render_views(scene, {&camera, 1}, options,
                        [this](auto&& reading) { return pending(std::move(reading)); });
}

Pending<Frame> Renderer::begin_render(const SceneSnapshot& scene, const StereoValue& camera,
                                      const FrameOptions& options) {
    const CameraValue eyes[] = {camera.eyes.left, camera.eyes.right};
    Pending<Frame> begun =
        render_views(scene, eyes, eye_options(options, camera.layout),
                     [this](auto&& reading) { return pending(std::move(reading)); });
    begun.layout = camera.layout;
    return begun;
}

Pending<std::shared_ptr<CubeMap>> Renderer::begin_capture(const SceneSnapshot& scene,
                                                          const CaptureOptions& options) {
    return capture_views(scene, options,
                         [this](auto&& reading) { return pending(std::move(reading)); });
}

template <class Result>
std::optional<Result> Renderer::arrived(Pending<Result> pending) {
    if (pending.reading.pixels == nullptr) return std::move(pending.reading.result);
    if (gl::in_forked_child()) throw ContextError(forked);
    const std::lock_guard lock(mutex_);
    if (gpu_ == nullptr) throw ContextError(is_closed);
    if (gpu_->number != pending.context) return std::nullopt;
    const Running running(*this);
    try {
        const gl::CurrentScope scope(gpu_->context);
        try {
            pending.reading.pixels->arrive();
            gpu_->context.check_reset();
        } catch (const GlError&) {
            gpu_->context.check_reset();  // after a reset nothing that the driver reports is true
            throw;
        }
    } catch (const ContextLost& lost) {
        rebuild(lost);
        return std::nullopt;
    }
    return std::move(pending.reading.result);
}

std::optional<Frame> Renderer::finish(Pending<Frame> pending) {
    const std::optional<StereoLayout> layout = pending.layout;
    std::optional<Frame> frame = arrived(std::move(pending));
    if (frame && layout) return combine_eyes(*std::move(frame), *layout);
    return frame;
}

std::optional<std::shared_ptr<CubeMap>>
Renderer::finish(Pending<std::shared_ptr<CubeMap>> pending) {
    return arrived(std::move(pending));
}

namespace {

/// The memory of a batch's target should stay in the caches of a CPU; a GPU needs work for all its
/// cores.
constexpr std::size_t software_batch_bytes = std::size_t{8} << 20;
constexpr std::size_t gpu_batch_bytes = std::size_t{256} << 20;
constexpr int most_cubes_of_batch = 64;

TargetDescription batch_target(const gl::Context& context, const SceneSnapshot& scene,
                               const CaptureOptions& options, int cubes) {
    return describe_target(context,
                           capture_request(scene, options, TargetShape::cube_array(cubes)));
}

}  // namespace

Renderer::BatchShape Renderer::batch_shape(const SceneSnapshot& scene,
                                           const CaptureOptions& options) {
    check(options);
    check_buffers(options);
    return run([&](RendererState& gpu) {
        const TargetDescription one = batch_target(gpu.context, scene, options, 1);
        check_target_memory(gpu.context, one, result_bytes(one));
        TargetDescription texel = one;
        texel.width = texel.height = texel.samples = 1;
        Target& cleared = gpu.targets.get(gpu.context, texel);
        clear_all(gpu.context.gl(), cleared, scene);
        const std::size_t most = gpu.context.software() ? software_batch_bytes : gpu_batch_bytes;
        const int layers = most_layers(gpu.context.limits());
        const auto fitting =
            static_cast<int>(std::min<std::size_t>(most / one.bytes(), most_cubes_of_batch));
        return BatchShape{std::clamp(std::min(fitting, layers / 6), 1, most_cubes_of_batch),
                          output_kinds(one.outputs), scene_encoding(scene, 0, seen_by(options)),
                          read_texels(gpu.context, cleared, *gpu.results, gpu.read_ring)};
    });
}

std::shared_ptr<PixelBuffer> Renderer::result_memory(std::size_t bytes) {
    return run([&](RendererState& gpu) { return gpu.results->take(bytes); });
}

void Renderer::capture_batch(const SceneSnapshot& scene, const CaptureOptions& options,
                             std::span<const CapturePlace> places, const ClearTexels& clear,
                             const LayerMemory& to) {
    run([&](RendererState& gpu) {
        const TargetDescription description =
            batch_target(gpu.context, scene, options, static_cast<int>(places.size()));
        BatchTarget batch{gpu.targets.get(gpu.context, description),
                          std::vector<bool>(static_cast<std::size_t>(description.layers()))};
        const auto seen = seen_by(options);
        Stats sum;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (i > 0) ++gpu.call;  // for probes that are drawn every few calls
            FrameContext frame(gpu, scene, options.max_lod_error);
            frame.draw(cube_views(places[i].position, options.near, options.far, options.eye,
                                  places[i].rotation),
                       batch, i, seen);
            sum += frame.stats;
        }
        stats_ = std::move(sum);
        read_layers(gpu.context, batch.target, batch.drawn, clear, *gpu.results, gpu.read_ring, to);
        return true;
    });
}

void Renderer::update_probes(const SceneSnapshot& scene,
                             const std::vector<std::shared_ptr<Probe>>& probes) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < scene.probes.size(); ++i) {
        const auto given = std::find(probes.begin(), probes.end(), scene.probes[i].object);
        if (probes.empty() || given != probes.end()) indices.push_back(i);
    }
    for (const auto& probe : probes) {
        const bool known =
            std::any_of(scene.probes.begin(), scene.probes.end(),
                        [&probe](const ProbeSnapshot& p) { return p.object == probe; });
        if (!known)
            throw std::invalid_argument(
                "probes: expected probes that a visible node of the scene uses");
    }
    run([&](RendererState& gpu) {
        FrameContext frame(gpu, scene);
        frame.update_probes(indices);
        stats_ = frame.stats;
        return true;
    });
}

ShadowDistances Renderer::shadow_map(const SceneSnapshot& scene,
                                     const std::shared_ptr<Light>& light) {
    const auto found =
        std::find_if(scene.lights.begin(), scene.lights.end(),
                     [&light](const LightSnapshot& other) { return other.object == light; });
    if (found == scene.lights.end()) {
        throw std::invalid_argument(
            "light: expected a light of this scene, got one that is not in it");
    }
    if (!found->value.shadow) {
        throw std::invalid_argument("light: expected one with a shadow, got one without");
    }
    return run([&](RendererState& gpu) {
        FrameContext frame(gpu, scene);
        ShadowDistances seen;
        seen.size = found->value.shadow->size;
        seen.distances = frame.shadow_map(static_cast<std::size_t>(found - scene.lights.begin()));
        const auto size = static_cast<std::size_t>(seen.size);
        seen.layers = static_cast<int>(seen.distances.size() / (size * size));
        stats_ = frame.stats;
        return seen;
    });
}

std::shared_ptr<CubeMap> Renderer::read_probe(const std::shared_ptr<Probe>& probe) {
    return run([&](RendererState& gpu) {
        StatesByScene<ProbeLevels>* contents = gpu.probes.find(probe);
        ProbeLevels* levels = contents == nullptr ? nullptr : &contents->of(0);
        if (levels != nullptr && levels->last.lost) {
            draw_again(gpu, *probe, LostPicture(levels->last), "probe");
        }
        const auto drawn = levels == nullptr ? std::nullopt : levels->drawn();
        if (!drawn) {
            throw std::invalid_argument("probe: expected one that this renderer has drawn; render "
                                        "a frame that needs it, or call update_probes()");
        }
        const std::shared_ptr<ProbeState> state = levels->at(*drawn);
        return start_cube(gpu.context, *state->target, *gpu.results, gpu.read_ring, state->encoding)
            .finished();
    });
}

Frame Renderer::read_texture(const std::shared_ptr<RenderTexture>& texture) {
    return run([&](RendererState& gpu) {
        const TextureState* state = gpu.textures.find(texture);
        if (state != nullptr && state->last.lost) {
            draw_again(gpu, *texture, state->last, "render_texture");
        }
        if (state == nullptr || state->target == nullptr) {
            throw std::invalid_argument("render_texture: expected one that this renderer has "
                                        "drawn; render a frame that shows it");
        }
        return start_frame(gpu.context, *state->target, *gpu.results, gpu.read_ring).finished();
    });
}

}  // namespace cubecam
