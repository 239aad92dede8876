#pragma once

#include <optional>

#include "src/base/number_map.h"
#include "src/path/strip.h"
#include "src/path/tight_paths.h"
#include "src/path/turn.h"

namespace geodesic {

// A strip has a vertex at its side or passes it: portals `first` to `last` all contain it.
struct Pass {
    size_t first, last;
    uint32_t vertex;
};

// Puts the faces of a fan around that vertex in the place of the strip's own between the portals.
void turn_around(Strip& strip, const Pass& pass, const Turn::Fan& fan);

// Makes paths in strips locally shortest: while one bends at a vertex whose other side has an angle of less
// than pi, the strip is turned around that vertex (Xin and Wang 2007). Each turn makes the path shorter. It
// changes the path between the bends before and after it alone, so only that part is pulled tight again. The
// object keeps its arrays from one strip to the next.
class Straightening {
public:
    explicit Straightening(const Surface& surface) : surface_(surface), tight_paths_(surface) {}

    // Only way.strip is read.
    void straighten(StripWay& way);

    // The same of a path that is as short as its strip allows (TightPaths::pull_tight()).
    void turn_bends(StripWay& way);

    // Puts a part with the same ends in the place of a range between two bends, whose path was so long. Gives
    // the first portal that the path may pass in another way now.
    size_t replace_part(StripWay& way, PointRange range, const StripWay& part, double length_before);

private:
    static constexpr double SHORTER = 1e-13; // as a share of the path: less is rounding

    std::optional<Turn::Fan> shorter_side(const StripWay& way, const Pass& pass) const;
    std::optional<size_t> turn(StripWay& way, const Pass& pass);

    const Surface& surface_;
    TightPaths tight_paths_;
    StripWay part_; // that a turn changes
    // Per face before a bend, which tells two passes of one vertex apart: whether no turn helps there as long
    // as the path stays.
    NumberMap<bool> is_straight_;
};

// The same for one strip.
StripWay straighten(const Surface& surface, Strip&& strip);

}
