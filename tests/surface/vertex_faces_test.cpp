// The faces around vertices in 16 bits, compared with the lists that they were made of.
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "src/surface/vertex_faces.h"

using geodesic::ListOfLists;
using geodesic::VertexFaces;

namespace {

void check_same(const ListOfLists<uint32_t>& lists) {
    const VertexFaces faces(lists);
    for (uint32_t vertex = 0; vertex < lists.size(); ++vertex) {
        std::vector<uint32_t> found;
        for (const uint32_t face : faces[vertex]) found.push_back(face);
        CHECK(found == std::vector<uint32_t>(lists[vertex].begin(), lists[vertex].end()));
        CHECK(faces.room_for(vertex) >= found.size());
    }
}

}

TEST_CASE("faces around vertices: near the first ones of a block, just out of reach, and anywhere") {
    for (const uint32_t base : {0u, 5u, 32767u, 32768u, 70000u, 4000000000u}) {
        ListOfLists<uint32_t> lists;
        for (const uint32_t off : {0u, 1u, 32766u, 32767u, 32768u, 65534u, 65535u, 65536u, 99999u}) {
            if (off <= base) lists.items.push_back(base - off);
            lists.items.push_back(base);
            lists.items.push_back(base + off);
            lists.close_list();
        }
        check_same(lists);
    }
}

TEST_CASE("faces around vertices: many lists of random numbers") {
    std::mt19937_64 random(3);
    for (const uint32_t most : {10u, 100000u, 4294967295u}) {
        ListOfLists<uint32_t> lists;
        for (int vertex = 0; vertex < 200; ++vertex) {
            for (uint64_t i = 0; i <= random() % 9; ++i)
                lists.items.push_back(static_cast<uint32_t>(random() % (uint64_t{most} + 1)));
            lists.close_list();
        }
        check_same(lists);
    }
}
