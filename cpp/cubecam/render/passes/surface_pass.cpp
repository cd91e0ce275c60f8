#include "cubecam/render/passes/surface_pass.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/lighting/brdf_table.hpp"
#include "cubecam/render/passes/clear.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/passes/raster_state.hpp"
#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/render/resources/probe_grid_block.hpp"
#include "cubecam/render/resources/sampler.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace cubecam {
namespace {

constexpr GLuint lights_binding = 1;
constexpr GLuint shadows_binding = 2;
constexpr GLuint clip_binding = 6;
constexpr std::size_t unrolled_lights = 8;  // a loop of unknown length costs more for each light
constexpr std::size_t many_triangles = 10'000;  // of one call

double pixels(const Rect& rect) { return static_cast<double>(rect.area()); }

/// Whether a view shows the world mirrored: GL's own projections have a negative determinant.
bool mirrored(const View& view) { return glm::determinant(view.view_projection) > 0.0; }

}  // namespace

SurfacePass::SurfacePass(const gl::Context& context, GpuCache& cache, Layering layering)
    : context_(&context), gl_(&context.gl()), cache_(&cache),
      programs_(context.gl(), layering != Layering::never), layering_(layering), picker_(cache),
      black_(gl::create_texture_cube(*gl_, GL_RGBA8, 1)) {
    const std::uint8_t black[6 * 4] = {};
    gl_->TextureSubImage3D(black_.id(), 0, 0, 0, 0, 1, 1, 6, GL_RGBA, GL_UNSIGNED_BYTE, black);
    gl_->TextureParameteri(black_.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);

    gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl_->Disable(GL_DITHER);
    gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

void SurfacePass::upload_shadows(std::span<const ShadowUse> shadows, const glm::dvec3& origin) {
    shadow_kinds_ = 0;
    shadow_textures_.clear();
    if (shadows.empty()) return;
    std::vector<ShadowBlock> blocks;
    for (const ShadowUse& shadow : shadows) {
        shadow_kinds_ |= static_cast<std::uint32_t>(shadow.view.kind) << (2 * blocks.size());
        gl_->BindTextureUnit(texture_unit::first_shadow + static_cast<GLuint>(blocks.size()),
                             shadow.texture);
        shadow_textures_.push_back({shadow.texture, shadow.revision});
        blocks.push_back(make_shadow_block(shadow, origin));
    }
    blocks.resize(max_shadows);
    shadows_ = gl::create_buffer(*gl_, std::span<const ShadowBlock>(blocks));
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, shadows_binding, shadows_.id());
}

/// All views of a call have the same plane, since they have the same position.
void SurfacePass::upload_clip_plane(const SurfaceInput& input) {
    const std::optional<Plane>& clip = input.views[input.regions.front().view].clip;
    clipped_ = clip.has_value();
    if (!clipped_) return;
    const glm::vec4 plane(clip->normal, clip->height(input.origin()));
    clip_ = gl::create_buffer(*gl_, sizeof(plane), &plane);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, clip_binding, clip_.id());
}

void SurfacePass::upload_probe_grid(const SurfaceInput& input) {
    grid_ = input.scene.probe_grid.get();
    if (grid_ == nullptr) return;
    grid_textures_ = &cache_->probe_grid(*grid_);
    const ProbeGridBlock block = make_probe_grid_block(grid_->value, input.origin());
    grid_block_ = gl::create_buffer(*gl_, sizeof(block), &block);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, probe_grid_binding, grid_block_.id());
    gl_->BindTextureUnit(texture_unit::grid_light, grid_textures_->light.id());
    gl_->BindTextureUnit(texture_unit::grid_distances, grid_textures_->distances.id());
}

void SurfacePass::set_scissor(const Rect& rect) {
    gl_->Scissor(rect.x0, rect.y0, rect.width(), rect.height());
}

