#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/overlay/tables/tables.h"

namespace geodesic {

// The distance from a vertex to the middle of a segment is derived from those to the segment's two ends.
// Where shortest paths to the ends come around different sides of a bump, it is derived too short, and a
// field then rises more steeply between this vertex and its neighbours than along the surface. The distances
// of two internal vertices of a leaf from one middle cannot differ by more than the two are apart, which the
// leaf's internal table knows: so the shorter one is raised.
class MiddleRaiser {
public:
    explicit MiddleRaiser(const OverlayIndex& index) : index_(index) {}

    // Raises the middles of one leaf, which have been derived, in rows as those of the leaf's inner table,
    // end to end. The internal table of the leaf must be filled. The leaf has at most MOST_VERTICES: each
    // pair of vertices takes a pass over two rows, of which a file could ask for any number.
    void raise(uint32_t leaf, uint16_t* middles);
    static constexpr size_t MOST_VERTICES = 256;

private:
    void copy_derived();
    std::span<const uint32_t> find_near(const uint16_t* codes, size_t count, uint16_t most);
    void compare(size_t i, size_t j, uint16_t allowed);
    bool differ(size_t i, size_t j, uint16_t allowed) const;
    void raise_row(size_t i, const uint16_t* by, uint16_t allowed);

    uint16_t* row(size_t i) const { return middles_ + i * places_; }
    const uint16_t* derived(size_t i) const { return derived_.data() + i * whole_places_; }

    const OverlayIndex& index_;
    // Of the latest leaf. Arrays only grow, since to fill them anew takes long.
    uint16_t* middles_ = nullptr;
    size_t count_ = 0, places_ = 0, whole_places_ = 0;
    // Middles as they were derived, so that no raised one raises others. Rows are filled up to whole vectors
    // with 0, which also stands for a middle that is not there: it raises nothing.
    std::vector<uint16_t> derived_;
    std::vector<uint32_t> near_;
};

}
