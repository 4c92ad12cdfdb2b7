#version 330 core
#include "common/frame.glsl"
#include "common/lines_geometry.glsl"
