#include "src/metric/envelope.h"

#include <algorithm>

namespace geodesic {

namespace {

// A way must be longer by more than this share, or by more than so many tolerances: less may be rounding of
// where two windows are divided, or come from joining.
constexpr double BEATEN_BY = 1e-10, BEATEN_BY_TOLERANCES = 10;

// Makes the second of two windows begin where the first ends, for the simple and most frequent case that both
// stay and neither reaches beyond the other; false, and nothing done, otherwise.
bool divide(Window& first, Window& second) {
    if (first.end <= second.begin) return true;
    if (second.begin <= first.begin || second.end <= first.end) return false;
    const Advantage won = advantage(second, first, second.begin, first.end);
    if (won.begin < won.end) {
        if (won.inside_out || won.end < first.end) return false;
        first.end = won.begin;
        first.end_distance = first.distance_at(first.end);
    }
    if (second.begin < first.end) {
        second.begin = first.end;
        second.begin_distance = second.distance_at(second.begin);
    }
    return true;
}

}

// Divides two windows. Returns false also where they are to be one.
bool Envelope::stay_beside(Window& first, Window& second) const {
    return divide(first, second) && !join_windows(first, second, tolerance_);
}

// Whether everywhere on one of two windows beside each other, the way over the other one and along the edge
// is shorter: paths over it are no shortest ones.
bool Envelope::is_beaten_by_one_before(const Window& before, const Window& window) const {
    return window.end_distance > (before.end_distance + (window.end - before.end)) * (1 + beaten_by_);
}
bool Envelope::is_beaten_by_one_behind(const Window& window, const Window& behind) const {
    return window.begin_distance > (behind.begin_distance + (behind.begin - window.begin)) * (1 + beaten_by_);
}

std::span<const Window> Envelope::merge(std::span<const Window> holders, std::span<Window> windows,
                                        double tolerance) {
    tolerance_ = tolerance;
    beaten_by_ = std::max(BEATEN_BY, BEATEN_BY_TOLERANCES * tolerance);
    lowest_ = std::numeric_limits<double>::infinity();
    size_t divided = 0; // windows that are an envelope where they are
    if (holders.empty())
        for (; divided < windows.size(); ++divided) {
            if (divided > 0 && !stay_beside(windows[divided - 1], windows[divided])) break;
            lowest_ = std::min(lowest_, windows[divided].smallest_distance());
        }
    if (divided == windows.size() && holders.empty()) return windows;
    done_.assign(windows.begin(), windows.begin() + static_cast<std::ptrdiff_t>(divided));
    taken_back_.clear();
    rest_ = holders;
    for (Window& window : windows.subspan(divided)) insert(window);
    done_.insert(done_.end(), taken_back_.rbegin(), taken_back_.rend());
    done_.insert(done_.end(), rest_.begin(), rest_.end());
    return done_;
}

void Envelope::skip_next() {
    if (taken_back_.empty())
        rest_ = rest_.subspan(1);
    else
        taken_back_.pop_back();
}

// Left of the cursor is what ends at t or before.
void Envelope::move_cursor(double t) {
    while (!done_.empty() && done_.back().end > t) {
        taken_back_.push_back(done_.back());
        done_.pop_back();
    }
    while (!at_end() && next()->end <= t) {
        done_.push_back(*next());
        skip_next();
    }
}

void Envelope::insert(Window& window) {
    if (at_end() && (done_.empty() || divide(done_.back(), window))) {
        if (put_down(window)) lowest_ = std::min(lowest_, window.smallest_distance());
        return;
    }
    move_cursor(window.begin);
    double covered = window.begin;
    while (!at_end() && next()->begin < window.end) {
        const Window holder = *next();
        if (holder.begin > covered) emit_new(window, covered, holder.begin);
        skip_next();
        challenge(window, holder);
        covered = holder.end;
    }
    if (window.end > covered) emit_new(window, covered, window.end);
}

// Puts down a window unless one beside it beats it, and takes away those that it beats; one that goes on
// where the one before it ends is joined to that. Returns whether it is down. Where the ends of two windows
// should be one point, rounding leaves gaps, which any window fills that comes later, however long its paths
// are. Carried on over thin faces, such gaps and what fills them would multiply.
bool Envelope::put_down(const Window& window) {
    while (!done_.empty() && is_beaten_by_one_behind(done_.back(), window)) done_.pop_back();
    if (!done_.empty() && is_beaten_by_one_before(done_.back(), window)) return false;
    if (!at_end() && is_beaten_by_one_behind(window, *next())) return false;
    if (done_.empty() || !join_to_last(window)) done_.push_back(window);
    return true;
}

// Whether a window is now a part of the one that was put down last.
bool Envelope::join_to_last(const Window& window) {
    const std::optional<Window> both = join_windows(done_.back(), window, tolerance_);
    if (both) done_.back() = *both;
    return both.has_value();
}

// Puts down a part of a window. Returns whether it is down.
bool Envelope::emit(const Window& window, double begin, double end) {
    if (!(end > begin)) return false;
    Window part = window;
    if (begin != window.begin) part.begin_distance = window.distance_at(begin);
    if (end != window.end) part.end_distance = window.distance_at(end);
    part.begin = begin;
    part.end = end;
    return put_down(part);
}

void Envelope::emit_new(const Window& window, double begin, double end) {
    if (emit(window, begin, end)) lowest_ = std::min(lowest_, done_.back().smallest_distance());
}

// Puts down what is left of the holder, and of the challenger on the holder's interval.
void Envelope::challenge(const Window& challenger, const Window& holder) {
    const double s = std::max(challenger.begin, holder.begin);
    const double t = std::min(challenger.end, holder.end);
    const Advantage won = advantage(challenger, holder, s, t);
    if (won.inside_out) {
        emit(holder, holder.begin, s);
        emit_new(challenger, s, won.begin);
        emit(holder, won.begin, won.end);
        emit_new(challenger, won.end, t);
        emit(holder, t, holder.end);
    } else if (won.begin < won.end) {
        emit(holder, holder.begin, won.begin);
        emit_new(challenger, won.begin, won.end);
        emit(holder, won.end, holder.end);
    } else {
        emit(holder, holder.begin, holder.end);
    }
}

}
