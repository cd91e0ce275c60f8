"""Random edits of a FullWorld: each property with a setter in the stubs, of each class that has it, and method calls.

`VALUES` has for each property ("Class.name", the class being the one that declares it) a function of the world, a
random generator and the object to change, which gives a new value. If a property has no such function,
test_incremental.py fails, so that no property can be forgotten. `NAMES` has each property once for each class that has
it, "MirrorMaterial.depth_write" too: what a property changes depends on the rest of the object. METHODS has
changes by method calls, and changes of several objects between two pictures.
"""

import ast
import gc
from pathlib import Path

import numpy as np

import cubecam as cc
from tests.gl.full_world import (
    EFFECT_SOURCES,
    SOURCES,
    VERTEX_SOURCES,
    random_camera,
    random_cube,
    random_effect,
    random_image,
)

STUB = Path(cc.__file__).parent / "_core.pyi"
FORMATS = ("rgba8", "rgba16f", "rgba32f", "rgb565")
DEPTHS = ("depth_component24", "depth24_stencil8", "depth_component32f", "depth_component16", None)


STUB_CLASSES = [node for node in ast.parse(STUB.read_text()).body if isinstance(node, ast.ClassDef)]


def settable_properties():
    """ "Class.property" of every property with a setter, in the order of the stubs."""
    found = []
    for thing in STUB_CLASSES:
        for member in thing.body:
            decorators = getattr(member, "decorator_list", ())
            if any(isinstance(d, ast.Attribute) and d.attr == "setter" for d in decorators):
                assert isinstance(member, ast.FunctionDef)
                found.append(f"{thing.name}.{member.name}")
    return found


def changing_methods():
    """ "Class.method" of every public method of the stubs that returns nothing, so it is called for what it changes."""
    return [
        f"{thing.name}.{member.name}"
        for thing in STUB_CLASSES
        if not thing.name.startswith("_")
        for member in thing.body
        if isinstance(member, ast.FunctionDef)
        and not member.name.startswith("_")
        and not member.decorator_list
        and ast.unparse(member.returns or ast.Constant(0)) == "None"
    ]


def one(rng, *choices):
    return choices[rng.integers(len(choices))]


def number(low, high):
    return lambda world, rng, thing: float(rng.uniform(low, high))


def vector(low, high):
    return lambda world, rng, thing: rng.uniform(low, high, 3)


def choice(*choices):
    return lambda world, rng, thing: one(rng, *choices)


flag = choice(False, True)
color = vector(0, 1)
place = vector(-2, 2)


def some(world, rng, kind):
    """A random object of a class. If edits took all materials of that class off their nodes, one comes back."""
    if not world.things(kind):
        back = next(material for material in world.materials if isinstance(material, kind))
        world.scene.nodes[-1].material = back
    return one(rng, *world.things(kind))


def quick_material(world, rng):
    """A random material of the world whose programs compile fast, also in a scene with many lights and shadows.

    Where a node's material comes from has nothing to do with its kind, so edits that give materials to many nodes
    leave out StandardMaterial, each of whose variants takes a second or two.
    """
    quick = [m for m in world.things(cc.Material) if not isinstance(m, cc.StandardMaterial)]
    return one(rng, *quick, cc.BasicMaterial(color=rng.random(3)))


def random_node(world, rng, scene=None):
    return one(rng, *(scene or world.scene).nodes)


def some_node(world, rng, thing):
    """A node to follow, of the main scene or of another one."""
    return one(rng, None, random_node(world, rng), random_node(world, rng, world.spare))


def group_of(world, rng, thing):
    """The first node of the main scene is a group; the group itself has no parent."""
    group = world.scene.nodes[0]
    return None if thing is group or thing not in world.scene else one(rng, None, group)


def matrix(world, rng, thing):
    made = np.eye(4)
    made[:3, :3] = np.diag(rng.uniform(0.5, 1.4, 3) * rng.choice([-1, 1], 3))
    made[:3, :3] += rng.uniform(-0.2, 0.2, (3, 3))
    made[:3, 3] = rng.uniform(-1.5, 1.5, 3)
    return made


def stencil(world, rng, thing):
    words = ("keep", "zero", "replace", "incr", "decr_wrap", "invert")
    return one(
        rng,
        None,
        cc.Stencil(
            func=one(rng, "always", "equal", "less", "notequal"),
            reference=int(rng.integers(3)),
            depth_fail=one(rng, *words),
            depth_pass=one(rng, *words),
        ),
    )


