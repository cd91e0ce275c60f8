"""Program P14 written for cubecam."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

import cubecam as cc

from .. import scene


class Program:
    """The scene of P14 and a renderer.

    With `redraw=True` the light's intensity alternates between 1 and the next float: no pixel changes
    visibly, but every view has changed, so that every face is drawn for every frame.
    """

    def __init__(self, actor: scene.MeshArrays, redraw: bool = False) -> None:
        self.redraw = redraw
        self.scene = cc.Scene(background=scene.CLEAR)
        self.light = self.scene.add(cc.PointLight(position=scene.LIGHT))
        self.scene.add(
            _mesh(scene.ground_mesh()),
            _phong(scene.GROUND_COLOR),
            position=scene.GROUND_POSITION,
        )
        body = _mesh(actor)
        self.actors = [self.scene.add(body, _phong(color)) for color in scene.ACTOR_COLORS]
        ball = self.scene.add(
            _mesh(scene.sphere_mesh(scene.BALL_RADIUS)),
            cc.MirrorMaterial(
                env_weight=scene.ENV_WEIGHT,
                color=scene.BALL_COLOR,
                color_weight=scene.COLOR_WEIGHT,
            ),
        )
        ball.environment = cc.Probe(
            position=(0, 0, 0),
            size=scene.FACE_SIZE,
            near=scene.NEAR,
            far=scene.FAR,
            format="rgba8",
        )
        self.camera = cc.PerspectiveCamera(
            fov=scene.FOV, position=scene.EYE, target=(0, 0, 0), near=scene.NEAR, far=scene.FAR
        )
        self.renderer = cc.Renderer()

    def frame(self, index: int) -> np.ndarray:
        """(512, 512, 4) uint8, row 0 on top."""
        for actor, position in zip(self.actors, scene.actor_positions(index), strict=True):
            actor.position = position
        if self.redraw:
            self.light.intensity = 1.0 if index % 2 else math.nextafter(1.0, 0.0) - 1e-7
        return self.renderer.render(self.scene, self.camera, size=scene.FRAME_SIZE).color

    def views_drawn(self) -> int:
        """How many views the last frame drew, of the seven it needs."""
        return int(self.renderer.stats.views_drawn)

    def versions(self) -> dict[str, str]:
        info = self.renderer.info
        return {"cubecam": cc.__version__, "renderer": str(info.renderer), "gl": str(info.version)}


def _mesh(arrays: scene.MeshArrays) -> cc.Mesh:
    return cc.Mesh(arrays.positions, arrays.indices, normals=arrays.normals)


def _phong(color: ArrayLike) -> cc.PhongMaterial:
    return cc.PhongMaterial(
        color=color, ka=scene.KA, kd=scene.KD, ks=scene.KS, shininess=scene.SHININESS
    )
