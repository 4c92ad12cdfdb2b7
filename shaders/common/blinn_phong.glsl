// Blinn and Phong's light (J. F. Blinn, Models of light reflection, SIGGRAPH 1977), summed over the lamps:
// ka Ia + kd I / r^2 max(0, n.l) + ks I / r^2 max(0, n.h)^p. Needs common/frame.glsl and common/lighting.glsl.
uniform float ka = 1.0;   //@ label="Ambient ka" min=0 max=2 help="Share of the light from everywhere, Ia, that comes back."
uniform float kd = 1.0;   //@ label="Diffuse kd" min=0 max=2 help="Share of a lamp's light, I / r², that a matt surface sends back: times n·l."
uniform float ks = 0.4;   //@ label="Specular ks" min=0 max=2 help="Share of a lamp's light that comes back as highlight: times (n·h) to the power p."
uniform float p = 40.0;   //@ label="Shininess p" min=1 max=1000 log help="The exponent: the larger, the smaller and sharper the highlight."

float ambient_part() { return ka * frame.ambient.x; }

float diffuse_part(vec3 position, vec3 normal) { return kd * point_light(position, normal); }

float specular_part(vec3 position, vec3 normal) {
    vec3 to_eye = direction_to_eye(position);
    float sum = 0.0;
    for (int lamp = 0; lamp < lights; ++lamp) {
        vec3 to_light;
        float light = light_at(lamp, position, to_light);
        vec3 half_way = normalize(to_light + to_eye);
        sum += light * pow(max(0.0, dot(normal, half_way)), p);
    }
    return ks * sum;
}
