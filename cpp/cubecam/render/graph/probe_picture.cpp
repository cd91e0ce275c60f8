#include "cubecam/render/graph/probe_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/scene_encoding.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>

namespace cubecam {

ProbePicture::ProbePicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, id.scene), probe_(scene_.probes[id.object]),
      levels_(context.probe_levels(id.scene, id.object)), kept_(levels_.at(id.bounce)),
      state_(*kept_),
      first_(id.bounce == 0 ? *this : context.probe(probe_id(id.scene, id.object))) {}

bool ProbePicture::due() {
    if (&first_ != this) return first_.due();
    if (!due_) {
        due_ = count_and_decide();
        // A probe that keeps its pictures keeps all of them.
        if (*due_) levels_.drop_from(context_.probe_circles(id_.scene).levels(id_.object));
    }
    return *due_;
}

Environment ProbePicture::environment(const EnvironmentParts& parts) {
    const TargetDescription& description = state_.target->description();
    Environment made;
    made.cube = {state_.target->color().id(), state_.revision};
    made.parts = parts;
    if (description.mipmaps) {
        made.levels = EnvironmentLevels::mipmaps;
        made.level_count = gl::mip_levels(description.width, description.height);
    }
    made.position = state_.position;
    made.local = local_lookup(parts.filtered || parts.filtered_if_made || parts.mipmaps);
    const std::optional<bool> wanted = probe_.value.prefilter;
    if (parts.filtered ? wanted.value_or(true) : parts.filtered_if_made && wanted.value_or(false)) {
        made.filter(filter());
    }
    if (parts.mipmaps) made.box_mipmaps = {box_mipmaps(), state_.revision};
    return made;
}

LocalLookup ProbePicture::local_lookup(bool rough) {
    const ParallaxValue& parallax = probe_.value.parallax;
    LocalLookup local;
    if (parallax.by_proxy()) {
        local.method = parallax.method;
        local.to_proxy = parallax.to_proxy();
    } else if (parallax.by_distance()) {
        const bool layers = has_layers() && state_.distances.has_layers();
        local.method = layers ? Parallax::layers : Parallax::distance;
        local.fetches = parallax.fetches;
        local.distances = {state_.distances.id(), state_.distances.revision()};
        local.size = state_.target->description().width;
        if (layers) {
            if (rough && state_.farthest_mipmaps != state_.revision) {
                context_.gpu.context.gl().GenerateTextureMipmap(state_.farthest->color().id());
                state_.farthest_mipmaps = state_.revision;
            }
            local.farthest = {state_.farthest->color().id(), state_.distances.revision()};
        }
    }
    return local;
}

const FilteredTexture& ProbePicture::filter() {
    FilteredFaces::Revisions revisions{};
    std::copy_n(state_.target->revisions.begin(), face_count, revisions.begin());
    return state_.filtered.update(
        context_.gpu.context, state_.target->description().width, revisions,
        [this](Face face) { return read_face(face); }, context_.stats);
}

