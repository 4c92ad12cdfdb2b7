// Scenes with random values in every field of the table, extremes included.
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "scene/fields.h"
#include "sim/random.h"

namespace clothlab::test {

class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : random_(seed) {}

    scene::Scene scene() {
        scene::Scene s;
        const bool with_camera = below(2) == 0;
        for (const scene::Field& f : scene::fields())
            if (f.section() != "camera" || with_camera)
                set(s, f);
        s.name = text();
        s.description = text();
        sim::Cloth& cloth = s.simulation.cloth;
        for (std::uint64_t n = below(6); n > 0; --n)
            cloth.pinned.push_back({index_below(cloth.num_width_points), index_below(cloth.num_height_points)});
        for (std::uint64_t n = below(4); n > 0; --n)
            s.simulation.stepping.accelerations.push_back(vector());
        for (std::uint64_t n = below(5); n > 0; --n)
            s.simulation.colliders.push_back(collider());
        for (std::uint64_t n = below(4); n > 0; --n)
            s.look.shaders[text()][text()] = shader_value();
        return s;
    }

    /// Another value that the field allows.
    void set(scene::Scene& s, const scene::Field& f) {
        switch (f.type) {
        case scene::FieldType::vector:
            return f.set_vector(s, vector());
        case scene::FieldType::text:
            return f.set_text(s, text());
        default:
            return f.set(s, allowed(f));
        }
    }

    double allowed(const scene::Field& f) {
        if (f.type != scene::FieldType::number) {
            const auto values = static_cast<std::uint64_t>(f.allowed.max - f.allowed.min) + 1;
            const std::uint64_t ends = below(4);
            return ends == 0 ? f.allowed.min : ends == 1 ? f.allowed.max : f.allowed.min + double(below(values));
        }
        for (;;)
            if (const double value = number(); !scene::objection(f, value))
                return value;
    }

    /// Any finite double: an extreme, an everyday number, or random bits.
    double number() {
        constexpr double extremes[] = {0.0,
                                       -0.0,
                                       1e-300,
                                       -1e-300,
                                       1e300,
                                       -1e300,
                                       1,
                                       100,
                                       0.1,
                                       std::numeric_limits<double>::max(),
                                       std::numeric_limits<double>::min(),
                                       std::numeric_limits<double>::denorm_min(),
                                       9007199254740993.0,
                                       1 - 0x1p-53,
                                       1 + 0x1p-52};
        switch (below(3)) {
        case 0:
            return extremes[below(std::size(extremes))];
        case 1:
            return (random_.unit() - 0.3) * 100;
        default:
            const double any = std::bit_cast<double>(random_.next());
            return std::isfinite(any) ? any : 2.5;
        }
    }

    sim::Vec3 vector() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }

    /// UTF-8 with all that JSON has to escape.
    std::string text() {
        static const std::string pieces[] = {"\"", "\\", "\n", "\t",   "\r",   "\x01",   std::string(1, '\0'),
                                             "/",  "ä",  "布", "🧵", "\x7f", "\u2028", "a",
                                             "Z",  " ",  "{",  "\\u0", "\\\"", "//",     "\uffff",
                                             "'",  "\b", "\f"};
        std::string result;
        for (std::uint64_t n = below(12); n > 0; --n)
            result += pieces[below(std::size(pieces))];
        return result;
    }

    sim::Collider collider() {
        if (below(2) == 0)
            return sim::Sphere{vector(), positive(), random_.unit()};
        sim::Vec3 normal = vector();
        while (!(std::hypot(normal.x, normal.y, normal.z) > 0) || std::isinf(std::hypot(normal.x, normal.y, normal.z)))
            normal = vector();
        return sim::Plane{vector(), normal, below(3) == 0 ? 1.0 : random_.unit()};
    }

    scene::ShaderValue shader_value() {
        switch (below(4)) {
        case 0:
            return number();
        case 1:
            return below(2) == 0;
        case 2:
            return vector();
        default:
            return text();
        }
    }

    std::uint64_t below(std::uint64_t end) { return random_.next() % end; }

private:
    int index_below(int end) { return static_cast<int>(below(static_cast<std::uint64_t>(end))); }
    double positive() {
        for (;;)
            if (const double value = number(); value > 0)
                return value;
    }

    sim::SplitMix64 random_;
};

} // namespace clothlab::test
