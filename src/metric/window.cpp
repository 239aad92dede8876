#include "src/metric/window.h"

namespace geodesic {

namespace {

// A difference of distances below this share of the distance is rounding; so is one of where a source is, or
// of a place on the edge.
constexpr double RELATIVE_ROUNDING = 1e-12;

double difference(const Window& a, const Window& b, double t) { return a.distance_at(t) - b.distance_at(t); }

// Halves the bracket: slow, but cannot fail. Which of the two is lower at `low` is the caller's to say: where
// they touch there, the sign of the difference is rounding.
double bisect(const Window& a, const Window& b, double low, double high, bool a_is_lower_at_low) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((difference(a, b, middle) < 0) == a_is_lower_at_low ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// The t in [low, high] with a(t) = b(t), where a - b changes its sign once. Points whose distances to two
// sources differ by a constant lie on a hyperbola; this is where it meets the edge. Written so that nothing
// cancels when the constant is small.
double crossing(const Window& a, const Window& b, double low, double high, bool a_is_lower_at_low) {
    const double ax = a.x - low, bx = b.x - low;
    const double lag = b.sigma - a.sigma;
    const double slope = 2 * (bx - ax);
    const double offset = ax * ax + a.y * a.y - bx * bx - b.y * b.y - lag * lag;
    const double square = slope * slope - 4 * lag * lag;
    const double half_linear = slope * offset + 4 * lag * lag * bx;
    const double at_source = offset + slope * bx;
    const double root =
        2 * std::abs(lag) * std::sqrt(std::max(0.0, at_source * at_source + b.y * b.y * square));
    const double constant = offset * offset - 4 * lag * lag * (bx * bx + b.y * b.y);
    const double q = -(half_linear + std::copysign(root, half_linear));
    const double width = high - low;
    const double candidates[2] = {q / square, constant / q};
    for (double t : candidates)
        if (t >= 0 && t <= width && (slope * t + offset) * lag >= 0) {
            const double crossed = low + t;
            if (std::abs(difference(a, b, crossed)) <= 1e-11 * a.distance_at(crossed)) return crossed;
        }
    return bisect(a, b, low, high, a_is_lower_at_low);
}

// Whether b begins where a ends, and both are propagated alike.
bool is_beside(const Window& a, const Window& b) {
    return std::abs(b.begin - a.end) <= RELATIVE_ROUNDING * b.end && a.nearest == b.nearest &&
           a.from_face == b.from_face && a.pending == b.pending;
}

bool see_one_source(const Window& a, const Window& b) {
    const double apart = RELATIVE_ROUNDING * (std::abs(a.x) + a.y);
    return std::abs(a.x - b.x) <= apart && std::abs(a.y - b.y) <= apart && a.sigma == b.sigma;
}

// Whether one window for two would change their distances by clearly more than this share. Where the slopes
// of the two differ by k at the place where they meet, one that has the outer rays of both is off by k / 4 to
// k / 2 times the length of the longer one; where their second derivatives differ by c, the ends are off by
// c / 2 times the product of both lengths.
bool differ_too_much(const Window& a, const Window& b, double tolerance) {
    constexpr double SURELY = 2;
    const double most = SURELY * tolerance * a.end_distance;
    const double to_a = a.end_distance - a.sigma, to_b = b.begin_distance - b.sigma;
    const double a_length = a.end - a.begin, b_length = b.end - b.begin;
    const double slopes = std::abs((a.end - a.x) * to_b - (b.begin - b.x) * to_a); // times to_a * to_b
    const double bends = a.y * a.y * std::abs(to_b - to_a);                        // times to_a^3 * to_b
    return slopes * std::max(a_length, b_length) > 4 * most * to_a * to_b ||
           bends * a_length * b_length > 2 * most * to_a * to_a * to_a * to_b;
}

// What join_windows says of two that lie beside each other and see different sources.
std::optional<Window> join_nearly(const Window& a, const Window& b, double tolerance) {
    // A farther source would be rounded by too much beside the distances.
    constexpr double FARTHEST = 100;
    if (!a.pending || !(a.y > 0) || !(b.y > 0) || differ_too_much(a, b, tolerance)) return std::nullopt;
    const double a_across = a.x - a.begin, b_across = b.x - b.end;
    const double turn = a_across * b.y - a.y * b_across;
    if (!(turn > 0)) return std::nullopt;
    const double along = (b.end - a.begin) * b.y / turn;
    Window both = a;
    both.end = b.end;
    both.x = a.begin + along * a_across;
    both.y = along * a.y;
    both.sigma = 0;
    const double at_begin = both.distance_at(both.begin), at_end = both.distance_at(both.end);
    const double by_begin = a.begin_distance - at_begin, by_end = b.end_distance - at_end;
    both.sigma = 0.5 * (by_begin + by_end);
    both.begin_distance = at_begin + both.sigma;
    both.end_distance = at_end + both.sigma;
    const double most = tolerance * std::min({a.begin_distance, a.end_distance, b.end_distance});
    if (std::abs(by_begin - by_end) > most || at_begin > FARTHEST * a.begin_distance) return std::nullopt;
    const double between = both.distance_at(a.end);
    if (std::abs(between - a.end_distance) > most || std::abs(between - b.begin_distance) > most)
        return std::nullopt;
    return both;
}

}

std::optional<Window> join_windows(const Window& a, const Window& b, double tolerance) {
    if (!is_beside(a, b)) return std::nullopt;
    if (!see_one_source(a, b)) return tolerance > 0 ? join_nearly(a, b, tolerance) : std::nullopt;
    Window both = a;
    both.end = b.end;
    both.end_distance = b.end_distance;
    return both;
}

// The difference of two windows has at most one extremum on the edge, where the line through both sources
// meets it. Between the ends and that point it is monotonic, so that the signs there tell everything.
Advantage advantage(const Window& challenger, const Window& holder, double s, double t) {
    const double holder_s = s == holder.begin ? holder.begin_distance : holder.distance_at(s);
    const double holder_t = t == holder.end ? holder.end_distance : holder.distance_at(t);
    const double highest = std::max(holder_s, holder_t);
    if (challenger.smallest_distance() >= highest) return {s, s, false};
    const double at_s =
        (s == challenger.begin ? challenger.begin_distance : challenger.distance_at(s)) - holder_s;
    const double at_t =
        (t == challenger.end ? challenger.end_distance : challenger.distance_at(t)) - holder_t;
    const double rounding = RELATIVE_ROUNDING * highest;
    const double extremum = (challenger.x * holder.y - holder.x * challenger.y) / (holder.y - challenger.y);
    if (!(extremum > s && extremum < t)) { // also where the line runs along the edge
        if (at_s >= -rounding && at_t >= -rounding) return {s, s, false};
        const double begin = at_s <= 0 ? s : crossing(challenger, holder, s, t, false);
        const double end = at_t <= 0 ? t : crossing(challenger, holder, s, t, true);
        return {begin, end, false};
    }
    const double between = difference(challenger, holder, extremum);
    if (at_s >= -rounding && at_t >= -rounding && between >= -rounding) return {s, s, false};
    if (between < 0) {
        const double begin = at_s <= 0 ? s : crossing(challenger, holder, s, extremum, false);
        const double end = at_t <= 0 ? t : crossing(challenger, holder, extremum, t, true);
        return {begin, end, false};
    }
    const double first_end = at_s < 0 ? crossing(challenger, holder, s, extremum, true) : s;
    const double second_begin = at_t < 0 ? crossing(challenger, holder, extremum, t, false) : t;
    return {first_end, second_begin, true};
}

}
