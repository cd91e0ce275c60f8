// ShaderMaterial: shade() is the user's own.
#include "include/scene.glsl"
