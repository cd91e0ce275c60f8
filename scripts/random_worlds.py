"""Random scenes that combine all features of the renderer, for comparing two versions.

A world depends on its number alone. The code uses the names of the present version; `Names` finds the names that
the imported version has for the same things.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import cubecam as cc

STEPS = 3  # a world is drawn, changed, and drawn again by the same renderer
OUTPUTS = ("distance", "z", "normal", "position", "id")

#: Old names of properties and of the keywords that set them.
PROPERTIES = {
    "in_captures": "in_probes",
    "cast_shadow": "casts_shadows",
    "receive_shadow": "receives_shadows",
}
#: Old names of the renderer's methods.
METHODS = {"update_probes": "update", "read_probe": "cubemap", "read_texture": "texture"}


class Names:
    """Functions by their present names, also if the imported version has older names."""

    @staticmethod
    def node(name: str) -> str:
        return name if hasattr(cc.Node, name) else PROPERTIES.get(name, name)

    @classmethod
    def add(cls, scene: Any, *parts: Any, **options: Any) -> Any:
        return scene.add(*parts, **{cls.node(key): value for key, value in options.items()})

    @staticmethod
    def method(renderer: Any, name: str) -> Callable[..., Any]:
        method: Callable[..., Any] = getattr(
            renderer, name if hasattr(cc.Renderer, name) else METHODS[name]
        )
        return method

    @staticmethod
    def glass(ior: float, **options: Any) -> Any:
        if hasattr(cc.GlassMaterial, "ior"):
            return cc.GlassMaterial(ior=ior, **options)
        options["eta"] = 1 / ior
        return cc.GlassMaterial(**options)

    @staticmethod
    def mirror(f0: float | None, **options: Any) -> Any:
        options["f0" if hasattr(cc.MirrorMaterial, "f0") else "fresnel"] = f0
        return cc.MirrorMaterial(**options)


TONE = "uniform vec3 tone = vec3(0.2, 0.7, 0.4); vec3 shade(Surface s) { return tone * abs(s.normal); }"
REFLECTION = """uniform float share = 0.6;
vec3 shade(Surface s) { return share * environment(reflect(s.incident, s.normal)) + 0.2 * s.color.rgb; }"""
LIT = "vec4 shade(Surface s) { return vec4(phong(s, vec3(0.8, 0.5, 0.3), 0.2, 0.7, 0.5, 12.0), 0.6); }"
LIGHTS = """vec3 shade(Surface s) {
    vec3 sum = vec3(0.05);
    for (int i = 0; i < light_count(); ++i) {
        LightSample light = sample_light(i, s);
        sum += light.radiance * max(dot(light.direction, s.normal), 0.0);
    }
    return sum + schlick(s, 0.1) * environment_lod(s.normal, 1.0);
}"""
PICTURES = """uniform sampler2D picture; uniform samplerCube around;
vec3 shade(Surface s) {
    return 0.5 * texture(picture, s.uv).rgb + 0.5 * texture(around, s.normal_object).rgb;
}"""
HEIGHT = "in float height; vec3 shade(Surface s) { return vec3(fract(height), s.uv); }"
FRAGMENTS = (TONE, REFLECTION, LIT, LIGHTS, PICTURES, HEIGHT)
VERTEX = """uniform float time = 0.3; out float height;
void vertex(inout Vertex v) {
    v.position += 0.1 * sin(7.0 * v.position.yzx + time) * v.normal;
    height = v.position.y;
}"""
MIX = """uniform float strength = 0.5;
vec3 effect(vec2 uv) {
    return mix(frame(uv).rgb, frame_pixel(ivec2(gl_FragCoord.xy) + ivec2(1, -1)).bgr, strength);
}"""
VEIL = """uniform sampler2D picture;
vec4 effect(vec2 uv) { return frame(uv.yx) * (0.5 + 0.5 * texture(picture, uv)); }"""
EFFECTS = (MIX, VEIL)


class World:
    """A scene, the things in it that can be changed, and the cameras and options of its pictures."""

    def __init__(self, number: int) -> None:
        self.rng = np.random.default_rng(number)
        self.images = [self.image() for _ in range(3)]
        self.cubes = [self.cube() for _ in range(2)]
        self.meshes = self.some_meshes()
        self.textures: list[Any] = []
        self.probes: list[Any] = []
        self.materials: list[Any] = []
        self.inner = self.scene(nodes=4, lights=2)
        for _ in range(self.integer(0, 2)):
            self.textures.append(self.render_texture(self.inner))
        many = number % 5 == 4
        self.outer = self.scene(
            nodes=150 if many else self.integer(8, 24), lights=self.integer(1, 7)
        )
        for index, texture in enumerate(self.textures):
            material = self.one(cc.BasicMaterial, cc.PhongMaterial)(map=texture)
            Names.add(self.outer, self.meshes[0], material, position=(index, 1.5, 0.5), scale=1.5)
        if self.chance(0.4):  # a monitor in the room that it shows
            self.monitor()

    # Random numbers

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def integer(self, low: int, high: int) -> int:
        return int(self.rng.integers(low, high + 1))

    def number(self, low: float, high: float) -> float:
        """A number that float32 holds exactly, so that no version rounds it in its own way."""
        return float(np.float32(self.rng.uniform(low, high)))

    def numbers(self, low: float, high: float, count: int = 3) -> list[float]:
        return [self.number(low, high) for _ in range(count)]

    def one(self, *choices: Any) -> Any:
        return choices[int(self.rng.integers(len(choices)))]

    # Parts

    def image(self) -> Any:
        shape = (self.integer(3, 9), self.integer(3, 9), self.one(1, 3, 4))
        pixels = self.rng.random(shape).astype(np.float32)
        if self.chance(0.5):
            pixels = (pixels * 255).astype(np.uint8)
        return cc.Image(pixels, mipmaps=self.chance(0.5), wrap=self.one("repeat", "clamp"))

    def cube(self) -> Any:
        faces = self.rng.random((6, 8, 8, self.one(3, 4)), dtype=np.float32)
        return cc.CubeMap(faces, mipmaps=self.chance(0.5))

    def some_meshes(self) -> list[Any]:
        ball = cc.Mesh.sphere(0.5, 16, 8)
        colors = self.rng.random((len(ball.positions), 3)).astype(np.float32)
        colored = cc.Mesh(
            ball.positions, ball.indices, normals=ball.normals, uvs=ball.uvs, colors=colors
        )
        return [
            cc.Mesh.box(self.numbers(0.3, 1.0)),
            cc.Mesh.sphere(0.4, 24, 12),
            colored,
            cc.Mesh.torus(0.4, 0.15, 20, 10),
            cc.Mesh.cone(0.4, 0.8, 16),
            cc.Mesh.plane(1.2, 0.8),
            cc.Mesh.icosphere(0.4, 1),
        ]

    def stencil(self) -> Any:
        if self.chance(0.85):
            return None
        words = ("keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert")
        return cc.Stencil(
            func=self.one("always", "equal", "less", "gequal", "notequal"),
            reference=self.integer(0, 3),
            read_mask=self.one(255, 3),
            write_mask=self.one(255, 1),
            fail=self.one(*words),
            depth_fail=self.one(*words),
            depth_pass=self.one(*words),
        )

    def surface(self) -> dict[str, Any]:
        """The keyword arguments that every material takes."""
        options: dict[str, Any] = {"stencil": self.stencil(), "double_sided": self.chance(0.3)}
        if self.chance(0.3):
            options["opacity"] = self.number(0.2, 0.9)
        if self.chance(0.2):
            blends = ("opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied")
            options["blend"] = self.one(*blends)
        if self.chance(0.1):
            options["depth_write"] = self.chance(0.5)
        if self.chance(0.1):
            options["depth_test"] = False
        if self.chance(0.1):
            options["color_write"] = tuple(self.chance(0.7) for _ in range(4))
        return options

    def map(self) -> Any:
        if self.chance(0.4):
            return None
        return self.one(*self.images, *self.textures)

    def around(self) -> Any:
        """A cubemap or a probe to use as an environment."""
        if self.chance(0.4):
            return self.one(*self.cubes)
        if self.probes and self.chance(0.3):
            return self.one(*self.probes)
        self.probes.append(
            cc.Probe(
                position=self.numbers(-2, 2),
                size=self.integer(8, 20),
                near=0.0625,
                far=self.one(5.0, 100.0),
                format=self.one("rgba16f", "rgba8", "rgba32f", "rgb565"),
                mipmaps=self.chance(0.4),
                samples=self.one(1, 1, 4),
                update=self.one("on_change", "on_change", "once", 2),
                faces_per_frame=self.one(6, 6, 2),
                parallax=self.one("none", "box", "sphere", "distance", "layers"),
                box=((-2, -1.5, -3), (3, 2, 1)),
                fetches=self.one(6, 14, 35),
                depth_format=self.one(
                    "depth_component32f", "depth_component24", "depth24_stencil8"
                ),
            )
        )
        return self.probes[-1]

    def material(self) -> Any:
        color = self.numbers(0, 1, self.one(3, 4))
        kind = self.one("basic", "basic", "phong", "phong", "mirror", "glass", "shader")
        surface = self.surface()
        if kind == "basic":
            return cc.BasicMaterial(
                color=color,
                map=self.map(),
                cubemap=self.around() if self.chance(0.2) else None,
                vertex_colors=self.chance(0.3),
                **surface,
            )
        if kind == "phong":
            return cc.PhongMaterial(
                color=color,
                ka=self.number(0, 0.4),
                kd=self.number(0, 1),
                ks=self.number(0, 1),
                shininess=self.number(1, 40),
                map=self.map(),
                vertex_colors=self.chance(0.3),
                **surface,
            )
        if kind == "mirror":
            return Names.mirror(
                self.one(None, 0.25, 0.5),
                color=color[:3],
                env_weight=self.number(0.3, 1),
                color_weight=self.number(0, 0.5),
                tint=self.numbers(0.5, 1),
                **surface,
            )
        if kind == "glass":
            return Names.glass(
                self.one(1.25, 1.5, 2.0),
                fresnel=self.chance(0.5),
                tint=self.numbers(0.5, 1),
                **surface,
            )
        return self.shader(surface)

    def shader(self, surface: dict[str, Any]) -> Any:
        fragment = self.one(*FRAGMENTS)
        options: dict[str, Any] = {}
        if "height" in fragment or ("around" not in fragment and self.chance(0.3)):
            options["vertex"] = VERTEX
            options["displacement"] = self.one(None, 0.1)
            options["uniforms"] = {"time": self.number(0, 6)}
            if "height" not in fragment:
                fragment = "in float height; " + fragment
        if "picture" in fragment:
            options["textures"] = {
                "picture": self.one(*self.images, *self.textures),
                "around": self.around(),
            }
        return cc.ShaderMaterial(fragment, **options, **surface)

    def shadow(self) -> Any:
        if self.chance(0.5):
            return None
        return cc.Shadow(
            size=self.integer(24, 64),
            radius=self.one(0, 1, 1.5),
            bias=self.one(0, 0.0625),
            far=self.one(None, 6.0),
            extent=self.one(None, 5.0),
        )

    def light(self) -> Any:
        color, intensity = self.numbers(0.1, 1), self.number(0.2, 1)
        kind = self.one("point", "point", "spot", "directional", "ambient")
        if kind == "ambient":
            return cc.AmbientLight(color=color, intensity=intensity)
        more = {"color": color, "intensity": intensity, "shadow": self.shadow()}
        if kind == "directional":
            return cc.DirectionalLight(direction=self.numbers(-1, -0.1), **more)
        more["decay"] = self.one(0, 1, 2)
        position = self.numbers(-4, 4)
        if kind == "point":
            return cc.PointLight(position=position, **more)
        return cc.SpotLight(
            position=position,
            direction=[-x for x in position],
            angle=self.number(20, 70),
            penumbra=self.number(0, 1),
            **more,
        )

    def place(self) -> dict[str, Any]:
        place: dict[str, Any] = {"position": self.numbers(-2.5, 2.5)}
        if self.chance(0.7):
            place["rotation"] = cc.axis_angle(self.numbers(0.1, 1), self.number(0, 360))
        if self.chance(0.5):
            place["scale"] = self.one(-1, 1) * self.number(0.5, 1.5)
            if self.chance(0.3):
                place["scale"] = self.numbers(0.4, 1.6)
        return place

    def scene(self, nodes: int, lights: int) -> Any:
        background = self.one(
            None, self.numbers(0, 1), self.numbers(0, 1, 4), self.one(*self.cubes)
        )
        scene = cc.Scene(environment=self.one(None, *self.cubes), background=background)
        for _ in range(lights):
            scene.add(self.light())
        groups = [None, None, Names.add(scene, **self.place())]
        palette = [self.material() for _ in range(max(3, nodes // 4 if nodes < 50 else 6))]
        self.materials += palette
        for index in range(nodes):
            if self.chance(0.05):
                groups.append(Names.add(scene, parent=groups[-1], **self.place()))
            Names.add(
                scene,
                self.one(*self.meshes),
                self.one(*palette),
                parent=self.one(*groups),
                environment=self.around() if nodes < 50 and self.chance(0.2) else None,
                visible=self.chance(0.95),
                in_captures=self.chance(0.9),
                cast_shadow=self.chance(0.8),
                receive_shadow=self.chance(0.8),
                render_order=self.one(0, 0, 0, 1, -1),
                name=f"node {index}",
                **self.place(),
            )
        if self.chance(0.6):
            Names.add(
                scene, cc.Mesh.plane(7, 7), cc.PhongMaterial(color=self.numbers(0.4, 1)),
                position=(0, -2.75, 0),
            )  # fmt: skip
        return scene

    def effects(self) -> list[Any]:
        made = []
        for _ in range(self.one(0, 0, 1, 2)):
            source = self.one(*EFFECTS)
            textures = {"picture": self.one(*self.images)} if "picture" in source else None
            made.append(cc.ImageEffect(source, textures=textures))
        return made

    def render_texture(self, scene: Any, **options: Any) -> Any:
        return cc.RenderTexture(
            scene,
            self.camera(),
            size=(self.integer(9, 40), self.integer(9, 40)),
            format=self.one("rgba8", "rgba16f", "rgba32f", "rgb565"),
            samples=self.one(1, 4),
            mipmaps=self.chance(0.4),
            wrap=self.one("clamp", "repeat"),
            effects=self.effects(),
            depth_format=self.one("depth_component32f", "depth_component24", None),
            **options,
        )

    def monitor(self) -> None:
        """A screen that shows the room it stands in; probes do not see it, since the picture shows mirrors."""
        screen = Names.add(
            self.outer,
            cc.Mesh.box(0.9),
            cc.PhongMaterial(color=(1, 1, 1)),
            position=(1, 0.5, 1),
            in_captures=False,
        )
        texture = self.render_texture(self.outer, exclude=[screen], name="monitor")
        screen.material.map = texture
        self.textures.append(texture)

    # Looking

    def camera(self) -> Any:
        position, target = self.numbers(2, 5), self.numbers(-0.5, 0.5)
        kind = self.one("perspective", "perspective", "orthographic", "matrices")
        if kind == "orthographic":
            return cc.OrthographicCamera(
                height=self.number(3, 6), position=position, target=target, near=0.125, far=50
            )
        camera = cc.PerspectiveCamera(
            fov=self.number(40, 90),
            position=position,
            target=target,
            near=self.one(0.125, 1.0),
            far=self.one(7.0, 100.0),
            shift=self.one((0, 0), (0.25, -0.125)),
        )
        if kind == "matrices":
            return cc.Camera(view=camera.view, projection=camera.projection(aspect=1.5))
        return camera

    def frame(self) -> tuple[Any, tuple[int, int], dict[str, Any]]:
        """A camera, a size and the options of a picture."""
        camera = self.camera()
        outputs: tuple[str, ...] = OUTPUTS
        size = (2 * self.integer(20, 70), 2 * self.integer(15, 50))
        if self.chance(0.15) and hasattr(camera, "position"):
            layout = self.one("anaglyph", "side_by_side", "top_bottom")
            camera = cc.StereoCamera.off_axis(camera, separation=0.125, layout=layout)
            outputs = () if layout == "anaglyph" else outputs
        options: dict[str, Any] = {
            "format": self.one("rgba8", "rgba8", "rgba16f", "rgba32f", "rgb565"),
            "samples": self.one(1, 1, 4),
            "tonemap": self.one(None, None, "reinhard", "aces", "neutral"),
            "encode": self.one(None, "srgb"),
            "effects": self.effects(),
            "depth_format": self.one(
                "depth_component32f", "depth32f_stencil8", "depth24_stencil8", "depth_component16",
                "stencil_index8", None,
            ),
        }  # fmt: skip
        depth_format = options["depth_format"]
        if depth_format in (None, "stencil_index8"):
            outputs = ()
        elif outputs:
            outputs = (*outputs, "depth")
        if depth_format is not None and "stencil" in depth_format and camera_has_outputs(camera):
            outputs = (*outputs, "stencil")
        return camera, size, {**options, "outputs": outputs}

    def capture(self) -> dict[str, Any]:
        """The options of a capture."""
        stencil = self.chance(0.3)
        return {
            "position": self.numbers(-1, 1),
            "size": self.integer(12, 40),
            "near": 0.0625,
            "far": self.one(6.0, 100.0),
            "exclude": [self.one(*self.outer.nodes)],
            "outputs": (*OUTPUTS, "depth", *(["stencil"] if stencil else [])),
            "format": self.one("rgba32f", "rgba16f", "rgba8", "rgb565"),
            "samples": self.one(1, 1, 4),
            "eye": self.one(None, (0.5, 1.0, 0.25)),
            "depth_format": "depth24_stencil8" if stencil else "depth_component32f",
        }

    def change(self) -> None:
        """Change things of the world, as happens between two steps."""
        nodes = self.outer.nodes + self.inner.nodes
        for _ in range(self.integer(1, 4)):
            node = self.one(*nodes)
            what = self.one(
                "move", "move", "turn", "hide", "color", "light", "probe", "remove", "cast"
            )
            if what == "move":
                node.position = self.numbers(-2.5, 2.5)
            elif what == "turn":
                node.rotation = cc.axis_angle(self.numbers(0.1, 1), self.number(0, 360))
            elif what == "hide":
                node.visible = not node.visible
            elif what == "color":
                material = self.one(*self.materials)
                material.opacity = self.one(1.0, 0.5)
                if hasattr(material, "color"):
                    material.color = self.numbers(0, 1)
            elif what == "light":
                light = self.one(*self.outer.lights)
                light.intensity = self.number(0.2, 1.2)
                if hasattr(light, "position"):
                    light.position = self.numbers(-4, 4)
            elif what == "probe" and self.probes:
                self.one(*self.probes).position = self.numbers(-2, 2)
            elif what == "remove" and node in self.outer and node.mesh is not None:
                if node.name.startswith("node"):
                    self.outer.remove(node)
                    nodes = self.outer.nodes + self.inner.nodes
            elif what == "cast":
                name = Names.node("cast_shadow")
                setattr(node, name, not getattr(node, name))


def camera_has_outputs(camera: Any) -> bool:
    """Whether pictures of a camera have outputs: an anaglyph has none."""
    return getattr(camera, "layout", "") != "anaglyph"


def attempt(
    arrays_of: Callable[..., dict[str, Any]], call: Any, *given: Any, **options: Any
) -> Any:
    """Return the arrays of a call's result, or the kind of its error: both versions must refuse the same calls."""
    try:
        return arrays_of(call(*given, **options))
    except (ValueError, cc.Error) as error:
        return {"error": np.array(type(error).__name__), "message": np.array(str(error))}