std::vector<glm::vec4> ProbePicture::read_face(Face face) const {
    const GladGLContext& gl = context_.gpu.context.gl();
    const int size = state_.target->description().width;
    std::vector<glm::vec4> texels(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    gl::read_layer(gl, state_.target->color().id(), static_cast<int>(face), size, size, GL_RGBA,
                   GL_FLOAT, sizeof(glm::vec4), texels.data());
    gl::check_gl(gl, "reading a face of a probe");
    return texels;
}

GLuint ProbePicture::box_mipmaps() {
    const TargetDescription& description = state_.target->description();
    if (description.mipmaps) return state_.target->color().id();
    if (state_.box_mipmaps_revision == state_.revision) return state_.box_mipmaps.id();
    const GladGLContext& gl = context_.gpu.context.gl();
    const int size = description.width;
    GLint format = 0;
    gl.GetTextureLevelParameteriv(state_.target->color().id(), 0, GL_TEXTURE_INTERNAL_FORMAT,
                                  &format);
    state_.box_mipmaps = gl::create_texture_cube(gl, static_cast<GLenum>(format), size, 0);
    const GLuint id = state_.box_mipmaps.id();
    gl.TextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.CopyImageSubData(state_.target->color().id(), GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, id,
                        GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, size, size, face_count);
    gl.GenerateTextureMipmap(id);
    gl::check_gl(gl, "averaging a probe");
    state_.box_mipmaps_revision = state_.revision;
    return id;
}

bool ProbePicture::sees(const NodeSnapshot& node) const {
    return is_seen(scene_, node, id_.object);
}

bool ProbePicture::sees_in_mirrors(const NodeSnapshot& node) const {
    return node.in_captures && !is_excluded(node, probe_.excluded);
}

bool ProbePicture::count_and_decide() {
    const bool drawn = levels_.drawn().has_value();
    // Whatever its policy is: a picture that was lost with its context is drawn again.
    if (forced_ || levels_.last.lost) return true;
    switch (probe_.value.update) {
        case ProbeUpdate::on_change: return true;
        case ProbeUpdate::once: return !drawn || (has_layers() && state_.farthest == nullptr);
        case ProbeUpdate::manual: return false;
        case ProbeUpdate::every_n_frames: return due_by_count() || !drawn;
    }
    return true;
}

/// Counts the call, unless the same call counted before its context was lost.
bool ProbePicture::due_by_count() {
    if (levels_.counted != context_.gpu.call) ++levels_.calls;
    levels_.counted = context_.gpu.call;
    return (levels_.calls - 1) % probe_.value.every == 0;
}

std::vector<PictureId> ProbePicture::dependencies() {
    if (!due()) return {};  // it keeps its contents and depends on nothing
    return plan(cube_views(probe_.position, probe_.value.near, probe_.value.far), describe());
}

std::vector<PictureId> ProbePicture::companions() {
    // What follows changes is drawn as soon as something shows it. A policy concerns one moment.
    if (!due() || probe_.value.update == ProbeUpdate::on_change) return {};
    return context_.probe_pictures(id_.scene, id_.object);
}

TargetDescription ProbePicture::describe() const {
    const ProbeValue& value = probe_.value;
    TargetDescription description =
        describe_target(context_.gpu.context, {.shape = TargetShape::cube(),
                                               .width = value.size,
                                               .height = value.size,
                                               .samples = value.samples,
                                               .format = value.format,
                                               .depth_format = value.depth_format});
    description.mipmaps = value.mipmaps;
    // With several samples only the pass of the outputs leaves a depth for each texel.
    if (value.parallax.by_distance() && value.samples > 1) description.outputs.add(output_row("z"));
    return description;
}

TargetDescription ProbePicture::describe_farthest() const {
    TargetDescription description = describe();
    description.samples = 1;
    description.outputs = {};
    description.mipmaps = true;
    description.depth_order = DepthOrder::farthest;
    return description;
}

void ProbePicture::update() {
    if (due()) draw();
    if (!has_layers()) state_.farthest = nullptr;
    if (!probe_.value.parallax.by_distance()) state_.distances = {};
    if (drawn() && probe_.value.parallax.by_distance()) {
        context_.gpu.distances.update(state_.distances, *state_.target,
                                      has_layers() ? state_.farthest.get() : nullptr, state_.range,
                                      state_.revision, context_.stats);
    }
    if (drawn() && probe_.value.prefilter.value_or(false)) filter();
}

void ProbePicture::draw() {
    const TargetDescription description = describe();
    std::optional<Budget> budget;
    if (state_.target == nullptr || state_.target->description() != description) {
        state_.target = nullptr;  // frees the old memory first
        state_.target = std::make_unique<Target>(context_.gpu.context, description);
    } else if (!first_.forced_ && probe_.value.faces_per_frame < 6) {
        // The first time all six faces are drawn: an undrawn face would have undefined contents.
        budget = Budget{static_cast<std::size_t>(probe_.value.faces_per_frame), state_.next_face};
    }
    std::size_t drawn = 0;
    try {
        drawn = draw_changed(*state_.target, {}, budget);
        if (has_layers()) drawn = std::max(drawn, draw_farthest(budget));
    } catch (...) {
        state_.target = nullptr;
        state_.farthest = nullptr;
        context_.gpu.contents = next_revision();
        throw;
    }
    up_to_date_ = true;
    // A face that is left for a later call was drawn from elsewhere.
    if (state_.position != probe_.position) context_.gpu.contents = next_revision();
    state_.position = probe_.position;
    state_.range = {probe_.value.near, probe_.value.far};
    levels_.last = {false, context_.scenes.origin};
    state_.encoding =
        scene_encoding(context_.scenes, number_, [this](const NodeSnapshot& n) { return sees(n); });
    if (drawn == 0) return;
    if (budget) state_.next_face = (budget->first + drawn) % 6;
    if (description.mipmaps) {
        context_.gpu.context.gl().GenerateTextureMipmap(state_.target->color().id());
    }
    state_.revision = context_.gpu.contents = next_revision();
    if (!first_.updated_) ++context_.stats.probes_updated;
    first_.updated_ = true;
}

std::size_t ProbePicture::draw_farthest(std::optional<Budget> budget) {
    const TargetDescription description = describe_farthest();
    if (state_.farthest == nullptr || state_.farthest->description() != description) {
        state_.farthest = nullptr;  // frees the old memory first
        state_.farthest = std::make_unique<Target>(context_.gpu.context, description);
        budget.reset();
    }
    return draw_changed(*state_.farthest, {}, budget);
}

std::string ProbePicture::label(std::size_t /*place*/) const {
    const auto user =
        std::find_if(scene_.nodes.begin(), scene_.nodes.end(),
                     [this](const NodeSnapshot& node) { return uses_probe(node, id_.object); });
    return "the probe of node " + std::to_string(user == scene_.nodes.end() ? 0 : user->id);
}

}  // namespace cubecam
