#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/encoding.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/render/resources/depth_order.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/picture_key.hpp"
#include "cubecam/render/resources/target_shape.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cubecam {

/// The properties of a target; one of two targets with equal descriptions can replace the other.
struct TargetDescription {
    TargetShape shape;
    int width = 0;
    int height = 0;
    int samples = 1;
    Format format = Format::rgba8;
    Outputs outputs;
    bool mipmaps = false;
    bool post_processed =
        false;          ///< colour is drawn in float, then PostProcessPass converts it to `format`
    int effects = 0;    ///< passes before that; 2 means 2 or more
    bool color = true;  ///< false: no colour buffer
    DepthFormat depth_format = DepthFormat::depth_component32f;
    DepthOrder depth_order = DepthOrder::nearest;

    int layers() const { return shape.layers(); }
    /// The GPU memory of a target, without padding and the driver's overhead.
    std::size_t bytes() const;
    auto operator<=>(const TargetDescription&) const = default;
};

/// The arguments of describe_target. The sizes are those of the caller, so that error messages can
/// name them.
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

/// The largest number of layers of a target.
int most_layers(const gl::Limits& limits);

/// @throws std::invalid_argument that names the limit, if the size, the layers, the samples or the
/// number of outputs exceed what a driver allows for any format. `driver` is GL_RENDERER.
void check_limits(const gl::Limits& limits, const std::string& driver,
                  const TargetRequest& request);

/// The description of what a request asks for, whether a driver can draw it or not.
TargetDescription described(const TargetRequest& request);

/// Makes the description of a target. @throws std::invalid_argument that names the limit, if the
/// request exceeds the driver's limits.
TargetDescription describe_target(const gl::Context& context, const TargetRequest& request);

/// @throws std::invalid_argument if the memory cannot hold a new target of the description and,
/// besides, `result_bytes` of main memory for what is read from it.
void check_target_memory(const gl::Context& context, const TargetDescription& description,
                         std::size_t result_bytes = 0);

/// Sets whether PostProcessPass processes the picture, and by how many effects. `post_processed`:
/// whether there is a tone curve or encoding.
void set_post_process(TargetDescription& description, std::size_t effects, bool post_processed);

/// The attachment point of colour or an output, by its slot.
constexpr GLenum attachment(std::size_t slot) {
    return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot);
}

/// Framebuffers with the same textures: one for all layers, and one for each layer.
class Layers {
public:
    struct Attachment {
        GLenum point;
        GLuint texture;
        GLint level = 0;
    };

    Layers(const GladGLContext& gl, std::vector<Attachment> attachments, int layers);

    GLuint all();  ///< for layered drawing and clears of all layers
    GLuint one(int layer);

private:
    gl::Framebuffer make(std::optional<int> layer) const;

    const GladGLContext* gl_;
    std::vector<Attachment> attachments_;
    gl::Framebuffer all_;
    std::vector<gl::Framebuffer> one_;
};

/// The texture of depths in which reflections are followed has levels of cells, each with a side of
/// 2^level pixels. Its sides are whole numbers of cells of the last level.
inline constexpr int screen_depth_levels = 7;
constexpr int screen_depths_side(int pixels) {
    constexpr int cell = 1 << (screen_depth_levels - 1);
    return (pixels + cell - 1) / cell * cell;
}

/// Identifies a call that changed neither its picture nor any picture on which it depends. While
/// these members stay the same, the picture stays valid.
struct UnchangedCall {
    std::uint64_t scene;     ///< SceneSnapshot::revision
    std::uint64_t contents;  ///< RendererState::contents
    Key request;             ///< the views, the excluded nodes, the post-processing
    std::int64_t views;      ///< pictures that were still valid
    std::optional<Encoding> encoding = std::nullopt;  ///< of the picture, once it was found
};

/// The textures into which pictures are drawn, and for each layer the key of its picture.
///
/// With one sample a single pass writes colour and outputs. With more samples colour is drawn
/// multisampled and resolved, and a second pass without multisampling draws the outputs: an average
/// of ids has no meaning. A target without colour is never multisampled.
class Target {
public:
    /// @throws GlError or std::invalid_argument if there is not enough memory;
    /// std::invalid_argument that names the formats, if the driver cannot draw into them together.
    Target(const gl::Context& context, const TargetDescription& description);

    const TargetDescription& description() const { return description_; }
    bool multisampled() const { return description_.samples > 1; }

