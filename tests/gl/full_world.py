"""A small world that has at least one of everything whose properties can be set, and all pictures of it.

A driver compiles a program again for each format, depth format, wrap and filter with which it is used, and these tests
draw with hundreds of programs. So all worlds begin with the same images but for their pixels, pictures share formats
where their question is another one, and the lights have a decay and a range from the start. Edits bring the rest, and
the crowds of test_incremental.py follow every format.
"""

from dataclasses import dataclass, field

import numpy as np

import cubecam as cc
from tests.gl.flat import quad

SIZE = (24, 20)

SOURCES = (
    """uniform vec3 tone; uniform sampler2D picture; uniform samplerCube around; out vec4 heat;
    vec3 shade(Surface s) {
        heat = vec4(s.normal, tone.r);
        return tone * texture(picture, s.uv).rgb + 0.4 * environment_filtered(s.normal, tone.r)
            + 0.3 * texture(around, s.normal).rgb;
    }""",
    """uniform vec3 tone; uniform sampler2D picture; uniform samplerCube around; out vec4 heat;
    vec4 shade(Surface s) {
        heat = vec4(s.position, 1.0);
        vec3 lit = phong(s, tone, 0.1, 0.7, 0.4, 9.0);
        lit += environment_mip(s.normal, 9.0 * tone.g);
        return vec4(lit + texture(picture, s.uv).rgb * texture(around, s.incident).rgb, 0.7);
    }""",
)
VERTEX_SOURCES = (
    "uniform float time = 0.5; void vertex(inout Vertex v) { v.position.y += 0.2 * sin(9.0 * v.uv.x + time); }",
    "uniform float time = 0.5; void vertex(inout Vertex v) { v.position += 0.1 * time * v.normal; }",
)
EFFECT_SOURCES = (
    """uniform float strength = 0.5; uniform sampler2D veil;
    vec3 effect(vec2 uv) { return mix(frame(uv).rgb, texture(veil, uv).rgb, strength * 0.4); }""",
    """uniform float strength = 0.5; uniform sampler2D veil;
    vec4 effect(vec2 uv) { return frame(uv.yx) + strength * texture(veil, uv.yx); }""",
)


def some_image(rng, mipmaps, wrap):
    return cc.Image(rng.integers(0, 256, (6, 5, 3), dtype=np.uint8), mipmaps=mipmaps, wrap=wrap)


def random_image(rng):
    return some_image(rng, bool(rng.integers(2)), "repeat" if rng.integers(2) else "clamp")


def some_cube(rng, mipmaps):
    return cc.CubeMap(rng.random((6, 4, 4, 3), dtype=np.float32), mipmaps=mipmaps)


def random_cube(rng):
    return some_cube(rng, bool(rng.integers(2)))


def random_effect(rng):
    source = EFFECT_SOURCES[rng.integers(len(EFFECT_SOURCES))]
    return cc.ImageEffect(source, textures={"veil": random_image(rng)})


def random_camera(rng):
    return cc.PerspectiveCamera(
        fov=rng.uniform(50, 80), position=rng.uniform(2, 3, 3), target=rng.uniform(-0.3, 0.3, 3)
    )


def colored_box():
    """A box with colours, two joints and a morph target."""
    box = cc.Mesh.box(0.6)
    rng = np.random.default_rng(5)
    shape = box.positions.shape
    upper = box.positions[:, 1:2] > 0
    return cc.Mesh(
        box.positions,
        box.indices,
        normals=box.normals,
        uvs=box.uvs,
        colors=rng.random(shape),
        joints=np.tile((0, 1, 0, 0), (len(upper), 1)),
        joint_weights=np.c_[~upper, upper, 0 * upper, 0 * upper],
        morph_targets=[cc.MorphTarget(positions=rng.uniform(-0.2, 0.2, shape))],
    )


