#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "tests/campaign/bounds.h"
#include "tests/campaign/finding.h"

namespace geodesic::campaign {

using Floats = std::vector<float>;

inline bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }
void expect_same(const char* check, std::span<const float> answers, std::span<const float> expected);

// An index of a case with one query object for everything, so that what an answer leaves behind meets the
// next one.
class Subject {
public:
    Subject(const BuildInput& input, IndexHandle index, double longest);

    const BuildInput& input() const { return input_; }
    const Bounds& bounds() const { return bounds_; }
    const geoidx* index() const { return index_.get(); }
    geoidx_query* query() const { return query_.get(); }
    uint32_t vertex_count() const { return input_.surface().vertex_count(); }

    float sssd(uint32_t a, uint32_t b) const;
    Floats msad(std::span<const uint32_t> sources) const;
    Floats msad(uint32_t source) const { return msad(std::span(&source, 1)); }
    Floats msad_within(std::span<const uint32_t> sources, float radius) const;

private:
    const BuildInput& input_;
    IndexHandle index_;
    QueryHandle query_;
    Bounds bounds_;
};

geoidx_info info_of(const geoidx* index);

}