void SurfacePass::draw(const SurfaceInput& input, Target& target, Stats& stats) {
    const TargetDescription& description = target.description();
    const Rect whole{0, 0, description.width, description.height};
    lights_ = make_shader_lights(input.scene.lights, input.origin());
    lights_block_ = gl::create_buffer(*gl_, sizeof(lights_.block), &lights_.block);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, lights_binding, lights_block_.id());
    upload_shadows(input.shadows, input.origin());
    upload_clip_plane(input);
    upload_probe_grid(input);
    outputs_ = description.outputs.without_buffered();
    output_count_ = outputs_.by_slot().size();
    depth_ = depth_state(description.depth_order);
    behind_ = description.shape.has_faces() ? BehindLookup::cube : BehindLookup::flat;

    const SurfaceItems items = find_items(input, *cache_);
    picker_.start();
    SurfaceCallBuilder builder(
        input, items, {description.width, description.height}, lights_.ambient,
        static_cast<std::size_t>(context_->limits().uniform_buffer_offset_alignment), picker_);
    std::vector<SurfaceCalls> calls;  // one for each region, or one for all
    if (use_layers(input, items, whole)) {
        calls.push_back(builder.layered());
    } else {
        for (std::size_t r = 0; r < input.regions.size(); ++r)
            calls.push_back(builder.of_region(r));
    }
    // New buffers replace the old ones, which the GPU may still read.
    view_records_ = gl::create_buffer(*gl_, std::span(builder.view_records()));
    node_records_ = gl::create_buffer(*gl_, std::span(builder.node_records()));
    blocks_ = gl::create_buffer(*gl_, std::span(builder.blocks()));
    if (!picker_.bytes().empty()) indices_ = gl::create_buffer(*gl_, std::span(picker_.bytes()));

    gl_->Viewport(0, 0, description.width, description.height);
    // The test is never disabled: the values of pixels may not depend on the rectangle, but they
    // may depend on whether the test is enabled (GL 4.6 appendix A.3, rule 2).
    gl_->Enable(GL_SCISSOR_TEST);
    const bool shaded = description.outputs.shaded();
    draw_layers(input, calls, target, target.color_pass(), description.color,
                shaded && !target.multisampled(), stats);
    if (description.outputs.any() && target.multisampled()) {
        draw_layers(input, calls, target, target.output_pass(), false, shaded, stats);
    }
    set_scissor(whole);  // resolving and full-screen passes also use the scissor
    gl::check_gl(*gl_, "drawing a scene");
}

void SurfacePass::draw_layers(const SurfaceInput& input, std::span<const SurfaceCalls> calls,
                              Target& target, Layers& layers, bool color, bool outputs,
                              Stats& stats) {
    const TargetDescription& description = target.description();
    const auto* plain = std::get_if<glm::vec4>(&input.background);
    const ClearValues values{plain != nullptr ? *plain : glm::vec4(0.0F), color, outputs};
    const bool by_texture = description.shape.has_faces() && !(color && target.multisampled());
    if (by_texture && !input.shared_target) {
        for (const Region& region : input.regions) {
            poll_interrupts();
            clear_layer(*gl_, target, static_cast<int>(input.layer(region)), region.rect, values);
        }
    }
    const bool cleared = by_texture || input.shared_target;
    // llvmpipe keeps the triangles of a framebuffer until it is left: those of one layer stay in
    // the caches, those of a batch do not (docs/adr/0035).
    const bool routed = input.shared_target && layering_ != Layering::never &&
                        (layering_ == Layering::always || !context_->software());
    const auto bind = [&](const Region& region) {
        gl_->BindFramebuffer(GL_FRAMEBUFFER,
                             routed ? layers.all()
                                    : layers.one(static_cast<int>(input.layer(region))));
        set_scissor(region.rect);
        if (!cleared) clear_bound(*gl_, target, values);
    };
    // Transparent nodes write no shaded outputs, but they may change the depth and stencil buffers,
    // which other outputs read.
    Writes writes{color, outputs, color || description.outputs.buffered(), false};
    const auto look_through = [&](const Region& region) {
        writes.mirror = mirrored(input.views[region.view]);
    };

    const double cost = description.samples;
    const bool layered = calls.size() < input.regions.size();
    pass_.clear();
    pass_.add_target(description, color, outputs, layered || routed);
    pass_.add(clipped_);
    if (!layered) {
        for (std::size_t r = 0; r < input.regions.size(); ++r) {
            bind(input.regions[r]);
            look_through(input.regions[r]);
            draw_all(input, calls[r], writes, stats);
            context_->pace().submitted(*gl_, pixels(input.regions[r].rect) * cost);
        }
        return;
    }
    const bool all = input.regions.size() == static_cast<std::size_t>(description.layers());
    if (!all && !cleared) {
        for (const Region& region : input.regions) bind(region);
    }
    gl_->BindFramebuffer(GL_FRAMEBUFFER, layers.all());
    set_scissor({0, 0, description.width, description.height});
    if (all && !cleared) clear_bound(*gl_, target, values);
    look_through(input.regions.front());
    draw_all(input, calls.front(), writes, stats);
    for (const Region& region : input.regions) {
        context_->pace().submitted(*gl_, pixels(region.rect) * cost);
    }
}

