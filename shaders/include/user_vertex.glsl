// Stands for the vertex source of a ShaderMaterial, which takes its place.
