#include "cubecam/render/resources/target.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/large_texture.hpp"
#include "cubecam/gl/texture_memory.hpp"
#include "cubecam/render/resources/sampler.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
namespace cubecam {
namespace {

/// Three channels are stored as four: GL does not guarantee rendering to three.
GLenum gl_format(int channels, OutputType type) {
    if (type == OutputType::int32) return GL_R32I;
    return channels == 1 ? GL_R32F : channels == 2 ? GL_RG32F : GL_RGBA32F;
}

std::size_t stored_bytes(const ShadedOutput& output) {
    return output_type_size(output.type) *
           static_cast<std::size_t>(output.channels == 3 ? 4 : output.channels);
}

GLenum gl_format(Format format) {
    switch (format) {
        case Format::rgba8: return GL_RGBA8;
        case Format::rgba16f: return GL_RGBA16F;
        case Format::rgba32f: return GL_RGBA32F;
        case Format::rgb565: return GL_RGB565;
    }
    return GL_RGBA32F;
}

GLenum gl_format(DepthFormat format) {
    switch (format) {
        case DepthFormat::none: return GL_NONE;
        case DepthFormat::depth_component16: return GL_DEPTH_COMPONENT16;
        case DepthFormat::depth_component24: return GL_DEPTH_COMPONENT24;
        case DepthFormat::depth_component32f: return GL_DEPTH_COMPONENT32F;
        case DepthFormat::depth24_stencil8: return GL_DEPTH24_STENCIL8;
        case DepthFormat::depth32f_stencil8: return GL_DEPTH32F_STENCIL8;
        case DepthFormat::stencil_index8: return GL_STENCIL_INDEX8;
    }
    return GL_NONE;
}

GLenum depth_attachment(DepthFormat format) {
    if (!has_stencil(format)) return GL_DEPTH_ATTACHMENT;
    return has_depth(format) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_STENCIL_ATTACHMENT;
}

bool is_color(GLenum point) { return point >= GL_COLOR_ATTACHMENT0 && point < GL_DEPTH_ATTACHMENT; }

/// A driver may offer fewer samples for one format than for others.
void check_samples(const gl::Context& context, GLenum format, std::string_view name,
                   std::int64_t samples) {
    GLint most = 0;  // GL gives the first of a descending list
    context.gl().GetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, format, GL_SAMPLES, 1, &most);
    if (samples <= std::max(most, 1)) return;
    throw std::invalid_argument("samples: expected 1 to " + std::to_string(std::max(most, 1)) +
                                " (GL_SAMPLES of " + std::string(name) + " on " +
                                context.renderer() + "), got " + std::to_string(samples));
}

}  // namespace

int most_layers(const gl::Limits& limits) {
    return std::min(limits.max_array_texture_layers, limits.max_framebuffer_layers);
}

void check_limits(const gl::Limits& limits, const std::string& driver,
                  const TargetRequest& request) {
    const auto on = [&driver](const char* limit) {
        return std::string(" (") + limit + " of " + driver + ")";
    };
    const bool faces = request.shape.has_faces();
    const std::int64_t width = request.width;
    const std::int64_t height = request.height;
    const std::string got =
        faces ? std::to_string(width) : std::to_string(width) + " x " + std::to_string(height);
    const auto [largest, limit] = gl::largest_side(limits, faces);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        throw std::invalid_argument("size: expected 1 to " + std::to_string(largest) + " pixels" +
                                    on(limit) + ", got " + got);
    }
    const int layers = most_layers(limits);
    if (request.shape.count < 1 || request.shape.layers() > layers) {
        throw std::invalid_argument("layers: expected 1 to " + std::to_string(layers) +
                                    on("GL_MAX_ARRAY_TEXTURE_LAYERS") + ", got " +
                                    std::to_string(request.shape.layers()));
    }
    const std::int64_t samples = request.samples;
    if (samples < 1 || samples > limits.max_samples) {
        throw std::invalid_argument("samples: expected 1 to " + std::to_string(limits.max_samples) +
                                    on("GL_MAX_SAMPLES") + ", got " + std::to_string(samples));
    }
    const int buffers = std::min(limits.max_draw_buffers, limits.max_color_attachments);
    const std::size_t shaded = request.outputs.by_slot().size();
    if (shaded + 1 > static_cast<std::size_t>(buffers)) {
        throw std::invalid_argument("outputs: expected at most " + std::to_string(buffers - 1) +
                                    " besides colour, depth and stencil" +
                                    on("GL_MAX_DRAW_BUFFERS") + ", got " + std::to_string(shaded));
    }
}

TargetDescription described(const TargetRequest& request) {
    TargetDescription description;
    description.shape = request.shape;
    description.width = static_cast<int>(request.width);
    description.height = static_cast<int>(request.height);
    description.samples = request.color ? static_cast<int>(request.samples) : 1;
    description.format = request.color ? request.format : Format::rgba8;
    description.outputs = request.outputs;
    description.color = request.color;
    description.depth_format = request.depth_format;
    description.depth_order = request.depth_order;
    return description;
}

