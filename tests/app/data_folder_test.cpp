// Where the program finds what it comes with.
#include "app/core/data_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <optional>

#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Sets an environment variable while it lives.
class DataVariable {
public:
    explicit DataVariable(const std::string& value, const char* name = "CLOTHLAB_DATA") : name_(name) {
        if (const char* old = std::getenv(name))
            old_ = old;
        ::setenv(name, value.c_str(), 1);
    }
    ~DataVariable() {
        if (old_)
            ::setenv(name_, old_->c_str(), 1);
        else
            ::unsetenv(name_);
    }
    DataVariable(const DataVariable&) = delete;
    DataVariable& operator=(const DataVariable&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

TEST_CASE("A shipped scene is found by name, with and without its ending, and any scene by its file") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scenes");
    write_file(folder / "scenes" / "silk.json", "{}");
    write_file(folder / "mine.json", "{}");
    const DataVariable data(folder.path().string());
    REQUIRE(app::scene_path("silk") == folder / "scenes" / "silk.json");
    REQUIRE(app::scene_path("silk.json") == folder / "scenes" / "silk.json");
    const std::string file = (folder / "mine.json").string();
    REQUIRE(app::scene_path(file) == file);
    // What is neither is given back, so that reading it says what is wrong.
    for (const char* unknown : {"velvet", "silk.jso", "scenes/silk.jsonx", ""})
        REQUIRE(app::scene_path(unknown) == unknown);
}

TEST_CASE("The shipped scenes are the JSON files of scenes/, by name") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scenes");
    const DataVariable data(folder.path().string());
    REQUIRE(app::shipped_scenes().empty());
    for (const char* name : {"b.json", "a.json", "notes.txt", "c.json.part"})
        write_file(folder / "scenes" / name, "");
    REQUIRE(app::shipped_scenes() == std::vector{folder / "scenes" / "a.json", folder / "scenes" / "b.json"});
}

TEST_CASE("The shipped shaders are the files of shaders/cloth/") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "shaders" / "cloth");
    write_file(folder / "shaders" / "cloth" / "toon.frag", "");
    write_file(folder / "shaders" / "cloth" / "default.vert", "");
    const DataVariable data(folder.path().string());
    REQUIRE(app::shipped_shaders() == std::vector<std::string>{"toon"});
}

TEST_CASE("The user's shaders stand beside the shipped ones, in a folder that is looked in first") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "shaders" / "cloth");
    write_file(folder / "shaders" / "cloth" / "toon.frag", "");
    const DataVariable data(folder.path().string());
    const DataVariable home((folder / "home").string(), "XDG_DATA_HOME");
    const std::filesystem::path own = folder / "home" / "clothlab" / "shaders";
    REQUIRE(app::user_shader_folder() == own);
    REQUIRE(app::shader_folders() == std::vector{own, folder / "shaders"});
    REQUIRE(app::known_shaders() == app::shipped_shaders());
    std::filesystem::create_directories(own / "cloth");
    write_file(own / "cloth" / "silk.frag", "");
    write_file(own / "cloth" / "toon.frag", "");
    REQUIRE(app::known_shaders() == std::vector<std::string>{"silk", "toon"});
}

TEST_CASE("A folder that lacks a file is passed over for the next") {
    const TemporaryFolder folder;
    const DataVariable data(folder.path().string());
    REQUIRE(app::data_path("scenes/two-pins.json") != folder / "scenes" / "two-pins.json");
    REQUIRE(std::filesystem::exists(app::data_path("scenes/two-pins.json")));
    REQUIRE(app::shipped_scenes().size() >= 10);
}

TEST_CASE("A file that is nowhere is named, with all the folders where it was looked for") {
    const TemporaryFolder folder;
    const DataVariable data(folder.path().string());
    try {
        app::data_path("no-such-file.frag");
        FAIL("found");
    } catch (const std::runtime_error& e) {
        const std::string what = e.what();
        for (const std::string& part : {std::string("no-such-file.frag"), folder.path().string(), checkout().string(),
                                        std::string("CLOTHLAB_DATA")})
            REQUIRE(what.find(part) != std::string::npos);
    }
}
