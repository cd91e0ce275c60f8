#include "cubecam/render/passes/surface_pass.hpp"

#include "cubecam/math/transform.hpp"
#include "cubecam/render/passes/clear.hpp"
#include "cubecam/render/passes/draw_block.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/passes/raster_state.hpp"
#include "cubecam/render/resources/instance.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

constexpr GLuint lights_binding = 1;
constexpr GLuint shadows_binding = 2;
constexpr GLuint cube_unit = 1;
constexpr std::size_t flat_lights = 4;          // beyond that the vertex stage has no room for them
constexpr std::size_t many_triangles = 10'000;  // of a call
constexpr std::size_t dense_triangles = 4'000;  // of a mesh

/// Whether a view shows the world mirrored: GL's own projections have a negative determinant.
bool mirrored(const View& view) { return glm::determinant(view.view_projection) > 0.0; }

/// As shaders/include/lights.glsl has them, std140.
struct LightBlock {
    glm::vec4 position;
    glm::vec4 color;
    glm::vec4 cone{0.0F, 0.0F, 0.0F, 1.0F};
};

struct LightsBlock {
    glm::ivec4 counts{0};
    glm::vec4 ambient{1.0F};
    LightBlock lights[max_lights];
};

/// How a spot light fades towards its edge, so that the shader has dot(cone.xyz, travel) + cone.w
/// from 0 at the edge to 1 where the penumbra ends.
glm::vec4 cone_of(const SpotParameters& spot) {
    const double edge = std::cos(radians(spot.angle));
    const double full = std::cos(radians(spot.angle * (1.0 - spot.penumbra)));
    const double steepness = 1.0 / std::max(full - edge, 1e-6);  // without a penumbra: a step
    return {spot.direction * steepness, -edge * steepness};
}

}  // namespace

SurfacePass::SurfacePass(const gl::Context& context, GpuCache& cache, Layering layering)
    : context_(&context), gl_(&context.gl()), cache_(&cache),
      programs_(context.gl(), layering != Layering::never), layering_(layering),
      black_(gl::create_texture_cube(*gl_, GL_RGBA8, 1)) {
    const std::uint8_t black[6 * 4] = {};
    gl_->TextureSubImage3D(black_.id(), 0, 0, 0, 0, 1, 1, 6, GL_RGBA, GL_UNSIGNED_BYTE, black);
    gl_->TextureParameteri(black_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);

    gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl_->Disable(GL_DITHER);
    gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void SurfacePass::upload_lights(std::span<const LightSnapshot> lights, const glm::dvec3& origin) {
    LightsBlock block;
    ambient_ = glm::vec3(1.0F);
    light_count_ = 0;
    light_decay_ = false;
    light_cone_ = false;
    shadow_count_ = 0;
    const auto add = [&](const LightValue& light) {
        const glm::vec3 color = light.color * light.intensity;
        if (std::holds_alternative<AmbientParameters>(light.parameters)) {
            ambient_ += color;
            return;
        }
        if (light_count_ == max_lights) {
            throw std::invalid_argument("lights: expected at most " + std::to_string(max_lights) +
                                        " lights beside ambient ones");
        }
        LightBlock& to = block.lights[light_count_++];
        if (const auto* point = std::get_if<PointParameters>(&light.parameters)) {
            to.position = glm::vec4(point->position - origin, 1.0F);
            to.color = glm::vec4(color, point->decay);
            light_decay_ = light_decay_ || point->decay != 0.0;
        } else if (const auto* spot = std::get_if<SpotParameters>(&light.parameters)) {
            to.position = glm::vec4(spot->position - origin, 1.0F);
            to.color = glm::vec4(color, spot->decay);
            to.cone = cone_of(*spot);
            light_decay_ = light_decay_ || spot->decay != 0.0;
            light_cone_ = true;
        } else {
            to.position =
                glm::vec4(-std::get<DirectionalParameters>(light.parameters).direction, 0.0F);
            to.color = glm::vec4(color, 0.0F);
        }
    };
    // Those with a shadow first: so a shader knows which they are when it is compiled. The order
    // must not hang on whether anything drawn receives one: sums of floats depend on it.
    for (const LightSnapshot& light : lights) {
        if (light.value.shadow) add(light.value);
    }
    shadow_count_ = light_count_;
    for (const LightSnapshot& light : lights) {
        if (!light.value.shadow) add(light.value);
    }
    block.counts.x = static_cast<int>(light_count_);
    block.ambient = glm::vec4(ambient_, 1.0F);
    lights_ = gl::create_buffer(*gl_, sizeof(block), &block);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, lights_binding, lights_.id());
}

