#include "src/metric/callback.h"

#include <string>

#include "format/error.h"
#include "src/base/number_text.h"

namespace geodesic {

namespace {

class CallbackSolver final : public FieldSolver {
public:
    explicit CallbackSolver(std::shared_ptr<const CallbackMetric::Function> function)
        : FieldSolver(static_cast<uint32_t>(function->id_of_vertex.size())), function_(std::move(function)) {}

private:
    void run(const FieldRequest& request) override {
        set_targets(request.targets);
        for (uint32_t i = 0; i < request.sources.size(); ++i) {
            check_cancelled();
            ask(request.sources[i]);
            // A source is 0 from itself, also where the callback answers more.
            for (size_t k = 0; k < targets_.size(); ++k)
                improve(targets_[k], targets_[k] == request.sources[i] ? 0 : answer_[k], i);
        }
    }

    void set_targets(std::span<const uint32_t> targets) {
        targets_.assign(targets.begin(), targets.end());
        if (targets.empty())
            for (uint32_t v = 0; v < vertex_count(); ++v) targets_.push_back(v);
        target_ids_.clear();
        for (uint32_t v : targets_) target_ids_.push_back(function_->id_of_vertex[v]);
        answer_.resize(targets_.size());
    }

    void ask(uint32_t source) {
        const uint32_t id = function_->id_of_vertex[source];
        std::fill(answer_.begin(), answer_.end(), UNREACHABLE);
        const geoidx_status status =
            function_->call(function_->user, id, target_ids_.data(),
                            static_cast<uint32_t>(target_ids_.size()), answer_.data());
        if (status != GEOIDX_OK)
            throw Error(GEOIDX_ERROR_CALLBACK, "the metric callback returned " + std::to_string(status) +
                                                   " for source " + std::to_string(id));
        for (size_t k = 0; k < answer_.size(); ++k)
            if (!(answer_[k] >= 0))
                throw Error(GEOIDX_ERROR_CALLBACK, "the metric callback gave the distance " +
                                                       number_text(answer_[k]) + " from vertex " +
                                                       std::to_string(id) + " to vertex " +
                                                       std::to_string(target_ids_[k]));
    }

    std::shared_ptr<const CallbackMetric::Function> function_;
    std::vector<uint32_t> targets_, target_ids_;
    std::vector<double> answer_;
};

}

CallbackMetric::CallbackMetric(geoidx_metric_fn function, void* user, std::vector<uint32_t> id_of_vertex)
    : function_(std::make_shared<Function>(Function{function, user, std::move(id_of_vertex)})) {}

std::unique_ptr<FieldSolver> CallbackMetric::make_solver() const {
    return std::make_unique<CallbackSolver>(function_);
}

}
