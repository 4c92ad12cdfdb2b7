// A few threads that work through a list of tasks.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace clothlab::cli {

class Crew {
public:
    explicit Crew(int threads);
    /// Waits for the tasks that have begun; those that have not are dropped.
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    enum class Turn { last, next };
    /// A task must not throw. `next` comes before all that wait.
    void add(std::function<void()> task, Turn turn = Turn::last);

private:
    void work();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> tasks_;
    bool closed_ = false;
    std::vector<std::jthread> threads_; ///< last, so that they end first
};

} // namespace clothlab::cli
