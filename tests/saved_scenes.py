"""Scenes for tests of saving: one for each kind of object, and scenes that hypothesis makes."""

import numpy as np
from hypothesis import strategies as st

import cubecam as cc

RNG = np.random.default_rng(7)
GLSL = """
uniform float strength = 1.0;
uniform sampler2D picture;
uniform samplerCube around;
vec3 shade(Surface s) { return strength * texture(picture, s.uv).rgb + texture(around, s.normal).rgb; }
"""


def image(channels=3, dtype=np.uint8, size=(4, 6), **options):
    shape = (*size, channels)
    if dtype == np.uint8:
        return cc.Image(RNG.integers(0, 256, shape, dtype=np.uint8), **options)
    return cc.Image((3 * RNG.random(shape)).astype(dtype), **options)


def cube(size=4, dtype=np.float16, **options):
    return cc.CubeMap(RNG.random((6, size, size, 3)).astype(dtype), **options)


def mesh(count=5, **options):
    positions = RNG.normal(size=(count, 3))
    return cc.Mesh(positions, RNG.integers(0, count, (4, 3)), **options)


def full_mesh(count=6):
    return mesh(
        count,
        normals=RNG.normal(size=(count, 3)),
        uvs=RNG.random((count, 2)),
        uvs1=RNG.random((count, 2)),
        colors=RNG.random((count, 4)),
        tangents=np.c_[RNG.normal(size=(count, 3)), np.ones(count)],
    )


def _nodes(scene):
    top = scene.add(
        name="top", position=(1, 2, 3), rotation=cc.axis_angle((1, 2, 3), 40), scale=(1, -2, 0.5)
    )
    scene.add(name="ä", parent=top, label=7, render_order=-3, in_captures=False, visible=False)
    late = scene.add(mesh(), cc.StandardMaterial(), cast_shadow=False, receive_shadow=False)
    below = scene.add(matrix=np.diag([2.0, 3, 4, 1]), parent=late)
    shear = np.eye(4)
    shear[:3] += RNG.normal(size=(3, 4))
    late.parent = scene.add(matrix=shear)  # a parent that comes after its child
    below.environment = cube()


def _meshes(scene):
    for shape in (full_mesh(), mesh(300), mesh(colors=RNG.normal(size=(5, 3)))):
        for material in (
            cc.StandardMaterial(),
            cc.BasicMaterial(vertex_colors=True),
            cc.PhongMaterial(),
        ):
            scene.add(shape, material)
    scene.add(mesh(), cc.StandardMaterial(map=cc.Texture(image(), uv_set=1)))
    scene.add(mesh(uvs1=RNG.random((5, 2))), cc.StandardMaterial())
    for _ in range(2):  # equal meshes, which may change one by one
        scene.add(cc.Mesh.box(), cc.StandardMaterial())


def _standard(scene):
    one, other = image(4, encoding="srgb"), image(1, wrap=("clamp", "mirror"), mag_filter="nearest")
    floats = image(3, np.float16, mipmaps=True)
    for options in (
        {"color": (0.1, 0.2, 0.3, 0.4), "metallic": 0.7, "roughness": 0.3, "opacity": 0.6},
        {"map": one, "normal_map": one, "normal_scale": -2, "occlusion_map": other, "occlusion_strength": 0.2},
        {"map": floats, "emissive": (5, 0.1, 0), "emissive_strength": 2, "emissive_map": image(encoding="linear")},
        {"normal_scale": 0.5, "occlusion_strength": 0.5, "clearcoat_normal_scale": 0.25},
        {"alpha_mode": "mask", "alpha_cutoff": 0.3, "double_sided": True, "flat_shading": True},
        {"alpha_mode": "opaque", "alpha_cutoff": 0.3, "vertex_colors": False},
        {"alpha_mode": "blend", "blend": cc.Blend("one", "zero", equation="max"), "depth_write": True},
        {"unlit": True, "map": cc.Texture(one), "ior": 2, "roughness": 0.25, "emissive_map": other},
        {"sheen_color": (1, 0.5, 0), "sheen_color_map": one, "sheen_roughness": 0.3, "sheen_roughness_map": one},
        {"specular": "sampled", "specular_samples": 64, "multiple_scattering": False, "ior": 0},
        {"transmission": 0.5, "thickness": 1, "attenuation_distance": 3, "attenuation_color": (1, 0.5, 0.2)},
        {"dispersion": 0.3, "color_write": (True, False, True, True), "depth_test": False},
        {"iridescence": 1, "iridescence_thickness_map": cc.Texture(other, offset=(0.1, 0.7), rotation=200)},
        {"anisotropy": 0.5, "anisotropy_rotation": 77, "anisotropy_map": cc.Texture(one, uv_set=1, scale=(2, -3))},
        {"stencil": cc.Stencil(func="equal", reference=3, depth_pass="incr"), "specular_color": (3, 2, 1)},
    ):  # fmt: skip
        scene.add(full_mesh(), cc.StandardMaterial(**options))


