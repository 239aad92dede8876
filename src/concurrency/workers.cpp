#include "src/concurrency/workers.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "src/concurrency/threads.h"

namespace geodesic {

struct Workers::Failure {
    std::mutex mutex;
    std::condition_variable finished;
    uint32_t running = 0;
    size_t task = SIZE_MAX;
    std::exception_ptr error;
};

Workers::Workers(const Metric& metric, uint32_t threads, ProgressFunction progress)
    : progress_(std::move(progress)) {
    for (uint32_t i = thread_count(threads); i > 0; --i) {
        solvers_.push_back(metric.make_solver());
        solvers_.back()->cancel_when(cancelled_);
    }
}

void Workers::begin_stage(const char* name, double end_fraction, size_t task_count) {
    stage_ = name;
    stage_begin_ = stage_end_;
    stage_end_ = end_fraction;
    count_ = stage_count_ = task_count;
    done_ = 0;
    report();
    check_cancelled();
}

void Workers::check_cancelled() const {
    if (cancelled_) throw_cancelled();
}

void Workers::report() {
    if (!progress_ || cancelled_) return;
    const double share = count_ ? static_cast<double>(done_) / static_cast<double>(count_) : 0;
    reported_ = std::max(reported_, stage_begin_ + share * (stage_end_ - stage_begin_));
    if (!progress_(reported_, stage_)) cancelled_ = true;
}

void Workers::work(uint32_t thread, size_t count, const std::function<void(FieldSolver&, size_t)>& task,
                   Failure& failure) {
    for (size_t i; !cancelled_ && (i = next_++) < count; ++done_) {
        try {
            task(*solvers_[thread], i);
        } catch (...) {
            const std::lock_guard lock(failure.mutex);
            if (i < failure.task) {
                failure.task = i;
                failure.error = std::current_exception();
            }
            next_ = count;
        }
    }
    const std::lock_guard lock(failure.mutex);
    --failure.running;
    failure.finished.notify_all();
}

void Workers::run(size_t count, const std::function<void(FieldSolver&, size_t)>& task) {
    Failure failure;
    next_ = 0;
    if (stage_count_ == 0) {
        done_ = 0;
        count_ = count;
    }
    const auto used = static_cast<uint32_t>(std::min<size_t>(solvers_.size(), count));
    {
        std::vector<std::jthread> threads;
        for (uint32_t t = 0; t < used; ++t) {
            {
                const std::lock_guard lock(failure.mutex);
                ++failure.running;
            }
            threads.emplace_back([&, t] { work(t, count, task, failure); });
        }
        std::unique_lock lock(failure.mutex);
        while (!failure.finished.wait_for(lock, std::chrono::milliseconds(100),
                                          [&] { return failure.running == 0; })) {
            lock.unlock();
            report();
            lock.lock();
        }
    }
    report();
    check_cancelled();
    if (failure.error) std::rethrow_exception(failure.error);
}

}
