#version 330 core
// The vertex stage of every cloth shader that has none of its own.
#include "common/frame.glsl"
#include "common/vertex.glsl"

void main() { place(placed(position), normal); }