def of_frame(frame: Any) -> dict[str, Any]:
    names = ("color", *OUTPUTS, "depth", "stencil")
    return {name: getattr(frame, name) for name in names if getattr(frame, name) is not None}


def of_cube(cube: Any) -> dict[str, Any]:
    names = ("faces", *OUTPUTS, "depth", "stencil")
    return {name: getattr(cube, name) for name in names if getattr(cube, name) is not None}


def of_array(array: Any) -> dict[str, Any]:
    return {"color": array}


def pictures(number: int, renderer: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Draw a world step by step, and yield the name and the arrays of each picture."""
    world = World(number)
    for step in range(STEPS):
        camera, size, options = world.frame()
        yield (
            f"frame{step}",
            attempt(of_frame, renderer.render, world.outer, camera, size, **options),
        )
        options = world.capture()
        yield f"capture{step}", attempt(of_cube, renderer.capture, world.outer, **options)
        for index, light in enumerate(world.outer.lights):
            if getattr(light, "shadow", None) is not None:
                name = f"shadow{step}.{index}"
                yield name, attempt(of_array, renderer.shadow_map, world.outer, light)
        if step == STEPS - 1:
            for index, probe in enumerate(world.probes):
                read = Names.method(renderer, "read_probe")
                yield f"probe{index}", attempt(of_cube, read, probe)
            for index, texture in enumerate(world.textures):
                read = Names.method(renderer, "read_texture")
                yield f"texture{index}", attempt(of_array, read, texture)
        world.change()
