#include "src/path/funnel.h"

#include <algorithm>
#include <cmath>

#include "src/base/numbers.h"

namespace geodesic {

using Eigen::Vector2d;

void Funnel::begin(const Vector2d& source, size_t count) {
    if (points_.size() < count + 1) points_.resize(count + 1);
    if (chain_.size() < 2 * count + 1) chain_.resize(2 * count + 1);
    left_ = apex_ = right_ = count;
    count_ = 0;
    farthest_ = 0;
    reach(source);
    chain_[apex_] = add(source, NONE, 0, 0);
}

// What the way there passes no more leaves the chain of its side; where that is all of it, the apex may move
// along the other chain.
uint32_t Funnel::add_left(const Vector2d& at, uint32_t vertex, uint32_t gate) {
    reach(at);
    while (left_ < apex_ && turn(chain_[left_ + 1], chain_[left_], at) <= 0) ++left_;
    while (left_ == apex_ && apex_ < right_ && turn(chain_[apex_], chain_[apex_ + 1], at) < 0)
        left_ = ++apex_;
    const uint32_t added = add(at, vertex, gate, chain_[left_]);
    return chain_[--left_] = added;
}

uint32_t Funnel::add_right(const Vector2d& at, uint32_t vertex, uint32_t gate) {
    reach(at);
    while (right_ > apex_ && turn(chain_[right_ - 1], chain_[right_], at) >= 0) --right_;
    while (right_ == apex_ && apex_ > left_ && turn(chain_[apex_], chain_[apex_ - 1], at) > 0)
        right_ = --apex_;
    const uint32_t added = add(at, vertex, gate, chain_[right_]);
    return chain_[++right_] = added;
}

// Over 0 if the way from `first` over `second` to a position turns left, and 0 where it is straight but for
// the rounding of positions, as within a needle.
inline double Funnel::turn(uint32_t first, uint32_t second, const Vector2d& at) const {
    const Vector2d &begin = points_[first].at, way = points_[second].at - begin, on = at - begin;
    const double turn = way.x() * on.y() - way.y() * on.x();
    return std::abs(turn) > most_rounding_ ? turn : turn_or_rounding(turn, way, on);
}

double Funnel::turn_or_rounding(double turn, const Vector2d& way, const Vector2d& on) const {
    return std::abs(turn) <= ROUNDING * farthest_ * (way.lpNorm<1>() + on.lpNorm<1>()) ? 0 : turn;
}

// No way between two positions is longer than twice farthest_, so that turn_or_rounding() compares a turn
// with 4 * ROUNDING * farthest_^2 at most: a larger one is none of rounding. 4.1 leaves room for the rounding
// of this product.
inline void Funnel::reach(const Vector2d& at) {
    farthest_ = std::max(farthest_, at.lpNorm<1>());
    most_rounding_ = 4.1 * ROUNDING * farthest_ * farthest_;
}

inline uint32_t Funnel::add(const Vector2d& at, uint32_t vertex, uint32_t gate, uint32_t before) {
    points_[count_] = {at, vertex, gate, before};
    return count_++;
}

}
