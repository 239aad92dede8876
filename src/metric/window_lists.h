#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/metric/window.h"

namespace geodesic {

// A list of windows for every edge that has any. Memory is kept from solve to solve and given back list by
// list; forgetting all of them costs nothing.
class WindowLists {
public:
    explicit WindowLists(uint32_t edge_count) : lists_(edge_count) {}

    void clear();

    std::span<Window> at(uint32_t edge) {
        const List& list = lists_[edge];
        return list.epoch == epoch_ && list.windows ? std::span(list.windows, list.count)
                                                    : std::span<Window>();
    }
    std::span<const Window> at(uint32_t edge) const {
        const List& list = lists_[edge];
        return list.epoch == epoch_ && list.windows ? std::span<const Window>(list.windows, list.count)
                                                    : std::span<const Window>();
    }

    // Ask for memory that is soon read: where the list is, and its windows.
    void prefetch(uint32_t edge) const { __builtin_prefetch(&lists_[edge]); }
    void prefetch_windows(uint32_t edge) const { __builtin_prefetch(lists_[edge].windows); }

    // Replaces the list of an edge. The windows may not be those of the list itself.
    void assign(uint32_t edge, std::span<const Window> windows);

    // Whether a sweep is due: the lists have doubled since the latest one.
    bool crowded() const { return room_in_use_ > sweep_at_; }

    // Gives back the memory of the edges for which is_done(edge) holds: nothing more can be put into them.
    template <class Predicate>
    void sweep(Predicate is_done) {
        std::erase_if(edges_, [&](uint32_t edge) {
            if (!is_done(edge)) return false;
            close(edge);
            return true;
        });
        sweep_at_ = std::max(SMALLEST_SWEEP, 2 * room_in_use_);
    }

    bool closed(uint32_t edge) const {
        return lists_[edge].epoch == epoch_ && lists_[edge].windows == nullptr;
    }

private:
    struct List {
        Window* windows = nullptr; // NULL: closed
        uint32_t epoch = 0;
        uint32_t count = 0; // its room follows from it
    };
    struct Chunk {
        std::unique_ptr<Window[]> windows;
        uint32_t room;
    };
    static constexpr uint32_t CHUNK_ROOM = 4096;
    static constexpr uint64_t SMALLEST_SWEEP = 4096;

    void close(uint32_t edge);
    Window* take_block(uint32_t size_class);
    void give_back(const List& list);

    std::vector<List> lists_;
    std::vector<uint32_t> edges_; // that have a list
    std::vector<Chunk> chunks_;
    size_t chunk_ = 0; // the one that blocks are cut from,
    uint32_t cut_ = 0; // from this window on
    std::array<std::vector<Window*>, 48> free_blocks_;
    uint64_t room_in_use_ = 0;
    uint64_t sweep_at_ = SMALLEST_SWEEP;
    uint32_t epoch_ = 1;
};

}
