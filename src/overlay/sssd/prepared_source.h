#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>

#include "src/overlay/fields/point_ways.h"
#include "src/overlay/fields/ssad.h"
#include "src/overlay/kernels/dispatch.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

// A source with its distances to borders, so that a distance to any vertex is one minimum over the border
// around that vertex. Borders become known when a target needs them, and stay so: up from the source to the
// first patch around both, across to the next patch around the target, then down to it. Vertices are given by
// their numbers. An object is the scratch of one thread.
class PreparedSource {
public:
    PreparedSource(const OverlayIndex& index, std::pmr::memory_resource* memory)
        : index_(index), kernels_(runnable_kernels().back()), known_(memory), is_inner_known_(memory),
          is_border_known_(memory), begun_(memory), kept_(memory), kept_begin_(memory), code_(memory),
          in_leaf_(index, memory) {}

    void prepare(uint32_t vertex);
    // A point of a face that a leaf has.
    void prepare(const FacePoint& point);

    // prepare() comes before. `field` is scratch.
    float distance(uint32_t target, OverlaySsad& field);

private:
    void begin(uint32_t innermost);
    void make_room();
    void forget();
    void forget(uint32_t patch);
    void begin_border(uint32_t patch);
    bool is_around_source(uint32_t patch) const { return index_.numbering.is_within(innermost_, patch); }
    uint32_t child_around_source(uint32_t patch) const;
    void require(uint32_t border_vertex, OverlaySsad& field);
    void require_border(uint32_t patch, OverlaySsad& field);
    void require_inner(uint32_t patch, OverlaySsad& field);
    float distance_in_own_leaf(uint32_t target) const;
    BorderFromSource border_around(uint32_t leaf);
    float distance_over_border(uint32_t leaf, uint32_t target);

    const OverlayIndex& index_;
    const Kernels& kernels_;
    uint32_t innermost_ = 0;         // patch around the source
    std::optional<FacePoint> point_; // unless the source is a vertex
    Array<float> known_;             // by number: of the inner vertices and of the borders that are known
    // Per patch, whether all of its inner vertices are known (not told of patches around the source), and
    // whether its border is.
    Array<uint8_t> is_inner_known_, is_border_known_;
    Array<uint32_t> begun_; // patches whose borders are known
    // Of the borders of leaves that were asked for: feet, heights and distances, as BorderFromSource has
    // them.
    Array<float> kept_;
    Array<uint32_t> kept_begin_; // per patch; NONE: not yet
    Array<int16_t> code_;        // scratch: codes of places, which are not read here
    PointsInLeaf in_leaf_;       // of a point
};

}
