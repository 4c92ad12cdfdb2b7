// clothlab experiment sweep and merge, as a program: stopped at any moment, in shards, by any number of processes, the
// table has the same bytes.
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>

#include "support/run.h"

using namespace clothlab::test;
using Words = std::vector<std::string>;

namespace {

Words sweep_of(const std::string& scene, const Words& rest) {
    Words all{"experiment", "sweep", scene};
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

/// A sweep of 12 cells that takes some tenths of a second.
Words usual(const std::string& scene, const Words& rest = {}) {
    Words all = sweep_of(scene, {"--vary", "cloth.ks=100:10000:4log", "--vary",
                                 "simulation.integrator=course-verlet,rk4,"
                                 "backward-euler",
                                 "--frames", "60"});
    all.insert(all.end(), rest.begin(), rest.end());
    return all;
}

Finished succeed(const Words& words) {
    Finished finished = clothlab::test::clothlab(words);
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    return finished;
}

Finished fail(const Words& words, int status = 2) {
    Finished finished = clothlab::test::clothlab(words);
    INFO(finished.err);
    REQUIRE(finished.status == status);
    return finished;
}

std::size_t lines_of(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error))
        return 0;
    const std::string text = read_file(file);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool has(const std::string& text, const std::string& part) {
    INFO(text);
    INFO(part);
    const bool found = text.find(part) != std::string::npos;
    CHECK(found);
    return found;
}

/// The program at work, with nothing on its standard output and its complaints in a file.
class Running {
public:
    Running(Words words, const std::filesystem::path& errors) {
        words.insert(words.begin(), CLOTHLAB_TEST_BINARY);
        std::vector<char*> argv;
        for (std::string& word : words)
            argv.push_back(word.data());
        argv.push_back(nullptr);
        const std::string file = errors.string();
        process_ = ::fork();
        if (process_ == 0) {
            const int out = ::open("/dev/null", O_WRONLY),
                      err = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
            if (::dup2(out, STDOUT_FILENO) < 0 || ::dup2(err, STDERR_FILENO) < 0)
                ::_exit(126);
            ::execv(argv[0], argv.data());
            ::_exit(127);
        }
    }
    ~Running() {
        if (process_ > 0)
            end(SIGKILL);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t process() const { return process_; }
    /// Its wait status.
    int end(int signal) {
        ::kill(process_, signal);
        return wait();
    }
    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return status;
    }
    bool ended() {
        int status = 0;
        if (::waitpid(process_, &status, WNOHANG) != process_)
            return false;
        process_ = -1;
        return true;
    }

private:
    pid_t process_ = -1;
};

/// Processes that a process has started.
std::vector<pid_t> children_of(pid_t process) {
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        if (entry.path().filename().string().find_first_not_of("0123456789") != std::string::npos)
            continue;
        std::ifstream stat(entry.path() / "stat");
        std::string text; // stays empty where the process goes while it is looked at
        std::getline(stat, text);
        const std::size_t name_end = text.rfind(')'); // "17 (clothlab) S 16 ..."
        long parent = 0;
        if (name_end != std::string::npos && std::sscanf(text.c_str() + name_end + 1, " %*c %ld", &parent) == 1 &&
            parent == process)
            children.push_back(static_cast<pid_t>(std::stol(text)));
    }
    return children;
}

/// Stops the usual sweep by a signal when it has written some of its cells.
void stop_half_way(const std::string& scene, const TemporaryFolder& folder, int signal) {
    Running running(usual(scene, {"--csv", (folder / "t.csv").string(), "--jobs", "2"}), folder / "errors");
    while (lines_of(folder / "t.csv") < 4) {
        REQUIRE_FALSE(running.ended());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const int status = running.end(signal);
    if (signal == SIGKILL)
        REQUIRE(WIFSIGNALED(status));
    else
        REQUIRE(WEXITSTATUS(status) == 1);
    REQUIRE(lines_of(folder / "t.csv") >= 4);
    REQUIRE(lines_of(folder / "t.csv") < 13);
}

} // namespace

