#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "format/container.h"
#include "src/index/border_segments.h"
#include "src/index/description.h"

namespace geodesic {

// Coordinates are at most so many steps, so that the sum of three squares of differences is exact in double
// precision.
constexpr int32_t MOST_STEPS = (1 << 23) - 1;

// Two vertices, by their numbers, and a distance of theirs.
struct VertexPair {
    uint32_t first, second; // first < second
    float distance;
};

// What a file holds: one field for each field of format/SPEC.md, in the same order. The builder and the
// reader fill it, prepare() makes from it what queries read, restore() does the opposite, and the writer
// writes it. No field can be derived from the others.
//
// The tables of several patches lie end to end, in the order of the patches. Each table is stored row by row.
// Of a symmetric table only the entries below the diagonal are stored, beginning with the shortest row.
// (src/file folds them into images.)
struct StoredIndex {
    Description description; // the header and META

    // HIER
    uint32_t level_count = 0;
    std::vector<uint32_t> child_count; // per inner patch

    // VERT
    std::vector<uint32_t> number_of_id; // per id of the caller; NONE if no triangle uses it

    // POSI. The count of positions is the vertex count of VERT.
    float position_step = 1;
    std::array<double, 3> position_origin{};
    std::vector<std::array<int32_t, 3>> positions; // per number, in steps from the origin: 0 .. MOST_STEPS

    // BORD
    std::vector<uint32_t> owned_count;    // per inner patch
    std::vector<uint32_t> internal_count; // per leaf
    std::vector<uint32_t> border_size;    // per patch but the root
    std::vector<uint32_t> border;         // the vertices' numbers, in the order of the patches

    // Graph engine: distances; infinite where there is no path.
    std::vector<float> border_tables;          // BVBV: of every patch but the root, below the diagonal
    std::vector<float> border_internal_tables; // BVIV: of every leaf, a row for each border vertex
    std::vector<float> internal_tables;        // IVIV: of every leaf, below the diagonal

    // Overlay engine: codes of distances (src/overlay/tables/codes.h), in steps of the quantum of the patch.
    std::vector<float> quantum; // QUAN: per patch
    std::vector<uint8_t> shift; // QUAN: per patch; its codes are multiples of 2^shift
    BorderSegments segments;    // SEGM: those of chains per element of `border`
    // PAIR: the largest of what tables say of these pairs, by the classes of their distances
    std::array<float, DISTANCE_CLASSES> errors_of_measured{};
    std::vector<VertexPair> measured_pairs;      // PAIR: by the metric; in ascending order, each once
    std::vector<VertexPair> steep_edges;         // EDGE: what the distances of both ends may differ by, at
                                                 // most; in ascending order, each once
    std::vector<uint16_t> overlay_codes;         // OVOV: of every inner patch, owned x border, then owned x
                                                 // owned below the diagonal
    std::vector<uint16_t> border_internal_codes; // BVIV: of every leaf, a row for each border vertex
    std::vector<uint16_t> internal_codes;        // IVIV: of every leaf, below the diagonal
    // HOPS: in a mapped file, in place of the three above: the tables of HopTables, which is what queries
    // read. They lie in the file, or in the index that is going to be saved.
    std::span<const uint16_t> hop_codes;

    // MESH, still packed: it lies in the file, or in the index that is going to be saved. No bytes if the
    // mesh is not kept.
    format::StoredBytes mesh;
};

}
