#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "tests/overlay/stored_tables.h"

// A hop in plain loops, written after the text of format/SPEC.md, "Distances of the overlay engine".
namespace geodesic::test {

inline constexpr double NOWHERE = std::numeric_limits<double>::infinity();

// What happened in a hop to one vertex.
struct Hop {
    double distance = NOWHERE;
    uint32_t over = NONE;         // b of a hop over vertices
    bool had_sum = true;          // whether any sum counted
    bool is_near = false;         // whether the near rule replaced the distance,
    bool is_other = false;        // by another one
    bool is_straightened = false; // whether a way over a segment beside b was less than that over b
};

using Rows = std::vector<std::vector<uint16_t>>;

// The root of a square that rounded distances may have made a little too small, or NaN.
template <class Number>
Number root(Number square, Number length) {
    return square < -length * length / 32 ? NAN : std::sqrt(std::max(square, Number{0}));
}

// The codes of all middles of a border as they are derived: for each row one of each segment, NaN if it is
// left out.
inline std::vector<std::vector<float>> derived_middles(const StoredBorder& border, const Rows& rows,
                                                       float quantum) {
    std::vector<std::vector<float>> codes(rows.size(), std::vector<float>(border.segment_count(), NAN));
    for (size_t x = 0; x < rows.size(); ++x)
        for (uint32_t i = 0; i < border.segment_count(); ++i) {
            const uint32_t p = border.begin[i], q = border.end[i];
            if (q == NONE || rows[x][p] == NO_PATH || rows[x][q] == NO_PATH) continue;
            const float at_p = rows[x][p], at_q = rows[x][q], length = border.length[i] / quantum;
            const float square = 0.5f * (at_p * at_p + at_q * at_q) - 0.25f * (length * length);
            codes[x][i] = std::trunc(root(square, length) + 0.5f);
        }
    return codes;
}

// The same, raised where there are at most 256 rows. `apart` has the codes of all pairs of rows: of a leaf,
// and of other patches no rows.
inline std::vector<std::vector<float>> raised_middles(const StoredBorder& border, const Rows& rows,
                                                      const Rows& apart, float quantum) {
    const auto derived = derived_middles(border, rows, quantum);
    auto codes = derived;
    if (rows.size() > 256) return codes;
    const float longest =
        border.size() == 0 ? 0 : *std::max_element(border.length.begin(), border.length.end());
    for (size_t x = 0; x < apart.size(); ++x)
        for (size_t y = 0; y < apart.size(); ++y) {
            const int t = apart[x][y];
            if (x == y || t == NO_PATH || static_cast<float>(t) > longest / quantum) continue;
            for (uint32_t i = 0; i < border.segment_count(); ++i) // not where either is NaN
                if (derived[y][i] - static_cast<float>(t + t / 25) > codes[x][i])
                    codes[x][i] = derived[y][i] - static_cast<float>(t + t / 25);
        }
    return codes;
}

// The same as they are kept: so many strides below the mean of both ends, of which one without a path counts
// as 32767. NaN where no segment begins.
inline std::vector<std::vector<float>> middle_codes(const StoredBorder& border, const Rows& rows,
                                                    const Rows& apart, float quantum) {
    auto codes = raised_middles(border, rows, apart, quantum);
    for (size_t x = 0; x < rows.size(); ++x)
        for (uint32_t i = 0; i < border.segment_count(); ++i) {
            if (border.end[i] == NONE) continue;
            const auto mean = static_cast<float>((rows[x][border.begin[i]] + rows[x][border.end[i]] + 1) / 2);
            const float middle = std::isnan(codes[x][i]) ? mean : codes[x][i];
            const float in_strides = border.length[i] * (1 / quantum) * (0.5f / 255) + 1;
            const float stride = std::trunc(std::min(in_strides, 127.f));
            const float offset = std::trunc((mean - middle) * (1 / stride) + 0.5f);
            const float most = std::min(255.f, std::trunc(mean * (1 / stride)));
            codes[x][i] = mean - stride * std::max(0.f, std::min(most, offset));
        }
    return codes;
}

// From one source over one border. What decides between sums of steps is in single precision, as the text has
// it: the steps themselves, the distances of middles and their codes. All else is in double precision.
class PlainHop {
public:
    // The index has so many vertices.
    PlainHop(const StoredBorder& border, std::vector<float> distances, float quantum, uint32_t vertex_count)
        : border_(border), distances_(std::move(distances)), quantum_(quantum) {
        const double near_segments = std::clamp(10000.0 / vertex_count, 5.0, 20.0);
        for (uint32_t i = 0; i < border.segment_count(); ++i) {
            if (border.end[i] != NONE && distances_[border.begin[i]] < INFINITE)
                near_radius_ = std::max(near_radius_, near_segments * double{border.length[i]});
            middles_.push_back(middle(i));
        }
        for (uint32_t k = 0; k < border.size(); ++k) least_ = std::min(least_, distances_[k]);
        least_or_middle_ = least_;
        for (const float m : middles_)
            if (!std::isnan(m)) least_or_middle_ = std::min(least_or_middle_, m);
    }

    bool is_reached() const { return least_ < INFINITE; }

