"""What tests/mutation.py breaks: one sign, swap or forgotten step at a time, and which tests must notice."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutation:
    """`old` stands exactly once in `file`, its spaces being any white space."""

    name: str
    file: str
    old: str
    new: str
    tests: tuple


CONVENTIONS = ("tests/unit/test_cubemap_conventions.py",)
SAMPLE = ("tests/unit/test_cubemap_sample.py",)
EQUIRECT = ("tests/unit/test_cubemap_equirect.py",)
ORIENTATION = ("tests/gl/test_orientation.py",)
CAPTURE = ("tests/gl/test_capture.py",)
FRAMES = ("tests/gl/test_frames.py",)
LOOKUPS = ("tests/gl/test_lookups.py",)
PHONG = ("tests/gl/test_phong.py",)
SKYBOX = ("tests/gl/test_skybox.py",)
ALPHA = ("tests/gl/test_alpha.py",)
SIDES = ("tests/gl/test_sides.py",)
STATS = ("tests/gl/test_stats.py",)
PROBES = ("tests/gl/test_probes.py",)
FORMATS = ("tests/gl/test_formats.py",)
STENCIL = ("tests/gl/test_stencil.py",)
STEREO = ("tests/gl/test_stereo.py",)
INCREMENTAL = ("tests/gl/test_incremental.py",)
RENDER_TEXTURES = ("tests/gl/test_render_textures.py",)
SHADOWS = ("tests/gl/test_shadows.py",)
DEPTH_ORDER = ("tests/gl/test_depth_order.py",)
NAMED_OUTPUTS = ("tests/gl/test_named_outputs.py",)
RESULT_MEMORY = ("tests/gl/test_result_memory.py",)
SHADOW_MAPS = ("tests/gl/test_shadow_maps.py",)

CUBE_FACE = "cpp/cubecam/math/cube_face.hpp"
GRAPH = "cpp/cubecam/render/graph/"
DRAWN = GRAPH + "drawn_picture.cpp"
QUERIES = "cpp/cubecam/scene/snapshot_queries.cpp"
SURFACE = "cpp/cubecam/render/passes/surface_pass.cpp"
RASTER = "cpp/cubecam/render/passes/raster_state.cpp"

MUTATIONS = [
    # The convention, in its one place and in those that derive from it.
    Mutation(
        "face axes: +Y turned",
        CUBE_FACE,
        "{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}",
        "{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}",
        CAPTURE,
    ),
    Mutation(
        "face axes: +-Z swapped",
        CUBE_FACE,
        "{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},\n    {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},",
        "{{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},\n    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},",
        ORIENTATION,
    ),
    Mutation(
        "lookup: s of -Z not mirrored",
        CUBE_FACE,
        "sc = direction.z >= 0 ? direction.x : -direction.x;",
        "sc = direction.x;",
        SAMPLE,
    ),
    Mutation(
        "edge: neighbour walked backwards",
        "cpp/cubecam/math/cube_edges.hpp",
        "const int moving = edge.reversed ? size - 1 - along : along;",
        "const int moving = along;",
        SAMPLE,
    ),
    Mutation(
        "corner: average of four",
        "cpp/cubecam/cubemap/cube_texels.hpp",
        "3.0f;",
        "4.0f;",
        SAMPLE,
    ),
    Mutation(
        "convention: inside flips +-Y left-right",
        "cpp/cubecam/cubemap/cubemap_layout.cpp",
        "return {face, !vertical, vertical};",
        "return {face, true, false};",
        CONVENTIONS,
    ),
    Mutation(
        "convention: three does not swap",
        "cpp/cubecam/cubemap/cubemap_layout.cpp",
        "face == Face::pos_x ? Face::neg_x : face == Face::neg_x ? Face::pos_x",
        "face == Face::pos_x ? Face::pos_x : face == Face::neg_x ? Face::neg_x",
        CONVENTIONS,
    ),
    Mutation(
        "layout: last face of the vertical cross not turned",
        "cpp/cubecam/cubemap/cubemap_layout.cpp",
        "Cell{back, 1, 3, true}",
        "Cell{back, 1, 3, false}",
        CONVENTIONS,
    ),
    Mutation(
        "equirect: mirrored",
        "cpp/cubecam/math/equirect.hpp",
        "return {-forward.z, 0, forward.x};",
        "return {forward.z, 0, -forward.x};",
        EQUIRECT,
    ),
    # The renderer.
    Mutation(
        "skybox: mirrored",
        "shaders/passes/skybox.frag",
        "environment(normalize(direction))",
        "environment(normalize(direction * vec3(-1.0, 1.0, 1.0)))",
        ORIENTATION,
    ),
    Mutation(
        "skybox: moves with the camera",
        "cpp/cubecam/render/resources/view.cpp",
        "turned[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);",
        "turned[3] *= 1.0;",
        SKYBOX,
    ),
    Mutation(
        "mirror: the normal's sign",
        "shaders/materials/mirror.glsl",
        "environment(reflect(surface.incident, surface.normal))",
        "environment(surface.incident - 2.0 * surface.normal)",
        LOOKUPS,
    ),
    Mutation(
        "mirror: looks along the incident direction",
        "shaders/passes/surface.frag",
        "normalize(v_position - v_eye.xyz)",
        "normalize(v_eye.xyz - v_position)",
        LOOKUPS,
    ),
    Mutation(
        "glass: eta upside down",
        "shaders/materials/glass.glsl",
        "refract(surface.incident, surface.normal, eta)",
        "refract(surface.incident, surface.normal, 1.0 / eta)",
        LOOKUPS,
    ),
    Mutation(
        "glass: parallel and perpendicular confused",
        "shaders/materials/glass.glsl",
        "f = 0.5 * (r_s * r_s + r_p * r_p);",
        "f = r_s * r_s;",
        LOOKUPS,
    ),
    Mutation(
        "phong: highlight on the dark side",
        "shaders/materials/phong.glsl",
        "if (n_dot_l <= 0.0) return vec3(0.0);",
        "",
        PHONG,
    ),
    Mutation(
        "phong: ambient for each light",
        "shaders/materials/phong.glsl",
        "result += light_answer(surface,",
        "result += result + light_answer(surface,",
        PHONG,
    ),
    Mutation(
        "phong: highlight towards the light",
        "shaders/materials/phong.glsl",
        "2.0 * n_dot_l * dot(surface.normal, surface.incident)",
        "0.0 * n_dot_l",
        PHONG,
    ),
    Mutation(
        "normals by the model matrix",
        "shaders/passes/surface.vert",
        "v_normal = mat3(u_normal_matrix) * a_normal;",
        "v_normal = mat3(u_model) * a_normal;",
        CAPTURE + LOOKUPS,
    ),
    Mutation(
        "distance is z",
        "shaders/passes/surface.frag",
        "o_distance = v_eye.w == 0.0 ? length(from_view) : z - v_view_position.w;",
        "o_distance = z;",
        CAPTURE,
    ),
    Mutation(
        "frames upside down",
        "cpp/cubecam/image/flip.hpp",
        "to + (rows - 1 - row) * row_bytes",
        "to + row * row_bytes",
        FRAMES,
    ),
    Mutation(
        "culling of mirrored nodes",
        RASTER,
        "(glm::determinant(glm::dmat3(node.world)) < 0.0) != mirror",
        "mirror",
        SIDES,
    ),
    Mutation(
        "blending: alpha like colour",
        RASTER,
        "GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA",
        "GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA",
        ALPHA,
    ),
    Mutation(
        "translucent: near to far",
        "cpp/cubecam/render/passes/draw_plan.cpp",
        "key.distance = -key.distance;",
        "",
        ALPHA,
    ),
    Mutation(
        "translucent: higher order first",
        "cpp/cubecam/render/passes/draw_plan.cpp",
        "SortKey key{node.render_order, 0,",
        "SortKey key{-node.render_order, 0,",
        ("tests/gl/test_render_order.py",),
    ),
    Mutation(
        "stencil: less the other way round",
        "cpp/cubecam/render/passes/stencil_state.cpp",
        "case StencilFunc::less: return GL_LESS;",
        "case StencilFunc::less: return GL_GREATER;",
        STENCIL,
    ),
    Mutation(
        "stencil: not cleared with the rest",
        "cpp/cubecam/render/passes/clear.cpp",
        "gl.StencilMask(0xFF);",
        "",
        STENCIL,
    ),
    Mutation(
        "depth: reversed as it is stored",
        "cpp/cubecam/render/resources/repack.hpp",
        "values[i] = values[i] == clear ? 1.0F : 1.0F - values[i];",
        "values[i] = values[i];",
        FORMATS,
    ),
    Mutation(
        "stereo: red from the right eye",
        "cpp/cubecam/render/stereo.cpp",
        "to[i] = left[i];",
        "to[i] = right[i];",
        STEREO,
    ),
    Mutation(
        "stereo: sheared away from each other",
        "cpp/cubecam/scene/stereo_camera.cpp",
        "eye.lens.shift.x -= x / height;",
        "eye.lens.shift.x += x / height;",
        STEREO,
    ),
    Mutation(
        "stereo: positions of both eyes count from the left one",
        SURFACE,
        "const glm::dvec3 origin = input.views[input.regions.front().view].position;",
        "const glm::dvec3 origin = input.views.front().position;",
        STEREO,
    ),
    Mutation(
        "seams: not seamless",
        SURFACE,
        "gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);",
        "gl_->Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);",
        LOOKUPS,
    ),
    Mutation(
        "culling: too eager",
        "cpp/cubecam/math/frustum.hpp",
        "plane.offset + glm::dot(plane.reach, half);",
        "plane.offset + 0.0 * glm::dot(plane.reach, half);",
        STATS + CAPTURE,
    ),
    Mutation(
        "materials: every texture in the first unit",
        "cpp/cubecam/render/passes/programs.cpp",
        "std::to_string(first_material_unit + i)",
        "std::to_string(first_material_unit)",
        LOOKUPS,
    ),
    Mutation(
        "materials: the alpha of maps forgotten",
        "cpp/cubecam/scene/snapshot.cpp",
        "return texture.alpha_counts && map",
        "return false && texture.alpha_counts && map",
        ALPHA,
    ),
    Mutation(
        "glass: the inverse of ior forgotten",
        "cpp/cubecam/materials/glass.hpp",
        "glm::vec4(glm::vec3(tint), 1.0F / ior)",
        "glm::vec4(glm::vec3(tint), ior)",
        LOOKUPS,
    ),
    Mutation(
        "phong: the model's own ambient light forgotten",
        "cpp/cubecam/materials/phong.hpp",
        "(1.0F + ambient)",
        "ambient",
        PHONG,
    ),
    Mutation(
        "blend: the alpha's factor is the colour's",
        RASTER,
        "gl_factor(factors.src_alpha)",
        "gl_factor(factors.src)",
        ("tests/gl/test_blending.py",),
    ),
    Mutation(
        "blend: the equation of the node before stays",
        RASTER,
        "gl.BlendEquation(free ? gl_equation(factors.equation) : GL_FUNC_ADD);",
        "if (free) gl.BlendEquation(gl_equation(factors.equation));",
        ("tests/gl/test_blending.py",),
    ),
    # What a picture depends on.
    Mutation(
        "key: lights forgotten", DRAWN, "add_light(common, light.value);", "(void)light;", STATS
    ),
    Mutation(
        "key: the node's matrix forgotten",
        "cpp/cubecam/render/resources/picture_key.cpp",
        "a.material != b.material || a.world != b.world",
        "a.material != b.material",
        STATS,
    ),
    Mutation(
        "damage: where a node was is left as it is",
        "cpp/cubecam/render/resources/picture_key.cpp",
        "found.add(a.bounds);",
        "",
        ("tests/gl/test_damage.py",),
    ),
    Mutation(
        "damage: bounds mirrored",
        "cpp/cubecam/render/passes/screen_bounds.cpp",
        "const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;",
        "const glm::dvec2 ndc = glm::dvec2(-clip.x, clip.y) / clip.w;",
        ("tests/gl/test_damage.py",),
    ),
    Mutation(
        "key: the eye forgotten",
        DRAWN,
        "key.add(view.eye);",
        "",
        STATS,
    ),
    Mutation(
        "key: what a mirror shows forgotten",
        DRAWN,
        "picture.textures.push_back(found.environment.revision);",
        "",
        PROBES,
    ),
    Mutation(
        "probe: sees its own user",
        QUERIES,
        "return node.in_captures && !uses_probe(node, probe) &&",
        "return node.in_captures &&",
        PROBES,
    ),
    Mutation(
        "probe: a cycle shows old contents",
        GRAPH + "texture_lookup.cpp",
        "if (!back && held.texture != 0) return held;",
        "(void)back; if (held.texture != 0) return held;",
        PROBES + INCREMENTAL,
    ),
    Mutation(
        "key: what a map shows forgotten",
        DRAWN,
        "picture.textures.push_back(texture.revision);",
        "",
        RENDER_TEXTURES,
    ),
    Mutation(
        "texture: what it shows is not drawn first",
        GRAPH + "scene_picture.cpp",
        "add_dependencies(scene_, number_, node, shown);",
        "",
        RENDER_TEXTURES,
    ),
    Mutation(
        "texture: sees what it leaves out",
        QUERIES,
        "return !is_excluded(node, texture.excluded);",
        "return true;",
        RENDER_TEXTURES,
    ),
    Mutation(
        "texture: circles by way of others overlooked",
        GRAPH + "picture_order.cpp",
        "return sizes[components[picture]] > 1 ||",
        "return",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    Mutation(
        "texture: a circle that something leads to is freed",
        "cpp/cubecam/scene/cycle_collector.cpp",
        "if (entry.object.use_count() > entry.inside + 1) visit(object);",
        "if (entry.object.use_count() > entry.inside + 2) visit(object);",
        ("tests/unit/test_render_textures.py",),
    ),
    # Python.
    Mutation(
        "png: colour multiplied by alpha",
        "python/cubecam/io/oiio.py",
        'config.attribute("oiio:UnassociatedAlpha", 1)',
        'config.attribute("oiio:UnassociatedAlpha", 0)',
        ("tests/unit/test_images.py",),
    ),
    Mutation(
        "srgb: wrong power",
        "python/cubecam/io/pixels.py",
        "** np.float32(2.4)",
        "** np.float32(2.2)",
        ("tests/unit/test_images.py",),
    ),
    Mutation(
        "six files in another order",
        "python/cubecam/io/cubemap_names.py",
        '("px", "nx", "py", "ny", "pz", "nz"),',
        '("nx", "px", "py", "ny", "pz", "nz"),',
        ("tests/unit/test_cli.py", "tests/unit/test_cubemap_files.py"),
    ),
    Mutation(
        "openexr cube copied, not resampled",
        "python/cubecam/io/cubemap_save.py",
        'picture = source.to_layout("openexr", dtype=resampled)',
        'picture = source.to_layout("column", convention="inside")',
        ("tests/unit/test_cubemap_files.py",),
    ),
    Mutation(
        "mesh not centred",
        "python/cubecam/io/meshes.py",
        "positions = (positions - (low + high) / 2) * (size / extent)",
        "positions = positions * (size / extent)",
        ("tests/unit/test_meshes.py",),
    ),
    Mutation(
        "orbit: the scene turns against the drag",
        "python/cubecam/navigation.py",
        "-math.radians(turn)",
        "math.radians(turn)",
        ("tests/unit/test_navigation.py",),
    ),
    Mutation(
        "pitch: over the pole",
        "python/cubecam/navigation.py",
        "limit = max(90.0 - POLE_MARGIN, abs(elevation))",
        "limit = 180.0",
        ("tests/unit/test_navigation.py",),
    ),
    # The documents' programs.
    Mutation(
        "P1: turned the other way",
        "python/cubecam/examples/textured_cube.py",
        "cc.axis_angle((1, 0, 0), angle_y)",
        "cc.axis_angle((-1, 0, 0), angle_y)",
        ("tests/programs/test_p01_textured_cube.py",),
    ),
    Mutation(
        "P2: a drag turns about the camera's axes",
        "python/cubecam/examples/inside_the_box.py",
        "math.sin(x), -math.sin(y) * math.cos(x), math.cos(y) * math.cos(x)",
        "math.sin(x) * math.cos(y), -math.sin(y), math.cos(y) * math.cos(x)",
        ("tests/programs/test_p02_inside_the_box.py",),
    ),
    Mutation(
        "P4: eta upside down",
        "python/cubecam/examples/reflection_and_refraction.py",
        "ior=1 / eta, fresnel=False",
        "ior=eta, fresnel=False",
        ("tests/programs/test_p04_reflection_and_refraction.py",),
    ),
    Mutation(
        "P5: a photograph too early",
        "python/cubecam/examples/arriving_faces.py",
        "if number < count",
        "if number <= count",
        ("tests/programs/test_p05_arriving_faces.py",),
    ),
    Mutation(
        "P6: the direction stays in model space",
        "python/cubecam/examples/model_space_reflection.py",
        "return matModelToWorld * reflect(eyeDir, normal);",
        "return reflect(eyeDir, normal);",
        ("tests/programs/test_p06_model_space_reflection.py",),
    ),
    Mutation(
        "P6: the eye in camera space",
        "python/cubecam/examples/model_space_reflection.py",
        "np.linalg.inv(camera.view @ node.world_matrix)",
        "np.linalg.inv(node.world_matrix @ camera.view)",
        ("tests/programs/test_p06_model_space_reflection.py",),
    ),
    Mutation(
        "P7: opacity is transparency",
        "python/cubecam/examples/translucent_objects.py",
        "opacity=opacity",
        "opacity=1 - opacity",
        ("tests/programs/test_p07_translucent_objects.py",),
    ),
    Mutation(
        "P13: cube off by a hundredth",
        "python/cubecam/examples/cubemap_on_a_cube.py",
        "(0.0, 0.8, 0.0), 0.8",
        "(0.0, 0.8, 0.0), 0.79",
        ("tests/programs/test_p13_cubemap_on_a_cube.py",),
    ),
    Mutation(
        "P14: actors circle backwards",
        "python/cubecam/examples/dynamic_reflection.py",
        "TURN * frame +",
        "-TURN * frame +",
        ("tests/programs/test_p14_dynamic_reflection.py",),
    ),
    Mutation(
        "P15: the walker never rests",
        "python/cubecam/examples/nothing_redrawn.py",
        "TURN * steps(frame)",
        "TURN * frame",
        ("tests/programs/test_p15_nothing_redrawn.py",),
    ),
    Mutation(
        "P16: not the middle ball's probe",
        "python/cubecam/examples/shared_cubemap.py",
        "program.probes[1] if",
        "program.probes[0] if",
        ("tests/programs/test_p16_shared_cubemap.py",),
    ),
    Mutation(
        "P17: glass and mirror change places",
        "python/cubecam/examples/dynamic_refraction.py",
        "zip((-APART, APART)",
        "zip((APART, -APART)",
        ("tests/programs/test_p17_dynamic_refraction.py",),
    ),
    # Shadows.
    Mutation(
        "shadow: +Y of a point light's cube turned",
        "shaders/include/shadows.glsl",
        "axis == 1 ? vec3(v.x, s * v.z, s * v.y)",
        "axis == 1 ? vec3(v.x, -s * v.z, s * v.y)",
        SHADOWS,
    ),
    Mutation(
        "shadow: slope of the receiving plane forgotten",
        "shaders/include/shadows.glsl",
        "vec4 there = dot(corner - start - half_width, slope) + to_corners;",
        "vec4 there = vec4(0.0);",
        SHADOWS,
    ),
    Mutation(
        "shadow: no rounded surface along the terminator",
        "shaders/include/shadows.glsl",
        "place += facet_height * plane;",
        "place += 0.0 * facet_height * plane;",
        SHADOWS,
    ),
    Mutation(
        "shadow: texels of a gather in another order",
        "shaders/include/shadows.glsl",
        "y.y * dot(reached.xy, x) + y.x * dot(reached.wz, x)",
        "y.x * dot(reached.xy, x) + y.y * dot(reached.wz, x)",
        SHADOWS,
    ),
    Mutation(
        "key: shadow maps forgotten",
        "cpp/cubecam/render/resources/picture_key.cpp",
        "if (a.receives_shadows && !same_shadows) return false;",
        "",
        SHADOW_MAPS,
    ),
    Mutation(
        "shadow: a caster's matrix is not in the map's key",
        GRAPH + "shadow_picture.cpp",
        "key.add(node.world);",
        "",
        SHADOW_MAPS,
    ),
    Mutation(
        "shadow: single-sided casters",
        "cpp/cubecam/render/passes/shadow_pass.cpp",
        "gl_->Disable(GL_CULL_FACE);",
        "gl_->Enable(GL_CULL_FACE);",
        SHADOW_MAPS,
    ),
    Mutation(
        "spot: the penumbra's share turned round",
        SURFACE,
        "spot.angle * (1.0 - spot.penumbra)",
        "spot.angle * spot.penumbra",
        ("tests/gl/test_spot_light.py",),
    ),
    Mutation(
        "P3: an event late",
        "python/cubecam/examples/skybox.py",
        "program.script[: max(frame, 0)]",
        "program.script[: max(frame - 1, 0)]",
        ("tests/programs/test_p03_skybox.py",),
    ),
    Mutation(
        "P8: the eyes change places",
        "python/cubecam/examples/anaglyph.py",
        "return Program(scene, camera, stereo, ring)",
        "return Program(scene, camera, cc.StereoCamera(stereo.right, stereo.left), ring)",
        ("tests/programs/test_p08_anaglyph.py",),
    ),
    Mutation(
        "P9: a pass too far to the right",
        "python/cubecam/examples/additive_blur.py",
        "(-1, 1), (0, 1), (1, 1))",
        "(-1, 1), (0, 1), (2, 1))",
        ("tests/programs/test_p09_additive_blur.py",),
    ),
    Mutation(
        "P9: an eighth for a ninth",
        "python/cubecam/examples/additive_blur.py",
        "WEIGHT = 1 / 9",
        "WEIGHT = 1 / 8",
        ("tests/programs/test_p09_additive_blur.py",),
    ),
    Mutation(
        "P10: the discs go round backwards",
        "python/cubecam/examples/render_to_texture.py",
        "angle = rounds * 2 * math.pi",
        "angle = -rounds * 2 * math.pi",
        ("tests/programs/test_p10_render_to_texture.py",),
    ),
    Mutation(
        "P11: no shadow",
        "python/cubecam/examples/framebuffer_parts.py",
        "shadow=cc.Shadow(size=SHADOW)",
        "shadow=cc.Shadow(size=SHADOW, far=1)",
        ("tests/programs/test_p11_framebuffer_parts.py",),
    ),
    Mutation(
        "P11: 24 bits of depth for 16",
        "python/cubecam/examples/framebuffer_parts.py",
        'depth_format="depth_component16"',
        'depth_format="depth_component24"',
        ("tests/programs/test_p11_framebuffer_parts.py",),
    ),
    Mutation(
        "P12: the cubes circle backwards",
        "python/cubecam/examples/cube_camera.py",
        "(1 if index % 2 == 0 else -1)",
        "(-1 if index % 2 == 0 else 1)",
        ("tests/programs/test_p12_cube_camera.py",),
    ),
    # Blending, users' shaders, effects.
    Mutation(
        "blend: multiply forgets its alpha",
        "shaders/passes/surface.frag",
        "o_color.rgb = mix(vec3(1.0), o_color.rgb, o_color.a);",
        "",
        ("tests/gl/test_blending.py",),
    ),
    Mutation(
        "blend: alpha_keep writes alpha",
        "cpp/cubecam/render/passes/raster_state.cpp",
        "gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);",
        "gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);",
        ("tests/gl/test_blending.py",),
    ),
    Mutation(
        "uniforms: matrices by columns",
        "cpp/cubecam/render/passes/user_program.cpp",
        "gl.ProgramUniformMatrix3fv(id, at, n, GL_TRUE, v)",
        "gl.ProgramUniformMatrix3fv(id, at, n, GL_FALSE, v)",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "uniforms: the last material's value stays",
        "cpp/cubecam/render/passes/user_program.cpp",
        "set(uniform, uniform.initial);",
        "",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "effects: in reverse order",
        "cpp/cubecam/render/passes/post_process_pass.cpp",
        "const EffectValue& effect = post_process.effects[i].value;",
        "const EffectValue& effect = post_process.effects[post_process.effects.size() - 1 - i].value;",
        ("tests/gl/test_effects.py",),
    ),
    Mutation(
        "key: effects forgotten",
        DRAWN,
        "common.add(effect.revision);",
        "",
        ("tests/gl/test_effects.py",),
    ),
    Mutation(
        "circles: shadows forgotten",
        GRAPH + "dependencies.cpp",
        "found.insert(found.end(), shadows_.begin(), shadows_.end());",
        "",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    Mutation(
        "colours: names not decoded",
        "cpp/bindings/colors.cpp",
        "color[i] = srgb_to_linear(bytes[static_cast<std::size_t>(i)] / 255.0);",
        "color[i] = bytes[static_cast<std::size_t>(i)] / 255.0;",
        ("tests/unit/test_colors.py",),
    ),
    Mutation(
        "colours: alpha decoded as well",
        "cpp/bindings/colors.cpp",
        "color[3] = bytes[3] / 255.0;",
        "color[3] = srgb_to_linear(bytes[3] / 255.0);",
        ("tests/unit/test_colors.py",),
    ),
    Mutation(
        "dtypes: the first piece again",
        "cpp/cubecam/cubemap/cubemap_resample.cpp",
        "pixels_to_floats(from, pixels.data() + i * dtype_size(from), length, line);",
        "pixels_to_floats(from, pixels.data() + begin * dtype_size(from), length, line);",
        ("tests/unit/test_cubemap_dtypes.py",),
    ),
    Mutation(
        "resampling: dtype of a panorama not kept",
        "cpp/bindings/bind_cubemap.cpp",
        "const DType to = to_dtype(dtype, image.dtype());",
        "const DType to = to_dtype(dtype, DType::float32);",
        ("tests/unit/test_cubemap_dtypes.py",),
    ),
    Mutation(
        "pickles: any format taken",
        "cpp/bindings/bind_pickling.cpp",
        "if (number != pickle_format)",
        "if (number < 0)",
        ("tests/unit/test_pickles.py",),
    ),
    Mutation(
        "errors: the old name is not known",
        "python/cubecam/_arguments.py",
        "answer = renamed(function, name)",
        "answer = None",
        ("tests/unit/test_old_names.py",),
    ),
    Mutation(
        "errors: arguments that are missing go unnoticed",
        "python/cubecam/_arguments.py",
        "if p.required and p.name not in have]",
        "if False]",
        ("tests/unit/test_signatures.py",),
    ),
    Mutation(
        "shadow: depends on all textures",
        QUERIES,
        "if (mentions(traits.user_code->vertex->text, traits.textures[place].name)) {",
        "{",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    Mutation(
        "farthest: cleared as for the nearest",
        "cpp/cubecam/render/resources/depth_order.hpp",
        "DepthState{GL_LESS, GL_LEQUAL, 1.0F}",
        "DepthState{GL_LESS, GL_LEQUAL, 0.0F}",
        DEPTH_ORDER,
    ),
    Mutation(
        "farthest: the sky over everything",
        "shaders/passes/skybox.vert",
        "vec4(corner, u_depth, 1.0)",
        "vec4(corner, 0.0, 1.0)",
        DEPTH_ORDER,
    ),
    Mutation(
        "farthest: depth of the background",
        "cpp/cubecam/render/resources/repack.hpp",
        "values[i] == clear ? 1.0F : 1.0F - values[i]",
        "1.0F - values[i]",
        DEPTH_ORDER,
    ),
    Mutation(
        "users' outputs: left as the node before wrote them",
        "cpp/cubecam/render/passes/output_declarations.cpp",
        "set_zero(name, output.channels);",
        "",
        NAMED_OUTPUTS,
    ),
    Mutation(
        "users' outputs: all at one place",
        "cpp/cubecam/render/resources/outputs.cpp",
        "{output.name, shaded.size() + 1, output.channels, OutputType::float32, 0.0F}",
        "{output.name, 1, output.channels, OutputType::float32, 0.0F}",
        NAMED_OUTPUTS,
    ),
    Mutation(
        "results: memory is kept for ever",
        "cpp/cubecam/render/resources/result_pool.cpp",
        "held_.back().call + patience < call_",
        "held_.back().call + 1000 * patience < call_",
        RESULT_MEMORY,
    ),
    Mutation(
        "results: without a bound",
        "cpp/cubecam/render/resources/result_pool.cpp",
        "while (bytes_ > capacity_) {",
        "while (false) {",
        RESULT_MEMORY,
    ),
    Mutation(
        "rgb565: rounded down",
        "cpp/cubecam/render/resources/repack.hpp",
        "((p & 31) * 527 + 23) >> 6",
        "((p & 31) * 527) >> 6",
        FORMATS,
    ),
    Mutation(
        "stats: what just fits is told as too large",
        "cpp/cubecam/render/resources/target_store.hpp",
        "target->description().bytes() > capacity_;",
        "target->description().bytes() >= capacity_;",
        STATS,
    ),
    # Meshes set anew.
    Mutation(
        "snapshot: an updated mesh goes unseen",
        "cpp/cubecam/scene/snapshot.cpp",
        "seen_.push_back({&mesh->revision(), data->revision()});",
        "",
        ("tests/gl/test_dynamic_meshes.py",),
    ),
    Mutation(
        "gpu: a stream set anew is not uploaded",
        "cpp/cubecam/render/resources/gpu_cache.cpp",
        "if (to.writable && to.bytes == bytes) {",
        "if (to.bytes == bytes) {",
        ("tests/gl/test_dynamic_meshes.py",),
    ),
    Mutation(
        "gpu: a stream that went stays",
        "cpp/cubecam/render/resources/gpu_cache.cpp",
        "gl.DisableVertexArrayAttrib(array, place.attribute);",
        "",
        ("tests/gl/test_dynamic_meshes.py",),
    ),
    Mutation(
        "gpu: 16 bits for one vertex too many",
        "cpp/cubecam/render/resources/gpu_cache.cpp",
        "if (data.positions()->size() > std::size_t{1} << 16) {",
        "if (data.positions()->size() > (std::size_t{1} << 16) + 1) {",
        ("tests/gl/test_dynamic_meshes.py",),
    ),
    Mutation(
        "mesh: smooth normals stay behind",
        "cpp/cubecam/geometry/mesh_data.cpp",
        "} else if (moved && smooth_) {",
        "} else if (moved && !smooth_) {",
        ("tests/unit/test_meshes.py",),
    ),
]
