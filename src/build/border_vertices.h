#pragma once

#include <cstdint>
#include <vector>

#include "src/mesh/intake.h"
#include "src/partition/random.h"
#include "src/query/index.h"

namespace geodesic {

// Chooses vertices of the caller's mesh by where they lie to the borders of patches. Added vertices are never
// chosen.
class BorderVertices {
public:
    BorderVertices(const Index& index, const Intake& intake);

    // Whether there are patches with borders at all.
    bool are_there() const { return !levels_.empty(); }

    // A vertex on a border or next to one. Borders of each level are chosen as often, though those of upper
    // patches have fewer vertices. Requires are_there().
    uint32_t on_or_next_to(Random& random) const;

    // Vertices next to each other along a border, at most `count`. Requires are_there().
    std::vector<uint32_t> in_a_row(Random& random, uint32_t count) const;

private:
    const Mesh& mesh_;
    // Per level with border vertices of which some have an id: these vertices, in the order of their numbers,
    // which go along borders.
    std::vector<std::vector<uint32_t>> levels_;
};

}
