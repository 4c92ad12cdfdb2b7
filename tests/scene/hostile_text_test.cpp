// No text, however broken, does more than fail with a SceneError, and soon.
#include <catch2/catch_message.hpp>
#include <catch2/catch_test_macros.hpp>

#include "scene/fields.h"
#include "scene/io.h"
#include "support/effort.h"
#include "support/files.h"
#include "support/random_scene.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Whether the text is a scene. Anything but a sound scene or a SceneError with a sentence fails the test.
bool is_scene(const std::string& text) {
    try {
        const scene::Scene scene = scene::read_scene(text, "text");
        scene::check(scene, "text");
        for (const scene::Field& f : scene::fields()) {
            if (!f.get)
                continue;
            INFO(f.key);
            REQUIRE_FALSE(scene::objection(f, f.get(scene)));
        }
        return true;
    } catch (const scene::SceneError& e) {
        const std::string what = e.what();
        REQUIRE(what.rfind("text:", 0) == 0);
        REQUIRE(what.size() > 15);
        return false;
    }
}

std::string small_scene() {
    scene::Scene scene;
    scene.name = "a \"name\" \\ with\nlines, ä and 🧵";
    scene.camera.emplace();
    scene.simulation.cloth.pinned = {{0, 0}, {49, 49}};
    scene.simulation.colliders = {sim::Sphere{}, sim::Plane{}};
    scene.simulation.stepping.accelerations = {{1, 2, 3}};
    return scene::write_scene(scene);
}

std::string repeated(const std::string& piece, std::size_t size) {
    std::string text;
    text.reserve(size + piece.size());
    while (text.size() < size)
        text += piece;
    return text;
}

constexpr std::size_t ten_megabytes = 10'000'000;

} // namespace

TEST_CASE("A scene that ends at any byte is no scene until its last bracket") {
    for (const std::string& whole : {small_scene(), read_file(checkout() / "tests/data/cs184-sphere.json")}) {
        const std::size_t last = whole.rfind('}');
        REQUIRE(is_scene(whole));
        for (std::size_t size = 0; size < whole.size(); ++size) {
            INFO("cut at " << size);
            REQUIRE(is_scene(whole.substr(0, size)) == (size > last));
        }
    }
}

TEST_CASE("Ten megabytes of brackets are refused for their depth") {
    for (const std::string piece : {"[", "{\"a\":", "[{\"a\":", "{\"cloth\":"}) {
        const std::string text = repeated(piece, ten_megabytes);
        try {
            scene::read_scene(text, "text");
            FAIL("it was read");
        } catch (const scene::SceneError& e) {
            REQUIRE(std::string(e.what()) == "text:1: nested deeper than 32 levels");
        }
    }
    REQUIRE_FALSE(is_scene(repeated("]", ten_megabytes)));
    REQUIRE_FALSE(is_scene(repeated("\n", ten_megabytes)));
    REQUIRE_FALSE(is_scene("{\"clothlab\": 1, \"name\": \"" + repeated("x", ten_megabytes)));
}

TEST_CASE("Thirty-two levels are read, thirty-three are not") {
    const auto nested = [](std::size_t levels) { return repeated("[", levels) + repeated("]", levels); };
    const auto error_of = [](const std::string& text) -> std::string {
        try {
            scene::read_scene(text, "text");
        } catch (const scene::SceneError& e) {
            return e.what();
        }
        return "";
    };
    REQUIRE(error_of(nested(32)).find("one JSON object") != std::string::npos);
    REQUIRE(error_of(nested(33)).find("nested deeper") != std::string::npos);
}

TEST_CASE("Megabytes of values, lines and keys take a time in proportion, not its square") {
    // Were lines counted from the start for each value, or every key compared with all others, this would take hours.
    const std::size_t size = ten_megabytes / (sanitized ? 10 : 2);
    REQUIRE_FALSE(is_scene("{\"clothlab\": 1, \"pinned\": [" + repeated("[0, 0],\n", size) + "[0, 0]]}"));
    REQUIRE(is_scene("{\"clothlab\": 1, \"cloth\": {\"pinned\": [" + repeated("[0, 0],\n", size / 4) + "[0, 0]]}}"));
    std::string keys = "{\"clothlab\": 1";
    for (int i = 0; keys.size() < size; ++i)
        keys += ", \"key " + std::to_string(i) + "\": 0";
    REQUIRE_FALSE(is_scene(keys + "}"));
}

TEST_CASE("Noise is no scene") {
    for (int seed = 0; seed < attempts(5000); ++seed) {
        RandomScene random(static_cast<std::uint64_t>(seed));
        std::string noise(random.below(200), '\0');
        const bool printable = seed % 2 == 0;
        for (char& c : noise)
            c = static_cast<char>(printable ? ' ' + static_cast<int>(random.below(95))
                                            : static_cast<int>(random.below(256)));
        INFO("seed " << seed);
        REQUIRE_FALSE(is_scene(noise));
        REQUIRE_FALSE(is_scene("{" + noise));
        REQUIRE_FALSE(is_scene("{\"clothlab\": 1, " + noise));
    }
}

TEST_CASE("A scene with bytes changed, lost and added is a sound scene or an error") {
    const std::string whole = small_scene();
    // Bytes that matter in JSON come more often than by chance.
    const std::string telling = "{}[]\",:0123456789.-+eE\\ \n\ttruefalsn\xff\x80";
    int scenes = 0;
    const int tries = attempts(20000);
    for (int seed = 0; seed < tries; ++seed) {
        RandomScene random(static_cast<std::uint64_t>(seed));
        std::string text = whole;
        for (std::uint64_t changes = 1 + random.below(4); changes > 0; --changes) {
            const std::size_t at = random.below(text.size());
            const char byte = random.below(2) == 0 ? telling[random.below(telling.size())]
                                                   : static_cast<char>(static_cast<unsigned char>(random.below(256)));
            switch (random.below(4)) {
            case 0:
                text[at] = byte;
                break;
            case 1:
                text.insert(at, 1, byte);
                break;
            case 2:
                text.erase(at, 1 + random.below(3));
                break;
            default: // a passage from elsewhere
                text.insert(at, text.substr(random.below(text.size()), random.below(30)));
            }
        }
        INFO("seed " << seed);
        scenes += is_scene(text);
    }
    CHECK(scenes > 0); // some changes do no harm
    CHECK(scenes < tries);
}
