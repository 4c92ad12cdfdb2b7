#include "cli/gui/crew.h"

namespace clothlab::cli {

Crew::Crew(int threads) {
    for (int i = 0; i < threads; ++i)
        threads_.emplace_back([this] { work(); });
}

Crew::~Crew() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
}

void Crew::add(std::function<void()> task, Turn turn) {
    const std::lock_guard lock(mutex_);
    if (turn == Turn::next)
        tasks_.push_front(std::move(task));
    else
        tasks_.push_back(std::move(task));
    wake_.notify_one();
}

void Crew::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return closed_ || !tasks_.empty(); });
        if (closed_)
            return;
        const std::function<void()> task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        task();
        lock.lock();
    }
}

} // namespace clothlab::cli
