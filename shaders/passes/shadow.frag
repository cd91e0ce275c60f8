// This pass writes only depth.
void main() {}
