#include "src/build/measure.h"

#include "src/build/relative_errors.h"

namespace geodesic {

namespace {

constexpr uint64_t MEASURING_SEED = 0x6572726F72;

}

MeasuredError measure_error(const Index& index, std::span<const uint32_t> vertex_of_number,
                            Workers& workers) {
    const ExactFields exact = exact_fields(index.description, vertex_of_number, MEASURING_SEED, workers);
    const auto measured = [&](Crossing crossing) {
        return summary(relative_errors(index, crossing, vertex_of_number, exact, workers));
    };
    MeasuredError result = measured(Crossing::BETWEEN_VERTICES);
    result.mean_at_vertices =
        crosses_between_vertices(index.description) ? measured(Crossing::AT_VERTICES).mean : result.mean;
    return result;
}

}