    /// The colour that materials write, resolved.
    const gl::Texture& color() const { return color_; }
    /// The texture of the finished picture: color(), or the result of PostProcessPass.
    const gl::Texture& picture() const {
        return description_.post_processed ? post_processed_ : color_;
    }
    const gl::Texture& depth() const { return depth_; }
    /// The texture of an output, by ShadedOutput::slot.
    const gl::Texture& output(std::size_t slot) const { return outputs_[slot - 1]; }

    /// The framebuffers of the colour pass; outputs are attached, too, unless the target is
    /// multisampled.
    Layers& color_pass() { return *color_pass_; }
    /// The framebuffers of the outputs alone; only for a multisampled target with outputs.
    Layers& output_pass() { return *output_pass_; }
    Layers& resolved() { return *resolved_; }
    Layers& post_processed_pass() { return *post_processed_pass_; }
    /// The framebuffers from which outputs are read.
    Layers& outputs() { return multisampled() ? *output_pass_ : *color_pass_; }

    /// The two textures into which effects draw in turn.
    const gl::Texture& scratch(std::size_t turn) const { return scratch_[turn]; }
    Layers& scratch_pass(std::size_t turn) { return *scratch_pass_[turn]; }

    /// Averages the samples of a part of one layer into color().
    void resolve(int layer, const Rect& rect);

    /// The key of each layer's picture; none: the contents are not valid.
    std::vector<std::optional<PictureKey>> keys;
    /// Of each layer: the number of its last drawing (RendererState::views_drawn).
    std::vector<std::uint64_t> revisions;
    /// The scene behind the transmissive surfaces of a picture (graph/behind_picture.hpp).
    struct Behind {
        std::unique_ptr<Target> target;  ///< null: not drawn yet
        std::uint64_t revision = 0;      ///< new whenever a layer was drawn
    };
    Behind behind;  ///< of the picture in this target, if it is a frame or a capture
    /// The pictures of the planar mirrors that a picture shows (graph/planar_mirror_picture.hpp).
    struct Mirrors {
        /// PlanarMirror::identity, and the id of the first node that it belongs to.
        using Name = std::pair<std::uint64_t, std::int32_t>;
        struct Kept;
        std::map<Name, std::unique_ptr<Kept>> kept;

        std::size_t bytes() const;
    };
    struct Mirrors::Kept {
        std::unique_ptr<Target> target;  ///< null: not drawn yet
        std::uint64_t revision = 0;      ///< new whenever a layer was drawn
        Behind behind;                   ///< of this picture
        Mirrors mirrors;                 ///< that this picture shows
    };
    Mirrors mirrors;  ///< of the picture in this target, if it is a frame or a capture
    /// What reflections find on the screen (graph/screen_picture.hpp).
    struct Screen {
        std::unique_ptr<Target> target;  ///< null: not drawn yet
        gl::Texture depths;              ///< passes/screen_depth_pass.hpp
        std::vector<Layers> levels;      ///< of `depths`
        std::uint64_t revision = 0;      ///< new whenever a layer was drawn

        std::size_t depth_bytes() const;  ///< of `depths`, whether made or not
        std::size_t bytes() const { return target ? target->bytes() + depth_bytes() : 0; }
    };
    Screen screen;  ///< of the picture in this target, if it is a frame

    /// The GPU memory of the target, of what is behind it, of what its planar mirrors show and of
    /// what its reflections find on the screen.
    std::size_t bytes() const {
        return description_.bytes() + (behind.target ? behind.target->bytes() : 0) +
               mirrors.bytes() + screen.bytes();
    }

    /// The last call, if it drew nothing.
    std::optional<UnchangedCall> unchanged;

private:
    void check_complete();
    double texels() const;  ///< of all layers
    gl::Texture make_texture(const gl::Context& context, GLenum format, int levels) const;
    gl::Texture make_samples(const gl::Context& context, GLenum format) const;

    const GladGLContext* gl_;
    bool flushes_before_resolve_;
    TargetDescription description_;
    gl::Texture color_, depth_, post_processed_, sample_color_, sample_depth_;
    std::vector<gl::Texture> outputs_;  // by slot; the first slot is 1
    gl::Texture scratch_[2];
    std::optional<Layers> scratch_pass_[2];
    std::optional<Layers> color_pass_, output_pass_, resolved_, post_processed_pass_;
};

}  // namespace cubecam