TEST_CASE("A sweep has the same bytes for any number of processes, in a file and on standard output", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string table = succeed(usual(scene, {"--csv", "-", "--jobs", "1"})).out;
    REQUIRE(std::count(table.begin(), table.end(), '\n') == 13);
    for (const char* jobs : {"1", "3", "12"}) {
        const std::string file = (folder / jobs).string();
        REQUIRE(succeed(usual(scene, {"--csv", file, "--jobs", jobs})).err.empty());
        REQUIRE(read_file(file) == table);
    }
    REQUIRE(succeed(usual(scene, {"--csv", "-"})).out == table);
    // The last cell, by the command that runs it alone.
    const std::string hash = run(scene, {"--frames", "60", "--hash", "--set", "cloth.ks=10000", "--set",
                                         "simulation.integrator=backward-euler"});
    REQUIRE(table.find("," + hash.substr(0, 16) + ",") > table.rfind('\n', table.size() - 2));
}

TEST_CASE("A sweep that was killed half way goes on, and its table is that of one that was not", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string table = succeed(usual(scene, {"--csv", "-"})).out;
    stop_half_way(scene, folder, SIGKILL);
    const std::string file = (folder / "t.csv").string();
    const std::string left = read_file(file);
    const std::size_t finished = lines_of(file) - 1;
    write_file(file, left + "11,10000,impl"); // as if in the middle of a line
    const Finished again = succeed(usual(scene, {"--csv", file}));
    REQUIRE(has(again.err, std::to_string(finished) + " of 12 cells were finished before\n"));
    REQUIRE(read_file(file) == table);

    write_file(folder / "t.csv.part", "what a crash left behind");
    const Finished once_more = succeed(usual(scene, {"--csv", file}));
    REQUIRE(has(once_more.err, "12 of 12 cells were finished before\n"));
    REQUIRE(read_file(file) == table);
    REQUIRE(once_more.out == again.out);
}

TEST_CASE("Finished cells are not run again", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string file = (folder / "t.csv").string();
    succeed(usual(scene, {"--csv", file, "--times"}));
    const std::string timed = read_file(file); // no run has the same times again
    const std::size_t last_line = timed.rfind('\n', timed.size() - 2) + 1;
    write_file(file, timed.substr(0, last_line));
    succeed(usual(scene, {"--csv", file, "--times"}));
    REQUIRE(read_file(file).substr(0, last_line) == timed.substr(0, last_line));
    REQUIRE(read_file(file) != timed);
    succeed(usual(scene, {"--csv", file, "--times", "--fresh"}));
    REQUIRE(read_file(file).substr(0, last_line) != timed.substr(0, last_line));
}

TEST_CASE("Ctrl+C keeps what is finished, says how to go on, and leaves no process", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    stop_half_way(scene, folder, SIGINT);
    REQUIRE(has(read_file(folder / "errors"), "clothlab: stopped: "));
    REQUIRE(has(read_file(folder / "errors"), " of 12 cells are finished and kept in " + (folder / "t.csv").string() +
                                                  "; the same command goes on with the rest\n"));
    const std::string table = succeed(usual(scene, {"--csv", "-"})).out;
    succeed(usual(scene, {"--csv", (folder / "t.csv").string()}));
    REQUIRE(read_file(folder / "t.csv") == table);
}

TEST_CASE("Four shards merge into the bytes of the whole, and nothing else does", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string table = succeed(usual(scene, {"--csv", "-"})).out;
    Words files;
    for (int i = 1; i <= 4; ++i) {
        files.push_back((folder / ("part" + std::to_string(i) + ".csv")).string());
        succeed(usual(scene, {"--csv", files.back(), "--shard", std::to_string(i) + "/4"}));
        REQUIRE(lines_of(files.back()) == 4);
    }
    const std::string merged = (folder / "merged.csv").string();
    const auto merge = [&](const Words& shards) {
        Words words{"experiment", "merge"};
        words.insert(words.end(), shards.begin(), shards.end());
        words.insert(words.end(), {"-o", merged});
        return words;
    };
    REQUIRE(has(fail(merge({files[0], files[1], files[3]})).err,
                "3 of the sweep's 12 cells are in none of the files: 2, 6, 10"));
    REQUIRE(has(fail(merge({files[0], files[1], files[2], files[3], files[1]})).err, "cell 1 is there twice"));
    REQUIRE_FALSE(std::filesystem::exists(merged));
    succeed(merge({files[3], files[0], files[2], files[1]}));
    REQUIRE(read_file(merged) == table);

    REQUIRE(has(fail(usual(scene, {"--csv", files[0], "--shard", "2/4"})).err,
                files[0] + ": has cell 0, which is not of shard 2/4; give each shard a file of its own"));
    succeed(usual(scene, {"--csv", files[0]})); // a shard's file is a beginning of the whole
    REQUIRE(read_file(files[0]) == table);
}

