#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "src/metric/window.h"

namespace geodesic {

// The lower envelope of the windows on every edge: per edge a list sorted along it, without overlaps. Memory
// is kept from solve to solve; forgetting all lists costs nothing.
class WindowLists {
public:
    explicit WindowLists(uint32_t edge_count) : lists_(edge_count) {}

    void clear();

    std::span<Window> at(uint32_t edge) {
        const List& list = lists_[edge];
        return list.epoch == epoch_ ? std::span(pool_.data() + list.first, list.count) : std::span<Window>();
    }

    // Puts the parts of a window where it is the lowest into the edge's list and returns the smallest
    // distance on them; infinity if there are none.
    double insert(uint32_t edge, const Window& window);

private:
    struct List {
        uint32_t epoch = 0;
        uint32_t first = 0;
        uint32_t count = 0;
        uint32_t size_class = 0; // room for FIRST_ROOM << size_class windows
    };
    static constexpr uint32_t FIRST_ROOM = 4;

    List& list_at(uint32_t edge);
    void replace(List& list, uint32_t begin, uint32_t end, std::span<const Window> replacement);
    uint32_t take_block(uint32_t size_class);
    void challenge(const Window& challenger, const Window& holder);
    void emit(const Window& window, double begin, double end);

    std::vector<List> lists_;
    std::vector<Window> pool_;
    std::array<std::vector<uint32_t>, 28> free_blocks_;
    std::vector<Window> merged_; // of one insertion
    const Window* challenger_ = nullptr;
    double lowest_ = std::numeric_limits<double>::infinity();
    uint32_t epoch_ = 1;
};

}