@dataclass
class FullWorld:
    """`scene` is the main scene that is drawn; render textures can show `inner` and `spare`."""

    scene: cc.Scene
    inner: cc.Scene
    spare: cc.Scene
    cameras: list
    stereo: cc.StereoCamera
    effects: list
    meshes: list
    cubes: list
    images: list
    textures: list = field(default_factory=list)
    probes: list = field(default_factory=list)
    mirrors: list = field(default_factory=list)
    blends: list = field(default_factory=list)
    grids: list = field(default_factory=list)
    materials: list = field(default_factory=list)  # at first, whatever the nodes have later

    @property
    def scenes(self):
        return [self.scene, self.inner, self.spare]

    def things(self, kind):
        """All objects of a class, in an order that does not change."""
        nodes = [node for scene in self.scenes for node in scene.nodes]
        cameras = [*self.cameras, self.stereo.left, self.stereo.right]
        cameras += [texture.camera for texture in self.textures]
        effects = [*self.effects, *(e for texture in self.textures for e in texture.effects)]
        lights = [light for scene in self.scenes for light in scene.lights]
        materials = [node.material for node in nodes if node.material is not None]
        every = [*nodes, *self.scenes, *lights, *materials, *cameras, self.stereo, *effects]
        every += [
            *self.textures,
            *self.probes,
            *self.mirrors,
            *self.grids,
            *self.cubes,
            *self.images,
            *self.meshes,
        ]
        if kind is cc.Camera:  # its subclasses compute their matrices
            return [thing for thing in every if type(thing) is cc.Camera]
        return [thing for thing in every if isinstance(thing, kind)]


def inner_scene(rng):
    scene = cc.Scene(background=rng.random(3), environment=some_cube(rng, mipmaps=True))
    scene.add(cc.PointLight(position=(2, 4, 1)))
    scene.add(cc.Mesh.box(0.6), cc.PhongMaterial(color=rng.random(3)), position=(0.7, 0, 0))
    scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=rng.random(3)), position=(-0.5, 0.4, 0))
    return scene


