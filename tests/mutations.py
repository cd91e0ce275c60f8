"""What tests/mutation.py breaks: one sign, swap or forgotten step at a time, and which tests must notice."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mutation:
    """`old` stands exactly once in `file`, its spaces being any white space.

    `file` is a name, such as "cube_face.hpp", which one source has, wherever it lies; where several have it,
    as many folders are named before it as tell them apart: "examples/skybox.py".
    """

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
SHADOW_MAPS = ("tests/gl/test_shadow_maps.py",)

CUBE_FACE = "cube_face.hpp"
DRAWN = "drawn_picture.cpp"
QUERIES = "snapshot_queries.cpp"
SURFACE = "surface_pass.cpp"
RASTER = "raster_state.cpp"

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
        "cube_edges.hpp",
        "const int moving = edge.reversed ? size - 1 - along : along;",
        "const int moving = along;",
        SAMPLE,
    ),
    Mutation(
        "corner: average of four",
        "cube_texels.hpp",
        "3.0f;",
        "4.0f;",
        SAMPLE,
    ),
    Mutation(
        "convention: inside flips +-Y left-right",
        "cubemap_layout.cpp",
        "return {face, !vertical, vertical};",
        "return {face, true, false};",
        CONVENTIONS,
    ),
    Mutation(
        "convention: three does not swap",
        "cubemap_layout.cpp",
        "face == Face::pos_x ? Face::neg_x : face == Face::neg_x ? Face::pos_x",
        "face == Face::pos_x ? Face::pos_x : face == Face::neg_x ? Face::neg_x",
        CONVENTIONS,
    ),
    Mutation(
        "layout: last face of the vertical cross not turned",
        "cubemap_layout.cpp",
        "Cell{back, 1, 3, true}",
        "Cell{back, 1, 3, false}",
        CONVENTIONS,
    ),
    Mutation(
        "equirect: mirrored",
        "equirect.hpp",
        "return {-forward.z, 0, forward.x};",
        "return {forward.z, 0, -forward.x};",
        EQUIRECT,
    ),
    # The renderer.
    Mutation(
        "skybox: mirrored",
        "skybox.frag",
        "environment(normalize(direction))",
        "environment(normalize(direction * vec3(-1.0, 1.0, 1.0)))",
        ORIENTATION,
    ),
    Mutation(
        "skybox: moves with the camera",
        "view.cpp",
        "turned[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);",
        "turned[3] *= 1.0;",
        SKYBOX,
    ),
    Mutation(
        "mirror: the normal's sign",
        "mirror.glsl",
        "environment(reflect(surface.incident, surface.normal))",
        "environment(surface.incident - 2.0 * surface.normal)",
        LOOKUPS,
    ),
    Mutation(
        "mirror: looks along the incident direction",
        "surface.frag",
        "normalize(v_position - v_eye.xyz)",
        "normalize(v_eye.xyz - v_position)",
        LOOKUPS,
    ),
    Mutation(
        "glass: eta upside down",
        "glass.glsl",
        "refract(surface.incident, surface.normal, eta)",
        "refract(surface.incident, surface.normal, 1.0 / eta)",
        LOOKUPS,
    ),
    Mutation(
        "glass: parallel and perpendicular confused",
        "glass.glsl",
        "f = 0.5 * (r_s * r_s + r_p * r_p);",
        "f = r_s * r_s;",
        LOOKUPS,
    ),
    Mutation(
        "phong: highlight on the dark side",
        "phong.glsl",
        "if (n_dot_l <= 0.0) return vec3(0.0);",
        "",
        PHONG,
    ),
    Mutation(
        "phong: ambient for each light",
        "phong.glsl",
        "result += light_answer(surface,",
        "result += result + light_answer(surface,",
        PHONG,
    ),
    Mutation(
        "phong: highlight towards the light",
        "phong.glsl",
        "2.0 * n_dot_l * dot(surface.normal, surface.incident)",
        "0.0 * n_dot_l",
        PHONG,
    ),
    Mutation(
        "normals by the model matrix",
        "surface.vert",
        "v_normal = mat3(u_normal_matrix) * a_normal;",
        "v_normal = mat3(u_model) * a_normal;",
        CAPTURE + LOOKUPS,
    ),
    Mutation(
        "distance is z",
        "surface.frag",
        "o_distance = v_eye.w == 0.0 ? length(from_view) : z - v_view_position.w;",
        "o_distance = z;",
        CAPTURE,
    ),
    Mutation(
        "frames upside down",
        "flip.hpp",
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
        "draw_plan.cpp",
        "return a.distance > b.distance;",
        "return a.distance < b.distance;",
        ALPHA,
    ),
    Mutation(
        "translucent: higher order first",
        "draw_plan.cpp",
        "a.order < b.order : before(a, b)",
        "a.order > b.order : before(a, b)",
        ("tests/gl/test_render_order.py",),
    ),
    Mutation(
        "stencil: less the other way round",
        "stencil_state.cpp",
        "case StencilFunc::less: return GL_LESS;",
        "case StencilFunc::less: return GL_GREATER;",
        STENCIL,
    ),
    Mutation(
        "stencil: not cleared with the rest",
        "clear.cpp",
        "gl.StencilMask(0xFF);",
        "",
        STENCIL,
    ),
    Mutation(
        "depth: reversed as it is stored",
        "readback.cpp",
        "value = 1.0F - value;",
        "value = value;",
        FORMATS,
    ),
    Mutation(
        "stereo: red from the right eye",
        "stereo.cpp",
        "to[i] = left[i];",
        "to[i] = right[i];",
        STEREO,
    ),
    Mutation(
        "stereo: sheared away from each other",
        "stereo_camera.cpp",
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
        "frustum.hpp",
        "return corners == 8;",
        "return corners >= 6;",
        STATS + CAPTURE,
    ),
    # What a picture depends on.
    Mutation(
        "key: lights forgotten", DRAWN, "add_light(common, light.value);", "(void)light;", STATS
    ),
    Mutation(
        "key: the node's matrix forgotten",
        DRAWN,
        "key.add(node.world);",
        "",
        STATS,
    ),
    Mutation(
        "damage: where a node was is left as it is",
        "picture_key.cpp",
        "if (found != old.end()) add(found->second->bounds);",
        "",
        ("tests/gl/test_damage.py",),
    ),
    Mutation(
        "damage: bounds mirrored",
        "screen_bounds.cpp",
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
        "key.add(found.cube.revision);",
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
        "texture_lookup.cpp",
        "if (!back && held.texture != 0) return held;",
        "(void)back; if (held.texture != 0) return held;",
        PROBES + INCREMENTAL,
    ),
    Mutation(
        "key: what a map shows forgotten",
        DRAWN,
        "key.add(found.map.revision);",
        "",
        RENDER_TEXTURES,
    ),
    Mutation(
        "texture: what it shows is not drawn first",
        "scene_picture.cpp",
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
        "picture_order.cpp",
        "return sizes[components[picture]] > 1 ||",
        "return",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    Mutation(
        "texture: a circle that something leads to is freed",
        "cycle_collector.cpp",
        "if (entry.object.use_count() > entry.inside + 1) visit(object);",
        "if (entry.object.use_count() > entry.inside + 2) visit(object);",
        ("tests/unit/test_render_textures.py",),
    ),
    # Python.
    Mutation(
        "png: colour multiplied by alpha",
        "oiio.py",
        'config.attribute("oiio:UnassociatedAlpha", 1)',
        'config.attribute("oiio:UnassociatedAlpha", 0)',
        ("tests/unit/test_images.py",),
    ),
    Mutation(
        "srgb: wrong power",
        "pixels.py",
        "** np.float32(2.4)",
        "** np.float32(2.2)",
        ("tests/unit/test_images.py",),
    ),
    Mutation(
        "six files in another order",
        "cubemap_names.py",
        '("px", "nx", "py", "ny", "pz", "nz"),',
        '("nx", "px", "py", "ny", "pz", "nz"),',
        ("tests/unit/test_cli.py", "tests/unit/test_cubemap_files.py"),
    ),
    Mutation(
        "openexr cube copied, not resampled",
        "cubemap_save.py",
        'picture = source.to_layout("openexr", "inside")',
        'picture = source.to_layout("column", "inside")',
        ("tests/unit/test_cubemap_files.py",),
    ),
    Mutation(
        "mesh not centred",
        "meshes.py",
        "positions = (positions - (low + high) / 2) * (size / extent)",
        "positions = positions * (size / extent)",
        ("tests/unit/test_meshes.py",),
    ),
    Mutation(
        "orbit: the scene turns against the drag",
        "navigation.py",
        "-math.radians(turn)",
        "math.radians(turn)",
        ("tests/unit/test_navigation.py",),
    ),
    Mutation(
        "pitch: over the pole",
        "navigation.py",
        "limit = max(90.0 - POLE_MARGIN, abs(elevation))",
        "limit = 180.0",
        ("tests/unit/test_navigation.py",),
    ),
    # The documents' programs.
    Mutation(
        "P1: turned the other way",
        "textured_cube.py",
        "cc.axis_angle((1, 0, 0), angle_y)",
        "cc.axis_angle((-1, 0, 0), angle_y)",
        ("tests/programs/test_p01_textured_cube.py",),
    ),
    Mutation(
        "P2: a drag turns about the camera's axes",
        "inside_the_box.py",
        "math.sin(x), -math.sin(y) * math.cos(x), math.cos(y) * math.cos(x)",
        "math.sin(x) * math.cos(y), -math.sin(y), math.cos(y) * math.cos(x)",
        ("tests/programs/test_p02_inside_the_box.py",),
    ),
    Mutation(
        "P4: eta upside down",
        "reflection_and_refraction.py",
        "eta=eta, fresnel=False",
        "eta=1 / eta, fresnel=False",
        ("tests/programs/test_p04_reflection_and_refraction.py",),
    ),
    Mutation(
        "P5: a photograph too early",
        "arriving_faces.py",
        "if number < count",
        "if number <= count",
        ("tests/programs/test_p05_arriving_faces.py",),
    ),
    Mutation(
        "P6: the direction stays in model space",
        "model_space_reflection.py",
        "return matModelToWorld * reflect(eyeDir, normal);",
        "return reflect(eyeDir, normal);",
        ("tests/programs/test_p06_model_space_reflection.py",),
    ),
    Mutation(
        "P6: the eye in camera space",
        "model_space_reflection.py",
        "np.linalg.inv(camera.view @ node.world_matrix)",
        "np.linalg.inv(node.world_matrix @ camera.view)",
        ("tests/programs/test_p06_model_space_reflection.py",),
    ),
    Mutation(
        "P7: opacity is transparency",
        "translucent_objects.py",
        "opacity=opacity",
        "opacity=1 - opacity",
        ("tests/programs/test_p07_translucent_objects.py",),
    ),
    Mutation(
        "P13: cube off by a hundredth",
        "cubemap_on_a_cube.py",
        "(0.0, 0.8, 0.0), 0.8",
        "(0.0, 0.8, 0.0), 0.79",
        ("tests/programs/test_p13_cubemap_on_a_cube.py",),
    ),
    Mutation(
        "P14: actors circle backwards",
        "dynamic_reflection.py",
        "TURN * frame +",
        "-TURN * frame +",
        ("tests/programs/test_p14_dynamic_reflection.py",),
    ),
    Mutation(
        "P15: the walker never rests",
        "nothing_redrawn.py",
        "TURN * steps(frame)",
        "TURN * frame",
        ("tests/programs/test_p15_nothing_redrawn.py",),
    ),
    Mutation(
        "P16: not the middle ball's probe",
        "shared_cubemap.py",
        "program.probes[1] if",
        "program.probes[0] if",
        ("tests/programs/test_p16_shared_cubemap.py",),
    ),
    Mutation(
        "P17: glass and mirror change places",
        "dynamic_refraction.py",
        "zip((-APART, APART)",
        "zip((APART, -APART)",
        ("tests/programs/test_p17_dynamic_refraction.py",),
    ),
    # Shadows.
    Mutation(
        "shadow: +Y of a point light's cube turned",
        "shadows.glsl",
        "axis == 1 ? vec3(v.x, s * v.z, s * v.y)",
        "axis == 1 ? vec3(v.x, -s * v.z, s * v.y)",
        SHADOWS,
    ),
    Mutation(
        "shadow: slope of the receiving plane forgotten",
        "shadows.glsl",
        "vec4 there = dot(corner - start - half_width, slope) + to_corners;",
        "vec4 there = vec4(0.0);",
        SHADOWS,
    ),
    Mutation(
        "shadow: no rounded surface along the terminator",
        "shadows.glsl",
        "place += facet_height * plane;",
        "place += 0.0 * facet_height * plane;",
        SHADOWS,
    ),
    Mutation(
        "shadow: texels of a gather in another order",
        "shadows.glsl",
        "y.y * dot(reached.xy, x) + y.x * dot(reached.wz, x)",
        "y.x * dot(reached.xy, x) + y.y * dot(reached.wz, x)",
        SHADOWS,
    ),
    Mutation(
        "key: shadow maps forgotten",
        DRAWN,
        "if (receive_shadow(node)) key.add(shadow_key);",
        "",
        SHADOW_MAPS,
    ),
    Mutation(
        "shadow: a caster's matrix is not in the map's key",
        "shadow_picture.cpp",
        "key.add(node.world);",
        "",
        SHADOW_MAPS,
    ),
    Mutation(
        "shadow: single-sided casters",
        "shadow_pass.cpp",
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
        "skybox.py",
        "program.script[: max(frame, 0)]",
        "program.script[: max(frame - 1, 0)]",
        ("tests/programs/test_p03_skybox.py",),
    ),
    Mutation(
        "P8: the eyes change places",
        "anaglyph.py",
        "return Program(scene, camera, stereo, ring)",
        "return Program(scene, camera, cc.StereoCamera(stereo.right, stereo.left), ring)",
        ("tests/programs/test_p08_anaglyph.py",),
    ),
    Mutation(
        "P9: a pass too far to the right",
        "additive_blur.py",
        "(-1, 1), (0, 1), (1, 1))",
        "(-1, 1), (0, 1), (2, 1))",
        ("tests/programs/test_p09_additive_blur.py",),
    ),
    Mutation(
        "P9: an eighth for a ninth",
        "additive_blur.py",
        "WEIGHT = 1 / 9",
        "WEIGHT = 1 / 8",
        ("tests/programs/test_p09_additive_blur.py",),
    ),
    Mutation(
        "P10: the discs go round backwards",
        "render_to_texture.py",
        "angle = rounds * 2 * math.pi",
        "angle = -rounds * 2 * math.pi",
        ("tests/programs/test_p10_render_to_texture.py",),
    ),
    Mutation(
        "P11: no shadow",
        "framebuffer_parts.py",
        "shadow=cc.Shadow(size=SHADOW)",
        "shadow=cc.Shadow(size=SHADOW, far=1)",
        ("tests/programs/test_p11_framebuffer_parts.py",),
    ),
    Mutation(
        "P11: 24 bits of depth for 16",
        "framebuffer_parts.py",
        'depth_format="depth_component16"',
        'depth_format="depth_component24"',
        ("tests/programs/test_p11_framebuffer_parts.py",),
    ),
    Mutation(
        "P12: the cubes circle backwards",
        "cube_camera.py",
        "(1 if index % 2 == 0 else -1)",
        "(-1 if index % 2 == 0 else 1)",
        ("tests/programs/test_p12_cube_camera.py",),
    ),
    # Blending, users' shaders, effects.
    Mutation(
        "blend: multiply forgets its alpha",
        "surface.frag",
        "o_color.rgb = mix(vec3(1.0), o_color.rgb, o_color.a);",
        "",
        ("tests/gl/test_blending.py",),
    ),
    Mutation(
        "blend: alpha_keep writes alpha",
        "raster_state.cpp",
        "gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);",
        "gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);",
        ("tests/gl/test_blending.py",),
    ),
    Mutation(
        "uniforms: matrices by columns",
        "user_program.cpp",
        "gl.ProgramUniformMatrix3fv(id, at, n, GL_TRUE, v)",
        "gl.ProgramUniformMatrix3fv(id, at, n, GL_FALSE, v)",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "uniforms: the last material's value stays",
        "user_program.cpp",
        "set(uniform, uniform.initial);",
        "",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "effects: in reverse order",
        "post_process_pass.cpp",
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
        "dependencies.cpp",
        "found.insert(found.end(), shadows_.begin(), shadows_.end());",
        "",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    Mutation(
        "shadow: depends on all textures",
        QUERIES,
        "if (mentions(shader.vertex.text, name)) found.push_back(place);",
        "found.push_back(place);",
        ("tests/gl/test_render_texture_circles.py",),
    ),
    # What survived a search by hand: kinds that were not tested by value.
    Mutation(
        "glb: normals by the matrix itself",
        "meshes.py",
        "geometry.vertex_normals, dtype=np.float64) @ cofactors.T",
        "geometry.vertex_normals, dtype=np.float64) @ linear.T",
        ("tests/unit/test_meshes.py",),
    ),
    Mutation(
        "glb: a mirrored node inside out",
        "meshes.py",
        "faces = faces[:, ::-1]",
        "faces = faces",
        ("tests/unit/test_meshes.py",),
    ),
    Mutation(
        "glb: a mirrored node's normals turned",
        "meshes.py",
        "None if normals is None else -normals",
        "None if normals is None else normals",
        ("tests/unit/test_meshes.py",),
    ),
    Mutation(
        "notebooks: every cubemap mirrored",
        "pictures.py",
        'cube.to_layout("cross", "inside")',
        'cube.to_layout("cross", "gl")',
        ("tests/unit/test_cubemap.py",),
    ),
    Mutation(
        "names of files: +X and -X swapped",
        "cubemap_names.py",
        '("posx", "negx",',
        '("negx", "posx",',
        ("tests/unit/test_cubemap_files.py",),
    ),
    Mutation(
        "names of files: +Z and -Z swapped",
        "cubemap_names.py",
        '"pos-z", "neg-z"',
        '"neg-z", "pos-z"',
        ("tests/unit/test_cubemap_files.py",),
    ),
    Mutation(
        "output maps: the convention ignored",
        "cubemap_save.py",
        "CubeMap(texels).to_layout(layout, convention)",
        'CubeMap(texels).to_layout(layout, "gl")',
        ("tests/unit/test_cubemap_files.py",),
    ),
    Mutation(
        "GLSL of vertices: the eye of a capture ignored",
        "scene.glsl",
        "return a_view_eye.xyz + u_origin.xyz;",
        "return a_view_position.xyz + u_origin.xyz;",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "GLSL: levels of the environment from behind",
        "scene.glsl",
        "textureLod(u_cube, direction_world, level)",
        "textureLod(u_cube, -direction_world, level)",
        ("tests/gl/test_shader_material.py",),
    ),
    Mutation(
        "equirect: rows beyond a pole not turned",
        "cubemap_from_equirect.cpp",
        "column += period / 2;",
        "column += 0;",
        EQUIRECT,
    ),
    Mutation(
        "equirect: side faces alike at every even width",
        "cubemap_resample.cpp",
        "width_ % 8 == 0",
        "width_ % 2 == 0",
        EQUIRECT,
    ),
]
