#include "src/metric/window_lists.h"

#include <algorithm>
#include <bit>

namespace geodesic {

namespace {

// Blocks have room for 2, 4, 6 .. 32 windows, then for 64, 128 and so on.
constexpr uint32_t STEP = 2, FINE_CLASSES = 16;

uint32_t size_class_of(uint32_t count) {
    if (count <= STEP * FINE_CLASSES) return (count + STEP - 1) / STEP - 1;
    return FINE_CLASSES + static_cast<uint32_t>(std::bit_width((count - 1) / (STEP * FINE_CLASSES))) - 1;
}

uint32_t room_of(uint32_t size_class) {
    if (size_class < FINE_CLASSES) return STEP * (size_class + 1);
    return STEP * FINE_CLASSES << (size_class - FINE_CLASSES + 1);
}

}

void WindowLists::clear() {
    for (auto& blocks : free_blocks_) blocks.clear();
    edges_.clear();
    chunk_ = 0;
    cut_ = 0;
    room_in_use_ = 0;
    sweep_at_ = SMALLEST_SWEEP;
    if (++epoch_ == 0) {
        for (List& list : lists_) list.epoch = 0;
        epoch_ = 1;
    }
}

Window* WindowLists::take_block(uint32_t size_class) {
    const uint32_t room = room_of(size_class);
    room_in_use_ += room;
    auto& blocks = free_blocks_[size_class];
    if (!blocks.empty()) {
        Window* block = blocks.back();
        blocks.pop_back();
        return block;
    }
    while (chunk_ < chunks_.size() && cut_ + room > chunks_[chunk_].room) {
        ++chunk_;
        cut_ = 0;
    }
    if (chunk_ == chunks_.size()) {
        const uint32_t chunk_room = std::max(room, CHUNK_ROOM);
        chunks_.push_back({std::make_unique_for_overwrite<Window[]>(chunk_room), chunk_room});
    }
    Window* block = chunks_[chunk_].windows.get() + cut_;
    cut_ += room;
    return block;
}

void WindowLists::give_back(const List& list) {
    const uint32_t size_class = size_class_of(list.count);
    room_in_use_ -= room_of(size_class);
    free_blocks_[size_class].push_back(list.windows);
}

void WindowLists::assign(uint32_t edge, std::span<const Window> windows) {
    List& list = lists_[edge];
    const auto count = static_cast<uint32_t>(windows.size());
    if (list.epoch != epoch_) {
        edges_.push_back(edge);
        list = {take_block(size_class_of(count)), epoch_, count};
    } else if (size_class_of(count) != size_class_of(list.count)) {
        give_back(list);
        list.windows = take_block(size_class_of(count));
    }
    list.count = count;
    std::ranges::copy(windows, list.windows);
}

void WindowLists::close(uint32_t edge) {
    give_back(lists_[edge]);
    lists_[edge].windows = nullptr;
}

}
