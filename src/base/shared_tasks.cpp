#include "src/base/shared_tasks.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

namespace geodesic {

SharedTasks::SharedTasks(size_t count, std::function<void(uint32_t thread, size_t task)> run)
    : count_(count), run_(std::move(run)) {}

SharedTasks::~SharedTasks() { next_ = count_; }

uint32_t SharedTasks::start_threads(uint32_t first, uint32_t end) {
    uint32_t started = 0;
    while (first + started < end && start_thread(first + started)) ++started;
    return started;
}

// A system that is out of memory for threads says so by an error of its own (EAGAIN).
bool SharedTasks::start_thread(uint32_t thread) {
    {
        const std::lock_guard lock(mutex_);
        ++running_;
    }
    try {
        threads_.emplace_back([this, thread] {
            work(thread);
            const std::lock_guard lock(mutex_);
            --running_;
            ended_.notify_all();
        });
        return true;
    } catch (const std::bad_alloc&) {
    } catch (const std::system_error&) {
    }
    const std::lock_guard lock(mutex_);
    --running_;
    return false;
}

void SharedTasks::work(uint32_t thread) noexcept {
    for (size_t task; (task = next_++) < count_;) {
        try {
            run_(thread, task);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (task < failed_task_) {
                failed_task_ = task;
                error_ = std::current_exception();
            }
            next_ = count_;
        }
    }
}

bool SharedTasks::wait_for(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, longest, [this] { return running_ == 0; });
}

void SharedTasks::finish() {
    threads_.clear();
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void share_out(uint32_t threads, size_t count, const std::function<void(size_t task)>& task) {
    SharedTasks tasks(count, [&](uint32_t, size_t i) { task(i); });
    tasks.start_threads(1, static_cast<uint32_t>(std::min<size_t>(threads, count)));
    tasks.work(0);
    tasks.finish();
}

}
