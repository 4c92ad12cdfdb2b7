#include "render/texture_library.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <stdexcept>

namespace clothlab::render {

namespace {

GLint integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

/// Keeps how pixels are sent and what is bound, and makes both plain meanwhile.
class Upload {
public:
    Upload(GLenum target, GLuint texture) : target_(target) {
        before_ = integer(target == GL_TEXTURE_2D ? GL_TEXTURE_BINDING_2D : GL_TEXTURE_BINDING_CUBE_MAP);
        buffer_ = integer(GL_PIXEL_UNPACK_BUFFER_BINDING);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
        for (std::size_t i = 0; i < names.size(); ++i) {
            values_[i] = integer(names[i]);
            glPixelStorei(names[i], names[i] == GL_UNPACK_ALIGNMENT ? 1 : 0);
        }
        glBindTexture(target, texture);
    }
    ~Upload() {
        glBindTexture(target_, static_cast<GLuint>(before_));
        for (std::size_t i = 0; i < names.size(); ++i)
            glPixelStorei(names[i], values_[i]);
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(buffer_));
    }
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;

private:
    static constexpr std::array<GLenum, 6> names = {GL_UNPACK_ALIGNMENT,   GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                                    GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST};
    GLenum target_;
    GLint before_ = 0, buffer_ = 0;
    std::array<GLint, names.size()> values_{};
};

/// The rows from the last to the first: OpenGL's order for a picture whose lower edge is v = 0.
template <class Value>
std::vector<Value> bottom_up(const std::vector<Value>& values, int height) {
    const std::size_t rows = static_cast<std::size_t>(height), stride = values.size() / rows;
    std::vector<Value> turned;
    turned.reserve(values.size());
    for (std::size_t row = rows; row-- > 0;) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * stride);
        turned.insert(turned.end(), first, first + static_cast<std::ptrdiff_t>(stride));
    }
    return turned;
}

// Each sends one picture to the bound texture.
void send(GLenum target, const Image& image, const std::uint8_t* rows) {
    glTexImage2D(target, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rows);
}

void send(GLenum target, const FloatImage& image, const float* rows) {
    glTexImage2D(target, 0, GL_RGB16F, image.width, image.height, 0, GL_RGB, GL_FLOAT, rows);
}

void send(GLenum target, const GreyImage& image, const float* rows) {
    glTexImage2D(target, 0, GL_R32F, image.width, image.height, 0, GL_RED, GL_FLOAT, rows);
}

const auto& values_of(const Image& image) {
    return image.rgba;
}
const auto& values_of(const FloatImage& image) {
    return image.rgb;
}
const auto& values_of(const GreyImage& image) {
    return image.values;
}

/// Half floats end at 65504, and the light of a sun may be more.
void limit(FloatImage& image) {
    for (float& value : image.rgb)
        value = std::clamp(value, 0.f, 65504.f);
}

void set_filters(GLenum target, TextureUsage usage) {
    const bool mipmaps = usage != TextureUsage::ramp;
    const bool repeats = usage == TextureUsage::colour || usage == TextureUsage::height;
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(target, wrap, repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    if (mipmaps)
        glGenerateMipmap(target);
    else
        glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    // On the CPU each of its samples costs as much as the first.
    if (repeats && GLAD_GL_EXT_texture_filter_anisotropic != 0 && !software_rendering()) {
        GLfloat most = 1;
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
        glTexParameterf(target, GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(most, 8.f));
    }
}

/// Calls fill() with a new texture bound, then sets its filters.
template <class Fill>
TextureEntry upload(GLenum target, TextureUsage usage, int width, int height, Fill fill) {
    TextureEntry entry{Texture::create(), target, width, height, {}};
    const Upload state(target, entry.id());
    fill();
    set_filters(target, usage);
    return entry;
}

template <class Picture>
TextureEntry to_texture(const Picture& image, TextureUsage usage) {
    return upload(GL_TEXTURE_2D, usage, image.width, image.height, [&] {
        const auto rows = bottom_up(values_of(image), image.height);
        send(GL_TEXTURE_2D, image, rows.data());
    });
}

template <class Picture>
TextureEntry to_texture(const Cube<Picture>& cube, TextureUsage usage) {
    return upload(GL_TEXTURE_CUBE_MAP, usage, cube[0].width, cube[0].height, [&] {
        GLenum face = GL_TEXTURE_CUBE_MAP_POSITIVE_X;
        for (const Picture& image : cube) // whose rows OpenGL wants from the top
            send(face++, image, values_of(image).data());
    });
}

/// What was not asked for in this way, made so.
GreyImage grey_of(const Image& image) {
    GreyImage grey{image.width, image.height, {}};
    grey.values.reserve(image.rgba.size() / 4);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) // Rec. 601, as for files
        grey.values.push_back((0.299f * image.rgba[i] + 0.587f * image.rgba[i + 1] + 0.114f * image.rgba[i + 2]) / 255);
    return grey;
}

Image image_of(const GreyImage& grey) {
    Image image{grey.width, grey.height, {}};
    image.rgba.reserve(grey.values.size() * 4);
    for (const float value : grey.values) {
        const auto byte = static_cast<std::uint8_t>(value * 255 + 0.5f);
        image.rgba.insert(image.rgba.end(), {byte, byte, byte, 255});
    }
    return image;
}

