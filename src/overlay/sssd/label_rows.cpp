#include "src/overlay/sssd/label_rows.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace geodesic {

namespace {

// At most one of so many segments of a border is long.
constexpr size_t SEGMENTS_FOR_A_LONG_ONE = 16;

// The longest of the others spans so many steps. Distances that are not exact differ by a few more, which
// still fit: a byte holds up to MOST_OF_BYTE.
constexpr float STEPS_OF_LONGEST = 124;
constexpr int MOST_OF_BYTE = 127;

// The length up to which segments of a border are not long; 0 if it has none.
float longest_of_short_segments(const Rings& rings, uint32_t patch) {
    std::vector<float> lengths;
    for_each_segment(rings, patch, [&](uint32_t, float length) { lengths.push_back(length); });
    if (lengths.empty()) return 0;
    const auto longest = lengths.end() - 1 - static_cast<ptrdiff_t>(lengths.size() / SEGMENTS_FOR_A_LONG_ONE);
    std::ranges::nth_element(lengths, longest);
    return *longest;
}

// Calls use(run, begin, end) for each run of a ring with so many places.
template <class Use>
void for_each_run(std::span<const uint16_t> runs, size_t places, const Use& use) {
    for (size_t run = 0; run < runs.size(); ++run)
        use(run, size_t{runs[run]}, run + 1 < runs.size() ? size_t{runs[run + 1]} : places);
}

// The steps from each code to the next one, if all of them fit into bytes. Returns whether they do.
bool take_steps(std::span<const uint16_t> codes, uint8_t* steps) {
    uint16_t largest = 0; // of the steps, with MOST_OF_BYTE more
    for (size_t i = 1; i < codes.size(); ++i) {
        const auto step = static_cast<uint16_t>(codes[i] - codes[i - 1]);
        largest = std::max(largest, static_cast<uint16_t>(step + MOST_OF_BYTE));
        steps[i] = static_cast<uint8_t>(step);
    }
    return largest <= 2 * MOST_OF_BYTE;
}

void take_steps_that_fit(std::span<const uint16_t> codes, uint8_t* steps) {
    int code = codes[0];
    for (size_t i = 1; i < codes.size(); ++i) {
        const int step = std::clamp(codes[i] - code, -MOST_OF_BYTE, MOST_OF_BYTE);
        steps[i] = static_cast<uint8_t>(step);
        code += step;
    }
}

using EightSteps [[gnu::vector_size(8)]] = int8_t;
using EightSums [[gnu::vector_size(16)]] = uint16_t;

// The sum of each lane and all lanes before it.
void add_up(EightSums& lanes) {
    const EightSums none{};
    lanes += __builtin_shufflevector(none, lanes, 0, 8, 9, 10, 11, 12, 13, 14);
    lanes += __builtin_shufflevector(none, lanes, 0, 0, 8, 9, 10, 11, 12, 13);
    lanes += __builtin_shufflevector(none, lanes, 0, 0, 0, 0, 8, 9, 10, 11);
}

}

float find_runs(const Rings& rings, uint32_t patch, Array<uint16_t>& runs) {
    const uint32_t ring = rings.begin[patch];
    const float longest = longest_of_short_segments(rings, patch);
    for (const auto& [first, last, is_closed] : rings.chains_of(patch)) {
        runs.push_back(static_cast<uint16_t>(first - Rings::REACH - ring));
        for (uint32_t place = first - Rings::REACH; place < last + Rings::REACH; ++place)
            if (rings.segment_length[place] > longest)
                runs.push_back(static_cast<uint16_t>(place + 1 - ring));
    }
    for_each_bridge(rings, patch, [&](uint32_t place, float length) {
        runs.push_back(static_cast<uint16_t>(place - ring));
        if (length > longest) runs.push_back(static_cast<uint16_t>(place + 1 - ring));
    });
    return longest / STEPS_OF_LONGEST;
}

void write_label_row(std::span<const uint16_t> codes, std::span<const uint16_t> runs, uint8_t* row) {
    if (runs.size() == codes.size()) {
        std::memcpy(row, codes.data(), codes.size_bytes());
        return;
    }
    uint8_t* const steps = row + runs.size_bytes();
    for_each_run(runs, codes.size(), [&](size_t run, size_t first, size_t end) {
        const auto of_run = codes.subspan(first, end - first);
        const bool has_unreached = std::ranges::count(of_run, TableCode::UNREACHED) > 0;
        const uint16_t code = has_unreached ? TableCode::UNREACHED : of_run.front();
        std::memcpy(row + run * sizeof code, &code, sizeof code);
        steps[first] = 0;
        if (has_unreached)
            std::fill(steps + first, steps + end, uint8_t{0});
        else if (!take_steps(of_run, steps + first))
            take_steps_that_fit(of_run, steps + first);
    });
}

void read_label_row(const uint8_t* row, std::span<const uint16_t> runs, size_t places, uint16_t* codes) {
    if (runs.size() == places) {
        std::memcpy(codes, row, runs.size_bytes());
        return;
    }
    const uint8_t* const steps = row + runs.size_bytes();
    for_each_run(runs, places, [&](size_t run, size_t first, size_t end) {
        uint16_t code;
        std::memcpy(&code, row + run * sizeof code, sizeof code);
        for (size_t place = first; place < end; place += 8) {
            EightSteps eight;
            std::memcpy(&eight, steps + place, sizeof eight);
            EightSums sums = __builtin_convertvector(eight, EightSums);
            add_up(sums);
            sums += code;
            std::memcpy(codes + place, &sums, sizeof sums);
            code = sums[7];
        }
    });
}

}
