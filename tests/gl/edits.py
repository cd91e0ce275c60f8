"""Random edits of a FullWorld: one for every property with a setter in the stubs, and some method calls.

`VALUES` has for each property ("Class.name", the class being the one that declares it) a function of the world, a
random generator and the object to change, which gives a new value. If a property has
no such function, test_incremental.py fails, so that no property can be forgotten.
"""

import ast
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


def settable_properties():
    """ "Class.property" of every property with a setter, in the order of the stubs."""
    found = []
    classes = [node for node in ast.parse(STUB.read_text()).body if isinstance(node, ast.ClassDef)]
    for thing in classes:
        for member in thing.body:
            decorators = getattr(member, "decorator_list", ())
            if any(isinstance(d, ast.Attribute) and d.attr == "setter" for d in decorators):
                assert isinstance(member, ast.FunctionDef)
                found.append(f"{thing.name}.{member.name}")
    return found


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
    return {name: one(rng, *world.things(cc.Material)) for name in names if rng.random() < 0.7}


def variant(world, rng, thing):
    """One of the scene's variants, for which some nodes have a material."""
    if not thing.variants:
        thing.variants = ("day", "night")
    for node in thing.nodes[-3:]:
        node.variants = {"day": cc.PhongMaterial(color=rng.random(3))}
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


VALUES = {
    "Node.cast_shadow": flag,
    "Node.environment": cube_of,
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
    "Probe.depth_format": choice(*DEPTHS),
    "Probe.exclude": excluded,
    "Probe.faces_per_frame": choice(1, 2, 5),
    "Probe.far": number(1, 20),
    "Probe.format": choice(*FORMATS),
    "Probe.mipmaps": flag,
    "Probe.near": number(0.01, 0.6),
    "Probe.parent": some_node,
    "Probe.position": vector(-1, 1),
    "Probe.prefilter": choice(None, True, False),
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
    "RenderTexture.wrap": choice("clamp", "repeat", "mirror"),
    "Scene.background": lambda world, rng, thing: one(rng, None, rng.random(4), *world.cubes),
    "Scene.environment": lambda world, rng, thing: one(rng, None, random_cube(rng), *world.cubes),
    "Scene.environment_intensity": number(0, 2),
    "Scene.environment_rotation": lambda world, rng, thing: rng.normal(size=4),
    "Scene.variant": variant,
    "Scene.variants": choice((), ("day", "night"), ("night", "dusk")),
    "Mesh.colors": lambda world, rng, thing: one(rng, None, rng.random(thing.positions.shape)),
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
    "GlassMaterial.ior": number(0.7, 2),
    "GlassMaterial.fresnel": flag,
    "GlassMaterial.roughness": choice(0, 0.3, 0.8),
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
LATE = {"Probe.update": "on_change", "Probe.faces_per_frame": 6}


def has_value(thing, attribute):
    """Whether an attribute can be read: a node with a sheared matrix has neither rotation nor scale."""
    try:
        getattr(thing, attribute)
    except ValueError:
        return False
    return True


def edit_property(name, world, rng, draw):
    """Set a property of a random object that has it. Returns the change in words, and a function to undo it."""
    class_name, attribute = name.split(".")
    kind = getattr(cc, class_name)
    thing = some(world, rng, kind)
    if not has_value(thing, attribute):
        thing = one(rng, *(t for t in world.things(kind) if has_value(t, attribute)))
    old = getattr(thing, attribute)
    old = dict(old) if attribute in ("uniforms", "textures") else old
    setattr(thing, attribute, VALUES[name](world, rng, thing))
    if name in LATE:
        draw()
        node = random_node(world, rng)
        node.position = np.array(node.position) + rng.uniform(-0.3, 0.3, 3)
        draw()
        setattr(thing, attribute, LATE[name])
    return f"{name} of {thing!r}", lambda: setattr(thing, attribute, old)


def method_set_face(world, rng, draw):
    cube = one(rng, *world.cubes)
    cube.set_face(int(rng.integers(6)), rng.random((4, 4, 3)).astype(np.float32))


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


METHODS = {name[7:]: value for name, value in sorted(globals().items()) if name[:7] == "method_"}
