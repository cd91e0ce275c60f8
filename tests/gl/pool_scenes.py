"""Functions that the workers of a pool import, for tests/gl/test_pool.py."""

import os
import signal
import sys
import time
from pathlib import Path

import cubecam as cc

BALL = cc.Mesh.sphere(1, 16, 8)


def numbered(number):
    """A scene that shows its number."""
    scene = cc.Scene(background=(0, 0, number / 100))
    scene.add(BALL, cc.BasicMaterial(color=(1, number / 100, 0)), position=(0, 0, -2 - number / 50))
    return scene


def failing(number):
    if number == 7:
        raise LookupError("no scene has the number 7")
    return numbered(number)


def failing_from_7(number):
    """Number 7 takes longer to fail than those after it."""
    if number == 7:
        time.sleep(0.1)
    if number >= 7:
        raise LookupError(f"no scene has the number {number}")
    return numbered(number)


def other_outputs(number):
    """The material of number 5 declares another type."""
    scene = numbered(number)
    kind = "vec2" if number == 5 else "float"
    source = f"out {kind} heat; vec3 shade(Surface s) {{ heat = {kind}(1.0); return vec3(1); }}"
    scene.add(BALL, cc.ShaderMaterial(source))
    return scene


def leaving(number):
    if number == 3:
        sys.exit("enough")
    return numbered(number)


def dying(number):
    """Ends its process at number 3, always."""
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return numbered(number)


class DiesOnce:
    """Ends its process at number 3, the first time."""

    def __init__(self, folder):
        self.mark = Path(folder) / "died"

    def __call__(self, number):
        if number == 3 and not self.mark.exists():
            self.mark.touch()
            os.kill(os.getpid(), signal.SIGSEGV)
        return numbered(number)


def warning(number):
    import warnings

    if number == 2:
        warnings.warn("number 2 is odd", UserWarning, stacklevel=1)
    return numbered(number)


def slow(number):
    if number:
        time.sleep(60)
    return numbered(number)


SHARED = cc.Scene(background=(0.2, 0.4, 0.6))
_BALL = SHARED.add(BALL, cc.MirrorMaterial(), position=(0, 0, -3))
_BALL.environment = cc.Probe(parent=_BALL, size=8, update="once")
_MATERIAL = cc.BasicMaterial()
SHARED.add(cc.Mesh.box(20), _MATERIAL, position=(0, 0, 14))


def same_again(number):
    """One scene for all numbers, whose probe is drawn once."""
    _MATERIAL.color = (1, number / 40, 0)
    return SHARED
