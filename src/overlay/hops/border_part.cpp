#include "src/overlay/hops/border_part.h"

namespace geodesic {

void BorderPart::join(BorderRange range) {
    BorderRange& last = ranges_[count_ - 1];
    const uint32_t end = std::max(last.last, range.last);
    size_ += end - last.last;
    last.last = end;
}

bool BorderPart::covers(const BorderPart& other) const {
    return std::ranges::all_of(other.ranges(), [&](const BorderRange& of_other) {
        return std::ranges::any_of(ranges(), [&](const BorderRange& own) { return own.covers(of_other); });
    });
}

PartOfRing::PartOfRing(const Rings& rings, std::pmr::memory_resource* memory)
    : rings_(rings), lengths_(rings.largest_size() + Rings::PADDING, memory),
      half_inverses_(lengths_.size(), memory), is_own_copy_(lengths_.size(), memory) {}

void PartOfRing::take(const BorderPart& part) {
    if (part.ranges().size() == 1) {
        const uint32_t first = part.ranges().front().first;
        segments_ = segments_from(rings_, first);
        is_own_ = rings_.is_own.data() + first;
        return;
    }
    segments_ = {lengths_.data(), half_inverses_.data()};
    is_own_ = is_own_copy_.data();
    size_t end = 0;
    for (const BorderRange& range : part.ranges()) {
        const auto copy = [&](const auto& from, auto& to) {
            std::copy_n(from.begin() + range.first, range.size(), to.begin() + static_cast<ptrdiff_t>(end));
        };
        copy(rings_.segment_length, lengths_);
        copy(rings_.half_inverse, half_inverses_);
        copy(rings_.is_own, is_own_copy_);
        end += range.size();
        lengths_[end - 1] = half_inverses_[end - 1] = Rings::GAP;
    }
}

}
