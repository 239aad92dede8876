#pragma once

#include <limits>
#include <span>
#include <vector>

#include "src/metric/window.h"

namespace geodesic {

// The lower envelope of windows on one edge.
class Envelope {
public:
    // Puts windows into a list that is sorted along the edge, without overlaps: the parts of each where it is
    // the lowest. They may come in any order; where that is the order of the edge they cost a constant each.
    // Changes the windows. Those beside each other are joined where distances at their ends change by no more
    // than a share, the tolerance; 0: only where one goes on in the other. The result, a list of the same
    // kind, is valid until the next merge, and as long as `windows` are.
    std::span<const Window> merge(std::span<const Window> holders, std::span<Window> windows,
                                  double tolerance = 0);

    // No more than the smallest distance on the parts that the latest merge put in, which it is unless one of
    // them was taken away again or, but for the tolerance, joined; infinity if it put in none.
    double lowest() const { return lowest_; }

private:
    void insert(Window& window);
    void move_cursor(double t);
    const Window* next() const { return !taken_back_.empty() ? &taken_back_.back() : rest_.data(); }
    bool at_end() const { return taken_back_.empty() && rest_.empty(); }
    void skip_next();
    void challenge(const Window& challenger, const Window& holder);
    bool stay_beside(Window& first, Window& second) const;
    bool is_beaten_by_one_before(const Window& before, const Window& window) const;
    bool is_beaten_by_one_behind(const Window& window, const Window& behind) const;
    bool join_to_last(const Window& window);
    bool put_down(const Window& window);
    bool emit(const Window& window, double begin, double end);
    void emit_new(const Window& window, double begin, double end);

    double tolerance_ = 0, beaten_by_ = 0; // of the merge that runs
    std::vector<Window> done_;             // left of the cursor
    std::vector<Window> taken_back_;       // right of the cursor, the leftmost last
    std::span<const Window> rest_;         // right of those
    double lowest_ = std::numeric_limits<double>::infinity();
};

}