TEST_CASE("GNU parallel runs the shards, as docs/sweeps.md shows", "[program]") {
    if (std::system("parallel --version 2>/dev/null | grep -q '^GNU parallel'") != 0)
        SKIP("GNU parallel is not installed");
    const std::string docs = read_file(checkout() / "docs/sweeps.md");
    const std::size_t named = docs.find("With GNU parallel"), fence = docs.find("```sh\n", named);
    REQUIRE(fence != std::string::npos);
    const std::string shown = docs.substr(fence + 6, docs.find("```\n", fence + 6) - fence - 6);
    REQUIRE(has(shown, "parallel \"$sweep --jobs 1 --shard {}/4"));

    const TemporaryFolder folder;
    const std::string path = std::filesystem::path(CLOTHLAB_TEST_BINARY).parent_path().string();
    write_file(folder / "shown.sh", "set -e\nexport HOME=$PWD PATH='" + path + "':$PATH\n" + shown +
                                        "$sweep --csv whole.csv > whole.txt\ncmp ks.csv whole.csv\n");
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && sh shown.sh > said 2>&1").c_str()) == 0);
    REQUIRE(lines_of(folder / "ks.csv") == 9);
    REQUIRE(lines_of(folder / "part-4.csv") == 3);
}

TEST_CASE("A file of something else is refused and left as it is, and replaced with --fresh", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string file = (folder / "t.csv").string();
    const auto refused = [&](const Words& words, const std::string& why) {
        const std::string before = read_file(file);
        REQUIRE(has(fail(words).err, why));
        REQUIRE(read_file(file) == before);
    };
    write_file(file, "frame,index,x,y,z\n");
    refused(usual(scene, {"--csv", file}),
            "t.csv: is there and is no table of this sweep; name another file, or replace");
    succeed(usual(scene, {"--csv", file, "--fresh"}));
    const Words other{"--vary",   "cloth.ks=100:10000:4log",
                      "--vary",   "simulation.integrator=course-verlet,rk4,backward-euler",
                      "--csv",    file,
                      "--frames", "61"};
    refused(sweep_of(scene, other), "t.csv:2: a cell of another sweep: its scene, --set, --vary, --frames");
    succeed(usual(scene, {"--csv", file}));
}

TEST_CASE("Two programs do not write one sweep's file", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string file = (folder / "t.csv").string();
    const Running running(sweep_of(scene, {"--vary", "cloth.ks=1,2", "--frames", "100000000", "--csv", file}),
                          folder / "errors");
    while (lines_of(file) == 0)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const Finished second =
        fail(sweep_of(scene, {"--vary", "cloth.ks=1,2", "--frames", "100000000", "--csv", file}), 1);
    REQUIRE(has(second.err, "t.csv: cannot be written: another program is writing it"));
}

