#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace geodesic {

// Tasks 0 .. count - 1, shared out to threads in no particular order. This is the only place of the library
// that starts threads. What a task throws reaches the caller of finish(), and no further task begins then.
class SharedTasks {
public:
    // Each of several threads, which number themselves, calls run(thread, task).
    SharedTasks(size_t count, std::function<void(uint32_t thread, size_t task)> run);
    // No further task begins; those that have begun are waited for.
    ~SharedTasks();
    SharedTasks(const SharedTasks&) = delete;
    SharedTasks& operator=(const SharedTasks&) = delete;

    // Starts threads first .. end - 1, or the first few of them if there is no memory for more. Returns how
    // many have been started.
    uint32_t start_threads(uint32_t first, uint32_t end);

    // The calling thread takes its share until no task is left to begin.
    void work(uint32_t thread) noexcept;

    // Waits for all started threads, at most so long; returns whether they have ended.
    bool wait_for(std::chrono::milliseconds longest);

    // Waits for all started threads, then rethrows the error of the task with the smallest number that
    // failed.
    void finish();

private:
    bool start_thread(uint32_t thread);

    const size_t count_;
    const std::function<void(uint32_t, size_t)> run_;
    std::atomic<size_t> next_ = 0;
    std::mutex mutex_; // guards these
    std::condition_variable ended_;
    uint32_t running_ = 0;
    size_t failed_task_ = SIZE_MAX;
    std::exception_ptr error_;
    std::vector<std::jthread> threads_; // the last member: it is joined before the others are destroyed
};

// Runs task(0) .. task(count - 1) on up to so many threads, of which the calling one is the first. Throws
// what the failed task with the smallest number threw.
void share_out(uint32_t threads, size_t count, const std::function<void(size_t task)>& task);

}
