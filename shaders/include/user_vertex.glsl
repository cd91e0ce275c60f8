// The vertex source of a ShaderMaterial replaces this file.
