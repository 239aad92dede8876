#pragma once

#include <span>
#include <vector>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/mesh/intake.h"
#include "src/metric/workers.h"
#include "src/partition/random.h"
#include "src/query/index.h"

namespace geodesic {

// How much NearSearch looks at.
struct NearEffort {
    uint32_t candidates;        // on and next to borders, and anywhere, of which
    uint32_t first_sources;     // so many become sources
    uint32_t climbs;            // how often the search goes on around the worst pairs,
    uint32_t sources_per_climb; // with how many sources at most
};

// Looks for the largest errors of short distances, up to a little more than the near ones. From each source
// it compares MSAD to all vertices that are so near, about a thousand at most, and, of the overlay engine,
// SSSD, but for pairs of internal vertices of one leaf, whose distance a table holds. The errors are
// only added to maxima, since sources are chosen where errors are large.
//
// To ask the metric takes longest, so sources are chosen by the index itself: MSAD and SSSD put their ways
// together from different tables, and where one is wrong they mostly disagree.
class NearSearch {
public:
    explicit NearSearch(const Compared& compared);

    void run(const NearEffort& effort, uint64_t seed, Workers& workers);

    const ErrorsByDistance& errors() const { return errors_; }

private:
    // A vertex from which all near distances have been compared.
    struct Source {
        uint32_t vertex;
        double largest = 0;      // error,
        uint32_t worst = NONE;   // and where it is
        bool is_climbed = false; // whether the vertices around both have become sources, too
    };
    class Answers;
    class Comparison;

    std::vector<uint32_t> choose_candidates(uint32_t count, Random& random) const;
    void add_first_sources(const NearEffort& effort, Random& random, Workers& workers);
    std::vector<double> disagreements(std::span<const uint32_t> sources, Workers& workers) const;
    bool climb(uint32_t most_sources);
    void add_source(uint32_t vertex);
    void compare_new_sources(Workers& workers);

    const Index& index_;
    const Intake& intake_;
    const double average_edge_;
    const ShortDistances& too_short_;
    std::vector<Source> sources_;
    size_t compared_ = 0; // of the sources, the first ones
    std::vector<bool> is_source_;
    ErrorsByDistance errors_;
};

}