void SurfacePass::upload_shadows(std::span<const ShadowUse> shadows, const glm::dvec3& origin) {
    shadow_kinds_ = 0;
    if (shadows.empty()) return;
    std::vector<ShadowBlock> blocks;
    for (const ShadowUse& shadow : shadows) {
        shadow_kinds_ |= static_cast<std::uint32_t>(shadow.view.kind) << (2 * blocks.size());
        gl_->BindTextureUnit(shadow_unit + static_cast<GLuint>(blocks.size()), shadow.texture);
        blocks.push_back(make_shadow_block(shadow, origin));
    }
    blocks.resize(max_shadows);
    shadows_ = gl::create_buffer(*gl_, std::span<const ShadowBlock>(blocks));
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, shadows_binding, shadows_.id());
}

void SurfacePass::set_scissor(const Rect& rect) {
    gl_->Scissor(rect.x0, rect.y0, rect.width(), rect.height());
}

SurfacePass::Prepared SurfacePass::prepare(const PassInput& input) {
    Prepared prepared;
    // The shaders' positions count from where the views stand: far from the world's origin a
    // float would have no digits left for what is near.
    const glm::dvec3 origin = input.views[input.regions.front().view].position;
    std::vector<Instance> views;  // of each region
    for (const Region& region : input.regions) {
        const View& view = input.views[region.view];
        const glm::dmat4 from_origin = glm::translate(view.view_projection, origin);
        views.push_back(make_instance(view, reverse_depth(from_origin), origin, region.view));
    }

    const auto alignment =
        static_cast<std::size_t>(context_->limits().uniform_buffer_offset_alignment);
    std::vector<Instance> instances;
    std::vector<std::byte> blocks;
    std::vector<glm::vec4> constants;
    const auto append = [&](const void* block, std::size_t size) {
        const std::size_t at = blocks.size();
        blocks.resize(at + (size + alignment - 1) / alignment * alignment);
        std::memcpy(blocks.data() + at, block, size);
        return static_cast<GLintptr>(at);
    };
    const auto add = [&](const std::vector<PlannedNode>& from, std::vector<Item>& to) {
        for (const PlannedNode& planned : from) {
            const NodeSnapshot& node = input.scene.nodes[planned.node];
            Item item{&node,
                      nullptr,
                      {},
                      static_cast<GLuint>(instances.size()),
                      0,
                      0,
                      &input.lookups[planned.node]};
            const auto visibilities = input.plan.visible_in(planned);
            auto visibility = visibilities.begin();
            for (std::size_t r = 0; r < input.regions.size(); ++r) {
                const Region& region = input.regions[r];
                while (visibility != visibilities.end() && visibility->view < region.view)
                    ++visibility;
                if (visibility == visibilities.end()) break;
                if (visibility->view != region.view || !visibility->bounds.overlaps(region.rect))
                    continue;
                item.regions.push_back(r);
                instances.push_back(views[r]);
            }
            if (item.regions.empty()) continue;
            item.mesh = &cache_->mesh(*node.mesh);
            const DrawBlock block = make_draw_block(node, origin);
            item.block = append(&block, sizeof(block));
            const MaterialModel& material = *node.material.value.model;
            constants.resize(material.traits().kind->constants);
            if (!constants.empty()) {
                material.write_constants(ambient_, constants);
                item.constants = append(constants.data(), constants.size() * sizeof(glm::vec4));
            }
            to.push_back(std::move(item));
        }
    };
    add(input.plan.opaque, prepared.opaque);
    add(input.plan.transparent, prepared.transparent);

    prepared.first_skybox = static_cast<GLuint>(instances.size());
    if (std::holds_alternative<GLuint>(input.background)) {
        for (const Region& region : input.regions) {
            const View& view = input.views[region.view];
            instances.push_back(make_instance(view, view.far_to_world, origin, region.view));
        }
    }
    // New buffers instead of rewriting the old: the GPU may still read those.
    instances_ = gl::create_buffer(*gl_, instances.size() * sizeof(Instance), instances.data());
    blocks_ = gl::create_buffer(*gl_, blocks.size(), blocks.data());
    return prepared;
}

