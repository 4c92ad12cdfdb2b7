// A height map that bump and displacement share; both stages include it.
uniform sampler2D height_map;    //@ label="Heights" texture=height default="bricks-height" help="Black is the surface itself, white is k_h above it."
uniform float k_h = 0.02;        //@ label="Height k_h" unit="m" min=0 max=0.2 help="How high white stands above the front."
uniform float k_n = 400.0;       //@ label="Normal k_n" min=1 max=10000 log help="How much steeper the normals take the heights. The moved surface's own slopes are those at the texture's pixels per metre of cloth: its width times the repeats."
uniform float repeat_u = 2.0;    //@ label="Repeat along u" min=0.1 max=20 log help="How often the heights repeat along the cloth's width."
uniform float repeat_v = 2.0;    //@ label="Repeat along v" min=0.1 max=20 log help="How often the heights repeat along the cloth's height."

vec2 relief_uv(vec2 uv) { return uv * vec2(repeat_u, repeat_v); }