bool SurfacePass::use_layers(const SurfaceInput& input, const SurfaceItems& items,
                             const Rect& whole) const {
    if (layering_ == Layering::never || input.regions.size() == 1) return false;
    // All layers share one scissor and one winding; if the regions need different ones, they are
    // drawn one by one. (Each region could have a viewport of its own, but llvmpipe then transforms
    // vertices by slower code with other rounding.)
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
    // A call that fills all layers of a large picture could not be interrupted.
    if (pixels(whole) * static_cast<double>(input.regions.size()) > gl::Pace::chunk) return false;
    // With layered drawing every node needs a call of its own.
    if (items.opaque.size() > count_calls(items, input.regions.size())) return false;
    if (!context_->software()) return true;
    // llvmpipe sets up the triangles of all layers on one thread before it fills the first pixel.
    // Layer by layer, it fills one layer while it sets up the next, which is faster from about ten
    // thousand triangles on (docs/adr/0002).
    std::size_t triangles = 0;
    for (const SurfaceItem& item : items.opaque) {
        triangles += static_cast<std::size_t>(item.mesh->index_count / 3) * item.region_count;
    }
    return triangles < many_triangles;
}

void SurfacePass::draw_all(const SurfaceInput& input, const SurfaceCalls& calls,
                           const Writes& writes, Stats& stats) {
    reset_raster_state(*gl_, depth_);
    if (calls.view_block) {
        gl_->BindBufferRange(GL_UNIFORM_BUFFER, view_binding, blocks_.id(), *calls.view_block,
                             sizeof(ViewBlock));
    }
    const bool painted = input.plan.depth_mode == DepthMode::by_order;
    if (writes.color && painted) draw_background(input, calls, stats);
    draw_calls(calls.opaque, writes.mirror, writes.outputs, stats);
    reset_raster_state(*gl_, depth_);
    if (painted || !writes.transparent) return;

    write_outputs(false);
    if (writes.color) draw_background(input, calls, stats);
    draw_calls(calls.transparent, writes.mirror, false, stats);
    reset_raster_state(*gl_, depth_);
}

void SurfacePass::write_outputs(bool write) {
    const GLboolean mask = write ? GL_TRUE : GL_FALSE;
    for (std::size_t slot = 1; slot <= output_count_; ++slot) {
        gl_->ColorMaski(static_cast<GLuint>(slot), mask, mask, mask, mask);
    }
}

void SurfacePass::draw_background(const SurfaceInput& input, const SurfaceCalls& calls,
                                  Stats& stats) {
    const auto* sky = std::get_if<Environment>(&input.background);
    if (sky == nullptr) return;        // clearing has drawn it
    gl_->DepthFunc(depth_.untouched);  // the quad lies at the depth of the clear
    gl_->DepthMask(GL_FALSE);
    gl_->Disable(GL_CULL_FACE);
    const gl::Program& program = programs_.skybox(calls.sky_environment.has_value());
    program.set("u_depth", depth_.clear);
    program.use();
    if (calls.sky_environment) {
        gl_->BindBufferRange(GL_UNIFORM_BUFFER, environment_binding, blocks_.id(),
                             *calls.sky_environment, sizeof(EnvironmentBlock));
    }
    gl_->BindTextureUnit(texture_unit::cube, sky->cube.texture);
    draw_full_screen(*gl_, *cache_,
                     {view_records_.id(), calls.first_sky, std::int64_t{calls.sky_count}}, stats);
}