TextureEntry convert(const Image& image, TextureUsage usage) {
    return usage == TextureUsage::height ? to_texture(grey_of(image), usage) : to_texture(image, usage);
}

TextureEntry convert(const GreyImage& grey, TextureUsage usage) {
    return usage == TextureUsage::height ? to_texture(grey, usage) : to_texture(image_of(grey), usage);
}

TextureEntry convert(const Cube<Image>& cube, TextureUsage usage) {
    return to_texture(cube, usage);
}

TextureEntry from_built_in(const BuiltInTexture& texture, TextureUsage usage) {
    if ((texture.usage == TextureUsage::environment) != (usage == TextureUsage::environment))
        throw std::runtime_error(std::string("the texture ") + texture.name + " is for " + usage_name(texture.usage) +
                                 " and cannot be used for " + usage_name(usage));
    return std::visit([&](auto make) { return convert(make(), usage); }, texture.make);
}

TextureEntry from_environment(const std::filesystem::path& path) {
    Environment environment = load_environment(path, integer(GL_MAX_CUBE_MAP_TEXTURE_SIZE));
    if (auto* faces = std::get_if<Cube<FloatImage>>(&environment))
        std::for_each(faces->begin(), faces->end(), limit);
    return std::visit([](const auto& cube) { return to_texture(cube, TextureUsage::environment); }, environment);
}

TextureEntry from_file(const std::filesystem::path& path, TextureUsage usage) {
    if (usage == TextureUsage::environment)
        return from_environment(path);
    const PictureFile file = open_texture(path, integer(GL_MAX_TEXTURE_SIZE));
    if (usage == TextureUsage::height)
        return to_texture(file.grey(), usage);
    if (!file.high_range())
        return to_texture(file.rgba8(), usage);
    FloatImage image = file.linear();
    limit(image);
    return to_texture(image, usage);
}

/// What stands in for a texture that cannot be had.
TextureEntry fallback(TextureUsage usage) {
    switch (usage) {
    case TextureUsage::environment: {
        Cube<Image> cube;
        cube.fill({1, 1, {128, 128, 128, 255}});
        return to_texture(cube, usage);
    }
    case TextureUsage::height:
        return to_texture(GreyImage{1, 1, {0}}, usage);
    case TextureUsage::ramp:
        return to_texture(Image{2, 1, {40, 0, 40, 255, 255, 0, 255, 255}}, usage);
    case TextureUsage::colour:
        break;
    }
    Image checker{16, 16, {}};
    for (int y = 0; y < checker.height; ++y) {
        for (int x = 0; x < checker.width; ++x) {
            const std::uint8_t value = (x / 2 + y / 2) % 2 == 0 ? 255 : 0;
            checker.rgba.insert(checker.rgba.end(), {value, 0, value, 255});
        }
    }
    return to_texture(checker, usage);
}

/// A name that is neither built in nor a file: what there is.
std::string unknown(const std::string& name, TextureUsage usage) {
    std::string names;
    for (const BuiltInTexture& texture : built_in_textures())
        if (texture.usage == usage)
            names += (names.empty() ? "" : ", ") + std::string(texture.name);
    return "there is no file " + (name.empty() ? "\"\"" : name) + " and no texture of that name; built in are " + names;
}

} // namespace

void TextureLibrary::load(const Key& key, Held& held) {
    const auto& [name, usage] = key;
    const BuiltInTexture* built_in = find_built_in(name);
    held.stamps = built_in != nullptr ? std::vector<FileStamp>() : file_stamps(name);
    std::string error;
    try {
        std::error_code ignored;
        if (built_in == nullptr && !std::filesystem::exists(name, ignored))
            throw std::runtime_error(unknown(name, usage));
        while (glGetError() != GL_NO_ERROR) { // not ours
        }
        TextureEntry entry = built_in != nullptr ? from_built_in(*built_in, usage) : from_file(name, usage);
        if (glGetError() != GL_NO_ERROR)
            throw std::runtime_error("the driver has no memory for the texture " + name + ", " +
                                     std::to_string(entry.width) + " x " + std::to_string(entry.height) + " pixels");
        held.entry = std::move(entry);
        return;
    } catch (const std::bad_alloc&) {
        error = "there is no memory for the texture " + name;
    } catch (const std::exception& e) {
        error = e.what();
    }
    if (!held.entry.texture)
        held.entry = fallback(usage);
    held.entry.error = error;
}

const TextureEntry& TextureLibrary::get(const std::string& name, TextureUsage usage) {
    const auto [place, is_new] = textures_.try_emplace({name, usage});
    if (is_new)
        load(place->first, place->second);
    return place->second.entry;
}

void TextureLibrary::reload(const std::string& name) {
    for (auto& [key, held] : textures_)
        if (key.first == name)
            load(key, held);
}

bool TextureLibrary::refresh() {
    bool changed = false;
    for (auto& [key, held] : textures_) {
        if (find_built_in(key.first) != nullptr || file_stamps(key.first) == held.stamps)
            continue;
        load(key, held);
        changed = true;
    }
    return changed;
}

std::vector<std::string> TextureLibrary::errors() const {
    std::vector<std::string> messages;
    for (const auto& [key, held] : textures_)
        if (!held.entry.error.empty() &&
            std::find(messages.begin(), messages.end(), held.entry.error) == messages.end())
            messages.push_back(held.entry.error);
    return messages;
}

} // namespace clothlab::render
