"""Install PyTorch for CPUs into a folder of its own: what `make test-torch` needs, and nothing for GPUs.

    .venv/bin/python scripts/torch_cpu.py .venv/torch       then PYTHONPATH=.venv/torch .venv/bin/python ...

The package index has PyTorch for Linux with CUDA alone: 0.5 GB, and 2.5 GB of libraries, without which it cannot be
imported, although a CPU calls none of them. This script installs PyTorch without them and compiles small libraries with
their names; each of their functions fails if it is called, and `torch.cuda.is_available()` is False.

Nothing is done if PyTorch can be imported already, for example that for CPUs of PyTorch's own index.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

#: What `import torch` needs of its requirements; the others are for compilers and for GPUs.
PACKAGES = ["filelock", "fsspec", "jinja2", "networkx", "sympy", "typing-extensions"]
#: Names of functions of NVIDIA's libraries.
NVIDIA = re.compile(r"_*(cu[A-Za-z]*|nccl|nvml|nvrtc|nvshmem|nvtx)[A-Z_]")
#: What other functions give is neither 0, as success is, nor a null pointer.
SOURCE = """
static const char message[] = "this PyTorch was installed without CUDA";
int cudaGetDeviceCount(int *count) { *count = 0; return 100; } /* cudaErrorNoDevice */
"""
DEVICE_COUNT = "cudaGetDeviceCount"
TRIAL = "import torch, torch.utils.data; torch.ones(2).sum(); print(torch.__version__)"


def main(arguments: list[str]) -> int:
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    target = Path(arguments[0]).resolve()
    if version := imported(None) or imported(target):
        print(f"[setup] PyTorch {version}")
        return 0
    print("[setup] PyTorch for CPUs (0.5 GB)", flush=True)
    shutil.rmtree(target, ignore_errors=True)
    install(target, "--no-deps", requirement())
    install(target, *PACKAGES)
    complete(target / "torch" / "lib")
    version = imported(target)
    if version is None:
        print("[setup] PyTorch cannot be imported; its error is", file=sys.stderr)
        subprocess.run(trial(), env=environment(target))
        return 1
    print(f"[setup] PyTorch {version} in {target}")
    return 0


def requirement() -> str:
    """Give what pyproject.toml says of PyTorch."""
    from packages import requirements

    (found,) = requirements(["torch"])
    return found


def install(target: Path, *packages: str) -> None:
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-warn-conflicts"]
    subprocess.run(
        [*command, "--upgrade", "--target", str(target), *packages],
        check=True,
        env={"PIP_DISABLE_PIP_VERSION_CHECK": "1", **os.environ},
    )


def complete(folder: Path) -> None:
    """Compile into a folder of libraries those that they need and that are not there."""
    libraries = sorted(folder.glob("*.so*"))
    needed = {name for path in libraries for name in names_needed(path)}
    missing = sorted(
        name
        for name in needed - {path.name for path in libraries}
        if name.startswith(("libcu", "libn"))
    )
    versions = {  # which library has a version of names
        version: name
        for path in libraries
        for version, name in versions_needed(path).items()
        if name in missing
    }
    found: dict[str, dict[str, set[str]]] = {
        name: {} for name in missing
    }  # library, version, functions
    plain: set[str] = set()  # functions without a version
    defined: set[str] = set()
    for path in libraries:
        for line in read("nm", "-D", "--undefined-only", str(path)):
            name, _, version = line.split()[-1].partition("@")
            if version in versions:
                found[versions[version]].setdefault(version, set()).add(name)
            elif not version and NVIDIA.match(name):
                plain.add(name)
        for line in read("nm", "-D", "--defined-only", str(path)):
            defined.add(line.split()[-1].partition("@")[0])
    for library, functions in found.items():
        compile_library(folder / library, functions or {"": plain - defined})


def compile_library(path: Path, functions: dict[str, set[str]]) -> None:
    """Compile a library with functions of some versions; that of the version "" has none."""
    names = sorted(set().union(*functions.values()) - {DEVICE_COUNT})
    source = SOURCE + "\n".join(f"const void *{name}() {{ return message; }}" for name in names)
    options = ["-shared", "-fPIC", "-w", f"-Wl,-soname,{path.name}"]
    script = path.with_suffix(".map")
    if "" not in functions:
        lines = [f"{version} {{ {'; '.join(sorted(of))}; }};" for version, of in functions.items()]
        script.write_text("\n".join(lines))
        options.append(f"-Wl,--version-script={script}")
    subprocess.run(
        [os.environ.get("CC", "cc"), *options, "-x", "c", "-", "-o", str(path)],
        input=source,
        text=True,
        check=True,
    )
    script.unlink(missing_ok=True)


def versions_needed(path: Path) -> dict[str, str]:
    """Give the versions that a library needs, and the library that each is of."""
    text = "\n".join(read("readelf", "--version-info", "--wide", str(path)))
    needs = text.partition("Version needs section")[2]
    found = {}
    for part in needs.split("File: ")[1:]:
        library = part.split()[0]
        found.update(dict.fromkeys(re.findall(r"Name: (\S+)", part), library))
    return found


def names_needed(path: Path) -> list[str]:
    """Give the names of the libraries that a library needs."""
    lines = "\n".join(read("readelf", "--dynamic", str(path)))
    return re.findall(r"\(NEEDED\).*\[(.+)\]", lines)


def read(*command: str) -> list[str]:
    """Give the lines that a command prints."""
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return [line for line in done.stdout.splitlines() if line.strip()]


def trial() -> list[str]:
    return [sys.executable, "-c", TRIAL]


def environment(target: Path | None) -> dict[str, str]:
    """Give an environment whose programs find what is in a folder."""
    return {**os.environ, "PYTHONPATH": str(target)} if target else dict(os.environ)


def imported(target: Path | None) -> str | None:
    """Give the version of the PyTorch that can be imported, None if there is none."""
    done = subprocess.run(trial(), env=environment(target), capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else None


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
