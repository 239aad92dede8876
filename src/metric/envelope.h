#pragma once

#include <limits>
#include <span>
#include <vector>

#include "src/metric/window.h"

namespace geodesic {

// The lower envelope of windows on one edge: begins as a list of windows sorted along the edge, without
// overlaps, and takes more, one by one. Windows that come in the order of the edge cost a constant each.
class Envelope {
public:
    void begin(std::span<const Window> holders);

    // Puts in the parts of a window where it is the lowest.
    void insert(const Window& window);

    // The smallest distance on the parts put in so far; infinity if there are none.
    double lowest() const { return lowest_; }

    // The whole list, valid until the next begin.
    std::span<const Window> finish();

private:
    void move_cursor(double t);
    const Window* next() const { return !taken_back_.empty() ? &taken_back_.back() : rest_.data(); }
    bool at_end() const { return taken_back_.empty() && rest_.empty(); }
    void skip_next();
    void challenge(const Window& challenger, const Window& holder);
    void emit(const Window& window, double begin, double end);
    void emit_new(const Window& window, double begin, double end);

    std::vector<Window> done_;       // left of the cursor
    std::vector<Window> taken_back_; // right of the cursor, the leftmost last
    std::span<const Window> rest_;   // right of those
    double lowest_ = std::numeric_limits<double>::infinity();
};

}