def full_world(rng):
    scene = cc.Scene(environment=some_cube(rng, mipmaps=True), environment_intensity=0.9)
    inner, spare = inner_scene(rng), inner_scene(rng)
    images = [some_image(rng, True, "repeat"), some_image(rng, False, "clamp")]
    cubes = [some_cube(rng, True), some_cube(rng, False)]
    effects = [cc.ImageEffect(source, textures={"veil": images[1]}) for source in EFFECT_SOURCES]
    meshes = [colored_box(), cc.Mesh.sphere(0.4, 12, 6), cc.Mesh.box(0.5), cc.Mesh.plane(0.8, 0.8)]
    camera = cc.PerspectiveCamera(fov=65, position=(3, 1, 2), target=(0, 0, 0))
    lens = camera.projection(aspect=SIZE[0] / SIZE[1])
    world = FullWorld(
        scene=scene,
        inner=inner,
        spare=spare,
        cameras=[
            camera,
            cc.OrthographicCamera(height=5, position=(-3, 2, 3), target=(0, 0, 0)),
            cc.Camera(view=random_camera(rng).view, projection=lens),
        ],
        stereo=cc.StereoCamera(random_camera(rng), random_camera(rng), layout="side_by_side"),
        effects=effects[:1],
        meshes=meshes,
        cubes=cubes,
        images=images,
    )
    scene.add(cc.PointLight(position=(2, 4, 1), shadow=cc.Shadow(size=24)))
    scene.add(cc.DirectionalLight((-1, -2, 0.4), intensity=0.4, shadow=cc.Shadow(size=32)))
    scene.add(cc.SpotLight((2, 3, 2), (-2, -3, -2), angle=50, shadow=cc.Shadow(size=32, radius=0)))
    scene.add(cc.PointLight(position=(-2, 1, 2), intensity=0.3, decay=1, range=30))
    scene.add(cc.AmbientLight(intensity=0.2))

    inner_camera = cc.PerspectiveCamera(fov=50, position=(0.5, 0.6, 2), target=(0, 0, 0))
    world.textures = [
        cc.RenderTexture(inner, inner_camera, size=(12, 9), mipmaps=True, name="inner"),
        cc.RenderTexture(
            scene,
            random_camera(rng),
            size=(14, 10),
            format="rgba32f",
            effects=effects[1:],
            name="monitor",
        ),
    ]
    group = scene.add(name="group")
    joints = [
        scene.add(position=(1.2, 0.4 + y, -0.6), parent=above, name="joint")
        for y, above in ((0, None), (0.1, group))
    ]
    ball, box = meshes[1], meshes[2]
    world.probes = [
        cc.Probe(
            position=(0.3, 0.2, 0.1), size=12, format="rgba32f", box=((-2, -2, -3), (2, 1, 2))
        ),
        cc.Probe(position=(-1, 0.3, 0.5), size=10, format="rgba32f", box=((-4, -1, -2), (1, 2, 2))),
        cc.Probe(size=8, format="rgba32f"),
    ]
    mirror, glass, shown = world.probes
    for probe, low, high in ((mirror, -1, 0.5), (glass, 0, 2)):
        probe.influence = (low, -2, -2), (high, 2, 2)
    world.blends = [cc.ProbeBlend([mirror, glass])]
    grid = cc.ProbeGrid(((-2, -1.5, -2), (2, 1.5, 2)), (3, 2, 2), size=4, resolution=4)
    grid.coefficients = np.random.default_rng(5).random(grid.coefficients.shape)
    grid.distances = 1 + np.random.default_rng(6).random(grid.distances.shape)
    world.grids = [grid]
    scene.probe_grid = grid
    shown_colors = cc.BasicMaterial(vertex_colors=True)
    scene.add(meshes[0], shown_colors, skin=cc.Skin(joints), weights=[0.5], name="bent")
    scene.add(box, cc.BasicMaterial(map=images[0]), position=(-1.2, -0.4, -0.8), parent=group)
    scene.add(box, cc.PhongMaterial(map=images[1]), position=(0.4, 1.1, 0.3), parent=group)
    scene.add(ball, cc.MirrorMaterial(), position=(0.2, 0, 0.2), environment=mirror, scale=1.3)
    scene.add(ball, cc.GlassMaterial(), position=(-1, 0.3, 0.5), environment=glass)
    scene.add(ball, cc.MirrorMaterial(env_weight=0.7), position=(1, -0.5, 1))
    scene.add(ball, cc.MirrorMaterial(), position=(0.4, 0.5, 1.4), environment=world.blends[0])
    scene.add(
        ball,
        cc.GlassMaterial(roughness=0.5, surfaces=2),
        position=(-0.4, -0.8, 1.3),
        environment=glass,
    )
    scene.add(box, cc.BasicMaterial(cubemap=shown), position=(0.5, -0.7, 1.5), name="shown")
    scene.add(
        box, cc.BasicMaterial(color=(1, 0.5, 0.2), opacity=0.5), position=(1.5, 0.3, 0.8), scale=1.2
    )
    scene.add(cc.Mesh.plane(6, 5), cc.PhongMaterial(), position=(0, -1.3, 0), name="floor")
    # Its programs take long to compile, so the one with many parts is in the scene with one light.
    plain = cc.StandardMaterial(color=(0.9, 0.7, 0.4), roughness=0.4)
    scene.add(ball, plain, position=(-1.6, 0.8, 0.2), receive_shadow=False)
    painted = cc.StandardMaterial(
        map=images[0],
        metallic=0.5,
        roughness=0.6,
        normal_map=images[1],
        emissive=(0.2, 0.1, 0),
        emissive_map=images[0],
        clearcoat=0.8,
        clearcoat_map=images[1],
        anisotropy=0.5,
    )
    inner.add(box, painted, position=(0.1, -0.6, 0.4))
    world.mirrors = [cc.PlanarMirror(bounces=2)]
    inner.add(
        quad(2, 1.6),
        cc.MirrorMaterial(),
        position=(-0.9, -0.7, -0.8),
        environment=world.mirrors[0],
        name="pane",
    )
    shader = cc.ShaderMaterial(
        SOURCES[0],
        vertex=VERTEX_SOURCES[0],
        displacement=0.3,
        uniforms={"tone": (0.6, 0.4, 0.3)},
        textures={"picture": images[0], "around": cubes[0]},
    )
    scene.add(meshes[0], shader, position=(-0.5, 0.9, 1.2))
    screens = [
        scene.add(
            quad(1.2, 1.2),
            cc.PhongMaterial(map=texture, ka=0.6, double_sided=True),
            position=(0.9 * index - 1.4, 0.2, 1 - index),
            rotation=cc.axis_angle((0, 1, 0), 40),
            name="screen",
            in_captures=index == 0,
        )
        for index, texture in enumerate(world.textures)
    ]
    world.textures[1].exclude = [screens[1]]
    world.materials = world.things(cc.Material)
    return world


