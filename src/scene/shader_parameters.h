// What a shader file declares of itself: title, help, and a slider, switch, colour or texture for each of its uniforms.
// The declarations are comments beside the uniforms, so that a new shader is a pair of files and no C++:
//
//   //@ shader title="Blinn-Phong" help="Ambient, diffuse and specular light."
//   uniform float p = 32.0;          //@ label="Shininess p" min=1 max=1000 log help="..."
//   uniform int bands = 3;           //@ label="Bands" min=1 max=8
//   uniform bool diffuse_on = true;  //@ label="Diffuse part"
//   uniform vec3 tint;               //@ label="Tint" colour="#E0714F"
//   uniform sampler2D albedo;        //@ label="Texture" texture=colour default="bricks"
//   uniform samplerCube environment; //@ label="Environment" default="sky"
//
// Numbers and switches take their default from the uniform's own initialiser. docs/shaders.md has the whole list.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace clothlab::scene {

enum class ShaderParameterType : std::uint8_t { number, integer, flag, colour, texture };

/// How a shader reads a picture: sRGB colours that repeat, heights that repeat, a ramp of colours from left to right
/// that ends at its ends, the six sides of a cube.
enum class TextureUsage : std::uint8_t { colour, height, ramp, environment };

struct ShaderParameter {
    std::string name; ///< of the uniform
    std::string label, help, unit;
    ShaderParameterType type = ShaderParameterType::number;
    double min = 0, max = 1;  ///< of the slider; typing may go beyond
    bool logarithmic = false; ///< the slider
    TextureUsage usage = TextureUsage::colour;
    ShaderValue value; ///< the default
};

/// What the colours of a heat map mean: from the value of one parameter to that of another, through a ramp.
struct ShaderLegend {
    std::string title, unit;
    std::string low, high, map; ///< names of parameters: two numbers, and a texture used as a ramp
};

struct ShaderDeclaration {
    std::string name;         ///< of the file, without extension
    std::string title;        ///< the name, when the file has none
    std::string help;         ///< one or two sentences
    bool lines = false;       ///< draws springs as lines instead of the surface
    bool translucent = false; ///< what is behind shines through
    std::string quantity;     ///< of the points that the vertex attribute `quantity` carries, or empty
    std::optional<ShaderLegend> legend;
    std::vector<ShaderParameter> parameters;
    std::string error; ///< why the file's declarations cannot be read; then there are no parameters

    const ShaderParameter* find(std::string_view parameter) const;
};

/// A declaration that is not right, with its line in the text, from 1.
class ShaderDeclarationError : public std::runtime_error {
public:
    ShaderDeclarationError(const std::string& what, int line) : std::runtime_error(what), line_(line) {}
    int line() const { return line_; }

private:
    int line_;
};

/// Reads the declarations in a shader's text; of a uniform that is declared twice, as stages that share an include have
/// it, the first counts. Throws ShaderDeclarationError.
ShaderDeclaration read_shader_declaration(const std::string& name, std::string_view text);

/// Why a value cannot be one of a parameter's, as the end of a sentence; nothing when it can.
std::optional<std::string> objection(const ShaderParameter& parameter, const ShaderValue& value);

/// The value that a look gives a parameter, else its default. A colour is three numbers from 0 to 1, however it was
/// written. A value of the wrong type counts as none: see check_shader_values.
ShaderValue value_of(const Look& look, const ShaderDeclaration& shader, const ShaderParameter& parameter);
/// Sets a parameter; one that has its default is not kept.
void set_value(Look& look, const ShaderDeclaration& shader, const ShaderParameter& parameter, const ShaderValue& value);
/// The value of a number, by name; 0 where there is no such parameter.
double number_of(const Look& look, const ShaderDeclaration& shader, std::string_view parameter);

/// Throws SceneError for values of look.shaders that no shader has, or that are of the wrong type; `source` begins the
/// sentence. Values of shaders that are not in the list are left alone: the scene may come from somebody who has more.
void check_shader_values(const Look& look, const std::vector<ShaderDeclaration>& shaders, const std::string& source);

/// Red, green and blue from 0 to 1 of "#RRGGBB"; nothing for any other text.
std::optional<sim::Vec3> colour_of(std::string_view text);

} // namespace clothlab::scene