TEST_CASE("A worker that dies takes only its cell with it, which is named", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string file = (folder / "t.csv").string();
    // One cell that never ends beside one that is soon done.
    Running running(
        sweep_of(scene, {"--vary", "simulation.substeps=100000,1", "--frames", "2000", "--csv", file, "--jobs", "1"}),
        folder / "errors");
    std::vector<pid_t> workers;
    while (workers.empty() || lines_of(file) == 0) {
        workers = children_of(running.process());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(workers.size() == 1);
    ::kill(workers.front(), SIGKILL);
    REQUIRE(WEXITSTATUS(running.wait()) == 1);
    const std::string errors = read_file(folder / "errors");
    REQUIRE(has(errors,
                "cell 0 (simulation.substeps=100000) could not be run: its process was ended by signal 9 (Killed)"));
    REQUIRE(has(errors, "1 of 2 cells are finished and kept in " + file));
    REQUIRE(lines_of(file) == 2);
    REQUIRE(read_file(file).find("\n1,1,ok,") != std::string::npos);
}

TEST_CASE("A worker whose sweep is gone ends by itself", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    Running running(sweep_of(scene, {"--vary", "cloth.ks=1,2", "--frames", "100000000", "--jobs", "1"}),
                    folder / "errors");
    std::vector<pid_t> workers;
    while (workers.empty()) {
        workers = children_of(running.process());
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    running.end(SIGKILL);
    const auto gone = [&] {
        std::ifstream stat("/proc/" + std::to_string(workers.front()) + "/stat");
        std::string text;
        std::getline(stat, text);
        return text.empty() || text.find(") Z ") != std::string::npos; // nobody may wait for it in a container
    };
    while (!gone())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_CASE("What cannot be swept is said before any work, with its place", "[program]") {
    const TemporaryFolder folder;
    const std::string scene = small_scene(folder);
    const std::string file = (folder / "t.csv").string();
    const auto refused = [&](const Words& rest, const std::string& why) {
        Words words = sweep_of(scene, {"--csv", file});
        words.insert(words.end(), rest.begin(), rest.end());
        REQUIRE(has(fail(words).err, why));
        REQUIRE_FALSE(std::filesystem::exists(file));
    };
    refused({}, "--vary is required");
    refused({"--vary", "cloth.ks=1:2"}, "clothlab: --vary cloth.ks=1:2: a range is FIRST:LAST:COUNT");
    refused({"--vary", "cloth.ks=5,-5"}, "clothlab: --vary cloth.ks=-5: ");
    refused({"--vary", "cloth.ks=1,2", "--set", "cloth.ks=3"}, "clothlab: --set cloth.ks=3: --vary varies it");
    for (const char* shard : {"0/4", "5/4", "1", "1/4x", "-1/4", "1/0"})
        refused({"--vary", "cloth.ks=1,2", "--shard", shard},
                std::string("clothlab: --shard ") + shard + ": write I/N");
    refused({"--vary", "cloth.ks=1,2", "--plot", "hash"}, "clothlab: --plot hash: there is no such number");
    refused({"--vary", "cloth.ks=1,2", "--size", "large"}, "--size large");
    refused({"--vary", "cloth.ks=1,2", "--frames", "-1"}, "--frames");
    refused({"--vary", "cloth.ks=1,2", "--seconds", "1", "--frames", "9"}, "excludes");
    REQUIRE(has(fail(sweep_of(scene, {"--vary", "cloth.ks=1,2", "--fresh"})).err, "--fresh: there is no --csv file"));
}

TEST_CASE("A sweep as one JSON object has a row for each cell", "[program]") {
    const TemporaryFolder folder;
    const auto json = nlohmann::json::parse(
        succeed(sweep_of(small_scene(folder), {"--vary", "cloth.ks=100,200", "--frames", "3", "--json"})).out);
    REQUIRE(json["rows"].size() == 2);
    REQUIRE(json["rows"][1]["cloth.ks"] == 200);
    REQUIRE(json["rows"][1]["settings"] == nlohmann::json::array({"cloth.ks=200"}));
}

TEST_CASE("experiment --report writes a page with the table, the scene and the command that was typed", "[program]") {
    const TemporaryFolder folder;
    const std::string report = (folder / "a report").string();
    const Finished finished = clothlab::test::clothlab(
        {"experiment", "sweep", "two-pins", "--set", "cloth.num_width_points=4", "--set", "cloth.num_height_points=4",
         "--set", "cloth.pinned=[[0, 0]]", "--vary", "cloth.ks=500,5000", "--frames", "2", "--report", report});
    INFO(finished.err);
    REQUIRE(finished.status == 0);
    const std::string page = read_file(folder / "a report/report.html");
    CHECK(page.find("'cloth.pinned=[[0, 0]]' --vary cloth.ks=500,5000 --frames 2") != std::string::npos);
    CHECK(page.find("<td>cloth.num_width_points</td>") != std::string::npos);
    CHECK(read_file(folder / "a report/findings.csv").starts_with("cell,cloth.ks,status,"));
    CHECK(clothlab::test::clothlab({"validate", report + "/scene.json"}).status == 0);
    CHECK(read_file(folder / "a report/report.md").starts_with("# Sweep of two-pins\n"));
}
