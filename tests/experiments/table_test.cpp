#include "experiments/table.h"

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using namespace clothlab::experiments;

namespace {

Table table_of(const std::vector<std::vector<Value>>& rows) {
    Table table;
    table.columns = {{"method", "Method"}, {"error_mm", "Error (mm)", 3}};
    table.rows = rows;
    return table;
}

} // namespace

TEST_CASE("A table comes back from CSV to the last bit, whatever its texts are") {
    const Table table = table_of({{"rk4", 0.1 + 0.2},
                                  {"with, comma", -0.0},
                                  {"with \"quotes\"", std::numeric_limits<double>::denorm_min()},
                                  {"on\ntwo lines", std::numeric_limits<double>::infinity()},
                                  {Value(), 1e300}});
    const Table back = from_csv(to_csv(table));
    REQUIRE(back.rows.size() == table.rows.size());
    CHECK(back.columns[1].name == "error_mm");
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        CHECK(back.rows[i] == table.rows[i]);
    CHECK(std::signbit(back.number(1, "error_mm")));
    CHECK(to_csv(back) == to_csv(table));
}

TEST_CASE("What is not a number is none") {
    const Table table = table_of({{"rk4", Value()}});
    CHECK(std::isnan(table.number(0, "error_mm")));
    CHECK(std::isnan(table.number(0, "method")));
    CHECK_THROWS_AS(table.column("error_m"), std::out_of_range);
    CHECK_THROWS_AS(table.number(1, "error_mm"), std::out_of_range);
    CHECK(std::isnan(from_csv("a\nnan\n").number(0, "a")));
}

TEST_CASE("A CSV text that is not a table is refused with its line") {
    const auto why = [](const char* text) {
        try {
            from_csv(text);
        } catch (const std::invalid_argument& e) {
            return std::string(e.what());
        }
        return std::string("taken");
    };
    CHECK(why("a,b\n1,2\n3\n").find("line 3: 1 cells, where the first line has 2") == 0);
    CHECK(why("a,b\n\"x\ny\",2\n1,2,3\n").find("line 4: ") == 0);
    CHECK(why("a,b\n1,\"2\n").find("line 2: a quote does not close") == 0);
    CHECK(why("a,b\r\n1,2\r\n") == "taken");
}

TEST_CASE("A table is read by people in columns, numbers to the right") {
    CHECK(to_text(table_of({{"rk4", 0.00012345}, {"heun", Value()}})) == "Method  Error (mm)\n"
                                                                         "rk4       0.000123\n"
                                                                         "heun\n");
    CHECK(to_markdown(table_of({{"a|b", 2.0}})) == "| Method | Error (mm) |\n|---|---|\n| a\\|b | 2 |\n");
}