def _kinds(scene):
    picture, around = image(), cube(mipmaps=True)
    probe = cc.Probe((1, 2, 3), size=16, update=3, far=50, parent=scene.add())
    probe.exclude = [scene.nodes[0]]
    for material in (
        cc.MirrorMaterial(tint=(1, 0.5, 0.25), f0=0.25, color=(0, 1, 0), color_weight=0.5),
        cc.GlassMaterial(ior=0.8, tint="pink", roughness=0.5, fresnel=False),
        cc.BasicMaterial(color=(3, 2, 1, 0.5), map=picture, opacity=0.5),
        cc.BasicMaterial(cubemap=probe),
        cc.PhongMaterial(ka=0.1, kd=2, ks=0.5, shininess=100, map=picture, blend="additive"),
        cc.ShaderMaterial(
            GLSL,
            vertex="void vertex(inout Vertex v) { v.position.x += 1.0; }",
            uniforms={"strength": 0.5},
            textures={"picture": picture, "around": probe},
            displacement=1.5,
            opacity=0.5,
        ),
        cc.ShaderMaterial(GLSL, textures={"picture": picture, "around": around}),
    ):
        scene.add(mesh(), material)
        scene.nodes[-1].environment = probe


def _lights(scene):
    shadow = cc.Shadow(size=64, radius=2, bias=0.01, far=20)
    scene.add(cc.AmbientLight(color="red", intensity=0.25))
    scene.add(cc.PointLight((1, 2, 3), intensity=5, decay=2, shadow=shadow))
    scene.add(cc.PointLight((0, 0, 0), color=(2, 1, 0), decay=1))
    scene.add(cc.SpotLight((1, 0, 0), (1, 2, 3), angle=70, penumbra=0.5, decay=2, intensity=100))
    scene.add(cc.SpotLight(penumbra=0))
    scene.add(cc.DirectionalLight((0, 0, 1), shadow=cc.Shadow(extent=3)))
    scene.add(cc.DirectionalLight((0, 0, -1)))


def _surroundings(scene):
    scene.environment = cube(8).prefilter(levels=3)
    scene.environment_intensity = 0.5
    scene.environment_rotation = cc.axis_angle((0, 1, 0), 30)
    scene.background = cube(dtype=np.uint8)
    scene.add(mesh(), cc.MirrorMaterial())


def _background(scene):
    scene.background = (0.1, 0.2, 0.3, 0.4)


def _textures(scene):
    effect = cc.ImageEffect(
        "uniform float k; vec3 effect(vec2 uv) { return k * frame(uv).rgb; }",
        uniforms={"k": np.float32(2)},
    )
    scene.add(cc.Mesh.box(), cc.BasicMaterial(color="red"))
    camera = cc.PerspectiveCamera(position=(0, 0, 5), target=(0, 0, 0), shift=(0, 0.5))
    options = {"size": (8, 4), "effects": [effect, effect], "name": "tv"}
    shown = cc.RenderTexture(scene, camera, **options)
    matrices = cc.Camera(view=camera.view, projection=camera.projection(2))
    other = cc.RenderTexture(scene, matrices)
    for material in (
        cc.BasicMaterial(map=shown),
        cc.StandardMaterial(map=shown, emissive_map=cc.Texture(shown, scale=(2, 2))),
        cc.StandardMaterial(map=other),
    ):
        scene.add(mesh(uvs=RNG.random((5, 2))), material)
    shown.exclude = other.exclude = scene.nodes[1:]


def _held(scene):
    """Lights and cameras of nodes, at their origin and elsewhere, several at one node."""
    top = scene.add(position=(1, 2, 3), rotation=cc.axis_angle((0, 1, 0), 30), scale=2)
    below = scene.add(parent=top, position=(0, 1, 0))
    for parent in (below, top):
        scene.add(cc.PointLight(parent=parent, decay=2, range=7, intensity=3))
        scene.add(cc.SpotLight((0, 0, 0), (0, 0, -1), parent=parent, penumbra=0.5, range=2))
        scene.add(cc.DirectionalLight((1, 1, 0), parent=parent))
        scene.add(cc.PerspectiveCamera(parent=parent))
        scene.add(
            cc.OrthographicCamera(parent=parent, height=3, position=(1, 2, 3), target=(0, 0, 1))
        )
    scene.add(cc.DirectionalLight((0, 0, -1), parent=scene.add()))


