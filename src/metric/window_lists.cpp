#include "src/metric/window_lists.h"

#include <algorithm>

namespace geodesic {

void WindowLists::clear() {
    pool_.clear();
    for (auto& blocks : free_blocks_) blocks.clear();
    if (++epoch_ == 0) {
        for (List& list : lists_) list.epoch = 0;
        epoch_ = 1;
    }
}

uint32_t WindowLists::take_block(uint32_t size_class) {
    auto& blocks = free_blocks_[size_class];
    if (!blocks.empty()) {
        const uint32_t first = blocks.back();
        blocks.pop_back();
        return first;
    }
    const auto first = static_cast<uint32_t>(pool_.size());
    pool_.resize(pool_.size() + (FIRST_ROOM << size_class));
    return first;
}

WindowLists::List& WindowLists::list_at(uint32_t edge) {
    List& list = lists_[edge];
    if (list.epoch != epoch_) list = {epoch_, take_block(0), 0, 0};
    return list;
}

// Windows [begin, end) of the list give way to the replacement.
void WindowLists::replace(List& list, uint32_t begin, uint32_t end, std::span<const Window> replacement) {
    const auto added = static_cast<uint32_t>(replacement.size());
    const uint32_t count = list.count - (end - begin) + added;
    if (count > FIRST_ROOM << list.size_class) {
        uint32_t size_class = list.size_class;
        while (count > FIRST_ROOM << size_class) ++size_class;
        const uint32_t first = take_block(size_class);
        std::copy_n(pool_.begin() + list.first, list.count, pool_.begin() + first);
        free_blocks_[list.size_class].push_back(list.first);
        list.first = first;
        list.size_class = size_class;
    }
    Window* windows = pool_.data() + list.first;
    if (begin + added < end)
        std::copy(windows + end, windows + list.count, windows + begin + added);
    else if (begin + added > end)
        std::copy_backward(windows + end, windows + list.count, windows + count);
    std::copy(replacement.begin(), replacement.end(), windows + begin);
    list.count = count;
}

// Appends a part of a window to the merged run, joined to the part before it where it goes on.
void WindowLists::emit(const Window& window, double begin, double end) {
    const bool continues = !merged_.empty() && merged_.back().end == begin && merged_.back().x == window.x &&
                           merged_.back().y == window.y && merged_.back().sigma == window.sigma &&
                           merged_.back().from_face == window.from_face &&
                           merged_.back().pending == window.pending;
    if (continues) {
        merged_.back().end = end;
        merged_.back().end_distance = end == window.end ? window.end_distance : window.distance_at(end);
    } else if (end > begin) {
        Window part = window;
        part.begin = begin;
        part.end = end;
        if (begin != window.begin) part.begin_distance = window.distance_at(begin);
        if (end != window.end) part.end_distance = window.distance_at(end);
        merged_.push_back(part);
    } else {
        return;
    }
    if (&window == challenger_) lowest_ = std::min(lowest_, merged_.back().smallest_distance());
}

// Appends what is left of the holder, and of the challenger on the holder's interval.
void WindowLists::challenge(const Window& challenger, const Window& holder) {
    const double s = std::max(challenger.begin, holder.begin);
    const double t = std::min(challenger.end, holder.end);
    const Advantage won = advantage(challenger, holder, s, t);
    if (won.inside_out) {
        emit(holder, holder.begin, s);
        emit(challenger, s, won.begin);
        emit(holder, won.begin, won.end);
        emit(challenger, won.end, t);
        emit(holder, t, holder.end);
    } else if (won.begin < won.end) {
        emit(holder, holder.begin, won.begin);
        emit(challenger, won.begin, won.end);
        emit(holder, won.end, holder.end);
    } else {
        emit(holder, holder.begin, holder.end);
    }
}

double WindowLists::insert(uint32_t edge, const Window& window) {
    List& list = list_at(edge);
    const Window* windows = pool_.data() + list.first;
    uint32_t begin = 0;
    while (begin < list.count && windows[begin].end <= window.begin) ++begin;
    uint32_t end = begin;
    while (end < list.count && windows[end].begin < window.end) ++end;

    merged_.clear();
    challenger_ = &window;
    lowest_ = std::numeric_limits<double>::infinity();
    double covered = window.begin;
    for (uint32_t i = begin; i < end; ++i) {
        if (windows[i].begin > covered) emit(window, covered, windows[i].begin);
        challenge(window, windows[i]);
        covered = windows[i].end;
    }
    if (window.end > covered) emit(window, covered, window.end);
    if (lowest_ < std::numeric_limits<double>::infinity()) replace(list, begin, end, merged_);
    return lowest_;
}

}
