#version 330 core
#include "common/lines_vertex.glsl"
