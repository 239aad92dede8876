#include "src/path/slide.h"

#include <algorithm>
#include <cmath>

namespace geodesic {

namespace {

using Eigen::Vector3d;

// Points on rails, the portals; a portal that is a vertex has a rail of length 0. Smoothed, a piece is as
// long as if its ends were apart by `smoothing` in a direction of their own, so that its length has
// derivatives where both ends meet.
class Sliding {
public:
    Sliding(const Surface& surface, const Strip& strip, const std::vector<double>& shares);

    void run();
    double length() const { return length_of_points(shares_, 0); }
    std::vector<double> shares() && { return std::move(shares_); }

private:
    struct Rail {
        Vector3d begin, along;
    };

    Vector3d at(const std::vector<double>& shares, size_t i) const {
        return rails_[i].begin + shares[i] * rails_[i].along;
    }
    double length_of_points(const std::vector<double>& shares, double smoothing) const;
    void differentiate(double smoothing);
    bool is_held(size_t i) const;
    void solve();
    bool step(double smoothing, double share_of_length);
    void snap();

    std::vector<Rail> rails_;
    Vector3d source_, target_;
    std::vector<double> cost_; // per piece
    std::vector<double> shares_;
    // Derivatives of the smoothed length, of which the matrix of second ones is tridiagonal, and the Newton
    // step. solve() eliminates in place.
    std::vector<double> first_, diagonal_, beside_, step_;
};

Sliding::Sliding(const Surface& surface, const Strip& strip, const std::vector<double>& shares)
    : source_(position_of(surface, strip.source)), target_(position_of(surface, strip.target)),
      shares_(shares) {
    for (const auto& [a, b] : strip.portals)
        rails_.push_back({surface.positions[a], surface.positions[b] - surface.positions[a]});
    for (const uint32_t face : strip.faces) cost_.push_back(surface.costs.of_face[face]);
    first_.resize(rails_.size());
    diagonal_.resize(rails_.size());
    beside_.resize(rails_.size());
    step_.resize(rails_.size());
}

double Sliding::length_of_points(const std::vector<double>& shares, double smoothing) const {
    double length = 0;
    Vector3d last = source_;
    for (size_t i = 0; i <= rails_.size(); ++i) {
        const Vector3d next = i < rails_.size() ? at(shares, i) : target_;
        length += cost_[i] * std::sqrt((next - last).squaredNorm() + smoothing * smoothing);
        last = next;
    }
    return length;
}

// Piece by piece, each of which depends on the points at its two ends.
void Sliding::differentiate(double smoothing) {
    std::ranges::fill(first_, 0);
    std::ranges::fill(diagonal_, 0);
    std::ranges::fill(beside_, 0);
    Vector3d last = source_;
    for (size_t i = 0; i <= rails_.size(); ++i) {
        const Vector3d next = i < rails_.size() ? at(shares_, i) : target_;
        const Vector3d piece = next - last;
        const double length = std::sqrt(piece.squaredNorm() + smoothing * smoothing);
        const Vector3d direction = piece / length;
        const double bend = cost_[i] / length;
        const double begin = i > 0 ? direction.dot(rails_[i - 1].along) : 0;
        const double end = i < rails_.size() ? direction.dot(rails_[i].along) : 0;
        if (i > 0) {
            first_[i - 1] -= cost_[i] * begin;
            diagonal_[i - 1] += bend * (rails_[i - 1].along.squaredNorm() - begin * begin);
        }
        if (i < rails_.size()) {
            first_[i] += cost_[i] * end;
            diagonal_[i] += bend * (rails_[i].along.squaredNorm() - end * end);
        }
        if (i > 0 && i < rails_.size())
            beside_[i - 1] = -bend * (rails_[i - 1].along.dot(rails_[i].along) - begin * end);
        last = next;
    }
}

// At an end of its rail, and the path would be shorter beyond.
bool Sliding::is_held(size_t i) const {
    return rails_[i].along.isZero(0) || (shares_[i] == 0 && first_[i] > 0) ||
           (shares_[i] == 1 && first_[i] < 0);
}

// The Newton step of the points that are not held: elimination down and substitution up.
void Sliding::solve() {
    // Such a share of a diagonal entry is added to it, and of the cost times the rail, since the entry is 0
    // where both pieces run along the rail.
    constexpr double LEAST = 1e-10;
    double before = 0, pivot = 1, right = 0; // of the last row: its entry beside the diagonal, and the rest
    for (size_t i = 0; i < rails_.size(); ++i) {
        const bool held = is_held(i);
        const double coupling = held ? 0 : before;
        const double factor = coupling / pivot;
        const double of_rail = std::max(cost_[i], cost_[i + 1]) * rails_[i].along.norm();
        const double own = held ? 1 : diagonal_[i] * (1 + LEAST) + of_rail * LEAST;
        right = (held ? 0 : -first_[i]) - factor * right;
        pivot = std::max(own - factor * coupling, own * LEAST);
        const bool next_held = i + 1 == rails_.size() || is_held(i + 1);
        before = held || next_held ? 0 : beside_[i];
        diagonal_[i] = pivot;
        beside_[i] = before;
        step_[i] = right;
    }
    for (size_t i = rails_.size(); i-- > 0;) {
        const double next = i + 1 < rails_.size() ? beside_[i] * step_[i + 1] : 0;
        step_[i] = (step_[i] - next) / diagonal_[i];
    }
}

// One step as far as it makes the smoothed length shorter. Returns whether it did by at least this share.
bool Sliding::step(double smoothing, double share_of_length) {
    constexpr int MOST_HALVINGS = 30;
    differentiate(smoothing);
    solve();
    const double before = length_of_points(shares_, smoothing);
    std::vector<double> moved(shares_.size());
    double share = 1;
    for (int i = 0; i < MOST_HALVINGS; ++i, share /= 2) {
        for (size_t k = 0; k < moved.size(); ++k)
            moved[k] = std::clamp(shares_[k] + share * step_[k], 0.0, 1.0);
        const double after = length_of_points(moved, smoothing);
        if (!(after < before)) continue;
        shares_.swap(moved);
        return after < before * (1 - share_of_length);
    }
    return false;
}

// Points that are at the end of their rail but for what the smoothing left are put there.
void Sliding::snap() {
    constexpr double CLOSE = 1e-6, SAME = 1e-12;
    std::vector<double> snapped = shares_;
    for (double& share : snapped) share = share < CLOSE ? 0 : share > 1 - CLOSE ? 1 : share;
    if (length_of_points(snapped, 0) <= length() * (1 + SAME)) shares_ = std::move(snapped);
}

void Sliding::run() {
    constexpr int MOST_STEPS = 40;
    constexpr double ENOUGH = 1e-4; // of the smoothing: less than this share of the length is no gain
    double costs = 0;
    for (const double cost : cost_) costs += cost;
    const double mean_piece = length() / costs;
    if (!(mean_piece > 0)) return;
    for (const double smoothing : {1e-2, 1e-4, 1e-7})
        for (int i = 0; i < MOST_STEPS && step(smoothing * mean_piece, smoothing * ENOUGH); ++i) {
        }
    snap();
}

}

double weighted_length(const Surface& surface, const Strip& strip, const std::vector<double>& shares) {
    return Sliding(surface, strip, shares).length();
}

void slide(const Surface& surface, const Strip& strip, StripPath& path) {
    Sliding sliding(surface, strip, path.shares);
    const double before = sliding.length();
    path.length = before;
    if (path.shares.empty()) return;
    sliding.run();
    if (const double after = sliding.length(); after < before) path = {std::move(sliding).shares(), after};
}

}
