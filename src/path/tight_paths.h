#pragma once

#include <span>
#include <vector>

#include "src/path/funnel.h"
#include "src/path/strip.h"

namespace geodesic {

// Finds the shortest paths in strips: between two portals that are vertices the strip is unfolded into the
// plane, and the path pulled tight there. It keeps its arrays from one strip to the next.
class TightPaths {
public:
    explicit TightPaths(const Surface& surface) : surface_(surface) {}

    void pull_tight(const Strip& strip, StripPath& path);

private:
    struct Part;
    struct Piece;
    // A portal in the plane: its ends as whoever goes through it sees them, as points of the funnel.
    struct Gate {
        uint32_t left, right;
    };

    void unfold(const Strip& strip, const Part& part);
    void find_bends();
    void fill_shares(std::span<const Portal> portals, double* shares) const;
    double share(const Gate& gate, const Portal& portal, const Piece& piece) const;

    const Surface& surface_;
    std::vector<Gate> gates_; // of a part, and room for more
    Funnel funnel_;
    std::vector<uint32_t> bends_; // the points of the funnel where the way bends, and its ends
};

}
