// Textures in OpenGL, by name: built-in ones and the user's files, each made or read when it is first asked for.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "render/gl.h"
#include "render/options.h"
#include "render/texture_files.h"

namespace clothlab::render {

/// A texture that can be bound, whatever became of its file.
struct TextureEntry {
    Texture texture;
    GLenum target = GL_TEXTURE_2D; ///< or GL_TEXTURE_CUBE_MAP
    int width = 0, height = 0;     ///< px; of one face for a cube map
    std::string error;             ///< why it is not what was asked for; empty when it is
    GLuint id() const { return texture.id(); }
};

/// A built-in texture's name or a file's path, relative to the working directory, gives
/// - colour: sRGB (RGB16F for HDR), repeated, mipmaps; a built-in height map is shown in grey;
/// - height: R32F, repeated, mipmaps; a picture's luma, with all of its 16 bits where it has them;
/// - ramp: sRGB, clamped at the ends, no mipmaps. Sample a ramp of n pixels at (x (n - 1) + 0.5) / n, or its ends get
///   half a pixel more than the rest;
/// - environment: a cube map, sRGB (RGB16F for HDR and panoramas), mipmaps. Whoever draws enables
///   GL_TEXTURE_CUBE_MAP_SEAMLESS.
/// Texture coordinates are OpenGL's: v = 0 is the lowest row of a picture. Where there is a GPU and it can, colours and
/// heights are filtered anisotropically. Something bad shows as a checker of magenta and black, as flat ground, as a
/// magenta ramp or as grey surroundings, and says why.
///
/// OpenGL's state is as before after every call. A context has to be current, and the same one at the end.
class TextureLibrary {
public:
    /// Stays valid and in its place as long as the library lives; a reload changes it there. Never throws.
    const TextureEntry& get(const std::string& name, TextureUsage usage);

    /// Makes all textures of this name anew. One whose file has become bad stays as it was, with the error beside it.
    void reload(const std::string& name);

    /// Reloads every file that was changed, has gone or has come since it was read, and says whether there was one.
    /// Asks the file system for each file in use: for every half a second, not for every frame.
    bool refresh();

    /// What is wrong with the textures in use, each message once.
    std::vector<std::string> errors() const;

private:
    struct Held {
        TextureEntry entry;
        std::vector<FileStamp> stamps; ///< none for a built-in texture
    };
    using Key = std::pair<std::string, TextureUsage>;
    static void load(const Key& key, Held& held);
    std::map<Key, Held> textures_;
};

} // namespace clothlab::render
