"""Random edits against a fresh renderer, threads, contexts: `make soak` runs them for as long as one likes."""
