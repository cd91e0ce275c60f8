// ShaderMaterial: the user's source defines shade().
#include "include/scene.glsl"