def blend(world, rng, thing):
    modes = (None, "opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied")
    factors = (
        "zero",
        "one",
        "src_color",
        "one_minus_src_alpha",
        "dst_alpha",
        "one_minus_dst_color",
    )
    equations = ("add", "subtract", "reverse_subtract", "min", "max")
    made = cc.Blend(one(rng, *factors), one(rng, *factors), equation=one(rng, *equations))
    return one(rng, *modes, made, made, made)


def shadow(world, rng, thing):
    return one(rng, None, cc.Shadow(size=int(rng.integers(16, 40)), radius=one(rng, 0, 1, 1.5)))


def new_material(world, rng, thing):
    makers = (
        cc.BasicMaterial,
        cc.PhongMaterial,
        cc.MirrorMaterial,
        cc.GlassMaterial,
        cc.StandardMaterial,
    )
    return one(rng, None, one(rng, *makers)(), one(rng, *world.things(cc.Material)))


def map_of(world, rng, thing):
    return one(rng, None, one(rng, *world.images), random_image(rng), world.textures[0])


def placed_map(world, rng, thing):
    source = one(rng, *world.images, random_image(rng), world.textures[0])
    placed = cc.Texture(source, offset=rng.random(2), rotation=30, scale=rng.uniform(0.5, 2, 2))
    return one(rng, None, source, placed)


def cube_of(world, rng, thing):
    return one(rng, None, *world.cubes, *world.probes)


def environment_of(world, rng, thing):
    """A planar mirror only for a flat node, the one that has one at first."""
    mirrors = world.mirrors if thing.name == "pane" else []
    return one(rng, None, *world.cubes, *world.probes, *mirrors, *world.blends)


def scene_of(world, rng, thing):
    """A texture that shows the main scene keeps it: the other scenes do not have the nodes that it excludes."""
    return world.scene if thing.scene is world.scene else one(rng, world.inner, world.spare)


def excluded(world, rng, thing):
    """A render texture excludes the screen in its scene and one more node; other objects exclude random nodes."""
    if isinstance(thing, cc.RenderTexture):
        screens = [node for node in thing.scene.nodes if node.name == "screen"][-1:]
        return [*screens, random_node(world, rng, thing.scene)]
    return [random_node(world, rng) for _ in range(rng.integers(3))]


def uniforms_of_shader(world, rng, thing):
    return {"tone": rng.random(3)} | ({"time": float(rng.random())} if thing.vertex else {})


def variants(world, rng, thing):
    names = world.scene.variants or ("day", "night")
    return {name: quick_material(world, rng) for name in names if rng.random() < 0.7}


def variant(world, rng, thing):
    """One of the scene's variants, for which some nodes have a material."""
    if not thing.variants:
        thing.variants = ("day", "night")
    for node in thing.nodes[-3:]:
        node.variants = {"day": cc.BasicMaterial(color=rng.random(3))}
    return one(rng, None, *thing.variants)


def mesh_of(world, rng, thing):
    """None or one of the meshes; a node with a skin needs one with joints."""
    fit = [mesh for mesh in world.meshes if thing.skin is None or mesh.joints is not None]
    return one(rng, None, *fit)


def skin_of(world, rng, thing):
    joints = [node for node in world.scene.nodes if node.name == "joint"]
    bends = thing.mesh is not None and thing.mesh.joints is not None and thing in world.scene
    if not bends or len(joints) < 2:  # an edit may have given a joint another name
        return None
    return one(
        rng, None, cc.Skin(joints), cc.Skin(joints, [matrix(world, rng, thing)] * len(joints))
    )


def targets_of(world, rng, thing):
    shape = thing.positions.shape
    made = cc.MorphTarget(
        positions=rng.uniform(-0.1, 0.1, shape),
        normals=rng.uniform(-0.5, 0.5, shape),
        colors=rng.uniform(-0.5, 0.5, shape),
    )
    return one(rng, (), (made,), (*thing.morph_targets[:1], made))


def view(world, rng, thing):
    return random_camera(rng).view


#: The formats of depth through which a probe's parallax can march.
EXACT_DEPTHS = ("depth_component32f", "depth32f_stencil8")


