// Casters of one light. Here a_view_matrix goes directly from the mesh's own space to clip space.
#include "include/view.glsl"

layout(location = 0) in vec3 a_position;

void main() { gl_Position = a_view_matrix * vec4(a_position, 1.0); }
