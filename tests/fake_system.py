"""A machine in a folder, for the doctor: files, an environment, libraries that can be loaded, programs that answer."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cubecam.doctor.drawing import Drawing
from cubecam.doctor.system import Ran, System

MESA_JSON = '{"file_format_version": "1.0.0", "ICD": {"library_path": "libEGL_mesa.so.0"}}'
NVIDIA_JSON = '{"file_format_version": "1.0.0", "ICD": {"library_path": "libEGL_nvidia.so.0"}}'
#: What a machine with Mesa can load.
MESA = ("libEGL.so.1", "libGLdispatch.so.0", "libEGL_mesa.so.0")

DEBIAN = 'PRETTY_NAME="Debian GNU/Linux 13 (trixie)"\nID=debian\n'
UBUNTU = 'PRETTY_NAME="Ubuntu 24.04 LTS"\nID=ubuntu\nID_LIKE=debian\n'
FEDORA = 'PRETTY_NAME="Fedora Linux 42"\nID=fedora\n'
ROCKY = 'PRETTY_NAME="Rocky Linux 9"\nID="rocky"\nID_LIKE="rhel centos fedora"\n'
ARCH = 'PRETTY_NAME="Arch Linux"\nID=arch\n'
ALPINE = 'PRETTY_NAME="Alpine Linux v3.22"\nID=alpine\n'

#: What the process that draws tells on a machine where llvmpipe draws.
LLVMPIPE = {
    "index": 0, "name": "llvmpipe", "vendor": "Mesa", "driver": "Mesa 25", "software": True,
    "drm_node": "", "platform": "device", "problem": "",
}  # fmt: skip
CHOSEN = {
    "renderer": "llvmpipe",
    "vendor": "Mesa",
    "version": "4.5",
    "platform": "device",
    "software": True,
}
DRAWN = Drawing((LLVMPIPE,), {**CHOSEN, "index": 0})
NOT_DRAWN = Drawing(error="ContextError: no OpenGL 4.5 context")


@dataclass(frozen=True)
class FakeSystem(System):
    """`libraries` can be loaded, `programs` have answers, and what is `closed` may not be opened."""

    environ: Mapping[str, str] = field(default_factory=dict)
    uid: int = 1000
    groups: frozenset[int] = frozenset({1000})
    machine: str = "x86_64"
    libraries: Sequence[str] = MESA
    programs: Mapping[str, Ran] = field(default_factory=dict)
    closed: Sequence[str] = ()
    owners: Mapping[str, int] = field(default_factory=dict)  # the groups of files
    name: str = "alice"

    def library_problem(self, name):
        """Answer as the loader does."""
        if name in self.libraries:
            return ""
        return f"{name}: cannot open shared object file: No such file or directory"

    def run(self, command, timeout=20):
        """Answer for programs that are there."""
        return self.programs.get(command[0], Ran(None, "", f"{command[0]}: not found"))

    def may(self, name, mode):
        """Refuse what is closed, also to root, as whom tests may run."""
        return name not in self.closed and self.exists(name)

    def group_number(self, name):
        """Give the group that the test names."""
        return self.owners[name]

    def user(self):
        """Give a name that this machine may not have."""
        return self.name


def write(root: Path, files: Mapping[str, str]) -> Path:
    """Write the files of a machine, by their absolute names."""
    for name, text in files.items():
        path = root / name.lstrip("/")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return root