def _cameras(scene):
    scene.add(cc.OrthographicCamera(height=3, near=-5, far=-1))
    scene.add(
        cc.PerspectiveCamera(
            fov=35, position=(1, 5, 2), target=(1, 0, 2), up=(0, 0, -1), near=3, far=9
        )
    )
    scene.add(
        cc.PerspectiveCamera(
            position=(1, 2, 3), target=(3, 2, 1), shift=(0.5, 0.25), pixel_aspect=1.5
        )
    )
    view = np.eye(4)
    view[:3, 3] = (1, 2, -3)
    scene.add(cc.Camera(view=view, projection=scene.cameras[1].projection(2)))
    scene.add(cc.OrthographicCamera(height=0.25))
    shown = cc.RenderTexture(scene, scene.cameras[2], size=(4, 4))
    shown.exclude = [scene.add(mesh(uvs=RNG.random((5, 2))), cc.BasicMaterial(map=shown))]


def _variants(scene):
    red, blue, mirror = (
        cc.StandardMaterial(color="red"),
        cc.StandardMaterial(color="blue"),
        cc.MirrorMaterial(),
    )
    scene.variants = ["day", "night", "ä"]
    shape = mesh()
    for materials in ({"day": red, "ä": mirror}, {"night": blue}, {"day": blue, "night": blue}, {}):
        scene.add(shape, red).variants = materials
    scene.variant = "night"


def _motion(scene):
    still, moved = scene.add(name="still"), scene.add(matrix=np.diag([2.0, 2, 2, 1]))
    times = [0, 0.5, 2]
    turns = [cc.axis_angle((1, 2, 3), angle) for angle in (0, 90, 200)]
    channel = cc.AnimationChannel
    scene.add(cc.Animation([
        channel(moved, "translation", times, RNG.random((3, 3)), interpolation="step"),
        channel(moved, "rotation", times, turns),
        channel(moved, "scale", times, 1 + RNG.random((9, 3)), interpolation="cubic"),
    ], name="jump"))  # fmt: skip
    scene.add(cc.Animation([channel(still, "rotation", [1], [(1, 0, 0, 0)])]))
    # glTF has no times before 0.
    scene.add(cc.Animation([
        channel(still, "translation", [-1, 1], RNG.random((2, 3))),
        channel(moved, "rotation", [0, 1], turns[:2]),
    ]))  # fmt: skip
    early = channel(still, "scale", [-2, -1], 1 + RNG.random((2, 3)))
    scene.add(cc.Animation([early], name="early"))
    scene.add(cc.Animation([channel(still, "scale", [0, 1], 1 + RNG.random((2, 3)))]))


def skinned(count=6, joints=3):
    weights = RNG.random((count, 4))
    return cc.Mesh(
        RNG.normal(size=(count, 3)),
        RNG.integers(0, count, (4, 3)),
        joints=RNG.integers(0, joints, (count, 4)),
        joint_weights=weights / weights.sum(axis=1, keepdims=True),
    )


def _skins(scene):
    hip = scene.add(position=(0, 1, 0))
    knee = scene.add(parent=hip, position=(0, -1, 0))
    apart = scene.add(position=(3, 0, 0))
    binds = np.tile(np.eye(4), (3, 1, 1))
    binds[:, :3, 3] = RNG.normal(size=(3, 3))
    skin = cc.Skin([hip, knee, apart], binds, skeleton=hip)
    shape = skinned()
    scene.add(shape, cc.StandardMaterial(), skin=skin)
    scene.add(shape, cc.StandardMaterial(), skin=skin)
    scene.add(skinned(4, 2), cc.StandardMaterial(), skin=cc.Skin([knee, hip]))
    rough = skinned(50)
    rough.update(joints=rough.joints, joint_weights=rough.joint_weights * (1 + 1e-6))
    scene.add(rough, cc.StandardMaterial(), skin=skin)