SurfaceVariant SurfacePass::variant_of(const SurfaceItem& item, bool instanced,
                                       bool outputs) const {
    const NodeSnapshot& node = *item.node;
    const MaterialValue& material = node.material.value;
    const MaterialTraits& traits = material.traits();
    SurfaceVariant variant;
    variant.kind = traits.kind;
    variant.instanced = instanced;
    variant.switches = traits.switches;
    variant.vertex_colors =
        traits.vertex_colors != VertexColors::ignored && node.mesh->colors() != nullptr;
    variant.double_sided = material.surface.double_sided;
    variant.tangents = traits.uses_tangents && node.mesh->tangents() != nullptr;
    if (outputs) variant.outputs = outputs_;
    // The shader treats these modes like "alpha".
    const bool as_alpha = node.blend == Blend::alpha_keep || node.blend == Blend::factors;
    variant.blend = as_alpha ? Blend::alpha : node.blend;
    variant.dense = is_dense(node);
    if (traits.user_code) {
        variant.moved = traits.moves_vertices();
        variant.lights = -1;
        variant.dense = true;
        variant.uvs1 = traits.user_code->uses_uvs1 && node.mesh->uvs1() != nullptr;
    } else {
        for (std::size_t i = 0; i < node.textures.size(); ++i) {
            if (is_none(node.textures[i])) continue;
            const std::uint64_t bit = std::uint64_t{1} << i;
            variant.textures |= bit;
            if (uv_set_of(traits.textures[i]) == 1) variant.second_uvs |= bit;
            variant.uvs1 = variant.second_uvs != 0;
        }
        if (traits.uses_lights) {
            variant.lights =
                lights_.count <= unrolled_lights ? static_cast<int>(lights_.count) : -1;
            variant.decay = lights_.decay;
            variant.cone = lights_.cone;
            variant.range = lights_.range;
        }
    }
    variant.environment = EnvironmentVariant::of(item.textures->environment, traits);
    if (const EnvironmentBlend* blend = item.textures->environment.blend.get()) {
        for (const Environment& other : blend->others) {
            variant.others.push_back(EnvironmentVariant::of(other, traits));
            variant.others.back().block = true;
        }
        variant.has_rest = blend->has_rest;
    }
    if (traits.shows_behind) variant.behind = behind_;
    variant.body = traits.shows_far_side;
    if (item.textures->environment.planar.picture.texture != 0) variant.planar = behind_;
    variant.clipped = clipped_;
    variant.screen = item.textures->screen.depths != 0;
    variant.grid = grid_ != nullptr && sees_probe_grid(node);
    variant.grid_visibility = variant.grid && grid_->value.visibility;
    if (receive_shadow(node)) {
        variant.shadows = static_cast<int>(lights_.shadow_count);
        variant.shadow_kinds = shadow_kinds_;
    }
    return variant;
}

template <class Visit>
void SurfacePass::each_texture(const Environment& environment, const SurfaceVariant& variant,
                               const Visit& visit) const {
    const auto or_black = [this](GLuint cube) { return cube != 0 ? cube : black_.id(); };
    const auto visit_one = [&](const Environment& one, const EnvironmentUnits& units) {
        visit(units.cube, or_black(one.cube.texture), one.cube.revision);
        if (one.filtered != nullptr) visit(units.filtered, one.filtered->id(), 0);
        if (one.parts.mipmaps) {
            visit(units.box_mipmaps, or_black(one.box_mipmaps.texture), one.box_mipmaps.revision);
        }
        if (one.local.by_distance()) visit(units.distances, one.local.distances.texture, 0);
        if (one.local.has_layers()) visit(units.farthest, one.local.farthest.texture, 0);
    };
    visit_one(environment, {});
    if (environment.blend == nullptr) return;
    const std::vector<EnvironmentUnits> units = units_of(variant.others);
    for (std::size_t i = 0; i < units.size(); ++i) {
        visit_one(environment.blend->others[i], units[i]);
    }
}

