#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/partition/random.h"
#include "src/query/index.h"
#include "src/query/query.h"

namespace geodesic {

// How much TwoWaySearch looks at.
struct TwoWayEffort {
    uint32_t vertices;     // between which both directions of all pairs are compared,
    uint32_t around_worst; // once more around the worst pairs, if those were not all vertices
    uint32_t sources; // of each class of distances, from which the metric is asked then; of far ones fewer
    uint32_t pairs;   // of these vertices, of which SSSD is compared with MSAD
};

// Looks for the largest errors at all distances, with the overlay engine. The two directions of a pair take
// different parts of the tables, so where the answers of MSAD differ most, one of them is wrong; and where
// SSSD differs from both, it has lost a way. The index tells so in a small part of the time that the metric
// takes, which is asked only where answers differ most. The errors are only added to maxima.
class TwoWaySearch {
public:
    explicit TwoWaySearch(const Compared& compared);

    void run(const TwoWayEffort& effort, uint64_t seed, Workers& workers);

    const ErrorsByDistance& errors() const { return errors_; }

private:
    // How much answers differ at most between a vertex and another one, relative to the distance.
    struct Difference {
        float share = 0, distance = 0;
        uint32_t other = 0; // by its place among the vertices
    };
    // A pair of which SSSD is compared with MSAD.
    struct Pair {
        uint32_t place = 0;
        Difference difference;
    };
    using Differences = std::array<Difference, DISTANCE_CLASSES>;
    // A vertex, by its place, from which the metric is asked up to some distance.
    struct Source {
        uint32_t place = 0;
        double radius = 0;                // 0: it is none
        std::vector<uint32_t> of_pairs{}; // places of vertices to which SSSD is asked
    };
    struct WorstPair {
        double error = 0;
        uint32_t source = 0, target = 0; // vertices
    };

    std::vector<uint32_t> random_vertices(uint32_t count, Random& random) const;
    std::vector<uint32_t> vertices_around_worst(uint32_t count) const;
    void look_between(std::vector<uint32_t> vertices, uint32_t sources_of_class, uint32_t pairs,
                      Random& random, Workers& workers);
    void fill_answers(Workers& workers);
    std::vector<Differences> differences_of_directions(Workers& workers) const;
    void find_largest(size_t first, size_t end, std::span<Differences> largest) const;
    std::vector<Differences> differences_of_pairs(uint32_t count, Random& random, Workers& workers) const;
    void measure(std::span<Pair> pairs, Workers& workers) const;
    void measure(Query& query, Pair& pair) const;
    void keep_worst(std::vector<Pair>& pairs, size_t of_class) const;
    std::vector<Pair> pairs_around(std::span<const Pair> pairs, std::span<const uint32_t> places,
                                   Random& random) const;
    std::vector<uint32_t> places_of_vertices() const;
    void choose_sources(std::span<const Differences> largest, uint32_t of_class,
                        std::vector<Source>& sources) const;
    void compare(std::vector<Source> sources, Workers& workers);
    WorstPair compare_fields(const Source& source, const FieldSolver& exact, ErrorsByDistance& errors) const;
    void compare_pairs(const Source& source, const FieldSolver& exact, ErrorsByDistance& errors,
                       WorstPair& worst) const;

    size_t class_of(float distance) const { return distance_class(distance / average_edge_); }
    uint32_t id_of(uint32_t place) const { return intake_.id_of_vertex[vertices_[place]]; }
    float answer(size_t from, size_t to) const { return answers_[from * vertices_.size() + to]; }

    const Index& index_;
    const Intake& intake_;
    const double average_edge_;
    const ShortDistances& too_short_;
    std::vector<uint32_t> vertices_; // that are compared now
    std::vector<float> answers_;     // of MSAD from each of them to each
    std::vector<WorstPair> worst_;   // of each source so far
    ErrorsByDistance errors_;
};

}
