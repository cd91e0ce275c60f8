"""Read conda/recipe.yaml with rattler-build and build the package of one Python into dist/conda.

    .venv/bin/python scripts/conda.py --render            only read it, for all Pythons and systems
    .venv/bin/python scripts/conda.py --python 3.12       build and test, with packages of conda-forge

rattler-build comes from PyPI (py-rattler-build). A build needs the channel: conda-forge, or what
--channel names.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import rattler_build as rattler

ROOT = Path(__file__).resolve().parent.parent
RECIPE = ROOT / "conda" / "recipe.yaml"
PYTHONS = ("3.10", "3.11", "3.12", "3.13", "3.14")
#: conda-forge's names of the systems for which there are packages.
SYSTEMS = ("linux-64", "linux-aarch64")
#: The glibc for which conda-forge compiles is 2.17; cubecam's wheels need 2.28.
GLIBC = "2.28"


def render(system: str | None, pythons: list[str]) -> list[rattler.RenderedVariant]:
    """The recipe's packages, one for each Python."""
    recipe = rattler.Stage0Recipe.from_file(RECIPE)
    variants = rattler.VariantConfig(
        {"python": pythons, "c_stdlib": ["sysroot"], "c_stdlib_version": [GLIBC]}
    )
    platform = rattler.PlatformConfig(
        target_platform=system, build_platform=system, host_platform=system
    )
    rendered: list[rattler.RenderedVariant] = recipe.render(
        variants, rattler.RenderConfig(platform=platform)
    )
    if len(rendered) != len(pythons):
        raise SystemExit(
            f"{RECIPE}: expected a package for each of {pythons}, got {len(rendered)} packages"
        )
    return rendered


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--render", action="store_true", help="only read the recipe")
    parser.add_argument("--python", default="3.12", choices=PYTHONS)
    parser.add_argument("--channel", action="append", help="default: conda-forge")
    arguments = parser.parse_args()
    for system in SYSTEMS:
        for variant in render(system, list(PYTHONS)):
            recipe = variant.recipe.to_dict()
            print(system, "-".join(recipe["package"].values()) + "-" + recipe["build"]["string"])
    if arguments.render:
        return 0
    (variant,) = render(None, [arguments.python])
    built = variant.run_build(
        tool_config=rattler.ToolConfiguration(test_strategy="native"),
        output_dir=ROOT / "dist" / "conda",
        channels=arguments.channel or ["conda-forge"],
    )
    print(*built.packages, sep="\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
