"""The same work in cubecam and in its peers: `python -m benchmarks`."""
