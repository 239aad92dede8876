// What strips lead back through.
#include <vector>

#include <doctest/doctest.h>

#include "src/path/strip.h"

using namespace geodesic;

namespace {

// Faces 0, 1, 2 .. in a row, of which only numbers matter.
Strip strip_over(std::vector<uint32_t> faces, std::vector<Portal> portals) {
    Strip strip{};
    strip.faces = std::move(faces);
    strip.portals = std::move(portals);
    return strip;
}

// Without returns it has these faces and portals, and from its target to its source as well.
void check_without_returns(const Strip& strip, const Strip& expected) {
    Strip forwards = strip, backwards = strip;
    turn_back(backwards);
    drop_returns(forwards, {0, strip.portals.size()});
    drop_returns(backwards, {0, strip.portals.size()});
    turn_back(backwards);
    CHECK(is_same_strip(forwards, expected));
    CHECK(is_same_strip(backwards, expected));
}

}

TEST_CASE("strip: a face that is entered and left by one edge is taken out") {
    // Three faces share the edge 3-4.
    check_without_returns(strip_over({0, 1, 2}, {{3, 4}, {3, 4}}), strip_over({0, 2}, {{3, 4}}));
}

TEST_CASE("strip: what comes back into a face through one portal is taken out") {
    check_without_returns(strip_over({5, 0, 1, 0, 6}, {{1, 2}, {3, 4}, {3, 4}, {2, 7}}),
                          strip_over({5, 0, 6}, {{1, 2}, {2, 7}}));
    // Over an edge and back at its end, and at the end of an edge and back over it.
    check_without_returns(strip_over({5, 0, 1, 0, 6}, {{1, 2}, {3, 4}, {4, 4}, {2, 7}}),
                          strip_over({5, 0, 6}, {{1, 2}, {2, 7}}));
    check_without_returns(strip_over({5, 0, 1, 0, 6}, {{1, 2}, {4, 4}, {3, 4}, {2, 7}}),
                          strip_over({5, 0, 6}, {{1, 2}, {2, 7}}));
}

TEST_CASE("strip: what passes different edges, or goes on past a vertex, stays") {
    const Strip over_edges = strip_over({0, 1, 2}, {{3, 4}, {4, 5}}),
                past_vertex = strip_over({0, 1, 2}, {{3, 4}, {4, 4}});
    check_without_returns(over_edges, over_edges);
    check_without_returns(past_vertex, past_vertex);
}
