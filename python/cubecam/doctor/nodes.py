"""The files by which Mesa reaches a GPU, /dev/dri/renderD*, and the rights to open them."""

from __future__ import annotations

import os

from .drawing import Drawing
from .findings import Finding
from .nvidia import nvidia_signs
from .surroundings import container_sign, graphics_cards
from .system import System

__all__ = ["check_nodes"]


def check_nodes(system: System, drawing: Drawing) -> list[Finding]:
    """Look whether this user may open each render node."""
    nodes = system.glob("/dev/dri/renderD*")
    if not nodes:
        return _without_nodes(system)
    found, usable = [], []
    for node in nodes:
        if system.may(node, os.R_OK | os.W_OK):
            usable.append(node)
        else:
            found.append(_refused(system, node))
    if usable:
        found.insert(0, Finding("render-nodes", "ok", f"{', '.join(usable)} can be opened"))
    return found


def _refused(system: System, node: str) -> Finding:
    number, name = system.group_of(node)
    group = name or str(number)
    text = f"no right to open {node}, the way to a GPU: it belongs to the group {group} ({number})"
    user = system.user()
    cure: tuple[str, ...]
    # A user without a name is that of a container, too: docker run --user.
    if container_sign(system) or not user:
        cure = (
            "# start the container with the device and its group:",
            f"docker run --device /dev/dri --group-add {number} IMAGE",
        )
    elif number == 0:
        cure = (f"sudo chmod 666 {node}  # until the next start of the machine",)
    elif name and number not in system.groups and system.is_member(name):
        text += f", which {user} joined after this session began"
        cure = ("# log out and in again, or, for this shell:", f"newgrp {name}")
    else:
        cure = (f"sudo usermod -aG {group} {user}", f"newgrp {group}  # or log out and in again")
    return Finding("render-nodes", "warning", text, cure)


def _without_nodes(system: System) -> list[Finding]:
    every = graphics_cards(system)
    # NVIDIA's own driver draws without these files.
    cards = [card for card in every if not card.startswith("NVIDIA")]
    if every and not cards and not nvidia_signs(system):
        cards = every
    if not cards:
        return []
    text = f"{', '.join(cards)}: the machine has this GPU, and there is no /dev/dri/renderD* to reach it"
    nvidia = cards[0].startswith("NVIDIA")
    if container_sign(system):
        flags = "--gpus all -e NVIDIA_DRIVER_CAPABILITIES=all" if nvidia else "--device /dev/dri"
        cure = ("# if the container shall use it:", f"docker run {flags} IMAGE")
    else:
        cure = (
            "# its kernel driver is not loaded; the reason is often in the kernel's log:",
            "sudo dmesg | grep -iE 'drm|nvidia|amdgpu|i915|xe'",
        )
    return [Finding("render-nodes", "note", text, cure)]