TargetDescription describe_target(const gl::Context& context, const TargetRequest& request) {
    check_limits(context.limits(), context.renderer(), request);
    if (request.samples > 1 && request.color) {
        const DepthFormat depth_format = request.depth_format;
        check_samples(context, gl_format(request.format), to_string(request.format),
                      request.samples);
        if (depth_format != DepthFormat::none) {
            check_samples(context, gl_format(depth_format), to_string(depth_format),
                          request.samples);
        }
    }
    return described(request);
}

void check_target_memory(const gl::Context& context, const TargetDescription& description,
                         std::size_t result_bytes) {
    const std::string side = std::to_string(description.width);
    const std::string what =
        (description.shape.has_faces() ? side : side + " x " + std::to_string(description.height)) +
        " pixels";
    check_texture_memory(context, static_cast<double>(description.bytes()),
                         static_cast<double>(result_bytes), what);
}

void set_post_process(TargetDescription& description, std::size_t effects, bool post_processed) {
    description.post_processed = post_processed || effects > 0;
    description.effects = static_cast<int>(std::min<std::size_t>(effects, 2));
}

std::size_t TargetDescription::bytes() const {
    const std::size_t drawn = color ? texel_size(post_processed ? Format::rgba32f : format) : 0;
    const std::size_t depth = texel_size(depth_format);
    std::size_t texel = drawn + depth;
    if (samples > 1) texel += static_cast<std::size_t>(samples) * (drawn + depth);
    if (post_processed) texel += texel_size(format);
    texel += static_cast<std::size_t>(effects) * drawn;
    if (mipmaps) texel += drawn / 3;
    for (const ShadedOutput& output : outputs.by_slot()) texel += stored_bytes(output);
    return texel * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(layers());
}

std::size_t Target::Mirrors::bytes() const {
    std::size_t sum = 0;
    for (const auto& [name, mirror] : kept) {
        if (mirror->target) sum += mirror->target->bytes();
        if (mirror->behind.target) sum += mirror->behind.target->bytes();
        sum += mirror->mirrors.bytes();
    }
    return sum;
}

std::size_t Target::Screen::depth_bytes() const {
    const TargetDescription& drawn = target->description();
    const std::size_t texels = static_cast<std::size_t>(screen_depths_side(drawn.width)) *
                               static_cast<std::size_t>(screen_depths_side(drawn.height)) *
                               static_cast<std::size_t>(drawn.layers());
    return texels * 2 * sizeof(float) * 4 / 3;
}

Layers::Layers(const GladGLContext& gl, std::vector<Attachment> attachments, int layers)
    : gl_(&gl), attachments_(std::move(attachments)), one_(static_cast<std::size_t>(layers)) {}

gl::Framebuffer Layers::make(std::optional<int> layer) const {
    gl::Framebuffer framebuffer = gl::create_framebuffer(*gl_);
    std::vector<GLenum> draw_buffers(1, GL_NONE);
    for (const Attachment& a : attachments_) {
        if (layer) {
            gl_->NamedFramebufferTextureLayer(framebuffer.id(), a.point, a.texture, a.level,
                                              *layer);
        } else {
            gl_->NamedFramebufferTexture(framebuffer.id(), a.point, a.texture, a.level);
        }
        if (!is_color(a.point)) continue;
        const std::size_t slot = a.point - GL_COLOR_ATTACHMENT0;
        if (slot >= draw_buffers.size()) draw_buffers.resize(slot + 1, GL_NONE);
        draw_buffers[slot] = a.point;
    }
    gl_->NamedFramebufferDrawBuffers(framebuffer.id(), static_cast<GLsizei>(draw_buffers.size()),
                                     draw_buffers.data());
    const auto first = std::find_if(draw_buffers.begin(), draw_buffers.end(),
                                    [](GLenum buffer) { return buffer != GL_NONE; });
    gl_->NamedFramebufferReadBuffer(framebuffer.id(),
                                    first == draw_buffers.end() ? GLenum{GL_NONE} : *first);
    gl::check_framebuffer(*gl_, framebuffer, "making a render target");
    return framebuffer;
}

GLuint Layers::all() {
    if (!all_) all_ = make(std::nullopt);
    return all_.id();
}

GLuint Layers::one(int layer) {
    gl::Framebuffer& framebuffer = one_[static_cast<std::size_t>(layer)];
    if (!framebuffer) framebuffer = make(layer);
    return framebuffer.id();
}

