"""A camera of a scene, which may stand on a node that moves, as a free camera of the same view."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._core import OrthographicCamera, PerspectiveCamera, Scene

__all__ = ["camera_names", "free_camera", "name_of"]


def name_of(camera: Any) -> str:
    """Give the name of a camera's node; empty without one."""
    parent = getattr(camera, "parent", None)  # a camera of matrices has none
    return "" if parent is None else str(parent.name)


def camera_names(scene: Scene) -> dict[str, Any]:
    """Name the cameras of a scene: by their nodes' names, else by numbers."""
    found: dict[str, Any] = {}
    for i, camera in enumerate(scene.cameras):
        name = name_of(camera)
        word = name if name and name not in found else f"{name or 'camera'} {i}"
        found[word] = camera
    return found


def free_camera(camera: Any, ahead: float = 1.0) -> PerspectiveCamera | OrthographicCamera:
    """Make a camera without a node that sees what a camera sees now.

    Parameters
    ----------
    camera : PerspectiveCamera or OrthographicCamera
        It may have a parent, whose matrix moves its position and turns its view.
    ahead : float
        The distance of the target if the camera itself has none.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.scene_camera import free_camera
    >>> free_camera(cc.PerspectiveCamera(position=(0, 0, 2)), 2).target.tolist()
    [0.0, 0.0, 0.0]
    """
    position, up = np.asarray(camera.position, float), np.asarray(camera.up, float)
    if camera.target is None:
        target, up = position - np.array([0.0, 0.0, ahead]), np.array([0.0, 1.0, 0.0])
    else:
        target = np.asarray(camera.target, float)
    parent = camera.parent
    if parent is not None:
        matrix = np.asarray(parent.world_matrix, float)
        at = matrix[:3, :3] @ position + matrix[:3, 3]
        # A scaled node makes no picture larger: the distance of the target only says what the view turns round.
        forward = matrix[:3, :3] @ (target - position)
        forward *= np.linalg.norm(target - position) / max(float(np.linalg.norm(forward)), 1e-30)
        position, target, up = at, at + forward, matrix[:3, :3] @ up
    kind = OrthographicCamera if isinstance(camera, OrthographicCamera) else PerspectiveCamera
    made = kind()
    lens = ("height",) if kind is OrthographicCamera else ("fov",)
    for name in (*lens, "near", "far"):
        setattr(made, name, getattr(camera, name))
    made.target = None
    made.position, made.up = position, up
    made.target = target
    return made
