"""Writes python/cubecam/data/gallery.glb: a room with a lamp, a mirror ball and a golden head that turns.

    python scripts/gallery.py FILE.glb

The head is data/suzanne.glb (CC0-1.0); everything else is made here.
"""

import sys
from typing import Any

import numpy as np

import cubecam as cc

#: Walls: name, colour, position of the middle, width and height, rotation (axis, degrees).
WALLS = (
    ("back wall", (0.75, 0.73, 0.68), (0, 1.5, -2), (5, 3), ((1, 0, 0), 90)),
    ("red wall", (0.55, 0.06, 0.04), (-2.5, 1.5, 0), (4, 3), None),
    ("blue wall", (0.05, 0.13, 0.5), (2.5, 1.5, 0), (4, 3), None),
    ("ceiling", (0.8, 0.8, 0.8), (0, 3, 0), (5, 4), ((1, 0, 0), 180)),
)


def wall(scene: cc.Scene, name: str, color: Any, position: Any, size: Any, turn: Any) -> cc.Node:
    """Add a rectangle whose normal points into the room."""
    material = cc.StandardMaterial(color=color, metallic=0, roughness=0.9)
    rotation = None if turn is None else cc.axis_angle(*turn)
    if turn is None:  # a side wall: it stands, and looks at the middle
        side = np.sign(position[0])
        matrix = np.eye(4)
        matrix[:3, :3] = np.array([[0, -side, 0], [side, 0, 0], [0, 0, 1]])
        matrix[:3, 3] = position
        return scene.add(cc.Mesh.plane(size[1], size[0]), material, name=name, matrix=matrix)
    return scene.add(
        cc.Mesh.plane(*size), material, name=name, position=position, rotation=rotation
    )


def tiles() -> Any:
    """Make a floor of two kinds of stone with joints; uint8 (256, 256, 3), sRGB."""
    rows, columns = np.indices((256, 256))
    light = ((rows // 64 + columns // 64) % 2)[..., None]
    stone = np.where(light, (196, 184, 166), (92, 84, 78)).astype(float)
    joint = ((rows % 64 < 2) | (columns % 64 < 2))[..., None]
    return np.where(joint, 60, stone).astype(np.uint8)


def build() -> cc.Scene:
    """Make the scene."""
    scene = cc.Scene()
    room = scene.add(name="room")
    floor = cc.StandardMaterial(
        map=cc.Texture(cc.Image(tiles(), wrap="repeat"), scale=(2.5, 2)), metallic=0, roughness=0.35
    )
    scene.add(cc.Mesh.plane(5, 4), floor, name="floor", parent=room)
    for row in WALLS:
        wall(scene, *row).parent = room
    panel = cc.StandardMaterial(
        color=(0, 0, 0), metallic=0, emissive=(1, 0.86, 0.66), emissive_strength=12
    )
    down = cc.axis_angle((1, 0, 0), 180)
    scene.add(
        cc.Mesh.plane(1.6, 0.8),
        panel,
        name="lamp",
        parent=room,
        position=(0, 2.98, 0),
        rotation=down,
    )
    oak = cc.StandardMaterial(color=(0.36, 0.21, 0.1), metallic=0, roughness=0.6)
    scene.add(
        cc.Mesh.cylinder(0.45, 0.8, 48), oak, name="plinth", parent=room, position=(1, 0.4, -0.5)
    )
    gold = cc.StandardMaterial(color=(1, 0.77, 0.34), roughness=0.25)
    head = scene.add(
        cc.load_mesh(cc.sample_data("suzanne.glb"), size=1),
        gold,
        name="head",
        parent=room,
        position=(1, 1.15, -0.5),
    )
    silver = cc.StandardMaterial(color=(0.95, 0.95, 0.95), roughness=0.03)
    scene.add(
        cc.Mesh.sphere(0.6, 48, 24), silver, name="ball", parent=room, position=(-0.7, 0.6, 0.1)
    )
    bulb = scene.add(name="bulb", parent=room, position=(0, 2.6, 0))
    scene.add(cc.PointLight((0, 0, 0), color=(1, 0.86, 0.66), intensity=14, decay=2, parent=bulb))
    eye = scene.add(name="view", position=(0, 1.4, 5.1), rotation=cc.axis_angle((1, 0, 0), -2))
    scene.add(cc.PerspectiveCamera(fov=35, near=0.1, far=50, parent=eye))
    quarter = np.array([cc.axis_angle((0, 1, 0), angle) for angle in (0, 90, 180, 270, 360)])
    turn = cc.AnimationChannel(head, "rotation", np.arange(5) * 2.0, quarter)
    scene.add(cc.Animation([turn], name="turn"))
    return scene


if __name__ == "__main__":
    build().save(sys.argv[1])
