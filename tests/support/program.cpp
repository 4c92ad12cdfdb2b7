#include "support/program.h"

#include <array>
#include <cerrno>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace clothlab::test {
namespace {

struct Pipe {
    std::array<int, 2> ends{};
    Pipe() {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe");
    }
};

/// Reads both pipes until both are closed: one after the other could fill the second and wait for ever.
void drain(int out, int err, Finished& finished) {
    std::array<pollfd, 2> open{{{out, POLLIN, 0}, {err, POLLIN, 0}}};
    std::array<std::string*, 2> texts{&finished.out, &finished.err};
    std::array<char, 65536> piece{};
    while (open[0].fd >= 0 || open[1].fd >= 0) {
        if (::poll(open.data(), open.size(), -1) < 0 && errno != EINTR)
            throw std::runtime_error("poll failed");
        for (std::size_t i = 0; i < open.size(); ++i) {
            if (open[i].fd < 0 || open[i].revents == 0)
                continue;
            const ssize_t count = ::read(open[i].fd, piece.data(), piece.size());
            if (count > 0) {
                texts[i]->append(piece.data(), static_cast<std::size_t>(count));
            } else {
                ::close(open[i].fd);
                open[i].fd = -1; // poll passes over it
            }
        }
    }
}

} // namespace

Finished clothlab(const std::vector<std::string>& arguments, const std::string& out_file) {
    std::vector<std::string> words{CLOTHLAB_TEST_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    const Pipe out, err;
    const pid_t child = ::fork();
    if (child < 0)
        throw std::runtime_error("no process");
    if (child == 0) { // only calls that are safe between fork and exec
        const int file = out_file.empty() ? out.ends[1] : ::open(out_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (file < 0 || ::dup2(file, STDOUT_FILENO) < 0 || ::dup2(err.ends[1], STDERR_FILENO) < 0)
            ::_exit(126);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    ::close(out.ends[1]);
    ::close(err.ends[1]);
    Finished finished;
    drain(out.ends[0], err.ends[0], finished);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    finished.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return finished;
}

} // namespace clothlab::test
