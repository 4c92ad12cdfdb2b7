// Files that are there whole or not at all.
#include "scene/whole_file.h"

#include <catch2/catch_test_macros.hpp>

#include <sys/stat.h>

#include "support/files.h"

using namespace clothlab;
using namespace clothlab::test;

TEST_CASE("Until it is committed a file is what it was, and what is not committed leaves nothing") {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    {
        scene::WholeFile file(folder / "a");
        file.write("new, but not ");
        REQUIRE(read_file(folder / "a") == "old");
    }
    REQUIRE(read_file(folder / "a") == "old");
    REQUIRE(files_of(folder.path()).size() == 1);
    {
        scene::WholeFile file(folder / "a");
        file.write("new");
        file.write(" and whole");
        REQUIRE(file.size() == 13);
        REQUIRE(read_file(folder / "a") == "old");
        file.commit();
        REQUIRE(read_file(folder / "a") == "new and whole");
    }
    REQUIRE(read_file(folder / "a") == "new and whole");
    REQUIRE(files_of(folder.path()).size() == 1);
}

TEST_CASE("A part that a crash has left is taken over, whatever is in it") {
    const TemporaryFolder folder;
    write_file(folder / "a.part", "longer than what is to be written now");
    scene::WholeFile file(folder / "a");
    file.write("short");
    file.commit();
    REQUIRE(read_file(folder / "a") == "short");
    REQUIRE(files_of(folder.path()).size() == 1);
}

TEST_CASE("A file that is being written is not written by another at the same time") {
    const TemporaryFolder folder;
    scene::WholeFile first(folder / "a");
    first.write("first");
    REQUIRE_THROWS_AS(scene::WholeFile(folder / "a"), scene::FileError);
    first.commit();
    REQUIRE(read_file(folder / "a") == "first");
    scene::WholeFile second(folder / "a");
    second.write("second");
    second.commit();
    REQUIRE(read_file(folder / "a") == "second");
}

TEST_CASE("A link stays one, and a file's permissions stay") {
    const TemporaryFolder folder;
    write_file(folder / "a", "old");
    REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
    std::filesystem::create_symlink("a", folder / "link");
    scene::WholeFile file(folder / "link");
    file.write("new");
    file.commit();
    REQUIRE(std::filesystem::is_symlink(folder / "link"));
    REQUIRE(read_file(folder / "a") == "new");
    struct stat status {};
    REQUIRE(::stat((folder / "a").c_str(), &status) == 0);
    REQUIRE((status.st_mode & 0777) == 0640);
}

TEST_CASE("A device is written to, not replaced by a file") {
    scene::WholeFile null("/dev/null");
    null.write("nothing");
    null.commit();
    REQUIRE(std::filesystem::is_character_file("/dev/null"));
    REQUIRE_THROWS_AS(scene::WholeFile("/dev/full").write("much"), scene::FileError);
}
