#pragma once

#include <cmath>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "src/build/errors_by_distance.h"
#include "src/build/relative_errors.h"
#include "src/index/stored.h"
#include "src/mesh/intake.h"
#include "src/query/query.h"
#include "src/tables/near_distances.h"

namespace geodesic {

// How many times as far as the farthest near vertex MSAD is asked.
inline constexpr float LOOKED_AT = 1.1f;

struct WrongPair {
    VertexPair pair; // by number
    // Of what is answered, relative to the distance; infinite where MSAD answers more than LOOKED_AT times
    // the distance of the farthest near vertex, so that no answer is known.
    double error;
};

// One thread's answers compared with the metric near vertices, from one of them at a time.
class NearComparison {
public:
    // An error up to `limit` is let pass, and so are steep edges, unless asked for, which they may be where
    // positions alone decide distances.
    NearComparison(const Index& index, const Intake& intake, const NearDistances& near,
                   const ListOfLists<uint32_t>& edge_ends, const DistanceScale& scale, double limit,
                   bool finds_steep);

    // Adds the wrong pairs of this source with its near vertices:
    // - Pairs of which MSAD is off by more than the limit.
    // - Pairs of which SSSD is off by more than the limit. SSSD is asked only where MSAD is off by more than
    //   half of the limit, or where the distance is so short that the rounding of tables alone may be as
    //   much.
    // - If steep edges are asked for, ends of edges along which the distances of MSAD, with the pairs above
    //   put right, change by more than STEEPEST times the length of the edge: of both ends the one that is
    //   farther off, though its error is within the limit.
    void compare(uint32_t source, std::vector<WrongPair>& wrong);

    // The largest errors that were let pass, of all sources so far.
    const ErrorsByDistance& let_pass() const { return let_pass_; }

private:
    // Of a near vertex; others, and the source, have 0 for both.
    struct Distances {
        float exact, answer;
        double error() const { return relative_error(exact, answer); }
        float deviation() const { return std::abs(answer - exact); }
    };

    uint32_t id_of(uint32_t vertex) const { return intake_.id_of_vertex[vertex]; }
    void fill_field();
    double largest_error(uint32_t vertex);
    void note_let_pass(uint32_t vertex, double error);
    void correct(uint32_t vertex, double error);
    void correct_wrong();
    void correct_steep();
    void make_less_steep(uint32_t vertex);
    bool is_too_steep(uint32_t a, uint32_t b) const;

    const Index& index_;
    const Intake& intake_;
    const NearDistances& near_;
    const ListOfLists<uint32_t>& edge_ends_;
    const double limit_;
    const bool finds_steep_;
    const ShortDistances& too_short_; // to be compared
    const double rounded_by_limit_;   // up to which distance a step of codes may be the limit
    Query query_;
    uint32_t source_ = NONE;
    std::vector<WrongPair>* wrong_ = nullptr;
    std::vector<float> answer_;    // by id; infinite but while a field is filled
    std::vector<Distances> field_; // by vertex
    std::vector<uint32_t> open_;   // vertices whose edges are to be looked at
    ErrorsByDistance let_pass_;
};

}
