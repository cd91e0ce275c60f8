"""Panes in front of a camera, whose colors are composited one over the other."""

import cubecam as cc

LAYERS = [((1, 0.2, 0.1), 0.5, -2), ((0.1, 0.9, 0.3), 0.25, -3), ((0.2, 0.3, 1), 0.75, -4)]
UPRIGHT = cc.axis_angle((1, 0, 0), 90)


def front(scene, size=4):
    camera = cc.PerspectiveCamera(fov=20, position=(0, 0, 0), target=(0, 0, -1))
    return lambda renderer, **more: renderer.render(
        scene, camera, (size, size), format="rgba32f", **more
    )


def pane(scene, color, opacity, z, **more):
    return scene.add(
        cc.Mesh.plane(20, 20),
        cc.BasicMaterial(color=color, opacity=opacity, **more),
        position=(0, 0, z),
        rotation=UPRIGHT,
    )
