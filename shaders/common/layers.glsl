// Heights read through another map: its values move the place where they are read. Both stages of cloth/translucent
// include it.
uniform sampler2D height_map;     //@ label="Heights" texture=height default="skin-height" help="Black is the surface itself, white is k_h above it."
uniform sampler2D through_map;    //@ label="Read through" texture=height default="noise-height" help="Where the heights are read is moved by this map's values, as a picture seen through wavy glass."
uniform float bend = 0.25;        //@ label="Bend" min=0 max=1 help="How far they are moved at most, as a share of the map; 0 reads the heights as they are."
uniform float k_h = 0.01;         //@ label="Height k_h" unit="m" min=0 max=0.2 help="How high white stands above the front."
uniform float repeat_u = 1.0;     //@ label="Repeat along u" min=0.1 max=20 log help="How often both maps repeat along the cloth's width."
uniform float repeat_v = 1.0;     //@ label="Repeat along v" min=0.1 max=20 log help="How often both maps repeat along the cloth's height."

vec2 layer_uv(vec2 uv) { return uv * vec2(repeat_u, repeat_v); }

// Two values of the same map, half of it apart, so that both directions bend differently.
vec2 bent(vec2 uv, float there, float elsewhere) { return uv + bend * (vec2(there, elsewhere) - 0.5); }