def _morphs(scene):
    count = 6
    targets = [
        cc.MorphTarget(positions=RNG.normal(size=(count, 3)), name="smile"),
        cc.MorphTarget(
            positions=RNG.normal(size=(count, 3)),
            normals=RNG.normal(size=(count, 3)),
            tangents=RNG.normal(size=(count, 3)),
            uvs=RNG.normal(size=(count, 2)),
            uvs1=RNG.normal(size=(count, 2)),
            colors=RNG.normal(size=(count, 4)),
        ),
    ]
    whole = full_mesh(count)
    arrays = {n: getattr(whole, n) for n in ("normals", "uvs", "uvs1", "colors", "tangents")}
    face = cc.Mesh(whole.positions, whole.indices, morph_targets=targets, **arrays)
    node = scene.add(face, cc.StandardMaterial(), weights=[0.25, -0.5])
    # Targets of attributes that the mesh lacks.
    scene.add(mesh(count, morph_targets=targets), cc.StandardMaterial(), weights=[0, 1])
    scene.add(face, cc.MirrorMaterial())
    values = RNG.random((2, 2))
    scene.add(cc.Animation([cc.AnimationChannel(node, "weights", [0, 1], values)]))


#: One function for each kind of thing; it fills an empty scene.
KINDS = {
    f.__name__[1:]: f
    for f in (
        _nodes,
        _meshes,
        _standard,
        _kinds,
        _lights,
        _surroundings,
        _background,
        _textures,
        _held,
        _cameras,
        _variants,
        _motion,
        _skins,
        _morphs,
    )
}


def scene_of(kind):
    scene = cc.Scene()
    KINDS[kind](scene)
    return scene


@st.composite
def scenes(draw):
    """Scenes of a few nodes in any tree, with shared meshes, materials and images."""
    share = st.floats(0, 1, width=32)
    numbers = st.floats(-100, 100, width=32)
    points = st.tuples(numbers, numbers, numbers)
    images = [image(c, d) for c, d in draw(st.lists(st.sampled_from(
        [(1, np.uint8), (3, np.uint8), (4, np.uint8), (3, np.float32), (4, np.float16)]), max_size=2))]  # fmt: skip
    maps = st.sampled_from([None, *images])
    standard = st.builds(
        cc.StandardMaterial,
        color=st.tuples(share, share, share, share),
        metallic=share,
        roughness=share,
        map=maps,
        normal_map=maps,
        emissive=st.tuples(share, share, st.floats(0, 8, width=32)),
        alpha_mode=st.sampled_from([None, "opaque", "mask", "blend"]),
        transmission=share,
        thickness=share,
        clearcoat=share,
        clearcoat_map=maps,
        double_sided=st.booleans(),
        opacity=share,
    )
    others = st.one_of(
        st.builds(cc.MirrorMaterial, tint=st.tuples(share, share, share), f0=st.none() | share),
        st.builds(cc.BasicMaterial, map=maps, opacity=share, vertex_colors=st.booleans()),
        st.builds(cc.PhongMaterial, ks=share, map=maps),
        st.builds(cc.GlassMaterial, ior=st.floats(0.5, 3, width=32)),
    )
    scene = cc.Scene(background=draw(st.none() | st.tuples(share, share, share, share)))
    shapes = draw(st.lists(st.sampled_from([mesh, full_mesh]), min_size=1, max_size=2))
    shapes = [make() for make in shapes]
    materials = draw(st.lists(standard | others, min_size=1, max_size=3))
    quaternions = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1)
    scales = st.floats(0.01, 10) | st.floats(-10, -0.01)
    for _ in range(draw(st.integers(0, 5))):
        shape = draw(st.sampled_from([None, *shapes]))
        scene.add(
            shape,
            None if shape is None else draw(st.sampled_from(materials)),
            position=draw(points),
            rotation=draw(quaternions),
            scale=draw(st.tuples(scales, scales, scales)),
            visible=draw(st.booleans()),
            name=draw(st.text(st.characters(codec="utf-8"), max_size=4)),
            label=draw(st.integers(-(2**31), 2**31 - 1)),
        )
    for node in scene.nodes[1:]:
        node.parent = draw(st.sampled_from([None, *scene.nodes[: scene.nodes.index(node)]]))
    directions = points.filter(lambda d: np.linalg.norm(d) > 1e-3)
    lights = st.one_of(
        st.builds(cc.PointLight, points, intensity=share, decay=st.floats(0, 3)),
        st.builds(
            cc.SpotLight, points, directions, angle=st.floats(1, 89), penumbra=st.floats(0, 1)
        ),
        st.builds(cc.DirectionalLight, directions, color=points.map(np.abs)),
        st.builds(cc.AmbientLight, intensity=share),
    )
    for light in draw(st.lists(lights, max_size=3)):
        scene.add(light)
    return scene