Target::Target(const gl::Context& context, const TargetDescription& description)
    : gl_(&context.gl()),
      // Mesa's zink (26.2) makes the first resolve a part of the render pass, for one layer alone,
      // and leaves out the others: five faces of a cube show memory.
      flushes_before_resolve_(context.renderer().starts_with("zink")), description_(description) {
    check_target_memory(context, description);
    keys.resize(static_cast<std::size_t>(description.layers()));
    revisions.resize(keys.size(), 0);

    const GLenum color_format =
        gl_format(description.post_processed ? Format::rgba32f : description.format);
    const int levels =
        description.mipmaps ? gl::mip_levels(description.width, description.height) : 1;
    const GLenum depth_format = gl_format(description.depth_format);
    const GLenum depth_point = depth_attachment(description.depth_format);
    if (description.color) {
        color_ = make_texture(context, color_format, description.post_processed ? 1 : levels);
    }
    if (depth_format != GL_NONE) depth_ = make_texture(context, depth_format, 1);
    if (description.mipmaps && !description.post_processed) {
        gl_->TextureParameteri(color_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    }

    std::vector<Layers::Attachment> color_pass;
    std::vector<Layers::Attachment> output_pass;
    if (color_) color_pass.push_back({attachment(0), color_.id()});
    if (depth_) output_pass.push_back({depth_point, depth_.id()});
    for (const ShadedOutput& output : description.outputs.by_slot()) {
        outputs_.push_back(make_texture(context, gl_format(output.channels, output.type), 1));
        output_pass.push_back({attachment(output.slot), outputs_.back().id()});
    }
    if (multisampled()) {
        sample_color_ = make_samples(context, color_format);
        resolved_.emplace(*gl_, color_pass, description.layers());
        color_pass = {{attachment(0), sample_color_.id()}};
        if (depth_format != GL_NONE) {
            sample_depth_ = make_samples(context, depth_format);
            color_pass.push_back({depth_point, sample_depth_.id()});
        }
        if (description.outputs.any())
            output_pass_.emplace(*gl_, output_pass, description.layers());
    } else {
        color_pass.insert(color_pass.end(), output_pass.begin(), output_pass.end());
    }
    color_pass_.emplace(*gl_, color_pass, description.layers());
    if (description.post_processed) {
        post_processed_ = make_texture(context, gl_format(description.format), levels);
        post_processed_pass_.emplace(
            *gl_, std::vector<Layers::Attachment>{{attachment(0), post_processed_.id()}},
            description.layers());
    }
    for (int turn = 0; turn < description.effects; ++turn) {
        scratch_[turn] = make_texture(context, color_format, 1);
        scratch_pass_[turn].emplace(
            *gl_, std::vector<Layers::Attachment>{{attachment(0), scratch_[turn].id()}},
            description.layers());
    }
    gl::check_gl(*gl_, "making a render target");
    check_complete();
}

void Target::check_complete() {
    try {
        for (auto* pass : {&color_pass_, &output_pass_, &resolved_, &post_processed_pass_}) {
            if (*pass) (*pass)->one(0);
        }
    } catch (const GlError& error) {
        if (error.code() != GL_FRAMEBUFFER_UNSUPPORTED &&
            error.code() != GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT) {
            throw;
        }
        const auto* driver = reinterpret_cast<const char*>(gl_->GetString(GL_RENDERER));
        throw std::invalid_argument(
            std::string("format, depth_format: expected a pair that ") + driver +
            " can draw into, got " +
            std::string(description_.color ? to_string(description_.format) : "None") + " and " +
            std::string(to_string(description_.depth_format)) + ": " + error.what());
    }
}

double Target::texels() const {
    return static_cast<double>(description_.width) * description_.height * description_.layers();
}

gl::Texture Target::make_samples(const gl::Context& context, GLenum format) const {
    return gl::make_large_texture(
        context, texels() * description_.samples,
        [format, samples = description_.samples, width = description_.width,
         height = description_.height, layers = description_.layers()](const GladGLContext& gl) {
            return gl::create_texture_2d_multisample_array(gl, format, samples, width, height,
                                                           layers);
        });
}

gl::Texture Target::make_texture(const gl::Context& context, GLenum format, int levels) const {
    // All attachments of a layered framebuffer must have one kind (GL 4.6 section 9.4.2). A flat
    // target is an array of one layer, so that full-screen passes look up all targets in one way.
    gl::Texture texture = gl::make_large_texture(
        context, texels(),
        [format, levels, shape = description_.shape, width = description_.width,
         height = description_.height](const GladGLContext& gl) {
            switch (shape.kind) {
                case TargetShape::Kind::cube:
                    return gl::create_texture_cube(gl, format, width, levels);
                case TargetShape::Kind::cube_array:
                    return gl::create_texture_cube_array(gl, format, width, shape.count, levels);
                case TargetShape::Kind::flat:
                case TargetShape::Kind::array: break;
            }
            return gl::create_texture_2d_array(gl, format, width, height, shape.count, levels);
        });
    // Probes and effects look up these textures.
    set_sampler(*gl_, texture.id(), clamped_linear);
    return texture;
}

void Target::resolve(int layer, const Rect& rect) {
    if (flushes_before_resolve_) gl_->Flush();
    gl_->BlitNamedFramebuffer(color_pass_->one(layer), resolved_->one(layer), rect.x0, rect.y0,
                              rect.x1, rect.y1, rect.x0, rect.y0, rect.x1, rect.y1,
                              GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace cubecam