void SurfacePass::draw(const PassInput& input, Target& target, Stats& stats) {
    const TargetDescription& description = target.description();
    const Rect whole{0, 0, description.width, description.height};
    const glm::dvec3& origin = input.views[input.regions.front().view].position;
    upload_lights(input.scene.lights, origin);
    upload_shadows(input.shadows, origin);
    outputs_ = description.outputs.without_buffered();
    output_count_ = outputs_.by_slot().size();
    depth_ = depth_state(description.depth_order);
    const Prepared prepared = prepare(input);
    gl_->Viewport(0, 0, description.width, description.height);
    // Never off: how pixels come out may not hang on the rectangle, but may on the test itself
    // (GL 4.6 appendix A.3, rule 2).
    gl_->Enable(GL_SCISSOR_TEST);
    const bool shaded = description.outputs.shaded();
    draw_layers(input, prepared, target, target.color_pass(), description.color,
                shaded && !target.multisampled(), stats);
    if (description.outputs.any() && target.multisampled()) {
        draw_layers(input, prepared, target, target.output_pass(), false, shaded, stats);
    }
    set_scissor(whole);  // resolving and grading obey it, too
    gl::check_gl(*gl_, "drawing a scene");
}

void SurfacePass::draw_layers(const PassInput& input, const Prepared& prepared, Target& target,
                              Layers& layers, bool color, bool outputs, Stats& stats) {
    const auto* plain = std::get_if<glm::vec4>(&input.background);
    const ClearValues values{plain != nullptr ? *plain : glm::vec4(0.0F), color, outputs};
    const bool by_texture =
        target.description().shape.has_faces() && !(color && target.multisampled());
    // Transparent nodes write no shaded outputs, but may write what is read of the buffers.
    const bool transparent = color || target.description().outputs.buffered();
    if (by_texture) {
        for (const Region& region : input.regions) {
            clear_layer(*gl_, target, static_cast<int>(region.view), region.rect, values);
        }
    }
    const auto bind = [&](const Region& region) {
        gl_->BindFramebuffer(GL_FRAMEBUFFER, layers.one(static_cast<int>(region.view)));
        set_scissor(region.rect);
        if (!by_texture) clear_bound(*gl_, target, values);
    };

    const Rect whole{0, 0, target.description().width, target.description().height};
    if (!use_layers(input, prepared, whole)) {
        for (std::size_t r = 0; r < input.regions.size(); ++r) {
            bind(input.regions[r]);
            draw_all(input, prepared, r, color, outputs, transparent, stats);
        }
        return;
    }
    const bool all = input.regions.size() == input.views.size();
    if (!all && !by_texture) {
        for (const Region& region : input.regions) bind(region);
    }
    gl_->BindFramebuffer(GL_FRAMEBUFFER, layers.all());
    set_scissor(whole);
    if (all && !by_texture) clear_bound(*gl_, target, values);
    draw_all(input, prepared, std::nullopt, color, outputs, transparent, stats);
}

