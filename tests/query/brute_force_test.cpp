// SSSD and MSAD against a brute-force search over exactly the tables that they may use.

#include "src/capi/handles.h"
#include "tests/query/brute_force.h"
#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic;
using namespace geodesic::test;

namespace {

bool agree(double answer, double expected) {
    if (expected == FAR || expected == 0) return answer == expected;
    return std::abs(answer - expected) <= ROUNDING * expected;
}

// Spread over the mesh, each id with a stride that has no factor in common with rows of the grids.
std::vector<uint32_t> some_ids(const TestMesh& mesh, uint32_t count) {
    std::vector<uint32_t> ids;
    for (uint32_t i = 0; i < count; ++i) ids.push_back((i * 131 + 1) % mesh.vertex_count());
    return ids;
}

}

TEST_CASE("SSSD is the shortest path over the overlays of both vertices' ancestors" *
          doctest::skip(SANITIZED)) {
    for (const QueryCase& test : query_cases()) {
        CAPTURE(test.name);
        const geoidx* handle = index_of(test);
        const Array<uint32_t>& number_of_id = handle->index.number_of_id;
        const auto& index = std::get<GraphIndex>(handle->index.engine);
        uint64_t searched = 0;
        for (uint32_t a : some_ids(test.mesh, 4))
            for (uint32_t b : some_ids(test.mesh, 9)) {
                const uint32_t from = number_of_id[a], to = number_of_id[b];
                double expected = a == b ? 0 : FAR;
                if (from != NONE && to != NONE) expected = brute_force_sssd(index, from, to);
                const double answer{sssd(handle, a, b)};
                searched += expected > 0 && expected < FAR;
                CAPTURE(a);
                CAPTURE(b);
                CAPTURE(answer);
                CAPTURE(expected);
                CHECK(agree(answer, expected));
            }
        CHECK(searched > 0);
    }
}

TEST_CASE("MSAD is the three phases over the tables, and never under the shortest path over all of them") {
    for (const QueryCase& test : query_cases()) {
        CAPTURE(test.name);
        const geoidx* handle = index_of(test);
        const Array<uint32_t>& number_of_id = handle->index.number_of_id;
        const auto& index = std::get<GraphIndex>(handle->index.engine);
        const Arcs every_arc = all_arcs(index);
        const auto ids = some_ids(test.mesh, 6);
        for (const auto& sources :
             {std::vector<uint32_t>{ids[0]}, std::vector<uint32_t>{ids[1]}, std::vector<uint32_t>{ids[2]},
              std::vector<uint32_t>{ids[3], ids[4], ids[5], ids[3]}}) {
            std::vector<uint32_t> numbers;
            for (uint32_t id : sources)
                if (number_of_id[id] != NONE) numbers.push_back(number_of_id[id]);
            const auto expected = brute_force_msad(index, numbers);
            std::vector<double> least(index.numbering.vertex_count(), FAR);
            for (uint32_t number : numbers) least[number] = 0;
            relax(every_arc, least);
            const auto answers = msad(handle, sources, test.mesh.vertex_count());
            for (uint32_t id = 0; id < answers.size(); ++id) {
                const bool is_source = std::ranges::count(sources, id) > 0;
                const uint32_t number = number_of_id[id];
                const double three_phases = is_source ? 0 : number == NONE ? FAR : expected[number];
                const double answer{answers[id]};
                if (!agree(answer, three_phases)) {
                    CAPTURE(id);
                    CAPTURE(answer);
                    CAPTURE(three_phases);
                    CHECK(agree(answer, three_phases));
                }
                if (!is_source && number != NONE && answer < least[number] * (1 - ROUNDING)) {
                    CAPTURE(id);
                    CHECK(answer >= least[number] * (1 - ROUNDING));
                }
            }
        }
    }
}