void SurfacePass::find_conditions(const SurfaceItem& item, const SurfaceVariant& variant,
                                  bool outputs) {
    conditions_.clear();
    conditions_.key = pass_.key;
    conditions_.add(outputs);
    conditions_.add_node(*item.node);
    const MaterialTraits& material = item.node->material.value.traits();
    conditions_.add_textures(
        std::span(item.textures->textures).subspan(material.user_code->first_texture));
    const auto add = [this](GLuint unit, GLuint texture, std::uint64_t revision) {
        conditions_.textures.push_back({unit, texture, revision});
    };
    const Environment& environment = item.textures->environment;
    each_texture(environment, variant, add);
    add(texture_unit::behind, item.textures->behind.texture, item.textures->behind.revision);
    if (environment.planar.picture.texture != 0) {
        add(texture_unit::planar, environment.planar.picture.texture,
            environment.planar.picture.revision);
    }
    if (environment.parts.filtered || environment.filtered != nullptr) {
        add(texture_unit::brdf_table, brdf_table(), 0);
    }
    if (item.textures->screen.depths != 0) {
        add(texture_unit::screen, item.textures->screen.picture.texture,
            item.textures->screen.picture.revision);
        add(texture_unit::screen_depths, item.textures->screen.depths, 0);
    }
    if (variant.grid) {
        add(texture_unit::grid_light, grid_textures_->light.id(), grid_->revision);
        add(texture_unit::grid_distances, grid_textures_->distances.id(), grid_->revision);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(variant.shadows); ++i) {
        add(texture_unit::first_shadow + static_cast<GLuint>(i), shadow_textures_[i].texture,
            shadow_textures_[i].revision);
    }
}

const gl::Program& SurfacePass::program_of(const SurfaceItem& item, const SurfaceVariant& variant,
                                           bool outputs) {
    const MaterialTraits& material = item.node->material.value.traits();
    if (!material.user_code) return programs_.surface(variant, material);
    if (programs_.tries()) find_conditions(item, variant, outputs);
    // llvmpipe runs vertex shaders at once, although it may still be drawing what they look up.
    if (context_->software() && vertices_see_pictures(*item.node)) gl_->Finish();
    UserProgram& program = programs_.user_surface(variant, material, conditions_);
    program.use(*material.user_code->inputs,
                std::span(item.textures->textures).subspan(material.user_code->first_texture));
    return program.program();
}

/// Binds the textures that the shader looks up; a user's program binds its own.
void SurfacePass::bind_textures(const SurfaceItem& item, const SurfaceVariant& variant) {
    const std::vector<BoundTexture>& textures = item.textures->textures;
    GLuint unit = texture_unit::first_of_material;
    for (std::size_t i = 0; i < textures.size(); ++i) {
        if ((variant.textures >> i & 1U) == 0) continue;
        const GLuint texture = textures[i].texture;
        const bool cube = std::holds_alternative<CubeSourceSnapshot>(item.node->textures[i]);
        gl_->BindTextureUnit(unit++, cube && texture == 0 ? black_.id() : texture);
    }
    const MaterialTraits& traits = item.node->material.value.traits();
    if (traits.uses_environment || traits.environment_parts.filtered) {
        bind_environment(item.textures->environment, variant);
    }
    if (traits.shows_behind) {
        gl_->BindTextureUnit(texture_unit::behind, item.textures->behind.texture);
    }
    if (traits.shows_far_side) {
        gl_->BindTextureUnit(texture_unit::body_nearness, item.textures->body.nearness);
        gl_->BindTextureUnit(texture_unit::body_normals, item.textures->body.normals);
    }
    if (item.textures->screen.depths != 0) {
        gl_->BindTextureUnit(texture_unit::screen, item.textures->screen.picture.texture);
        gl_->BindTextureUnit(texture_unit::screen_depths, item.textures->screen.depths);
    }
}

void SurfacePass::bind_environment(const Environment& environment, const SurfaceVariant& variant) {
    each_texture(environment, variant, [this](GLuint unit, GLuint texture, std::uint64_t) {
        gl_->BindTextureUnit(unit, texture);
    });
    if (environment.parts.filtered || environment.filtered != nullptr) {
        gl_->BindTextureUnit(texture_unit::brdf_table, brdf_table());
    }
    if (environment.planar.picture.texture != 0) {
        gl_->BindTextureUnit(texture_unit::planar, environment.planar.picture.texture);
    }
}

GLuint SurfacePass::brdf_table() {
    if (!brdf_table_) {
        brdf_table_ = gl::create_texture_2d(*gl_, GL_RGBA32F, brdf_table_size, brdf_table_size);
        const GLuint id = brdf_table_.id();
        gl_->TextureSubImage2D(id, 0, 0, 0, brdf_table_size, brdf_table_size, GL_RGBA, GL_FLOAT,
                               cubecam::brdf_table().data());
        set_sampler(*gl_, id, clamped_linear);
    }
    return brdf_table_.id();
}

