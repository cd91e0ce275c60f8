"""Files of cubecam in other programs: `make test-interop`. Packages of npm are pinned in package.json."""
