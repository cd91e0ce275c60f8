"""The objects that programs of api.py and pickles of pickles.py begin with, and what is done with them in the end."""

from __future__ import annotations

import contextlib
import copy
import functools
import pickle
from typing import Any

import numpy as np

import cubecam as cc
from tests.fuzz.hostile import HostileError
from tests.helpers import DEVICE

#: What a call may raise for absurd arguments.
EXPECTED = (TypeError, ValueError, AttributeError, LookupError, OSError, cc.Error, HostileError)
FRAGMENT = "uniform vec3 tone; uniform sampler2D veil; vec3 shade(Surface s) { return tone * texture(veil, s.uv).rgb; }"
EFFECT = "uniform float strength = 0.5; vec3 effect(vec2 uv) { return strength * frame(uv).rgb; }"


class World:
    """One object of every kind."""

    def __init__(self) -> None:
        self.cube = cc.CubeMap(np.full((6, 4, 4, 3), 0.5, np.float32))
        self.image = cc.Image(np.full((4, 5, 3), 200, np.uint8))
        self.scene = cc.Scene(environment=self.cube, background=(0.1, 0.2, 0.3))
        self.other = cc.Scene()
        box = cc.Mesh.box(0.5)
        upper = box.positions[:, 1:2] > 0
        self.target = cc.MorphTarget(positions=0.1 * box.normals)
        self.mesh = cc.Mesh(
            box.positions,
            box.indices,
            normals=box.normals,
            uvs=box.uvs,
            joints=np.tile((0, 1, 0, 0), (len(upper), 1)),
            joint_weights=np.c_[~upper, upper, 0 * upper, 0 * upper],
            morph_targets=[self.target],
        )
        self.texture = cc.Texture(self.image, scale=(2, 2))
        self.basic = cc.BasicMaterial(map=self.image)
        self.phong = cc.PhongMaterial(color=(0.5, 0.6, 0.7))
        self.mirror = cc.MirrorMaterial()
        self.glass = cc.GlassMaterial()
        self.standard = cc.StandardMaterial(map=self.texture)
        self.shader = cc.ShaderMaterial(
            FRAGMENT, uniforms={"tone": (1, 0.5, 0.2)}, textures={"veil": self.image}
        )
        self.effect = cc.ImageEffect(EFFECT)
        self.shadow = cc.Shadow(size=16)
        self.point = self.scene.add(cc.PointLight(position=(1, 2, 1), shadow=self.shadow))
        self.spot = self.scene.add(cc.SpotLight((0, 3, 1), (0, -1, 0)))
        self.sun = self.scene.add(cc.DirectionalLight((-1, -2, 0)))
        self.ambient = self.scene.add(cc.AmbientLight(intensity=0.1))
        self.probe = cc.Probe(size=4)
        self.grid = cc.ProbeGrid(((-1, -1, -1), (1, 1, 1)), (2, 2, 2), size=2, resolution=4)
        self.group = self.scene.add(name="group")
        joints = [self.scene.add(parent=self.group), self.scene.add(position=(0, 0.2, 0))]
        self.skin = cc.Skin(joints)
        self.bent = self.scene.add(self.mesh, self.phong, skin=self.skin, weights=[0.5])
        self.node = self.scene.add(cc.Mesh.sphere(0.3, 8, 4), self.basic, position=(0.5, 0, 0))
        self.ball = self.scene.add(
            cc.Mesh.plane(1, 1), self.mirror, position=(0, -0.5, 0), environment=self.probe
        )
        self.camera = self.scene.add(cc.PerspectiveCamera(position=(1, 1, 2), target=(0, 0, 0)))
        self.flat = cc.OrthographicCamera(height=3, position=(0, 0, 3), target=(0, 0, 0))
        self.matrices = cc.Camera(view=self.camera.view, projection=self.flat.projection(aspect=1))
        self.stereo = cc.StereoCamera.off_axis(self.camera, convergence=2)
        self.screen = cc.RenderTexture(self.scene, self.flat, size=(5, 4))
        self.channel = cc.AnimationChannel(self.node, "translation", [0, 1], [(0, 0, 0), (1, 0, 0)])
        self.animation = self.scene.add(cc.Animation([self.channel]))
        self.blend = cc.Blend("one", "zero")
        self.stencil = cc.Stencil()
        self.frame = renderer().render(self.other, self.camera, (2, 2), outputs=("id",))

    @property
    def renderer(self) -> cc.Renderer:
        """The renderer of all worlds."""
        return renderer()


@functools.cache
def _renderers() -> list[cc.Renderer]:
    return []


def renderer() -> cc.Renderer:
    """The renderer of this process; a new one if a program has closed the last one."""
    held = _renderers()
    if not held or held[-1].closed:
        held[:] = [cc.Renderer(device=DEVICE)]
    return held[-1]


@contextlib.contextmanager
def expected() -> Any:
    """Let the errors pass that absurd arguments may give; RecursionError and other RuntimeErrors are a fault."""
    try:
        yield
    except EXPECTED:
        pass
    except MemoryError as error:
        if "Unable to allocate" not in str(
            error
        ):  # numpy's own words; cubecam checks before it allocates
            raise


def use(thing: Any, world: World) -> None:
    """Do with an object what can be done: show it, copy it, add it to the scene."""
    if not type(thing).__module__.startswith("cubecam"):
        return
    with expected():
        repr(thing)
    with expected():
        copy.copy(thing)
    with expected():
        pickle.loads(pickle.dumps(thing))
    with expected():
        if isinstance(thing, cc.Mesh):
            world.scene.add(thing, world.phong)
        elif isinstance(thing, cc.Material):
            world.node.material = thing
        elif isinstance(thing, (cc.CubeMap, cc.Probe)):
            world.ball.environment = thing
        elif isinstance(thing, (cc.Image, cc.RenderTexture, cc.Texture)):
            world.standard.map = thing
        elif isinstance(thing, (cc.Light, cc.Animation, cc.Camera)):
            world.scene.add(thing)
        elif isinstance(thing, cc.ProbeGrid):
            world.scene.probe_grid = thing
        elif isinstance(thing, cc.Shadow):
            world.sun.shadow = thing
        elif isinstance(thing, cc.Scene):
            thing.add(world.mesh, world.phong)
            renderer().render(thing, world.flat, (6, 5))
    with expected():
        if isinstance(thing, (cc.Camera, cc.StereoCamera)):
            renderer().render(world.scene, thing, (8, 6))


def draw(world: World, number: int) -> None:
    """Draw the scene in one of five ways; a program that is new takes a renderer seconds."""
    with expected():
        if number % 5 == 0:
            renderer().render(world.scene, world.camera, (8, 6), outputs=("id", "distance"))
        elif number % 5 == 1:
            renderer().render(world.scene, world.flat, (6, 5), effects=[world.effect], samples=4)
        elif number % 5 == 2:
            renderer().capture(world.scene, size=4)
        elif number % 5 == 3:
            world.scene.set_time(0.3)
            copied = copy.deepcopy(world.scene)
            renderer().render(copied, world.stereo, (8, 6))
        else:
            renderer().render(world.scene, world.camera, (8, 6), format="rgba32f")
            renderer().shadow_map(world.scene, world.point)
