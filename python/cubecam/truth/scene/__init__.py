"""A scene as plain data: triangles in world space, materials as numbers, lights and what lies far away."""
