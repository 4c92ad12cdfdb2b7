// The layers of the design: what may include what, what the simulation may not do, and how long files may be.
#include <catch2/catch_test_macros.hpp>
#include <map>
#include <regex>
#include <sstream>

#include "support/files.h"

using namespace clothlab::test;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

struct Layer {
    std::string folder; ///< under src/, or a file
    Names own;          ///< folders that it may include with quotes
    Names foreign;      ///< beginnings of what else it may include with angle brackets, besides the standard library
};

/// The first that a file lies in is its layer.
const std::vector<Layer>& layers() {
    // With what POSIX has for running ffmpeg.
    static const Names gui{"imgui",   "implot",  "ImGuizmo", "TextEditor", "GLFW/", "glad/", "portable_file_dialogs.h",
                           "fcntl.h", "spawn.h", "sys/",     "unistd.h"};
    static const std::vector<Layer> list{
        {"sim/", {"sim/"}, {"Eigen/", "hwy/", "sched.h"}},
        // With what POSIX has for writing a file whole and for reading a part of it.
        {"scene/", {"scene/", "sim/"}, {"nlohmann/", "fcntl.h", "sys/", "unistd.h"}},
        {"timeline/", {"timeline/", "scene/", "sim/"}, {"lz4", "fcntl.h", "sys/", "unistd.h"}},
        {"experiments/", {"experiments/", "scene/", "sim/"}, {"hwy/"}},
        {"render/", {"render/", "sim/"}, {"glad/", "glm/", "stb/", "stb_"}},
        {"ui/",
         {"ui/", "experiments/", "timeline/", "scene/", "sim/"},
         {"imgui", "implot", "ImGuizmo", "TextEditor", "icons_font_awesome_6.h"}},
        {"app/core/", {"app/core/", "experiments/", "timeline/", "scene/", "sim/"}, {}},
        {"app/", {"app/", "ui/", "render/", "experiments/", "timeline/", "scene/", "sim/"}, gui},
        {"cli/gui/", {"cli/", "app/", "ui/", "render/", "experiments/", "timeline/", "scene/", "sim/"}, gui},
        {"cli/",
         {"cli/command_line.h", "cli/experiment/", "cli/finite.h", "cli/progress_bar.h", "app/core/", "experiments/",
          "timeline/", "scene/", "sim/"},
         {"CLI/", "nlohmann/", "fcntl.h", "spawn.h", "sys/", "unistd.h"}},
        {"main.cpp", {"cli/"}, {}},
    };
    return list;
}

bool begins_with_one_of(const std::string& text, const Names& beginnings) {
    for (const std::string& beginning : beginnings)
        if (text.rfind(beginning, 0) == 0)
            return true;
    return false;
}

/// The files below a folder, relative to it.
Names files_below(const fs::path& folder) {
    Names files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files.push_back(fs::relative(entry.path(), folder).string());
    std::sort(files.begin(), files.end());
    return files;
}

/// The files of a checkout that are its own: not build folders, whatever their names, nor what is downloaded.
Names own_files(const fs::path& root) {
    Names files;
    for (const fs::path& path : files_of(root)) {
        const std::string name = path.filename().string();
        if (fs::is_regular_file(path) && name != ".git" && name != "compile_commands.json" &&
            name != "CMakeUserPresets.json")
            files.push_back(name);
    }
    for (const std::string folder : {".ci", "assets", "cmake", "docs", "scenes", "shaders", "src", "tests"})
        if (fs::is_directory(root / folder))
            for (const std::string& file : files_below(root / folder))
                files.push_back(folder + "/" + file);
    return files;
}

bool is_source(const std::string& file) {
    const std::string ending = fs::path(file).extension().string();
    return ending == ".cpp" || ending == ".h" || ending == ".def";
}

/// Calls visit(file, line number, line) for every line of every source file.
template <class Visit>
void for_each_line(const fs::path& src, Visit visit) {
    for (const std::string& file : files_below(src)) {
        if (!is_source(file))
            continue;
        std::istringstream lines(read_file(src / file));
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number)
            visit(file, number, line);
    }
}

std::string at(const std::string& file, int line, const std::string& what) {
    return file + ":" + std::to_string(line) + ": " + what;
}