void SurfacePass::draw_calls(std::span<const SurfaceCall> calls, bool mirror, bool outputs,
                             Stats& stats) {
    const gl::Program* bound = nullptr;
    if (clipped_) gl_->Enable(GL_CLIP_DISTANCE0);
    for (const SurfaceCall& call : calls) {
        poll_interrupts();
        const NodeSnapshot& node = *call.item->node;
        const GpuMesh& mesh = *call.item->mesh;
        const IndexRange indices = call.indices.value_or(IndexRange{0, mesh.index_count});
        stats.triangles_skipped +=
            std::int64_t{(mesh.index_count - indices.count) / 3} * call.count;
        if (indices.count == 0) continue;
        const bool instanced = !call.node_block;
        const SurfaceVariant variant = variant_of(*call.item, instanced, outputs);
        const GLuint array = instanced ? mesh.instanced.id() : mesh.array.id();
        const GLuint records = instanced ? node_records_.id() : view_records_.id();
        const std::size_t record_bytes = instanced ? sizeof(NodeRecord) : sizeof(ViewRecord);
        // The machine code of a trial is that of an array that changes with each picture.
        bool& settled = instanced ? mesh.instanced_settled : mesh.array_settled;
        if (!settled && context_->software() && node.material.value.traits().user_code) {
            gl::settle_vertex_array(*gl_, array, vertex_buffer::records, records, record_bytes);
            settled = true;
        }
        gl_->VertexArrayVertexBuffer(array, vertex_buffer::records, records, 0,
                                     static_cast<GLsizei>(record_bytes));
        gl_->BindVertexArray(array);
        set_raster_state(*gl_, node, mirror, depth_);
        // A node that writes no depth need not be the nearest, so it writes no outputs.
        if (outputs) write_outputs(node.depth_write);
        const gl::Program& program = program_of(*call.item, variant, outputs);
        if (bound != &program) program.use();
        bound = &program;
        if (variant.body) {
            const BodyLookup& body = call.item->textures->body;
            program.set("u_body_middle", glm::vec4(body.middle, body.outside ? 1.0F : 0.0F));
            program.set("u_body_half", body.half);
        }

        if (call.node_block) {
            gl_->BindBufferRange(GL_UNIFORM_BUFFER, node_binding, blocks_.id(), *call.node_block,
                                 sizeof(NodeBlock));
        }
        if (call.constants) {
            const std::size_t constants = node.material.value.traits().constants;
            gl_->BindBufferRange(GL_UNIFORM_BUFFER, material_binding, blocks_.id(), *call.constants,
                                 static_cast<GLsizeiptr>(constants * sizeof(glm::vec4)));
        }
        if (call.environment) {
            gl_->BindBufferRange(GL_UNIFORM_BUFFER, environment_binding, blocks_.id(),
                                 *call.environment, sizeof(EnvironmentBlock));
        }
        for (std::size_t i = 0; i < call.blend.size(); ++i) {
            const bool first = i == 0;
            gl_->BindBufferRange(GL_UNIFORM_BUFFER,
                                 first ? influences_binding
                                       : further_environment_binding + static_cast<GLuint>(i) - 1,
                                 blocks_.id(), call.blend[i],
                                 first ? GLsizeiptr{sizeof(InfluencesBlock)}
                                       : GLsizeiptr{sizeof(EnvironmentBlock)});
        }
        bind_textures(*call.item, variant);
        const auto draw = [&] {
            gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, indices.count, mesh.index_type,
                                                   reinterpret_cast<const void*>(indices.offset),
                                                   call.count, call.first);
            ++stats.draw_calls;
        };
        if (call.indices) gl_->VertexArrayElementBuffer(array, indices_.id());
        if (node.backs_first()) {
            gl_->Enable(GL_CULL_FACE);
            gl_->CullFace(GL_FRONT);
            draw();
            gl_->CullFace(GL_BACK);
        }
        draw();
        if (call.indices) gl_->VertexArrayElementBuffer(array, mesh.indices.id());
        stats.triangles += std::int64_t{indices.count / 3} * call.count;
        stats.triangles_simplified +=
            (static_cast<std::int64_t>(node.mesh->triangles()->size()) -
             static_cast<std::int64_t>(call.item->data->triangles()->size())) *
            call.count;
    }
}

}  // namespace cubecam