bool SurfacePass::use_layers(const PassInput& input, const Prepared& prepared,
                             const Rect& whole) const {
    if (layering_ == Layering::never || input.regions.size() == 1) return false;
    // One scissor serves all layers, and one winding: other pictures are drawn one by one. (A
    // viewport for each region would do, but llvmpipe then transforms vertices by slower code that
    // rounds otherwise.)
    const bool one_scissor =
        std::all_of(input.regions.begin(), input.regions.end(),
                    [&whole](const Region& region) { return region.rect == whole; });
    const bool one_winding =
        std::all_of(input.regions.begin(), input.regions.end(), [&](const Region& region) {
            return mirrored(input.views[region.view]) ==
                   mirrored(input.views[input.regions.front().view]);
        });
    if (!one_winding || !one_scissor) return false;
    if (layering_ == Layering::always) return true;
    if (!context_->software()) return true;
    // llvmpipe sets all layers' triangles up before it fills the first pixel, on one thread. Layer
    // by layer, it fills one while it sets the next up: from some ten thousand triangles on that
    // wins (docs/adr/0002).
    std::size_t triangles = 0;
    for (const Item& item : prepared.opaque) {
        triangles += static_cast<std::size_t>(item.mesh->index_count / 3) * item.regions.size();
    }
    return triangles < many_triangles;
}

void SurfacePass::draw_all(const PassInput& input, const Prepared& prepared,
                           std::optional<std::size_t> region, bool color, bool outputs,
                           bool transparent, Stats& stats) {
    reset_raster_state(*gl_, depth_);
    const bool mirror = mirrored(input.views[input.regions[region.value_or(0)].view]);
    const bool painted = input.plan.depth_mode == DepthMode::by_order;
    if (color && painted) draw_background(input, prepared, region, stats);
    draw_items(prepared.opaque, region, mirror, outputs, stats);
    reset_raster_state(*gl_, depth_);
    if (painted || !transparent) return;

    write_outputs(false);
    if (color) draw_background(input, prepared, region, stats);
    draw_items(prepared.transparent, region, mirror, false, stats);
    reset_raster_state(*gl_, depth_);
}

void SurfacePass::write_outputs(bool write) {
    const GLboolean mask = write ? GL_TRUE : GL_FALSE;
    for (std::size_t slot = 1; slot <= output_count_; ++slot) {
        gl_->ColorMaski(static_cast<GLuint>(slot), mask, mask, mask, mask);
    }
}

void SurfacePass::draw_background(const PassInput& input, const Prepared& prepared,
                                  std::optional<std::size_t> region, Stats& stats) {
    const auto* cube = std::get_if<GLuint>(&input.background);
    if (cube == nullptr) return;  // cleared to
    draw_skybox(*cube, prepared.first_skybox + static_cast<GLuint>(region.value_or(0)),
                region ? 1 : input.regions.size(), stats);
}

SurfaceVariant SurfacePass::variant_of(const NodeSnapshot& node, bool outputs) const {
    const MaterialValue& material = node.material.value;
    SurfaceVariant variant;
    const MaterialTraits& traits = material.traits();
    variant.kind = traits.kind;
    variant.switches = traits.switches;
    variant.vertex_colors =
        traits.vertex_colors != VertexColors::ignored && node.mesh->colors() != nullptr;
    variant.double_sided = material.surface.double_sided;
    if (outputs) variant.outputs = outputs_;
    variant.blend = node.blend == Blend::alpha_keep ? Blend::alpha : node.blend;
    variant.dense = node.mesh->triangles()->size() >= dense_triangles;
    if (traits.user_code) {
        variant.moved = traits.moves_vertices();
        variant.lights = -1;
        variant.dense = true;
    } else {
        for (std::size_t i = 0; i < node.textures.size(); ++i) {
            if (!is_none(node.textures[i])) variant.textures |= 1U << i;
        }
        if (traits.uses_lights) {
            variant.lights = light_count_ <= flat_lights ? static_cast<int>(light_count_) : -1;
            variant.decay = light_decay_;
            variant.cone = light_cone_;
        }
    }
    if (receive_shadow(node)) {
        variant.shadows = static_cast<int>(shadow_count_);
        variant.shadow_kinds = shadow_kinds_;
    }
    return variant;
}

