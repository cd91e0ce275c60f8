"""What a long run did and what it found."""

from __future__ import annotations

import gc
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Report:
    """Counts by name, and faults with what repeats them."""

    counts: dict[str, int] = field(default_factory=dict)
    faults: list[str] = field(default_factory=list)

    def count(self, name: str, number: int = 1) -> None:
        """Count what was done."""
        self.counts[name] = self.counts.get(name, 0) + number

    def __str__(self) -> str:
        words = [f"{number} {name}" for name, number in self.counts.items()]
        return ", ".join([*words, f"{len(self.faults)} faults"])


@dataclass(frozen=True)
class Held:
    """What this process holds: memory in bytes, threads, open files."""

    memory: int
    threads: int
    files: int

    @classmethod
    def now(cls) -> Held:
        """Look, after a collection of garbage."""
        gc.collect()
        status = Path("/proc/self/status").read_text(encoding="ascii")
        memory = int(status.partition("VmRSS:")[2].split()[0]) * 1024
        threads = int(status.partition("Threads:")[2].split()[0])
        return cls(memory, threads, len(list(Path("/proc/self/fd").iterdir())))

    def growth(self, before: Held, memory: int) -> str | None:
        """Say what has grown since `before`; memory may grow by some bytes."""
        if self.memory - before.memory > memory:
            return f"memory grew by {(self.memory - before.memory) >> 20} MiB"
        if self.threads > before.threads:
            return f"{self.threads - before.threads} more threads"
        if self.files > before.files:
            return f"{self.files - before.files} more open files"
        return None
