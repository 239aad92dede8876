#include "src/build/measure.h"

namespace geodesic {

MeasuredError measure_error(const Index& index, const ExactFields& exact,
                            std::span<const uint32_t> vertex_of_number, Workers& workers) {
    const auto measured = [&](Crossing crossing) {
        return summary(relative_errors(index, crossing, vertex_of_number, exact, workers),
                       exact.sources.size());
    };
    MeasuredError result = measured(Crossing::BETWEEN_VERTICES);
    result.mean_at_vertices =
        crosses_between_vertices(index.description) ? measured(Crossing::AT_VERTICES).mean : result.mean;
    return result;
}

}
