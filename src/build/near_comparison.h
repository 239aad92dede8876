#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "src/build/errors_by_distance.h"
#include "src/index/stored.h"
#include "src/mesh/intake.h"
#include "src/query/query.h"
#include "src/tables/near_distances.h"

namespace geodesic {

struct WrongPair {
    VertexPair pair; // by number
    double error;    // of what is answered, relative to the distance
};

// One thread's answers compared with the metric near vertices, from one of them at a time.
class NearComparison {
public:
    // An error up to `limit` is let pass.
    NearComparison(const Index& index, const Intake& intake, const NearDistances& near,
                   const ListOfLists<uint32_t>& edge_ends, double limit)
        : index_(index), intake_(intake), near_(near), edge_ends_(edge_ends), limit_(limit),
          query_(index, std::pmr::get_default_resource()), answer_(index.description.id_count, INFINITE),
          field_(near.vertex_count(), {0, 0}) {}

    // Adds the wrong pairs of this source: those of which MSAD is off by more than the limit, or SSSD is and
    // MSAD by more than half of it; and of two neighbours between which MSAD, with these put right, would
    // change by more than STEEPEST times the length of their edge, the one that is worse.
    void compare(uint32_t source, std::vector<WrongPair>& wrong);

private:
    // Of a near vertex; others, and the source, have 0 for both.
    struct Distances {
        float exact, answer;
        double error() const { return relative_error(exact, answer); }
    };

    uint32_t id_of(uint32_t vertex) const { return intake_.id_of_vertex[vertex]; }
    void fill_field();
    double largest_error(uint32_t vertex);
    void correct(uint32_t vertex, double error);
    void make_less_steep(uint32_t vertex);
    bool is_too_steep(uint32_t a, uint32_t b) const;
    float deviation(uint32_t vertex) const;

    const Index& index_;
    const Intake& intake_;
    const NearDistances& near_;
    const ListOfLists<uint32_t>& edge_ends_;
    const double limit_;
    Query query_;
    uint32_t source_ = NONE;
    std::vector<WrongPair>* wrong_ = nullptr;
    std::vector<float> answer_;    // by id; infinite but while a field is filled
    std::vector<Distances> field_; // by vertex
    std::vector<uint32_t> open_;   // vertices whose edges are to be looked at
};

}
