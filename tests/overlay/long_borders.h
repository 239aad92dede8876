#pragma once

#include <list>

#include "tests/overlay/overlay_of.h"

namespace geodesic::test {

// Two patches with one long open border between them, and many, closed borders among theirs.
inline const TestMesh& strip() {
    static const TestMesh mesh = pressed(grid(400, 9), 0.01);
    return mesh;
}
inline const TestMesh& square() {
    static const TestMesh mesh = pressed(grid(400, 11), 0.025);
    return mesh;
}
// Thirty patches, the borders of which are longer than those that pairs cross as a whole.
constexpr uint32_t WIDE_X = 300, WIDE_Y = 60;
inline const TestMesh& wide() {
    static const TestMesh mesh = pressed(grid(WIDE_X, WIDE_Y), 0.2);
    return mesh;
}

inline const std::list<OverlayOf>& built() {
    static const std::list<OverlayOf> all = [] {
        std::list<OverlayOf> made;
        made.emplace_back(strip(), options_of_plane(strip(), {2, 4}));
        made.emplace_back(square(), options_of_plane(square(), {12}));
        made.emplace_back(wide(), options_of_plane(wide(), {30}));
        return made;
    }();
    return all;
}

}
