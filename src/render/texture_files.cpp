#include "render/texture_files.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include <glm/glm.hpp>

namespace clothlab::render {

namespace {

namespace fs = std::filesystem;
constexpr const char* face_endings[] = {".png", ".jpg", ".jpeg", ".hdr"};

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw std::runtime_error("cannot use the environment " + path.string() + ": " + why);
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

/// The file of a face in a folder, whatever its ending.
std::optional<fs::path> face_file(const fs::path& folder, const std::string& name) {
    std::error_code error;
    for (const char* ending : face_endings)
        if (fs::path file = folder / (name + ending); fs::exists(file, error))
            return file;
    return std::nullopt;
}

std::vector<PictureFile> open_faces(const fs::path& folder, int most_pixels) {
    std::string missing;
    std::vector<fs::path> paths;
    for (const char* name : cube_face_names) {
        if (const auto file = face_file(folder, name))
            paths.push_back(*file);
        else
            missing += (missing.empty() ? "" : ", ") + std::string(name);
    }
    if (!missing.empty())
        fail(folder, "the folder has no picture (.png, .jpg or .hdr) named " + missing);
    std::vector<PictureFile> faces;
    for (const fs::path& file : paths) {
        const PictureFile& face = faces.emplace_back(open_texture(file, most_pixels));
        const PictureFile& first = faces.front();
        if (face.width() != face.height())
            fail(folder, file.filename().string() + " is not square: " + size_text(face.width(), face.height()));
        if (face.width() != first.width())
            fail(folder, file.filename().string() + " is " + size_text(face.width(), face.height()) + ", but " +
                             paths.front().filename().string() + " is " + size_text(first.width(), first.height()));
    }
    return faces;
}

Environment load_faces(const fs::path& folder, int most_pixels) {
    const std::vector<PictureFile> files = open_faces(folder, most_pixels);
    const auto decoded = [&](auto decode) {
        Cube<decltype(decode(files[0]))> cube;
        for (std::size_t face = 0; face < cube.size(); ++face)
            cube[face] = decode(files[face]);
        return cube;
    };
    if (std::any_of(files.begin(), files.end(), [](const PictureFile& file) { return file.high_range(); }))
        return decoded([](const PictureFile& file) { return file.linear(); });
    return decoded([](const PictureFile& file) { return file.rgba8(); });
}

/// The colour at a place of the panorama, in pixels; it goes round sideways and ends above and below.
glm::vec3 sample(const FloatImage& panorama, float x, float y) {
    const float left = std::floor(x), top = std::floor(y);
    const auto column = [&](float at) {
        const int i = static_cast<int>(at) % panorama.width;
        return i < 0 ? i + panorama.width : i;
    };
    const auto row = [&](float at) { return std::clamp(static_cast<int>(at), 0, panorama.height - 1); };
    const auto pixel = [&](float at_x, float at_y) {
        const float* p = panorama.pixel(column(at_x), row(at_y));
        return glm::vec3(p[0], p[1], p[2]);
    };
    return glm::mix(glm::mix(pixel(left, top), pixel(left + 1, top), x - left),
                    glm::mix(pixel(left, top + 1), pixel(left + 1, top + 1), x - left), y - top);
}

} // namespace

PictureFile open_texture(const fs::path& path, int most_pixels) {
    PictureFile file(path);
    if (std::max(file.width(), file.height()) > most_pixels)
        throw std::runtime_error("cannot use the picture " + path.string() + ": it is " +
                                 size_text(file.width(), file.height()) + ", and this computer's graphics take " +
                                 std::to_string(most_pixels) + " at most along a side");
    return file;
}

Environment load_environment(const fs::path& path, int most_pixels) {
    std::error_code error;
    if (fs::is_directory(path, error))
        return load_faces(path, most_pixels);
    // Never a texture itself: any size will do.
    return cube_from_panorama(PictureFile(path).linear(), most_pixels);
}

Cube<FloatImage> cube_from_panorama(const FloatImage& panorama, int most_pixels) {
    constexpr float pi = std::numbers::pi_v<float>;
    const int quarter = std::min(panorama.width / 4, panorama.height / 2); // 90 degrees of it
    const int size = std::clamp(quarter, 1, std::min(1024, most_pixels));
    // In rows and columns, about as many samples of each pixel as the picture has pixels for it, within reason.
    const int samples = std::clamp((panorama.width + 4 * size - 1) / (4 * size), 1, 4);
    const float width = static_cast<float>(panorama.width), height = static_cast<float>(panorama.height);
    const float step = 2 / static_cast<float>(size * samples), weight = 1 / static_cast<float>(samples * samples);
    Cube<FloatImage> cube;
    for (int face = 0; face < 6; ++face) {
        FloatImage& image = cube[static_cast<std::size_t>(face)];
        image = {size, size, {}};
        image.rgb.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * 3);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                glm::vec3 sum(0);
                for (int i = 0; i < samples * samples; ++i) {
                    const auto d =
                        cube_direction(face, (static_cast<float>(x * samples + i % samples) + 0.5f) * step - 1,
                                       (static_cast<float>(y * samples + i / samples) + 0.5f) * step - 1);
                    const float u = 0.5f + std::atan2(d[0], -d[2]) / (2 * pi);
                    const float v = 0.5f - std::atan2(d[1], std::hypot(d[0], d[2])) / pi;
                    sum += sample(panorama, u * width - 0.5f, v * height - 0.5f);
                }
                sum *= weight;
                image.rgb.insert(image.rgb.end(), {sum.x, sum.y, sum.z});
            }
        }
    }
    return cube;
}

std::vector<FileStamp> file_stamps(const fs::path& path) {
    std::vector<FileStamp> stamps;
    const auto add = [&](const fs::path& file) {
        std::error_code no_time, no_size;
        const auto written = fs::last_write_time(file, no_time);
        const auto size = fs::file_size(file, no_size);
        if (!no_time && !no_size)
            stamps.push_back({file, written, size});
    };
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        add(path);
        return stamps;
    }
    for (const char* name : cube_face_names)
        if (const auto file = face_file(path, name))
            add(*file);
    return stamps;
}

} // namespace clothlab::render
