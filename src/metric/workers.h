#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "src/metric/metric.h"

namespace geodesic {

// Told how far the work is, 0 .. 1, and the name of the stage; returns false to cancel.
using ProgressFunction = std::function<bool(double fraction, const char* stage)>;

// Tells the progress of a part of the work, 0 .. 1, as that of the whole.
ProgressFunction part_of_progress(const ProgressFunction& whole, double begin, double end);

// The threads of one build. Each has a solver of the metric of its own.
class Workers {
public:
    Workers(const Metric& metric, uint32_t threads, ProgressFunction progress);

    // Names the stage that follows and the share of the whole work it ends at. A stage of several run() calls
    // says how many tasks they have together.
    void begin_stage(const char* name, double end_fraction, size_t task_count = 0);

    // The same for one of several stages in a row, of which nobody knows how many there will be: it has half
    // of the work that is left until the last one ends.
    void begin_half_of_stage(const char* name, double last_end_fraction) {
        begin_stage(name, (stage_end_ + last_end_fraction) / 2);
    }

    // Calls task(solver, i) for i in 0 .. count - 1 on all threads, in no particular order. Meanwhile the
    // calling thread reports progress. Rethrows the error of the task with the smallest number that failed;
    // throws Error CANCELLED when the progress function says so, and
    // OUT_OF_MEMORY when not even one thread can be started.
    void run(size_t count, const std::function<void(FieldSolver&, size_t)>& task);

    // From now on a solver of another metric, which a task uses, throws as theirs do once the work is
    // cancelled.
    void end_when_cancelled(FieldSolver& solver) const { solver.cancel_when(cancelled_); }

    // For long tasks: throws when the work was cancelled.
    void check_cancelled() const;

private:
    void report();

    std::vector<std::unique_ptr<FieldSolver>> solvers_;
    ProgressFunction progress_;
    const char* stage_ = "";
    double stage_begin_ = 0, stage_end_ = 0, reported_ = 0;
    std::atomic<size_t> done_ = 0;
    size_t count_ = 0;       // of the tasks that done_ counts
    size_t stage_count_ = 0; // of the whole stage; 0: of each run() by itself
    std::atomic<bool> cancelled_ = false;
};

}
