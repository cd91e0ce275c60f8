"""The same scene by exact rays, beside every approximation of the renderer."""
