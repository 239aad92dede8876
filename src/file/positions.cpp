// POSI: whole coordinates, each as its difference from that of the number before.
#include <cmath>
#include <string>
#include <utility>

#include "format/bytes.h"
#include "src/file/sections.h"

namespace geodesic {

namespace {

// Small differences of either sign are small numbers: 0, -1, 1, -2, 2 are 0, 1, 2, 3, 4.
uint32_t folded(uint32_t difference) { return difference << 1 ^ (difference >> 31 ? UINT32_MAX : 0); }
uint32_t unfolded(uint32_t number) { return number >> 1 ^ (number & 1 ? UINT32_MAX : 0); }

}

void write_positions(const StoredIndex& stored, format::ContainerWriter& writer) {
    std::vector<uint32_t> differences;
    std::array<int32_t, 3> last{};
    for (const auto& position : stored.positions)
        for (size_t k = 0; k < 3; ++k)
            differences.push_back(folded(static_cast<uint32_t>(position[k]) -
                                         static_cast<uint32_t>(std::exchange(last[k], position[k]))));
    format::ByteWriter bytes;
    bytes.f32(stored.position_step);
    bytes.u32_planes(differences);
    writer.add_bytes(TAG_POSITIONS, bytes.take());
}

void read_positions(const format::Container& container, StoredIndex& stored) {
    const uint64_t size = sizeof(float) + stored.positions.size() * 3 * sizeof(uint32_t);
    const auto bytes = container.read_bytes(TAG_POSITIONS, size);
    format::ByteReader reader(bytes, "section POSI");
    stored.position_step = reader.f32();
    if (!(stored.position_step >= 0) || !std::isfinite(stored.position_step))
        refuse_as_corrupt("section POSI: steps of " + std::to_string(stored.position_step));
    if (bytes.size() != size)
        refuse_as_corrupt("section POSI does not hold " + std::to_string(stored.positions.size()) +
                          " positions");
    std::vector<uint32_t> differences(stored.positions.size() * 3);
    reader.u32_planes(differences);
    std::array<uint32_t, 3> last{};
    for (size_t i = 0; i < differences.size(); ++i) {
        last[i % 3] += unfolded(differences[i]);
        const auto coordinate = static_cast<int32_t>(last[i % 3]);
        if (coordinate < -MOST_STEPS || coordinate > MOST_STEPS)
            refuse_as_corrupt("section POSI: a coordinate of " + std::to_string(coordinate) + " steps");
        stored.positions[i / 3][i % 3] = coordinate;
    }
}

}
