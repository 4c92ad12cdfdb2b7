#version 330 core
// One colour within a dark rim: seen on light and dark alike.
flat in vec3 colour;   // linear
flat in vec4 shape;    // px: half the shaft's width, its length, the head's length, half its width
flat in float rim;     // px
in vec2 place;         // px: ahead of the neck, to the left
out vec4 pixel;
uniform float share;   // that the arrow has of the pixel

void main() {
    float aside = abs(place.y);
    float in_shaft = min(min(shape.x - aside, -place.x), place.x + shape.y);
    // Of the head's edge, per pixel further in.
    float slope = shape.z / length(shape.zw);
    float in_head = min((shape.w * (1.0 - place.x / shape.z) - aside) * slope, place.x);
    float joined = shape.x > 0.0 && abs(place.x) < 1.0 ? shape.x - aside : -1.0;   // across the neck
    float within = max(max(in_shaft, in_head), joined);
    float inner = clamp(within + 1.0 - 0.5 * rim, 0.0, 1.0);
    pixel = vec4(colour * mix(0.02, 1.0, inner), share);
}
