"""Render the furnished room by exact rays and by cubemaps, and measure: python -m benchmarks.rooms --noise 0.01

It writes the room as a file, both pictures and the figure of the error to a folder. furnished.glb beside this file is
the same room, for other programs and for `cc.load_scene`.
"""

from __future__ import annotations

import argparse
import resource
from pathlib import Path

import cubecam as cc

from .furnished import build


def with_probes(scene: cc.Scene, size: int) -> None:
    """Give each mirror, each body of glass and each `StandardMaterial` a probe of its own."""
    for node in scene.nodes:
        if isinstance(node.material, (cc.MirrorMaterial, cc.GlassMaterial, cc.StandardMaterial)):
            node.environment = cc.Probe(parent=node, size=size, format="rgba16f")


def cpu_seconds() -> float:
    """Give the CPU time of this process and of those that it has waited for."""
    every = (resource.getrusage(w) for w in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(usage.ru_utime + usage.ru_stime for usage in every)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/rooms"))
    parser.add_argument("--size", type=int, nargs=2, default=(960, 640), metavar=("W", "H"))
    parser.add_argument(
        "--noise", type=float, default=0.01, help="of the exact picture, 0.01: 1 %%"
    )
    parser.add_argument("--samples", type=int, default=1024, help="the most for each pixel")
    parser.add_argument("--bounces", type=int, default=6)
    parser.add_argument("--probe", type=int, default=512, help="texels along an edge of a face")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    size = (options.size[0], options.size[1])

    scene = build()
    scene.save(options.out / "furnished.glb")
    camera = scene.cameras[0]
    before = cpu_seconds()
    exact = cc.truth.render(
        scene,
        camera,
        size,
        bounces=options.bounces,
        samples=options.samples,
        target_error=options.noise,
        outputs=("id",),
    )
    spent = cpu_seconds() - before
    exact.save(options.out / "truth.png")
    exact.save(options.out / "truth.exr")
    print(
        f"exact rays: {exact.samples.max()} samples, noise {exact.noise:.2%}, "
        f"{spent:.0f} s of CPU, {exact.seconds:.0f} s of wall time"
    )

    with_probes(scene, options.probe)
    with cc.Renderer() as renderer:
        before = cpu_seconds()
        drawn = renderer.render(scene, camera, size, format="rgba16f", samples=4)
        print(f"cubemaps: {cpu_seconds() - before:.1f} s of CPU")
    drawn.save(options.out / "cubemaps.png")
    print(cc.truth.compare(drawn, exact))
    names = {node.id: node.name for node in scene.nodes}
    for name in ("wall mirror", "left mirror ball", "right mirror ball", "glass ball", "teapot"):
        on = exact.outputs["id"] == next(k for k, v in names.items() if v == name)
        found = cc.truth.compare(drawn, exact, on, flip=False)
        print(f"{name:18s} {on.mean():6.1%} of the picture, RMSE {found.rmse:.3f}")
    found = cc.truth.compare(drawn, exact)
    found.plot().savefig(options.out / "error.png", dpi=100)


if __name__ == "__main__":
    main()
