#include "cubecam/render/graph/texture_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/render/resources/sampler.hpp"
#include "cubecam/scene/scene_encoding.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <stdexcept>

namespace cubecam {
TexturePicture::TexturePicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, context.scenes.textures[id.object].scene),
      texture_(context.scenes.textures[id.object]),
      state_(context.gpu.textures.get(texture_.object, [] { return TextureState{}; })) {}

bool TexturePicture::sees(const NodeSnapshot& node) const { return is_seen(texture_, node); }

std::vector<PictureId> TexturePicture::possible_dependencies() {
    Dependencies shown = possible();
    add_dependencies(texture_.effects, shown);
    return shown;
}

std::vector<PictureId> TexturePicture::dependencies() {
    const double aspect =
        static_cast<double>(texture_.value.width) / static_cast<double>(texture_.value.height);
    Dependencies shown = plan({camera_view(matrices(texture_.camera, aspect))}, describe());
    add_dependencies(texture_.effects, shown);
    return shown;
}

/// Like describe_target; if the texture has a name, error messages contain it.
TargetDescription TexturePicture::describe() const {
    const RenderTextureValue& value = texture_.value;
    try {
        TargetDescription description =
            describe_target(context_.gpu.context, {.shape = TargetShape::flat(),
                                                   .width = value.width,
                                                   .height = value.height,
                                                   .samples = value.samples,
                                                   .format = value.format,
                                                   .depth_format = value.depth_format});
        description.mipmaps = value.mipmaps;
        set_post_process(description, value.effects.size(), false);
        return description;
    } catch (const std::invalid_argument& error) {
        if (value.name.empty()) throw;
        throw std::invalid_argument("RenderTexture \"" + value.name + "\": " + error.what());
    }
}

void TexturePicture::reset() {
    Target::Behind behind = std::move(state_.behind);
    Target::Mirrors mirrors = std::move(state_.mirrors);
    state_ = TextureState{};
    state_.behind = std::move(behind);
    state_.mirrors = std::move(mirrors);
}

void TexturePicture::prepare(const TargetDescription& description) {
    const GladGLContext& gl = context_.gpu.context.gl();
    if (state_.target == nullptr || state_.target->description() != description) {
        reset();  // frees the old memory first
        state_.target = std::make_unique<Target>(context_.gpu.context, description);
        state_.view = gl::create_view_2d(
            gl, state_.target->picture(),
            description.mipmaps ? gl::mip_levels(description.width, description.height) : 1);
        state_.wrap = texture_.value.wrap;
        set_sampler(gl, state_.view.id(), sampler());
    }
    if (state_.wrap != texture_.value.wrap) {
        state_.wrap = texture_.value.wrap;
        set_sampler(gl, state_.view.id(), sampler());
        state_.revision = context_.gpu.contents = next_revision();
    }
}

void TexturePicture::update() {
    const TargetDescription description = describe();
    try {
        prepare(description);
        const std::size_t drawn = draw_changed(*state_.target, {.effects = texture_.effects});
        const Encoding encoding = scene_encoding(
            context_.scenes, number_, [this](const NodeSnapshot& node) { return sees(node); });
        // Nodes out of view change no pixel, but they may change what the numbers are.
        if (encoding != state_.encoding) state_.revision = context_.gpu.contents = next_revision();
        state_.encoding = encoding;
        state_.last = {false, context_.scenes.origin};
        if (drawn == 0) return;
        if (description.mipmaps) {
            context_.gpu.context.gl().GenerateTextureMipmap(state_.target->picture().id());
        }
    } catch (...) {
        reset();
        throw;
    }
    state_.revision = context_.gpu.contents = next_revision();
    ++context_.stats.textures_updated;
}

Sampler TexturePicture::sampler() const {
    return {{texture_.value.wrap, texture_.value.wrap},
            MagFilter::linear,
            texture_.value.mipmaps ? MinFilter::linear_mipmap_linear : MinFilter::linear};
}

bool TexturePicture::decodes() const {
    return texture_.value.format == Format::rgba8 && state_.encoding == Encoding::srgb;
}

BoundTexture TexturePicture::texture(bool colors) {
    if (!colors || !decodes()) return {state_.view.id(), state_.revision};
    if (state_.decoded_of != state_.revision) decode();
    return {state_.decoded.id(), state_.revision};
}

/// Copies the picture into a texture that decodes. A view of the same memory would do, except that
/// mip levels are means of decoded numbers.
void TexturePicture::decode() {
    const GladGLContext& gl = context_.gpu.context.gl();
    const TargetDescription& description = state_.target->description();
    if (!state_.decoded) {
        state_.decoded = gl::create_texture_2d(gl, GL_SRGB8_ALPHA8, description.width,
                                               description.height, description.mipmaps ? 0 : 1);
    }
    const GLuint id = state_.decoded.id();
    set_sampler(gl, id, sampler());
    gl.CopyImageSubData(state_.target->picture().id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, id,
                        GL_TEXTURE_2D, 0, 0, 0, 0, description.width, description.height, 1);
    if (description.mipmaps) gl.GenerateTextureMipmap(id);
    gl::check_gl(gl, "decoding a render texture");
    state_.decoded_of = state_.revision;
}

std::string TexturePicture::label(std::size_t place) const {
    const std::string& name = texture_.value.name;
    if (name.empty()) return "RenderTexture " + std::to_string(place == 0 ? 1 : place);
    return (place == 0 ? "RenderTexture \"" : "\"") + name + '"';
}

}  // namespace cubecam