    Hop over_vertices(const std::vector<uint16_t>& row) const {
        Hop hop;
        if (!is_reached()) return hop;
        int32_t least_sum = 32767;
        for (uint32_t b = 0; b < border_.size(); ++b) {
            const int32_t sum = steps(distances_[b], least_) + row[b];
            if (sum >= least_sum) continue;
            least_sum = sum;
            hop.over = b;
        }
        hop.had_sum = least_sum < 32767;
        double least = NOWHERE;
        if (!hop.had_sum) hop.over = first_least_way(row);
        if (hop.over != NONE) {
            least = way_over(row, hop.over);
            const double over_vertex = least;
            for (const uint32_t k : border_.beside(hop.over)) least = std::min(least, way_across(row, k));
            hop.is_straightened = least < over_vertex;
        }
        return follow_near_rule(row, hop, least);
    }

    // middle_codes: those of the row, see above.
    Hop over_middles(const std::vector<uint16_t>& row, const std::vector<float>& middle_codes) const {
        Hop hop;
        if (!is_reached()) return hop;
        int32_t least_sum = 32767;
        for (uint32_t b = 0; b < border_.size(); ++b)
            least_sum = std::min(least_sum, steps(distances_[b], least_or_middle_) + row[b]);
        for (uint32_t i = 0; i < border_.segment_count(); ++i) {
            const float code = middle_codes[i];
            if (std::isnan(middles_[i]) || std::isnan(code)) continue;
            least_sum =
                std::min(least_sum, steps(middles_[i], least_or_middle_) + static_cast<int32_t>(code));
        }
        hop.had_sum = least_sum < 32767;
        if (hop.had_sum)
            return follow_near_rule(row, hop, double{least_or_middle_} + least_sum * double{quantum_});
        const uint32_t b = first_least_way(row);
        return follow_near_rule(row, hop, b == NONE ? NOWHERE : way_over(row, b));
    }

private:
    // More than every sum where there is no distance.
    int32_t steps(float distance, float least) const {
        if (!(distance < INFINITE)) return 1 << 20;
        const float inverse = quantum_ == 0 ? 0 : 1 / quantum_;
        return static_cast<int32_t>(std::trunc(std::min((distance - least) * inverse + 0.5f, 32766.0f)));
    }

    // The distance of the source from the middle of a segment, NaN if there is none.
    float middle(uint32_t segment) const {
        if (border_.end[segment] == NONE) return NAN;
        const float at_p = distances_[border_.begin[segment]], at_q = distances_[border_.end[segment]],
                    length = border_.length[segment];
        return root(0.5f * (at_p * at_p + at_q * at_q) - 0.25f * (length * length), length);
    }

    double to_vertex(const std::vector<uint16_t>& row, uint32_t b) const {
        return row[b] == NO_PATH ? NOWHERE : row[b] * double{quantum_};
    }
    double way_over(const std::vector<uint16_t>& row, uint32_t b) const {
        return double{distances_[b]} + to_vertex(row, b);
    }
    // In single precision, as the text has it, in which more ways are of one length.
    uint32_t first_least_way(const std::vector<uint16_t>& row) const {
        float least = INFINITE;
        uint32_t first = NONE;
        for (uint32_t b = 0; b < border_.size(); ++b)
            if (const float way = distances_[b] + static_cast<float>(to_vertex(row, b)); way < least) {
                least = way;
                first = b;
            }
        return first;
    }

    // The way over a segment, straightened; infinite if there is none.
    double way_across(const std::vector<uint16_t>& row, uint32_t segment) const {
        const uint32_t p = border_.begin[segment], q = border_.end[segment];
        if (q == NONE) return NOWHERE;
        const double length{border_.length[segment]};
        const auto along = [&](double from_p, double from_q) {
            return (from_p - from_q) * (from_p + from_q) * (0.5 / length) + 0.5 * length;
        };
        const auto off = [&](double from_p, double x) { return root((from_p - x) * (from_p + x), length); };
        const double source_p{distances_[p]}, source_q{distances_[q]};
        const double target_p = to_vertex(row, p), target_q = to_vertex(row, q);
        const double xs = along(source_p, source_q), ys = off(source_p, xs);
        const double xt = along(target_p, target_q), yt = off(target_p, xt);
        if (std::isnan(xs) || std::isnan(ys) || std::isnan(xt) || std::isnan(yt)) return NOWHERE;
        const double crossing = xs * yt + xt * ys;
        if (!(0 < crossing && crossing < length * (ys + yt))) return NOWHERE;
        return std::sqrt((xs - xt) * (xs - xt) + (ys + yt) * (ys + yt));
    }

    Hop follow_near_rule(const std::vector<uint16_t>& row, Hop hop, double found) const {
        hop.distance = found;
        if (double{least_} > near_radius_ || found > near_radius_) return hop;
        double least = NOWHERE;
        for (uint32_t b = 0; b < border_.size(); ++b) least = std::min(least, way_over(row, b));
        for (uint32_t i = 0; i < border_.segment_count(); ++i) least = std::min(least, way_across(row, i));
        hop.is_near = true;
        hop.is_other = std::abs(least - found) > 1e-3 * found;
        hop.distance = least;
        return hop;
    }

    const StoredBorder& border_;
    std::vector<float> distances_; // per position
    float quantum_;
    double near_radius_ = 0;
    std::vector<float> middles_; // per segment: NaN if no middle is there
    float least_ = INFINITE, least_or_middle_ = INFINITE;
};

}