/// Includes that the design does not draw.
Names forbidden_includes(const fs::path& src) {
    static const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    static const std::regex standard("[a-z0-9_]+"); // <vector>: no folder, no ending
    Names found;
    for_each_line(src, [&](const std::string& file, int number, const std::string& line) {
        const Layer* layer = nullptr;
        for (const Layer& candidate : layers())
            if (!layer && file.rfind(candidate.folder, 0) == 0)
                layer = &candidate;
        std::smatch match;
        if (!layer)
            return void(number == 1 ? found.push_back(at(file, 1, "in no layer")) : void());
        if (!std::regex_search(line, match, include))
            return;
        const std::string what = match[2];
        const bool allowed = match[1] == "\""
                                 ? begins_with_one_of(what, layer->own)
                                 : std::regex_match(what, standard) || begins_with_one_of(what, layer->foreign);
        if (!allowed)
            found.push_back(at(file, number, what));
    });
    return found;
}

/// Where the simulation prints, reads files or the environment, or ends the program.
Names forbidden_calls(const fs::path& src) {
    static const std::regex call(
        R"(\b(v?f?printf|f?puts|f?putc|putchar|fwrite|fopen|exit|_Exit|quick_exit|abort|terminate)"
        R"(|getenv|system)\s*\(|\bstd::(cout|cerr|clog|cin|[io]?fstream|filesystem)\b)");
    static const std::regex header(R"(#\s*include\s*<(iostream|fstream|filesystem|print)>)");
    static const std::regex quiet(R"re(//.*|"(\\.|[^"\\])*")re"); // comments and text
    Names found;
    for_each_line(src, [&](const std::string& file, int number, const std::string& line) {
        if (file.rfind("sim/", 0) != 0)
            return;
        const std::string code = std::regex_replace(line, quiet, "");
        if (std::regex_search(code, call) || std::regex_search(code, header))
            found.push_back(at(file, number, line));
    });
    return found;
}

Names long_files(const fs::path& src, int most) {
    std::map<std::string, int> lines;
    for_each_line(src, [&](const std::string& file, int number, const std::string&) { lines[file] = number; });
    Names found;
    for (const auto& [file, count] : lines)
        if (count > most)
            found.push_back(file);
    return found;
}

/// Files with a place or a host that only one machine knows. Spelt in pieces, so that this file has none of them.
Names machine_names(const fs::path& root) {
    const Names needles{std::string("/wo") + "rk/",         std::string("/ho") + "me/",
                        std::string("/Use") + "rs/",        std::string("deb.") + "debian",
                        std::string("archive.") + "ubuntu", std::string("py") + "pi.org",
                        std::string("python") + "hosted",   std::string("snapshot.") + "debian"};
    Names found;
    for (const std::string& file : own_files(root)) {
        const std::string text = read_file(root / file);
        for (const std::string& needle : needles)
            if (text.find(needle) != std::string::npos)
                found.push_back(file + ": " + needle);
    }
    return found;
}

void plant(const TemporaryFolder& folder, const std::string& file, const std::string& text) {
    fs::create_directories((folder / file).parent_path());
    write_file(folder / file, text);
}

} // namespace

TEST_CASE("Every file includes only the layers below its own") {
    REQUIRE(files_below(checkout() / "src").size() > 50);
    REQUIRE(forbidden_includes(checkout() / "src") == Names{});
}

TEST_CASE("The simulation prints nothing, reads no files and ends no program") {
    REQUIRE(forbidden_calls(checkout() / "src") == Names{});
}

TEST_CASE("Test names are such that ctest can run each by its name") {
    // ctest hands the name to the test program, which reads a leading dash as an option; CMake's lists split at
    // semicolons and pair up brackets.
    static const std::regex name(R"re(TEST_CASE\(\s*"([^"]*)")re");
    int seen = 0;
    for (const std::string& file : files_below(checkout() / "tests")) {
        if (!is_source(file))
            continue;
        const std::string text = read_file(checkout() / "tests" / file);
        for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++seen) {
            INFO(file << ": " << (*it)[1]);
            CHECK((*it)[1].str().find_first_of(";[]") == std::string::npos);
            CHECK((*it)[1].str().rfind("-", 0) == std::string::npos);
        }
    }
    CHECK(seen > 100);
}

TEST_CASE("No source file is longer than 450 lines") {
    REQUIRE(long_files(checkout() / "src", 450) == Names{});
}

TEST_CASE("No file names a place on one machine or the host of a package registry") {
    REQUIRE(machine_names(checkout()) == Names{});
}

TEST_CASE("The checks of the architecture find what is planted for them, and nothing else") {
    const TemporaryFolder folder;
    plant(folder, "sim/good.h", "#include <vector>\n#include <Eigen/Sparse>\n#include \"sim/grid.h\"\n");
    plant(folder, "sim/bad.cpp", "#include <vector>\n  #  include \"scene/scene.h\"\n#include <nlohmann/json.hpp>\n");
    plant(folder, "scene/bad.cpp", "#include \"app/core/history.h\"\n#include <nlohmann/json.hpp>\n");
    plant(folder, "render/bad.h", "#include <glm/glm.hpp>\n#include \"ui/lab.h\"\n#include \"scene/scene.h\"\n");
    plant(folder, "ui/bad.cpp", "#include <imgui.h>\n#include \"render/view.h\"\n#include <glad/gl.h>\n");
    plant(folder, "app/core/bad.cpp", "#include \"sim/grid.h\"\n#include \"ui/lab.h\"\n#include <GLFW/glfw3.h>\n");
    plant(folder, "app/good.cpp", "#include \"ui/lab.h\"\n#include \"render/view.h\"\n#include <GLFW/glfw3.h>\n");
    plant(folder, "cli/bad.cpp", "#include \"cli/gui/a.h\"\n#include \"app/lab_app.h\"\n#include <CLI/CLI.hpp>\n");
    plant(folder, "cli/gui/good.cpp", "#include \"app/lab_app.h\"\n#include \"cli/gui/a.h\"\n");
    plant(folder, "sim/rules.def", "#include <unistd.h>\n");
    plant(folder, "other/file.h", "\n\n");
    REQUIRE(forbidden_includes(folder.path()) ==
            Names{"app/core/bad.cpp:2: ui/lab.h", "app/core/bad.cpp:3: GLFW/glfw3.h", "cli/bad.cpp:1: cli/gui/a.h",
                  "cli/bad.cpp:2: app/lab_app.h", "other/file.h:1: in no layer", "render/bad.h:2: ui/lab.h",
                  "render/bad.h:3: scene/scene.h", "scene/bad.cpp:1: app/core/history.h",
                  "sim/bad.cpp:2: scene/scene.h", "sim/bad.cpp:3: nlohmann/json.hpp", "sim/rules.def:1: unistd.h",
                  "ui/bad.cpp:2: render/view.h", "ui/bad.cpp:3: glad/gl.h"});

    plant(folder, "sim/calls.cpp",
          "std::snprintf(text, 3, \"printf(\");\n// printf()\nstd::printf(\"a\");\nstd::exit(1);\nabort();\n"
          "std::cout << 1;\nstd::getenv(\"A\");\n#include <iostream>\nint exits(int);\nstd::ofstream f;\n");
    const Names calls = forbidden_calls(folder.path());
    REQUIRE(calls.size() == 7);
    REQUIRE(calls.front() == "sim/calls.cpp:3: std::printf(\"a\");");
    REQUIRE(calls.back() == "sim/calls.cpp:10: std::ofstream f;");

    plant(folder, "ui/long.cpp", "1\n2\n3\n4\n5\n");
    fs::remove(folder / "sim/calls.cpp");
    REQUIRE(long_files(folder.path(), 4) == Names{"ui/long.cpp"});
    REQUIRE(long_files(folder.path(), 5) == Names{});

    plant(folder, "docs/a.md", std::string("see /wo") + "rk/x");
    plant(folder, "build/a.md", std::string("see /wo") + "rk/x");
    plant(folder, "setup.sh", std::string("curl py") + "pi.org");
    REQUIRE(machine_names(folder.path()) ==
            Names{std::string("setup.sh: py") + "pi.org", std::string("docs/a.md: /wo") + "rk/"});
}
