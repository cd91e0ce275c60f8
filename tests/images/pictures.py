"""The scenes whose small pictures are committed; scripts/compare_versions.py draws them as well."""

import functools

import cubecam as cc
from cubecam import examples

SIZE = 96


def surroundings(name, size=64):
    return cc.load_environment(cc.sample_data(f"{name}.exr"), size=size)


def bunny(size=1.4):
    return cc.load_mesh(cc.sample_data("bunny.obj"), size=size)


def front(renderer, scene, **more):
    camera = cc.PerspectiveCamera(fov=40, position=(1.5, 1.5, 4), target=(0, 0, 0))
    options = {"samples": 4, "tonemap": "neutral", "encode": "srgb", **more}
    return renderer.render(scene, camera, (SIZE, SIZE), **options).color


def draw_materials(renderer):
    """The four materials side by side at sunset."""
    scene = cc.Scene(environment=surroundings("sunset"))
    scene.add(cc.PointLight(position=(3, 4, 3)))
    materials = [
        cc.BasicMaterial(color=(0.9, 0.3, 0.1)),
        cc.PhongMaterial(color=(0.2, 0.5, 0.9)),
        cc.MirrorMaterial(tint=(1, 0.9, 0.7)),
        cc.GlassMaterial(ior=1.52),
    ]
    for index, material in enumerate(materials):
        scene.add(
            cc.Mesh.sphere(0.5),
            material,
            position=(1.1 * (index % 2) - 0.55, 0.55 - 1.1 * (index // 2), 0),
        )
    return front(renderer, scene)


def draw_reflection(renderer):
    """The scene of the front page: a mirror ball that shows bunny and teapot."""
    scene = cc.Scene(environment=surroundings("forest"))
    scene.add(cc.PointLight(position=(3, 4, 3)))
    scene.add(cc.Mesh.plane(10, 10), cc.PhongMaterial(color=(0.4, 0.4, 1)), position=(0, -0.8, 0))
    scene.add(bunny(1), cc.PhongMaterial(color=(1, 0.4, 0.4)), position=(1.2, -0.3, 0.6))
    teapot = cc.load_mesh(cc.sample_data("teapot.obj"), size=1)
    scene.add(teapot, cc.PhongMaterial(color=(0.4, 1, 0.4)), position=(-1.2, -0.4, 0.4))
    ball = scene.add(
        cc.Mesh.sphere(0.6),
        cc.MirrorMaterial(color=(0.95, 0.85, 0.4), env_weight=0.78, color_weight=0.3),
    )
    ball.environment = cc.Probe(position=(0, 0, 0), size=64)
    return front(renderer, scene)


def draw_capture(renderer):
    """A captured cube as a cross, in the convention whose faces look as seen from inside."""
    scene = cc.Scene(environment=surroundings("sunset"))
    scene.add(cc.PointLight(position=(3, 4, 3)))
    scene.add(bunny(), cc.PhongMaterial(color=(1, 0.4, 0.4)), position=(0, 0, -2))
    cube = renderer.capture(scene, size=32, format="rgba8", samples=4)
    return cube.to_layout("cross", convention="inside")


def draw_translucent(renderer):
    """A bunny behind coloured panes."""
    scene = cc.Scene(background=(0.8, 0.85, 0.9))
    scene.add(cc.PointLight(position=(3, 4, 3)))
    scene.add(bunny(), cc.PhongMaterial(color=(0.7, 0.6, 0.5)), position=(0, 0, -0.5))
    for x, color in ((-0.4, (1, 0, 0)), (0, (0, 1, 0)), (0.4, (0, 0, 1))):
        pane = cc.BasicMaterial(color=color, opacity=0.4, double_sided=True)
        scene.add(
            cc.Mesh.plane(1, 1),
            pane,
            position=(x, x, 0.8 + x),
            rotation=cc.axis_angle((1, 0, 0), 90),
        )
    return front(renderer, scene, tonemap=None)


def program_still(name, renderer):
    """The still picture of one of the documents' programs, with its document's numbers, small."""
    module = examples.load(name)
    program = module.build(document=True)
    width, height = examples.size_of(module, program)
    size = (64 * width // height, 64)
    return module.draw(program, renderer, examples.still_of(module, program), size=size)


PICTURES = {name[5:]: draw for name, draw in sorted(globals().items()) if name.startswith("draw_")}
for number, name in enumerate(examples.NAMES, start=1):
    PICTURES[f"p{number:02}_{name}"] = functools.partial(program_still, name)
