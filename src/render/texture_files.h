// Textures from files, before they go to OpenGL: pictures, and surroundings as the faces of a cube. Needs no GL.
#pragma once

#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "render/picture_file.h"
#include "render/procedural.h"

namespace clothlab::render {

/// Opens a picture that is to be a texture. Throws std::runtime_error, naming the file and why, when it cannot be read
/// or when a side is longer than most_pixels: it is better to say so than to show less than the file has.
PictureFile open_texture(const std::filesystem::path& path, int most_pixels);

/// Surroundings from a file or a folder. Faces of 8 bits are sRGB.
using Environment = std::variant<Cube<Image>, Cube<FloatImage>>;

/// - A folder with posx, negx, posy, negy, posz, negz (.png, .jpg, .jpeg or .hdr): these are the faces as they are.
/// - Else a picture of the whole surroundings (equirectangular, or latitude-longitude): its middle is -z, right of it
/// is
///   +x, its top +y. The faces have as many pixels as 90 degrees of it, 1024 a side at most.
/// Throws std::runtime_error with the path and the reason: a picture that cannot be read, a face that is missing, not
/// square or not as large as the others, a side longer than most_pixels.
Environment load_environment(const std::filesystem::path& path, int most_pixels);

/// The faces of a cube map from a picture of the whole surroundings, as load_environment makes them.
Cube<FloatImage> cube_from_panorama(const FloatImage& panorama, int most_pixels);

/// What says whether a file, or the faces in a folder, were changed: paths, times of writing and sizes. A file that is
/// not there is left out.
struct FileStamp {
    std::filesystem::path file;
    std::filesystem::file_time_type written;
    std::uintmax_t size;
    bool operator==(const FileStamp&) const = default;
};
std::vector<FileStamp> file_stamps(const std::filesystem::path& path);

} // namespace clothlab::render
