// The worker's side of sweep_workers.h, and the sweep on its way there.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include <sys/poll.h>
#include <unistd.h>

#include "cli/experiment/sweep_message.h"
#include "cli/experiment/sweep_workers.h"
#include "experiments/sweep/file.h"
#include "scene/io.h"

namespace clothlab::cli {
namespace {

using Json = nlohmann::json;

bool parent_is_gone() {
    pollfd input{STDIN_FILENO, 0, 0};
    return ::poll(&input, 1, 0) > 0 && (input.revents & (POLLHUP | POLLERR)) != 0;
}

void answer(const std::string& line) {
    std::cout << line << std::flush;
}

std::string one_line(std::string text) {
    for (char& c : text)
        if (c == '\n')
            c = ' ';
    return text;
}

void run_cell(const experiments::Sweep& sweep, std::size_t cell) {
    using Clock = std::chrono::steady_clock;
    auto told = Clock::now();
    const auto go_on = [&](double share) {
        if (const auto now = Clock::now(); now - told > std::chrono::milliseconds(200)) {
            told = now;
            answer("~" + std::to_string(share) + "\n");
        }
        return !parent_is_gone();
    };
    try {
        answer(experiments::sweep_line(sweep.run(cell, go_on)));
    } catch (const experiments::Cancelled&) {
        throw;
    } catch (const std::exception& e) {
        answer("!" + one_line(e.what()) + "\n");
    }
}

} // namespace

std::string sweep_message(const experiments::SweepConfig& config) {
    Json axes = Json::array();
    for (const experiments::SweepAxis& axis : config.axes)
        axes.push_back({{"key", axis.key}, {"values", axis.values}, {"numeric", axis.numeric}, {"log", axis.log}});
    Json json{{"scene", scene::write_scene(config.scene)},
              {"axes", axes},
              {"frames", config.length.frames},
              {"times", config.times}};
    if (config.length.seconds)
        json["seconds"] = *config.length.seconds;
    return json.dump() + "\n";
}

experiments::SweepConfig read_sweep_message(const std::string& line) {
    const Json json = Json::parse(line);
    experiments::SweepConfig config;
    config.scene = scene::read_scene(json.at("scene").get<std::string>(), "the sweep's scene");
    for (const Json& axis : json.at("axes"))
        config.axes.push_back(
            {axis.at("key"), axis.at("values").get<std::vector<std::string>>(), axis.at("numeric"), axis.at("log")});
    config.length.frames = json.at("frames");
    config.times = json.at("times");
    if (json.contains("seconds"))
        config.length.seconds = json.at("seconds").get<double>();
    return config;
}

int sweep_worker() {
    std::signal(SIGINT, SIG_IGN); // Ctrl+C reaches all processes of a terminal; the first of them ends the others
    std::string line;
    if (!std::getline(std::cin, line))
        return 0;
    const experiments::Sweep sweep(read_sweep_message(line));
    try {
        while (std::getline(std::cin, line))
            run_cell(sweep, std::stoul(line));
    } catch (const experiments::Cancelled&) {
    }
    return 0;
}

} // namespace clothlab::cli
