#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "src/overlay/border_field.h"
#include "src/overlay/tables.h"

namespace geodesic {

// Single source, single destination on overlay tables: up from both ends to the children of the lowest patch
// that has them both, and across. Labels and samples of all borders tell a few ways; then each of these is
// measured over all vertices near it. Vertices are given by their numbers, places are counted over all rings.
class OverlaySssd {
public:
    OverlaySssd(const OverlayIndex& index, std::pmr::memory_resource* memory);

    // Symmetric bit for bit if low < high.
    float distance(uint32_t low, uint32_t high);

    // From a source whose distances to the borders of all patches down to prepared_level() are known, by
    // number, as OverlaySsad::sweep_borders() gives them.
    float distance_from(uint32_t source, std::span<const float> known, uint32_t target);
    uint32_t prepared_level() const { return prepared_level_; }

private:
    // The places that a way may cross a border at, from `first` to `last`, repetitions of vertices too.
    struct Window {
        uint32_t first, last;
        uint32_t size() const { return last - first + 1; }
        bool covers(const Window& other) const { return first <= other.first && other.last <= last; }
    };

    // Consecutive places of a coarse ring, counted in it; none at first.
    struct Samples {
        uint32_t first = std::numeric_limits<uint32_t>::max(), last = 0;
        bool are_none() const { return first > last; }
        void add(uint32_t place) {
            first = std::min(first, place);
            last = std::max(last, place);
        }
    };

    // A border around a vertex, up to that of a child of the patch where both ends meet.
    struct Border {
        uint32_t patch;
        Window window; // where the way at hand crosses it, and around
        Window traced; // of trace()
    };
    struct End {
        explicit End(std::pmr::memory_resource* memory)
            : borders(memory), distance(memory), first_code(memory), window_distance(memory) {}
        uint32_t vertex = 0;
        Array<Border> borders;
        Array<float> distance;     // of the last border's samples
        Array<int16_t> first_code; // of the first border's samples
        bool is_first_encoded = false;
        Array<float> window_distance; // of each border's window; those of the first `crossed` are known
        size_t crossed = 0;
        bool is_near = false; // to the other end: borders are straightened over any segment
    };

    float distance_on_border(uint32_t border_vertex, uint32_t patch, uint32_t vertex) const;
    float distance_over(uint32_t patch, std::span<const float> known, uint32_t target) const;

    // How the other end is seen from the border where `to` waits: one that climbed, too, or a vertex whose
    // distances are known there.
    struct FromEnd;
    template <class OfPlace>
    struct FromVertex;
    template <class From>
    float meet(const From& from, End& to);
    uint32_t place_beside(std::span<const float> from_distance, const End& to) const;
    template <class From>
    float measure_over(const From& from, End& to, uint32_t place);
    template <class From>
    float measure(const From& from, End& to);

    // Over samples.
    void climb(uint32_t vertex, uint32_t top, End& end);
    struct Label {
        uint32_t nearest;
        float quantum;
        const int16_t* codes; // per position in the border, or per sample
        bool is_whole;

        float distance(uint32_t i) const {
            const auto steps = static_cast<uint32_t>(codes[i] - SourceCode::NEAREST);
            return codes[i] == SourceCode::UNREACHED ? INFINITE
                                                     : static_cast<float>(nearest + steps) * quantum;
        }
    };
    Label label_of(uint32_t vertex, uint32_t patch) const;
    Samples samples_within(const End& end, float reach) const;
    void cross_samples(const End& end, uint32_t sibling, std::span<float> out);
    bool trace(End& end, Samples samples);
    bool trace_near(End& end, float reach);
    Samples samples_before(End& end, size_t b, Samples samples);
    void encode_first(End& end);
    void spread(const Label& label, uint32_t patch, std::span<int16_t> out) const;
    const uint16_t* coarse_row(uint32_t patch, uint32_t row) const;
    Samples range_of(std::span<const uint16_t> winners) const;

    // Over windows.
    std::span<float> window_distances(End& end, size_t b) const;
    Window window_of(uint32_t patch, Samples samples) const;
    void prefetch_window(const End& end, size_t b) const;
    void climb_windows(End& end);
    void read_first_window(End& end);
    template <class OverlayPosition>
    void cross_window(End& end, size_t b, Window to, const OverlayPosition& overlay_position,
                      std::span<float> out);

    auto distances_from(uint32_t vertex) const;
    uint32_t position_at(uint32_t place) const { return index_.rings.position[place]; }
    uint32_t overlay_position_at(uint32_t patch, uint32_t place) const {
        return numbering_.overlay_position[numbering_.border_begin[patch] + position_at(place)];
    }

    const OverlayIndex& index_;
    const Numbering& numbering_;
    const uint32_t prepared_level_;
    BorderField field_;
    Array<const uint16_t*> rows_; // of the hop at hand
    End from_, to_;
    // Of a border that a way is traced over: codes of its samples, the winners of the rows.
    Array<int16_t> code_;
    Array<uint16_t> traced_;
    Array<float> samples_of_first_; // of encode_first()
    Array<int16_t> code_of_first_;
    // At the border where they meet.
    Array<float> samples_;     // distances from the other end
    Array<uint16_t> winners_;  // the places, in the other end's coarse ring, that the ways to these come over
    Array<float> from_window_; // distances from the other end, of the window
};

}
