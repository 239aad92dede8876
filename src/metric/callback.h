#pragma once

#include <memory>
#include <vector>

#include "geoidx.h"
#include "src/metric/metric.h"

namespace geodesic {

// The caller's own metric. Its answers are checked: an Error names the pair that is NaN or negative.
class CallbackMetric final : public Metric {
public:
    // id_of_vertex: the id that the caller knows each vertex by.
    CallbackMetric(geoidx_metric_fn function, void* user, std::vector<uint32_t> id_of_vertex);
    std::unique_ptr<FieldSolver> make_solver() const override;

    struct Function {
        geoidx_metric_fn call;
        void* user;
        std::vector<uint32_t> id_of_vertex;
    };

private:
    std::shared_ptr<const Function> function_;
};

}