def probe_depth(world, rng, thing):
    return one(rng, *(EXACT_DEPTHS if thing.parallax in ("distance", "layers") else DEPTHS))


def probe_parallax(world, rng, thing):
    proxies = ("box", "sphere") if thing.box is not None else ()
    marches = ("distance", "layers") if thing.depth_format in EXACT_DEPTHS else ()
    return one(rng, "none", *proxies, *marches)


VALUES = {
    "Node.cast_shadow": flag,
    "Node.environment": environment_of,
    "Node.in_captures": flag,
    "Node.label": choice(-1, 0, 2**31 - 1),
    "Node.material": new_material,
    "Node.matrix": matrix,
    "Node.mesh": mesh_of,
    "Node.name": choice("a", "b"),
    "Node.parent": group_of,
    "Node.position": place,
    "Node.receive_shadow": flag,
    "Node.render_order": choice(-1, 0, 1),
    "Node.rotation": lambda world, rng, thing: rng.normal(size=4),
    "Node.scale": lambda world, rng, thing: rng.choice([-1, 1]) * rng.uniform(0.5, 1.5, 3),
    "Node.skin": skin_of,
    "Node.variants": variants,
    "Node.visible": flag,
    "Node.weights": lambda world, rng, thing: rng.uniform(-0.5, 1, len(thing.weights)),
    "PlanarMirror.bounces": choice(1, 2, 3),
    "PlanarMirror.distance": number(0.1, 3),
    "Probe.blend_distance": number(0.1, 2),
    "Probe.bounces": choice(1, 2, 3),
    "Probe.box": choice(((-1, -1, -2), (2, 1, 1)), ((-0.5, -1, -1), (1, 2, 1))),
    "Probe.depth_format": probe_depth,
    "Probe.exclude": excluded,
    "Probe.faces_per_frame": choice(1, 2, 5),
    "Probe.far": number(1, 20),
    "Probe.fetches": choice(6, 14, 35),
    "Probe.format": choice(*FORMATS),
    "Probe.influence": choice(None, ((-1, -1, -2), (0.2, 1, 1)), ((-0.5, -1, -1), (1, 2, 1))),
    "Probe.influence_shape": choice("box", "sphere"),
    "Probe.mipmaps": flag,
    "Probe.near": number(0.01, 0.6),
    "Probe.parallax": probe_parallax,
    "Probe.parent": some_node,
    "Probe.position": vector(-1, 1),
    "Probe.prefilter": choice(None, True, False),
    "Probe.proxy_matrix": choice(None, np.diag([2.0, 1, 1, 1])),
    "Probe.samples": choice(1, 4),
    "Probe.size": choice(6, 9, 14),
    "Probe.update": choice("once", "manual", 2),
    "RenderTexture.camera": lambda world, rng, thing: random_camera(rng),
    "RenderTexture.depth_format": choice(*DEPTHS),
    "RenderTexture.effects": lambda world, rng, thing: [
        random_effect(rng) for _ in range(rng.integers(3))
    ],
    "RenderTexture.exclude": excluded,
    "RenderTexture.format": choice(*FORMATS),
    "RenderTexture.mipmaps": flag,
    "RenderTexture.name": choice("a", "b"),
    "RenderTexture.samples": choice(1, 4),
    "RenderTexture.scene": scene_of,
    "RenderTexture.size": lambda world, rng, thing: tuple(rng.integers(6, 20, 2).tolist()),
    "ProbeGrid.active": lambda world, rng, thing: rng.random(thing.active.shape) < 0.7,
    "ProbeGrid.coefficients": lambda world, rng, thing: rng.random(thing.coefficients.shape),
    "ProbeGrid.distances": lambda world, rng, thing: rng.random(thing.distances.shape),
    "ProbeGrid.normal_bias": number(0, 0.5),
    "ProbeGrid.size": choice(4, 8),
    "ProbeGrid.view_bias": number(0, 0.5),
    "ProbeGrid.visibility": flag,
    "RenderTexture.wrap": choice("clamp", "repeat", "mirror"),
    "Scene.background": lambda world, rng, thing: one(rng, None, rng.random(4), *world.cubes),
    "Scene.environment": lambda world, rng, thing: one(rng, None, random_cube(rng), *world.cubes),
    "Scene.environment_intensity": number(0, 2),
    "Scene.environment_rotation": lambda world, rng, thing: rng.normal(size=4),
    "Scene.probe_grid": lambda world, rng, thing: one(rng, None, *world.grids),
    "Scene.variant": variant,
    "Scene.variants": choice((), ("day", "night"), ("night", "dusk")),
    "Mesh.colors": lambda world, rng, thing: one(rng, None, rng.random(thing.positions.shape)),
    "Mesh.levels": lambda world, rng, thing: one(
        rng, (), [(thing.indices[: 1 + len(thing.indices) // 2], 0.01), (thing.indices[:1], 0.2)]
    ),
    "Mesh.morph_targets": targets_of,
    "Mesh.normals": lambda world, rng, thing: one(
        rng, None, rng.normal(size=thing.positions.shape)
    ),
    "Mesh.positions": lambda world, rng, thing: (
        thing.positions * rng.uniform(0.8, 1.2, 3) + rng.uniform(-0.1, 0.1, 3)
    ),
    "Mesh.tangents": lambda world, rng, thing: one(
        rng, None, np.c_[rng.normal(size=thing.positions.shape), np.ones(len(thing.positions))]
    ),
    "Mesh.uvs": lambda world, rng, thing: one(rng, None, rng.random((len(thing.positions), 2))),
    "Mesh.uvs1": lambda world, rng, thing: one(rng, None, rng.random((len(thing.positions), 2))),
    "Material.blend": blend,
    "Material.color_write": choice(True, False, (True, False, True, True)),
    "Material.depth_test": flag,
    "Material.depth_write": choice(None, False, True),
    "Material.double_sided": flag,
    "Material.flat_shading": flag,
    "Material.name": choice("a", "b"),
    "Material.opacity": choice(0.3, 0.7, 1),
    "Material.stencil": stencil,
    "BasicMaterial.color": color,
    "BasicMaterial.cubemap": cube_of,
    "BasicMaterial.map": map_of,
    "BasicMaterial.vertex_colors": flag,
    "PhongMaterial.color": color,
    "PhongMaterial.ka": number(0, 1),
    "PhongMaterial.kd": number(0, 1),
    "PhongMaterial.ks": number(0, 1),
    "PhongMaterial.map": map_of,
    "PhongMaterial.shininess": number(1, 30),
    "PhongMaterial.vertex_colors": flag,
    "MirrorMaterial.color": color,
    "MirrorMaterial.color_weight": number(0, 1),
    "MirrorMaterial.env_weight": number(0, 1),
    "MirrorMaterial.f0": choice(None, 0.1, 0.6),
    "MirrorMaterial.tint": color,
    "GlassMaterial.attenuation_color": vector(0.1, 1),
    "GlassMaterial.attenuation_distance": choice(float("inf"), 0.3, 2),
    "GlassMaterial.dispersion": choice(0, 0.5, 2),
    "GlassMaterial.ior": number(0.7, 2),
    "GlassMaterial.fresnel": flag,
    "GlassMaterial.roughness": choice(0, 0.3, 0.8),
    "GlassMaterial.surfaces": choice(1, 2),
    "GlassMaterial.tint": color,
    "StandardMaterial.alpha_cutoff": number(0, 1),
    "StandardMaterial.alpha_mode": choice(None, "opaque", "mask", "blend"),
    "StandardMaterial.anisotropy": number(0.2, 1),
    "StandardMaterial.anisotropy_map": placed_map,
    "StandardMaterial.anisotropy_rotation": number(-90, 90),
    "StandardMaterial.attenuation_color": vector(0.1, 1),
    "StandardMaterial.attenuation_distance": choice(float("inf"), 0.3, 2),
    "StandardMaterial.clearcoat": number(0.2, 1),
    "StandardMaterial.clearcoat_map": placed_map,
    "StandardMaterial.clearcoat_normal_map": placed_map,
    "StandardMaterial.clearcoat_normal_scale": number(-2, 2),
    "StandardMaterial.clearcoat_roughness": choice(0, 0.4, 1),
    "StandardMaterial.clearcoat_roughness_map": placed_map,
    "StandardMaterial.color": color,
    "StandardMaterial.dispersion": choice(0, 0.5, 3),
    "StandardMaterial.emissive": color,
    "StandardMaterial.emissive_map": placed_map,
    "StandardMaterial.emissive_strength": number(0, 2),
    "StandardMaterial.ior": choice(0, 1, 1.4, 2),
    "StandardMaterial.iridescence": choice(0, 0.4, 1),
    "StandardMaterial.iridescence_ior": number(1, 2),
    "StandardMaterial.iridescence_map": placed_map,
    "StandardMaterial.iridescence_thickness_map": placed_map,
    "StandardMaterial.iridescence_thickness_max": number(200, 600),
    "StandardMaterial.iridescence_thickness_min": number(0, 300),
    "StandardMaterial.map": placed_map,
    "StandardMaterial.metallic": choice(0, 0.4, 1),
    "StandardMaterial.metallic_roughness_map": placed_map,
    "StandardMaterial.multiple_scattering": flag,
    "StandardMaterial.normal_map": placed_map,
    "StandardMaterial.normal_scale": number(-2, 2),
    "StandardMaterial.occlusion_map": placed_map,
    "StandardMaterial.occlusion_strength": number(0, 1),
    "StandardMaterial.roughness": choice(0, 0.3, 0.8, 1),
    "StandardMaterial.sheen_color": color,
    "StandardMaterial.sheen_color_map": placed_map,
    "StandardMaterial.sheen_roughness": choice(0, 0.4, 1),
    "StandardMaterial.sheen_roughness_map": placed_map,
    "StandardMaterial.specular": choice("levels", "sampled"),
    "StandardMaterial.specular_color": color,
    "StandardMaterial.specular_color_map": placed_map,
    "StandardMaterial.specular_map": placed_map,
    "StandardMaterial.specular_samples": choice(1, 4, 9),
    "StandardMaterial.specular_weight": number(0, 1),
    "StandardMaterial.thickness": choice(0, 0.3, 0.6),
    "StandardMaterial.thickness_map": placed_map,
    "StandardMaterial.transmission": choice(0, 0.4, 1),
    "StandardMaterial.transmission_map": placed_map,
    "StandardMaterial.unlit": flag,
    "StandardMaterial.vertex_colors": flag,
    "ShaderMaterial.displacement": choice(None, 0.5, 1.0),
    "ShaderMaterial.fragment": choice(*SOURCES),
    "ShaderMaterial.textures": lambda world, rng, thing: {
        "picture": one(rng, random_image(rng), world.textures[0]),
        "around": one(rng, *world.cubes, *world.probes),
    },
    "ShaderMaterial.uniforms": uniforms_of_shader,
    "ShaderMaterial.vertex": choice(None, *VERTEX_SOURCES),
    "ImageEffect.fragment": choice(*EFFECT_SOURCES),
    "ImageEffect.textures": lambda world, rng, thing: {"veil": random_image(rng)},
    "ImageEffect.uniforms": lambda world, rng, thing: {"strength": float(rng.random())},
    "Light.color": color,
    "Light.intensity": number(0, 1.5),
    "PointLight.decay": choice(0, 1, 2),
    "PointLight.parent": some_node,
    "PointLight.position": vector(-4, 4),
    "PointLight.range": choice(3, 6, np.inf),
    "PointLight.shadow": shadow,
    "SpotLight.angle": number(20, 60),
    "SpotLight.decay": choice(0, 1, 2),
    "SpotLight.direction": vector(-3, -1),
    "SpotLight.parent": some_node,
    "SpotLight.penumbra": number(0, 1),
    "SpotLight.position": vector(1, 4),
    "SpotLight.range": choice(3, 6, np.inf),
    "SpotLight.shadow": shadow,
    "DirectionalLight.direction": vector(-3, -1),
    "DirectionalLight.parent": some_node,
    "DirectionalLight.shadow": shadow,
    "Camera.view": view,
    "PerspectiveCamera.far": number(3, 30),
    "PerspectiveCamera.fov": number(40, 90),
    "PerspectiveCamera.near": number(0.05, 1.5),
    "PerspectiveCamera.parent": some_node,
    "PerspectiveCamera.pixel_aspect": number(0.7, 1.4),
    "PerspectiveCamera.position": vector(1.5, 3),
    "PerspectiveCamera.shift": lambda world, rng, thing: rng.uniform(-0.3, 0.3, 2),
    "PerspectiveCamera.target": lambda world, rng, thing: one(rng, None, rng.uniform(-0.5, 0.5, 3)),
    "PerspectiveCamera.up": vector(0.1, 1),
    "OrthographicCamera.far": number(3, 30),
    "OrthographicCamera.height": number(3, 6),
    "OrthographicCamera.near": number(0.05, 2),
    "OrthographicCamera.parent": some_node,
    "OrthographicCamera.position": vector(-4, -2),
    "OrthographicCamera.target": lambda world, rng, thing: rng.uniform(-0.5, 0.5, 3),
    "OrthographicCamera.up": vector(0.1, 1),
    "StereoCamera.layout": choice("anaglyph", "side_by_side", "top_bottom"),
    "StereoCamera.left": lambda world, rng, thing: random_camera(rng),
    "StereoCamera.right": lambda world, rng, thing: random_camera(rng),
}

#: Edits of these properties can leave probes out of date on purpose. The values here, which are
#: set afterwards, make the probes catch up.
LATE = {"Probe.update": "on_change", "Probe.faces_per_frame": 6, "Probe.parallax": "none"}


def has_value(thing, attribute):
    """Whether an attribute can be read: a node with a sheared matrix has neither rotation nor scale."""
    try:
        getattr(thing, attribute)
    except ValueError:
        return False
    return True


def classes_below(kind):
    """A class and all classes of the stubs that inherit from it, in the order of the stubs."""
    found = [getattr(cc, node.name, None) for node in STUB_CLASSES]
    return [c for c in found if isinstance(c, type) and issubclass(c, kind)]


def names_of_edits():
    """The properties as "Class.name" for each class whose objects have them; Camera computes nothing for others."""
    for name in VALUES:
        class_name, attribute = name.split(".")
        kind = getattr(cc, class_name)
        below = [kind] if kind is cc.Camera else classes_below(kind)
        for thing in below:
            if thing not in (cc.Material, cc.Light):  # nothing is only that
                yield f"{thing.__name__}.{attribute}"


NAMES = tuple(names_of_edits())


def value_for(kind, attribute):
    """The entry of VALUES that a class has, or inherits."""
    return next(
        VALUES[name]
        for name in (f"{base.__name__}.{attribute}" for base in kind.__mro__)
        if name in VALUES
    )


def edit_property(name, world, rng, draw):
    """Set a property of a random object that has it. Returns the change in words, and a function to undo it."""
    class_name, attribute = name.split(".")
    kind = getattr(cc, class_name)
    thing = some(world, rng, kind)
    if not has_value(thing, attribute):
        able = [t for t in world.things(kind) if has_value(t, attribute)]
        if not able:  # every node has a shear
            return "nothing", None
        thing = one(rng, *able)
    old = getattr(thing, attribute)
    old = dict(old) if attribute in ("uniforms", "textures") else old
    setattr(thing, attribute, value_for(kind, attribute)(world, rng, thing))
    if f"{class_name}.{attribute}" in LATE:
        draw()
        node = random_node(world, rng)
        node.position = np.array(node.position) + rng.uniform(-0.3, 0.3, 3)
        draw()
        setattr(thing, attribute, LATE[name])
    return f"{name} of {thing!r}", lambda: setattr(thing, attribute, old)


def edit(name, world, rng, draw):
    """Make the edit of a name of NAMES, VALUES or METHODS. Returns it in words, and a function to undo it or None."""
    if name in METHODS:
        METHODS[name](world, rng, draw)
        return name, None
    return edit_property(name, world, rng, draw)


def method_set_face(world, rng, draw):
    cube = one(rng, *world.cubes)
    cube.set_face(int(rng.integers(6)), rng.random((4, 4, 3)).astype(np.float32))


def method_bake_a_grid(world, rng, draw):
    with cc.Renderer() as renderer:
        one(rng, *world.grids).bake(renderer, cc.Scene(background=rng.random(3)))


def method_add_node(world, rng, draw):
    scene = one(rng, *world.scenes)
    box, material = cc.Mesh.box(0.3), cc.PhongMaterial(color=rng.random(3))
    scene.add(box, material, position=rng.uniform(-2, 2, 3), name="added")


def method_remove_node(world, rng, draw):
    method_add_node(world, rng, draw)
    draw()
    for scene in world.scenes:
        for node in scene.nodes:
            if node.name == "added":
                scene.remove(node)


def method_add_and_remove_lights(world, rng, draw):
    lamp = world.scene.add(cc.SpotLight((0, 3, 0), shadow=cc.Shadow(size=16)))
    draw()
    world.scene.remove(lamp)


def method_set_time(world, rng, draw):
    node = random_node(world, rng)
    if not has_value(node, "rotation"):  # its matrix has a shear
        node.matrix = np.eye(4)
    turns = cc.AnimationChannel(node, "rotation", [0, 1], rng.normal(size=(2, 4)))
    sizes = cc.AnimationChannel(node, "scale", [0, 1], rng.uniform(0.5, 1.5, (2, 3)))
    animation = world.scene.add(cc.Animation([turns, sizes]))
    for seconds in rng.random(2):
        world.scene.set_time(seconds, animation)
        draw()
    world.scene.remove(animation)


def method_one_uniform(world, rng, draw):
    some(world, rng, cc.ShaderMaterial).uniforms["tone"] = rng.random(3)
    one(rng, *world.things(cc.ImageEffect)).uniforms["strength"] = float(rng.random())


def method_one_texture(world, rng, draw):
    material = some(world, rng, cc.ShaderMaterial)
    material.textures["around"] = one(rng, *world.cubes, *world.probes)


def method_update_a_mesh(world, rng, draw):
    mesh = one(rng, *world.meshes)
    mesh.update(positions=mesh.positions[:, [2, 0, 1]], colors=rng.random(mesh.positions.shape))


def method_bend_a_mesh(world, rng, draw):
    """Weights and joints change, together with what is drawn between the two."""
    for node in world.scene.nodes:
        if len(node.weights):
            node.weights = rng.uniform(-0.5, 1, len(node.weights))
    draw()
    for node in world.scene.nodes:
        if node.name == "joint":
            node.matrix = matrix(world, rng, node)


def method_move_the_camera(world, rng, draw):
    if world.cameras[0].target is None:  # by an earlier edit
        world.cameras[0].target = (0, 0, 0)
    world.cameras[0].orbit(yaw=float(rng.uniform(-30, 30)), pitch=5)
    world.cameras[0].walk(float(rng.uniform(-0.3, 0.3)))


def random_camera_of(world, rng):
    return one(rng, *(camera for camera in world.cameras if hasattr(camera, "target")))


def method_move_every_way(world, rng, draw):
    """All that moves a camera, in a random order."""
    camera = random_camera_of(world, rng)
    if camera.target is None:
        camera.target = (0, 0, 0)
    moves = [
        lambda: camera.yaw(float(rng.uniform(-20, 20))),
        lambda: camera.pitch(float(rng.uniform(-5, 5))),
        lambda: camera.look(rng.normal(size=3)),
        lambda: camera.strafe(float(rng.uniform(-0.3, 0.3))),
        lambda: camera.look_at(rng.uniform(-0.5, 0.5, 3)),
        lambda: camera.fit(one(rng, world.scene, np.array([[-2, -1, -2], [2, 2, 2]]))),
    ]
    for index in rng.permutation(len(moves))[:3]:
        moves[index]()
        draw()


def method_look_at(world, rng, draw):
    node = random_node(world, rng)
    if not has_value(node, "rotation"):
        node.matrix = np.eye(4)
    above = node.parent
    while above is not None:  # a shear above it makes a shear of any turn
        if not has_value(above, "rotation") or len(set(np.abs(above.scale))) > 1:
            above.matrix = np.eye(4)
        above = above.parent
    node.look_at(rng.uniform(-5, 5, 3))


def some_nodes(world, rng):
    scene = one(rng, *world.scenes)
    return scene, [node for node in scene.nodes if rng.random() < 0.4]


def method_set_positions(world, rng, draw):
    scene, nodes = some_nodes(world, rng)
    scene.set_positions(nodes, rng.uniform(-2, 2, (len(nodes), 3)))


def method_set_matrices(world, rng, draw):
    scene, nodes = some_nodes(world, rng)
    made = [matrix(world, rng, node) for node in nodes]
    scene.set_matrices(nodes, np.reshape(made, (-1, 4, 4)))


def method_clear(world, rng, draw):
    """A scene that a render texture may show is empty for a picture; then it has other nodes and another light."""
    scene = world.spare
    for texture in world.textures:
        if texture.scene is scene:
            texture.exclude = ()
    scene.clear()
    draw()
    scene.add(cc.PointLight(rng.uniform(1, 4, 3), shadow=cc.Shadow(size=16)))
    for height in (0.0, 1.0):
        material = one(rng, *world.things(cc.Material))
        scene.add(one(rng, *world.meshes), material, position=(0, height, 0))


def method_set_face_of_each_cube(world, rng, draw):
    for cube in world.cubes:
        cube.set_face(cc.Face(int(rng.integers(6))), rng.random((4, 4, 3)).astype(np.float32))


def method_play(world, rng, draw):
    """Several nodes of a scene, joints and weights too, at several moments of an animation that stays."""
    scene, interpolations = world.scene, ("linear", "step", "cubic")
    for animation in scene.animations[2:]:
        scene.remove(animation)
    channels = []
    for node in scene.nodes:
        if rng.random() < 0.6 or not has_value(node, "rotation"):
            continue
        way = one(rng, *interpolations)
        rows = 9 if way == "cubic" else 3
        widths = {"translation": 3, "rotation": 4, "scale": 3}
        if len(node.weights):
            widths["weights"] = len(node.weights)
        path = one(rng, *widths)
        values = rng.uniform(0.2, 1.2, (rows, widths[path]))
        times = np.cumsum(rng.uniform(0.1, 1, 3))
        channels.append(cc.AnimationChannel(node, path, times, values, interpolation=way))
    if not channels:
        return
    animation = scene.add(cc.Animation(channels, name="play"))
    for seconds in rng.uniform(-0.2, 3, 3):
        scene.set_time(float(seconds), animation)
        draw()


def method_show_variants(world, rng, draw):
    """Through all variants and back, while materials of the variants change."""
    scene = world.scene
    scene.variants = ("day", "night")
    nodes = [node for node in scene.nodes if node.material is not None and rng.random() < 0.3]
    for node in nodes:
        node.variants = {name: quick_material(world, rng) for name in scene.variants}
    for name in ("day", "night", None):
        scene.variant = name
        draw()
        for node in nodes[:2]:
            for material in node.variants.values():
                material.opacity = one(rng, 1, 1, 0.6)
                material.depth_write = one(rng, None, False)


def method_shadows_of_surfaces(world, rng, draw):
    """What a shadow map could forget: a caster changes in several ways between pictures."""
    nodes = [n for n in world.scene.nodes if n.mesh is not None and n.material is not None]
    for _ in range(3 if nodes else 0):
        node = one(rng, *nodes)
        node.material.depth_write = one(rng, None, False, True)
        node.material.blend = one(rng, None, None, "opaque", "additive")
        node.material.color_write = one(rng, True, True, False)
        if rng.random() < 0.5:
            draw()
        node.cast_shadow = one(rng, True, True, False)
        node.position = rng.uniform(-2, 2, 3)


def method_new_objects_in_old_places(world, rng, draw):
    """Meshes and materials end, and new ones may get their addresses: nothing may be known by an address."""
    nodes = [n for n in world.scene.nodes if n.name in ("added", "shown", "floor")]
    for _ in range(3):
        for node in nodes:
            node.mesh = cc.Mesh.box(float(rng.uniform(0.2, 0.6)))
            node.material = cc.PhongMaterial(color=rng.random(3))
        draw()
        for node in nodes:
            node.mesh = node.material = None
        gc.collect()


def method_another_topology(world, rng, draw):
    """Nodes of one mesh get another one, with other triangles and another number of vertices."""
    old = one(rng, *world.meshes[1:])
    ball = cc.Mesh.sphere(0.4, int(rng.integers(6, 14)), int(rng.integers(4, 8)))
    for node in world.scene.nodes:
        if node.mesh is old:
            node.mesh = ball
    world.meshes[world.meshes.index(old)] = ball


def method_light_parents(world, rng, draw):
    """Lights follow a node that then moves, of this scene or another one."""
    followed = some_node(world, rng, None)
    for light in world.scene.lights:
        if hasattr(light, "parent") and rng.random() < 0.7:
            light.parent = followed
    draw()
    if followed is not None:
        followed.matrix = matrix(world, rng, followed)


METHODS = {name[7:]: value for name, value in sorted(globals().items()) if name[:7] == "method_"}