def refused(call):
    """The result of a call, or the message of its error."""
    try:
        return call()
    except ValueError as error:
        return str(error)


def pictures(renderer, world):
    """Every picture of a world by name: an array, or the error message if the call is refused."""
    scene, found = world.scene, {}
    camera, flat, matrices = world.cameras

    def add_frame(name, eye, **options):
        frame = refused(lambda: renderer.render(scene, eye, SIZE, **options))
        for output in (
            ()
            if isinstance(frame, str)
            else ("color", "distance", "id", "label", "stencil", "heat")
        ):
            if getattr(frame, output, None) is not None:
                found[f"{name} {output}"] = getattr(frame, output)
        if isinstance(frame, str):
            found[name] = frame

    stencils = {"depth_format": "depth32f_stencil8"}
    outputs: tuple[str, ...] = ("distance", "id", "label", "stencil")
    # A frame of its own would compile each program once more.
    if any(isinstance(node.material, cc.ShaderMaterial) for node in scene.nodes):
        outputs = (*outputs, "heat")  # that the sources of this world declare
    add_frame("frame", camera, format="rgba32f", outputs=outputs, **stencils)
    add_frame("effects", flat, effects=world.effects, samples=4)
    add_frame("matrices", matrices, tonemap="aces", max_lod_error=5)
    add_frame("stereo", world.stereo, format="rgba32f")
    shaded = {"outputs": outputs, **stencils}
    cube = refused(lambda: renderer.capture(scene, (0.1, 0.2, 0.3), 10, **shaded))
    if isinstance(cube, str):
        found["capture"] = cube
    else:
        found["capture"], found["capture id"] = cube.faces, cube.id
    options = {"depth_order": "farthest", "max_lod_error": 2, **shaded}
    behind = refused(lambda: renderer.capture(scene, (0.1, 0.2, 0.3), 10, **options))
    if isinstance(behind, str):
        found["farthest"] = behind
    else:
        found["farthest"], found["farthest id"] = behind.faces, behind.id
    for index, light in enumerate(scene.lights):
        if getattr(light, "shadow", None) is not None:
            shadow = refused(lambda lamp=light: renderer.shadow_map(scene, lamp))
            found[f"shadow of light {index}"] = shadow
    if not any(isinstance(picture, str) for picture in found.values()):
        # After a refused call, probes and textures still hold what was drawn before that call.
        for index, probe in enumerate(world.probes):
            got = refused(lambda held=probe: renderer.read_probe(held).faces)
            found[f"probe {index}"] = got
        for index, texture in enumerate(world.textures):
            got = refused(lambda held=texture: renderer.read_texture(held))
            found[f"texture {index}"] = got
    return found
