// A sweep's file as its own journal, and shards that become one file.
#include <catch2/catch_test_macros.hpp>

#include "experiments/sweep/file.h"
#include "scene/error.h"

using namespace clothlab;
using namespace clothlab::experiments;

namespace {

SweepConfig config_of(const std::string& vary) {
    SweepConfig config;
    config.name = "small";
    config.scene.simulation.cloth.num_width_points = 3;
    config.scene.simulation.cloth.num_height_points = 2;
    config.length.frames = 1;
    config.axes = {parse_axis("simulation.integrator=course-verlet,rk4"), parse_axis(vary)};
    return config;
}

const Sweep& sweep() {
    static const Sweep sweep(config_of("cloth.ks=100,0.1,300"));
    return sweep;
}

/// The lines of these cells of a sweep.
std::string lines(const std::vector<std::size_t>& cells, const Sweep& of = sweep()) {
    std::string text;
    for (const std::size_t cell : cells)
        text += sweep_line(of.run(cell));
    return text;
}

std::string file(const std::vector<std::size_t>& cells, const Sweep& of = sweep()) {
    return sweep_header(of) + lines(cells, of);
}

template <class Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const scene::SceneError& e) {
        return e.what();
    }
    return "";
}

std::string merge_error(const std::vector<std::string>& texts) {
    std::vector<SweepShard> shards;
    for (const std::string& text : texts)
        shards.push_back({"part" + std::to_string(shards.size() + 1) + ".csv", text});
    return error_of([&] { merge_shards(shards); });
}

std::string read_error(const std::string& text) {
    return error_of([&] { read_sweep_file(sweep(), text, "t.csv"); });
}

bool holds(const std::string& text, const std::string& part) {
    INFO(text);
    INFO(part);
    const bool found = text.find(part) != std::string::npos;
    CHECK(found);
    return found;
}

} // namespace

TEST_CASE("A row is read back from its line to the last bit, with text that looks like a number") {
    std::vector<Value> row = sweep().run(4);
    const auto place = [&](const std::string& name) {
        const auto& columns = sweep().columns();
        return static_cast<std::size_t>(
            std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; }) -
            columns.begin());
    };
    row[place("hash")] = "0012345678901e23";
    row[place("cause")] = "with a comma, and \"quotes\"";
    row[place("kinetic_J")] = std::numeric_limits<double>::infinity();
    std::string line = sweep_line(row);
    REQUIRE(line.back() == '\n');
    line.pop_back();
    REQUIRE(sweep_row(sweep(), line) == row);
}

TEST_CASE("A file that was stopped is read up to its last whole line, wherever it was stopped") {
    const std::string whole = file({3, 0});
    const std::size_t header = sweep_header(sweep()).size();
    const std::size_t first = header + lines({3}).size();
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        const SweepFile read = read_sweep_file(sweep(), std::string_view(whole).substr(0, size), "t.csv");
        const std::size_t rows = size == whole.size() ? 2 : size >= first ? 1 : 0;
        INFO(size);
        REQUIRE(read.rows.size() == rows);
        if (size > header)
            REQUIRE(read.whole_bytes == (rows == 2 ? whole.size() : rows == 1 ? first : header));
    }
    REQUIRE(read_sweep_file(sweep(), whole, "t.csv").rows.at(3) == sweep().run(3));
}

TEST_CASE("A file that this sweep did not write is refused with its place") {
    REQUIRE(read_error("frame,index,x,y,z\n0,0,0,0,0\n") ==
            "t.csv: is there and is no table of this sweep; name another file, or replace this one with --fresh");
    const Sweep other(config_of("cloth.ks=100,0.1,301"));
    REQUIRE(read_error(file({0}, other)).find("t.csv:2: a cell of another sweep: its scene, --set, --vary,") == 0);
    REQUIRE(holds(read_error(sweep_header(sweep()) + "0,1\n"), "t.csv:2: the line is damaged"));
    REQUIRE(holds(read_error(file({0, 1, 0})), "t.csv:4: cell 0 is there twice"));
    std::string damaged = file({0, 1});
    damaged.replace(damaged.find(",ok,"), 4, ",\"ok,"); // a quote that does not close
    REQUIRE(holds(read_error(damaged), "t.csv:2: the line is damaged; name another file"));
    std::string changed = file({0});
    changed.insert(changed.find("\n0,") + 1, "0"); // cell 00
    REQUIRE(holds(read_error(changed), "t.csv:2: the line is damaged"));
}

TEST_CASE("Merged shards are the bytes of the whole sweep, in whatever order they come") {
    const std::string whole = file({0, 1, 2, 3, 4, 5});
    REQUIRE(merge_shards({{"a", file({5, 1})}, {"b", file({0, 2, 4})}, {"c", file({3})}}) == whole);
    REQUIRE(merge_shards({{"a", whole}}) == whole);
    REQUIRE(merge_shards({{"a", file({})}, {"b", whole}, {"c", file({})}}) == whole); // more shards than cells
}

TEST_CASE("Shards with a missing, a double or a foreign cell are not merged") {
    REQUIRE(merge_error({file({0, 2}), file({4, 5})}) == "2 of the sweep's 6 cells are in none of the files: 1, 3");
    REQUIRE(merge_error({file({0})}) == "5 of the sweep's 6 cells are in none of the files: 1 to 5");
    REQUIRE(merge_error({file({0, 1, 2}), file({2, 3, 4, 5})}) ==
            "cell 2 is there twice: in part1.csv and in part2.csv");
    const Sweep other(config_of("cloth.ks=100,0.1,301"));
    REQUIRE(
        merge_error({file({0, 1, 2}), file({3, 4, 5}, other)}) ==
        "part2.csv:2: a cell of another sweep than those of part1.csv: the scene, --set, --vary, --frames or --seconds "
        "differ");
    SweepConfig timed = config_of("cloth.ks=100,0.1,300");
    timed.times = true;
    REQUIRE(merge_error({file({0, 1, 2}), file({3, 4, 5}, Sweep(timed))}) ==
            "part2.csv: has other columns than part1.csv; it is of another sweep");
}

TEST_CASE("What is no finished shard is not merged") {
    std::string torn = file({3, 4, 5});
    torn.pop_back();
    REQUIRE(merge_error({file({0, 1, 2}), torn}) ==
            "part2.csv: the last line is not complete: that shard was stopped; let it go on to its end");
    REQUIRE(merge_error({"x,y\n1,2\n"}) == "part1.csv: is not the table of a sweep");
    REQUIRE(merge_error({""}) == "part1.csv: is not the table of a sweep");
    REQUIRE(merge_error({file({})}) == "there is no finished cell in these files");
    REQUIRE(merge_error({sweep_header(sweep()) + "7\n"}) == "part1.csv:2: the line is damaged");
}
