#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tests/campaign/build_input.h"

namespace geodesic::campaign {

// What an answer may be, by what the header and docs/limits.md promise of an engine.
class Bounds {
public:
    struct Range {
        double least, most;
    };
    Bounds(const BuildInput& input, const geoidx_info& info, double longest);

    // From the metric's own distance and the shortest way along edges.
    double least(double exact) const;
    double most(double along_edges) const;
    // Of a field from a point, which is answered by the vertices around it, to the float rounding of their
    // distances; and between two points, of which near ones are asked by a path.
    Range of_point_field(double exact, double along_edges) const;
    Range of_point_pair(double exact, double along_edges) const;
    // From the sum of two answers over a third vertex.
    double most_over(double sum) const;

private:
    bool is_graph_;
    bool unfolds_;
    bool is_along_edges_; // no way but along edges
    bool may_flip_edges_;
    double detour_;   // what pruning may add to a way
    double share_;    // of floats and of the metric itself, over all hops of a way of GEOIDX_ENGINE_GRAPH
    double rounding_; // of 16-bit tables, over all hops of a way
    double longest_edge_ = 0;
};

// The metric and its bounds from one source, or from the nearest of several, to every vertex.
struct Truth {
    std::vector<uint32_t> sources;
    std::vector<double> exact, along_edges;
};
Truth truth_of(const BuildInput& input, geoidx_solver* solver, std::span<const uint32_t> sources);

// The metric's own answers are themselves checked: reachable exactly where the surface hangs together, never
// shorter than straight, never longer than along edges.
void check_truth(const BuildInput& input, const Truth& truth);

// One answer for the way between the source and `target`.
void check_answer(const char* query, const BuildInput& input, const Bounds& bounds, const Truth& truth,
                  uint32_t target, float answer);

}
