#include "src/metric/workers.h"

#include <algorithm>
#include <chrono>

#include "format/error.h"
#include "src/base/shared_tasks.h"
#include "src/base/threads.h"

namespace geodesic {

ProgressFunction part_of_progress(const ProgressFunction& whole, double begin, double end) {
    if (!whole) return {};
    return [whole, begin, end](double fraction, const char* stage) {
        return whole(begin + fraction * (end - begin), stage);
    };
}

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

void Workers::run(size_t count, const std::function<void(FieldSolver&, size_t)>& task) {
    check_cancelled();
    if (stage_count_ == 0) {
        done_ = 0;
        count_ = count;
    }
    SharedTasks tasks(count, [&](uint32_t thread, size_t i) {
        task(*solvers_[thread], i);
        ++done_;
    });
    const auto used = static_cast<uint32_t>(std::min<size_t>(solvers_.size(), count));
    if (tasks.start_threads(0, used) == 0 && used > 0)
        throw Error(GEOIDX_ERROR_OUT_OF_MEMORY, "out of memory: no thread could be started");
    while (!tasks.wait_for(std::chrono::milliseconds(100))) {
        report();
        check_cancelled();
    }
    report();
    check_cancelled();
    tasks.finish();
}

}
