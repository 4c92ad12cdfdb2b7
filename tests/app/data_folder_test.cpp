// Where the program finds what it comes with.
#include "app/core/data_folder.h"

#include <catch2/catch_test_macros.hpp>
#include <cstdlib>
#include <optional>

#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;

namespace {

/// Sets CLOTHLAB_DATA while it lives.
class DataVariable {
public:
    explicit DataVariable(const std::string& value) {
        if (const char* old = std::getenv("CLOTHLAB_DATA"))
            old_ = old;
        ::setenv("CLOTHLAB_DATA", value.c_str(), 1);
    }
    ~DataVariable() {
        if (old_)
            ::setenv("CLOTHLAB_DATA", old_->c_str(), 1);
        else
            ::unsetenv("CLOTHLAB_DATA");
    }
    DataVariable(const DataVariable&) = delete;
    DataVariable& operator=(const DataVariable&) = delete;

private:
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

TEST_CASE("The shipped shaders are wireframe and the files of shaders/cloth/") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "shaders" / "cloth");
    write_file(folder / "shaders" / "cloth" / "toon.frag", "");
    write_file(folder / "shaders" / "cloth" / "default.vert", "");
    const DataVariable data(folder.path().string());
    REQUIRE(app::shipped_shaders() == std::vector<std::string>{"wireframe", "toon"});
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
