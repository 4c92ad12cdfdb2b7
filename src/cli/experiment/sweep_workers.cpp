#include "cli/experiment/sweep_workers.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <spawn.h>
#include <sys/poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/experiment/sweep_message.h"
#include "experiments/sweep/file.h"

extern char** environ; // NOLINT: POSIX's name

namespace clothlab::cli {
namespace {

[[noreturn]] void fail(int error) {
    throw std::runtime_error(std::string("a worker cannot be started: ") + std::strerror(error));
}

struct Pipe {
    int out = -1, in = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            fail(errno);
        out = ends[0];
        in = ends[1];
    }
    ~Pipe() {
        close(out);
        close(in);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    static void close(int& end) {
        if (end >= 0)
            ::close(end);
        end = -1;
    }
};

/// A process, which is gone when this is.
class Worker {
public:
    Worker() {
        std::string program = "/proc/self/exe"; // this program, also where its file has been replaced meanwhile
        std::array<std::string, 3> words{"clothlab", "experiment", "sweep-worker"};
        std::array<char*, 4> argv{words[0].data(), words[1].data(), words[2].data(), nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, to_.out, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, from_.in, STDOUT_FILENO);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        sigset_t usual;
        sigemptyset(&usual);
        sigaddset(&usual, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes, &usual);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        const int error = posix_spawn(&process_, program.c_str(), &actions, &attributes, argv.data(), environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0)
            fail(error);
        Pipe::close(to_.out);
        Pipe::close(from_.in);
    }
    ~Worker() {
        if (process_ < 0)
            return;
        ::kill(process_, SIGKILL);
        static_cast<void>(wait());
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// False when it no longer listens.
    bool tell(std::string_view text) {
        while (!text.empty()) {
            const ssize_t written = ::write(to_.in, text.data(), text.size());
            if (written < 0 && errno == EINTR)
                continue;
            if (written < 0)
                return false;
            text.remove_prefix(static_cast<std::size_t>(written));
        }
        return true;
    }
    int output() const { return from_.out; }

    /// Reads what is there; false when it has ended.
    bool listen() {
        std::array<char, 65536> piece{};
        const ssize_t count = ::read(from_.out, piece.data(), piece.size());
        if (count > 0)
            heard_.append(piece.data(), static_cast<std::size_t>(count));
        return count > 0 || (count < 0 && errno == EINTR);
    }
    /// The next whole line that it said, without its end.
    std::optional<std::string> line() {
        const std::size_t end = heard_.find('\n');
        if (end == std::string::npos)
            return std::nullopt;
        std::string first = heard_.substr(0, end);
        heard_.erase(0, end + 1);
        return first;
    }

    /// Of a process that has closed its output: how it ended, as the end of a sentence.
    std::string end() {
        const int status = wait();
        if (!WIFSIGNALED(status))
            return "its process ended with exit status " + std::to_string(WEXITSTATUS(status));
        const int signal = WTERMSIG(status);
        return "its process was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")" +
               (signal == SIGKILL ? "; perhaps the machine ran out of memory" : "");
    }

    std::optional<std::size_t> cell; ///< that it is running
    double share = 0;                ///< of it that is done

private:
    int wait() {
        int status = 0;
        while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return status;
    }

    Pipe to_, from_;
    pid_t process_ = -1;
    std::string heard_;
};

class Pool {
public:
    Pool(const experiments::Sweep& sweep, const std::vector<std::size_t>& cells, std::size_t jobs,
         const std::function<void(std::size_t, std::vector<experiments::Value>)>& done,
         const experiments::Progress& progress)
        : sweep_(sweep), waiting_(cells.begin(), cells.end()), count_(cells.size()), jobs_(jobs), done_(done),
          progress_(progress), message_(sweep_message(sweep.config())) {
        for (const std::size_t cell : cells)
            total_ += sweep.work(cell);
    }

    std::map<std::size_t, std::string> run() {
        while (finished_ < count_) {
            while (workers_.size() < jobs_ && !waiting_.empty())
                start();
            listen();
            double work = finished_work_;
            for (const Worker& worker : workers_)
                work += worker.share * sweep_.work(*worker.cell);
            progress_.tell(work / total_, std::to_string(finished_) + " of " + std::to_string(count_) + " cells");
        }
        return std::move(failed_);
    }

private:
    void start() {
        Worker& worker = workers_.emplace_back();
        worker.cell = waiting_.front();
        waiting_.pop_front();
        worker.tell(message_); // if it has ended, its output says so, too
        worker.tell(std::to_string(*worker.cell) + "\n");
    }

    void listen() {
        std::vector<pollfd> outputs;
        for (const Worker& worker : workers_)
            outputs.push_back({worker.output(), POLLIN, 0});
        if (::poll(outputs.data(), outputs.size(), 100) <= 0)
            return; // a signal, or nothing to hear
        auto output = outputs.begin();
        for (auto worker = workers_.begin(); worker != workers_.end(); ++output) {
            if (output->revents == 0 || hear(*worker)) {
                ++worker;
                continue;
            }
            worker = workers_.erase(worker);
        }
    }

    /// False when the worker is not needed any more.
    bool hear(Worker& worker) {
        const bool lives = worker.listen();
        while (const std::optional<std::string> line = worker.line())
            if (line->starts_with('~')) {
                worker.share = std::atof(line->c_str() + 1);
            } else {
                take(*worker.cell, *line);
                worker.cell.reset();
                worker.share = 0;
                if (waiting_.empty())
                    return false;
                worker.cell = waiting_.front();
                waiting_.pop_front();
                worker.tell(std::to_string(*worker.cell) + "\n");
            }
        if (!lives)
            fail_cell(*worker.cell, worker.end());
        return lives;
    }

    void take(std::size_t cell, const std::string& line) {
        if (line.starts_with('!'))
            return fail_cell(cell, line.substr(1));
        std::vector<experiments::Value> row;
        try {
            row = experiments::sweep_row(sweep_, line);
        } catch (const std::invalid_argument& e) {
            return fail_cell(cell, std::string("its worker answered something else: ") + e.what());
        }
        done_(cell, std::move(row));
        finish(cell);
    }

    void fail_cell(std::size_t cell, const std::string& why) {
        failed_[cell] = why;
        finish(cell);
    }
    void finish(std::size_t cell) {
        finished_work_ += sweep_.work(cell);
        ++finished_;
    }

    const experiments::Sweep& sweep_;
    std::deque<std::size_t> waiting_;
    std::size_t count_, finished_ = 0, jobs_;
    const std::function<void(std::size_t, std::vector<experiments::Value>)>& done_;
    const experiments::Progress& progress_;
    std::string message_;
    double total_ = 0, finished_work_ = 0;
    std::list<Worker> workers_; ///< each with a cell
    std::map<std::size_t, std::string> failed_;
};

} // namespace

std::map<std::size_t, std::string>
run_in_workers(const experiments::Sweep& sweep, const std::vector<std::size_t>& cells, int jobs,
               const std::function<void(std::size_t cell, std::vector<experiments::Value> row)>& done,
               const experiments::Progress& progress) {
    const std::size_t most =
        jobs > 0 ? static_cast<std::size_t>(jobs) : std::max(1u, std::thread::hardware_concurrency());
    return Pool(sweep, cells, most, done, progress).run();
}

} // namespace clothlab::cli
