#include "tests/campaign/subject.h"

namespace geodesic::campaign {

namespace {

QueryHandle query_of(const geoidx* index) {
    geoidx_query* made = nullptr;
    succeed(geoidx_query_create(index, &made), "geoidx_query_create");
    return QueryHandle(made);
}

}

void expect_same(const char* check, std::span<const float> answers, std::span<const float> expected) {
    expect(answers.size() == expected.size(), check, "%zu answers", answers.size());
    for (size_t i = 0; i < answers.size(); ++i)
        expect(same_bits(answers[i], expected[i]), check, "answer %zu is %.9g, expected %.9g", i,
               double{answers[i]}, double{expected[i]});
}

geoidx_info info_of(const geoidx* index) {
    geoidx_info info{};
    info.struct_size = sizeof info;
    succeed(geoidx_get_info(index, &info), "geoidx_get_info");
    return info;
}

Subject::Subject(const BuildInput& input, IndexHandle index, double longest)
    : input_(input), index_(std::move(index)), query_(query_of(index_.get())),
      bounds_(input, info_of(index_.get()), longest) {}

float Subject::sssd(uint32_t a, uint32_t b) const {
    float distance = -1;
    succeed(geoidx_query_sssd(query(), a, b, &distance), "geoidx_query_sssd");
    return distance;
}

Floats Subject::msad(std::span<const uint32_t> sources) const {
    Floats distances(vertex_count(), -1);
    succeed(geoidx_query_msad(query(), sources.data(), static_cast<uint32_t>(sources.size()),
                              distances.data(), vertex_count()),
            "geoidx_query_msad");
    return distances;
}

Floats Subject::msad_within(std::span<const uint32_t> sources, float radius) const {
    Floats distances(vertex_count(), -1);
    succeed(geoidx_query_msad_within(query(), sources.data(), static_cast<uint32_t>(sources.size()), radius,
                                     distances.data(), vertex_count()),
            "geoidx_query_msad_within");
    return distances;
}

}