const gl::Program& SurfacePass::user_program(const SurfaceVariant& variant,
                                             const MaterialTraits& material,
                                             const NodeTextures& lookups) {
    UserProgram& program = programs_.user_surface(variant, material);
    program.use(*material.user_code->inputs,
                std::span(lookups.textures).subspan(material.user_code->first_texture));
    return program.program();
}

/// Those that the shader looks up. A user's program binds its own.
void SurfacePass::bind_textures(const Item& item, const SurfaceVariant& variant) {
    for (std::size_t i = 0; i < item.lookups->textures.size(); ++i) {
        if ((variant.textures >> i & 1U) == 0) continue;
        const GLuint texture = item.lookups->textures[i].texture;
        const bool cube = std::holds_alternative<CubeSourceSnapshot>(item.node->textures[i]);
        gl_->BindTextureUnit(first_material_unit + static_cast<GLuint>(i),
                             cube && texture == 0 ? black_.id() : texture);
    }
    const GLuint environment = item.lookups->environment.texture;
    gl_->BindTextureUnit(cube_unit, environment != 0 ? environment : black_.id());
}

void SurfacePass::draw_items(std::span<const Item> items, std::optional<std::size_t> region,
                             bool mirror, bool outputs, Stats& stats) {
    const gl::Program* bound = nullptr;
    for (const Item& item : items) {
        GLuint first = item.first_instance;
        auto count = static_cast<GLsizei>(item.regions.size());
        if (region) {
            const auto place = std::lower_bound(item.regions.begin(), item.regions.end(), *region);
            if (place == item.regions.end() || *place != *region) continue;
            first += static_cast<GLuint>(place - item.regions.begin());
            count = 1;
        }
        const MaterialTraits& material = item.node->material.value.traits();
        const SurfaceVariant variant = variant_of(*item.node, outputs);
        const gl::Program& program = material.user_code
                                         ? user_program(variant, material, *item.lookups)
                                         : programs_.surface(variant, material);
        if (bound != &program) program.use();
        bound = &program;

        set_raster_state(*gl_, *item.node, mirror, depth_);
        // Of what leaves no depth nothing says that it is the nearest.
        if (outputs) write_outputs(item.node->depth_write);
        gl_->BindBufferRange(GL_UNIFORM_BUFFER, draw_binding, blocks_.id(), item.block,
                             sizeof(DrawBlock));
        if (const std::size_t constants = material.kind->constants; constants > 0) {
            gl_->BindBufferRange(GL_UNIFORM_BUFFER, material_binding, blocks_.id(), item.constants,
                                 static_cast<GLsizeiptr>(constants * sizeof(glm::vec4)));
        }
        bind_textures(item, variant);
        gl_->VertexArrayVertexBuffer(item.mesh->array.id(), vertex_buffer::views, instances_.id(),
                                     0, sizeof(Instance));
        gl_->BindVertexArray(item.mesh->array.id());
        gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, item.mesh->index_count,
                                               item.mesh->index_type, nullptr, count, first);
        ++stats.draw_calls;
        stats.triangles += std::int64_t{item.mesh->index_count / 3} * count;
    }
}

void SurfacePass::draw_skybox(GLuint cube, GLuint first_instance, std::size_t count, Stats& stats) {
    gl_->DepthFunc(depth_.untouched);  // the quad lies where the buffer was cleared to
    gl_->DepthMask(GL_FALSE);
    gl_->Disable(GL_CULL_FACE);
    programs_.skybox().set("u_depth", depth_.clear);
    programs_.skybox().use();
    gl_->BindTextureUnit(cube_unit, cube);
    draw_full_screen(*gl_, *cache_,
                     {instances_.id(), first_instance, static_cast<std::int64_t>(count)}, stats);
}

}  // namespace cubecam
