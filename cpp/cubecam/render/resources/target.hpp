#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/render/resources/depth_order.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/picture_key.hpp"
#include "cubecam/render/resources/target_shape.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// Two targets of one description can stand for each other.
struct TargetDescription {
    TargetShape shape;
    int width = 0;
    int height = 0;
    int samples = 1;
    Format format = Format::rgba8;
    Outputs outputs;
    bool mipmaps = false;
    bool post_processed =
        false;          ///< colour is drawn in float, then brought into `format` by PostProcessPass
    int effects = 0;    ///< passes before that, 2 standing for more
    bool color = true;  ///< false: no colour buffer
    DepthFormat depth_format = DepthFormat::depth_component32f;
    DepthOrder depth_order = DepthOrder::nearest;

    int layers() const { return shape.layers(); }
    /// GPU memory it takes, padding and driver overhead left out.
    std::size_t bytes() const;
    auto operator<=>(const TargetDescription&) const = default;
};

/// What describe_target makes a description of. Sizes come as the caller gave them, so that the
/// message of an error can name them.
struct TargetRequest {
    TargetShape shape;
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::int64_t samples = 1;
    Format format = Format::rgba8;
    Outputs outputs = {};
    DepthFormat depth_format = DepthFormat::depth_component32f;
    bool color = true;
    DepthOrder depth_order = DepthOrder::nearest;
};

/// A description of pictures of this size. @throws std::invalid_argument beyond the driver's limits
/// or the machine's memory, naming the limit.
TargetDescription describe_target(const gl::Context& context, const TargetRequest& request);

/// Says that a picture is worked on by PostProcessPass: by effects, by a tone curve or encoding, or
/// not.
void set_post_process(TargetDescription& description, std::size_t effects, bool post_processed);

/// The attachment of a colour or output by its slot.
constexpr GLenum attachment(std::size_t slot) {
    return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot);
}

/// Framebuffers over the same textures: all layers at once, and each layer alone.
class Layers {
public:
    struct Attachment {
        GLenum point;
        GLuint texture;
        GLint level = 0;
    };

    Layers(const GladGLContext& gl, std::vector<Attachment> attachments, int layers);

    GLuint all();  ///< for layered drawing and whole clears
    GLuint one(int layer);

private:
    gl::Framebuffer make(std::optional<int> layer) const;

    const GladGLContext* gl_;
    std::vector<Attachment> attachments_;
    gl::Framebuffer all_;
    std::vector<gl::Framebuffer> one_;
};

/// A call that found its picture, and all that the picture depends on, as they were left. While all
/// of this stays the same, so does the picture.
struct UnchangedCall {
    std::uint64_t scene;     ///< SceneSnapshot::revision
    std::uint64_t contents;  ///< RendererState::contents
    Key request;             ///< the views, the nodes left out, what is done to the picture
    std::int64_t views;      ///< pictures that were still true
};

/// Textures that pictures are drawn into, and for each layer the key of the picture it holds.
///
/// With one sample a single pass writes colour and outputs. With more, colour is drawn multisampled
/// and resolved, and the outputs are drawn in a pass of their own without multisampling: an average
/// of ids would mean nothing. Without a colour there is nothing to multisample.
class Target {
public:
    /// @throws GlError when memory is short; std::invalid_argument, naming the formats, if the
    /// driver cannot draw into them together.
    Target(const gl::Context& context, const TargetDescription& description);

    const TargetDescription& description() const { return description_; }
    bool multisampled() const { return description_.samples > 1; }

    /// Colour as materials write it, resolved.
    const gl::Texture& color() const { return color_; }
    /// What the picture is read from: color(), or what became of it in PostProcessPass.
    const gl::Texture& picture() const {
        return description_.post_processed ? post_processed_ : color_;
    }
    const gl::Texture& depth() const { return depth_; }
    /// By ShadedOutput::slot.
    const gl::Texture& output(std::size_t slot) const { return outputs_[slot - 1]; }

    /// What the colour pass draws into: outputs are attached as well unless the target is
    /// multisampled.
    Layers& color_pass() { return *color_pass_; }
    /// Outputs alone; only for a multisampled target that has some.
    Layers& output_pass() { return *output_pass_; }
    Layers& resolved() { return *resolved_; }
    Layers& post_processed_pass() { return *post_processed_pass_; }
    /// What the outputs can be read from.
    Layers& outputs() { return multisampled() ? *output_pass_ : *color_pass_; }

    /// Where effects draw to, by turns.
    const gl::Texture& scratch(std::size_t turn) const { return scratch_[turn]; }
    Layers& scratch_pass(std::size_t turn) { return *scratch_pass_[turn]; }

    /// Averages the samples of one layer into color().
    void resolve(int layer);

    /// The key of what each layer holds; nothing: not to be trusted.
    std::vector<std::optional<PictureKey>> keys;
    /// The last call, if it drew nothing.
    std::optional<UnchangedCall> unchanged;

private:
    void check_complete();
    gl::Texture make_texture(const gl::Context& context, GLenum format, int levels) const;

    const GladGLContext* gl_;
    TargetDescription description_;
    gl::Texture color_, depth_, post_processed_, sample_color_, sample_depth_;
    std::vector<gl::Texture> outputs_;  // by slot, the first being 1
    gl::Texture scratch_[2];
    std::optional<Layers> scratch_pass_[2];
    std::optional<Layers> color_pass_, output_pass_, resolved_, post_processed_pass_;
};

}  // namespace cubecam
