#include "cubecam/render/graph/session.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/gl/objects.hpp"

#include <map>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

/// As describe_target, saying which texture is meant if it has a name.
TargetDescription describe_texture(const gl::Context& context, const RenderTextureValue& value) {
    try {
        TargetDescription description =
            describe_target(context, {.shape = TargetShape::flat(),
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

void set_view_filters(const GladGLContext& gl, GLuint view, bool mipmaps) {
    gl.TextureParameteri(view, GL_TEXTURE_MIN_FILTER,
                         mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    gl.TextureParameteri(view, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void set_view_wrap(const GladGLContext& gl, GLuint view, Wrap wrap) {
    const GLint mode = wrap == Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    gl.TextureParameteri(view, GL_TEXTURE_WRAP_S, mode);
    gl.TextureParameteri(view, GL_TEXTURE_WRAP_T, mode);
}

}  // namespace

Session::Session(RendererState& its_gpu, const SceneSnapshot& scene)
    : gpu(its_gpu), asked_for(scene), numbers(scene), textures_(scene.textures.size()) {
    std::map<const Probe*, std::size_t> users;  // scenes so far; never walked
    std::map<const Light*, std::size_t> lit;    // the same
    for (std::size_t i = 0; i <= scene.others.size(); ++i) {
        const SceneSnapshot& one = scene.scene(i);
        std::vector<std::size_t> ranks;
        for (const ProbeSnapshot& probe : one.probes) ranks.push_back(users[probe.object.get()]++);
        std::vector<std::size_t> light_ranks;
        for (const LightSnapshot& light : one.lights) {
            light_ranks.push_back(lit[light.object.get()]++);
        }
        calls_.emplace_back(*this, one, i, std::move(ranks), std::move(light_ranks));
    }
}

void Session::update(const std::vector<std::size_t>& pictures) {
    std::vector<std::vector<std::size_t>> needs(numbers.count());
    std::vector<bool> found(numbers.count(), false);
    std::vector<std::size_t> open = pictures;
    while (!open.empty()) {
        const std::size_t picture = open.back();
        open.pop_back();
        if (found[picture]) continue;
        found[picture] = true;
        needs[picture] = find_work(picture);
        open.insert(open.end(), needs[picture].begin(), needs[picture].end());
    }
    order_ = order_pictures(needs, pictures);
    for (const std::size_t picture : order_.order) {
        const PictureNumbers::Place place = numbers.place(picture);
        if (place.scene) {
            calls_[*place.scene].draw_probe(place.index);
        } else {
            draw_texture(place.index);
        }
    }
}

std::vector<std::size_t> Session::find_work(std::size_t picture) {
    const PictureNumbers::Place place = numbers.place(picture);
    return place.scene ? calls_[*place.scene].find_work(place.index)
                       : find_texture_work(place.index);
}

std::vector<std::size_t> Session::find_texture_work(std::size_t index) {
    const RenderTextureSnapshot& texture = asked_for.textures[index];
    const RenderTextureValue& value = texture.value;
    const TargetDescription description = describe_texture(gpu.context, value);
    TextureWork& work = textures_[index].emplace();
    work.state = &gpu.textures.get(texture.object, [] { return TextureState{}; });
    work.view = camera_view(matrices(texture.camera, static_cast<double>(value.width) /
                                                         static_cast<double>(value.height)));
    work.plan = make_plan(
        asked_for.scene(texture.scene), {&work.view, 1}, description.width, description.height,
        [&](const NodeSnapshot& node) { return is_seen(texture, node); },
        depth_mode(value.depth_format));
    std::vector<std::size_t> needs = calls_[texture.scene].needs_of(work.plan);
    numbers.add_needs(texture.effects, needs);
    return unique(std::move(needs));
}

void Session::draw_texture(std::size_t index) {
    const RenderTextureSnapshot& texture = asked_for.textures[index];
    TextureWork& work = *textures_[index];
    TextureState& state = *work.state;
    const GladGLContext& gl = gpu.context.gl();
    const TargetDescription description = describe_texture(gpu.context, texture.value);
    try {
        if (state.target == nullptr || state.target->description() != description) {
            state = TextureState{};  // its memory first
            state.target = std::make_unique<Target>(gpu.context, description);
            state.view = gl::create_view_2d(
                gl, state.target->picture(),
                description.mipmaps ? gl::mip_levels(description.width, description.height) : 1);
            set_view_filters(gl, state.view.id(), description.mipmaps);
            set_view_wrap(gl, state.view.id(), state.wrap);
        }
        if (state.wrap != texture.value.wrap) {
            state.wrap = texture.value.wrap;
            set_view_wrap(gl, state.view.id(), state.wrap);
            state.revision = next_revision();
        }
        const std::size_t drawn =
            calls_[texture.scene].draw_planned({&work.view, 1}, work.plan, *state.target,
                                               {texture.effects, Tonemap::none, Encode::none});
        if (drawn == 0) return;
        if (description.mipmaps) gl.GenerateTextureMipmap(state.target->picture().id());
    } catch (...) {
        state = TextureState{};
        throw;
    }
    state.revision = next_revision();
    ++stats.textures_updated;
}

BoundTexture Session::look_up(const MapSnapshot& map) {
    if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&map)) {
        return {gpu.cache.image(*image).texture.id(), (*image)->revision()};
    }
    const auto* texture = std::get_if<std::size_t>(&map);
    if (texture == nullptr || !textures_[*texture]) return {};
    const TextureState& state = *textures_[*texture]->state;
    return {state.view.id(), state.revision};
}

}  // namespace cubecam
