// POSI: whole coordinates, each as its difference from that of the number before, of all vertices or of those
// only that cannot be worked out again from the mesh.
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "format/bytes.h"
#include "format/checksum.h"
#include "src/base/number_text.h"
#include "src/base/numbers.h"
#include "src/file/differences.h"
#include "src/file/sections.h"
#include "src/index/positions.h"
#include "src/mesh/intake.h"

namespace geodesic {

namespace {

constexpr uint64_t BYTES_BEFORE_COORDINATES = sizeof(float) + 3 * sizeof(double) + sizeof(uint64_t);
constexpr uint64_t BYTES_EACH = 3 * sizeof(uint32_t); // of each position

uint64_t checksum_of_positions(const StoredIndex& stored) {
    std::vector<uint32_t> coordinates;
    for (const auto& position : stored.positions)
        for (const int32_t coordinate : position) coordinates.push_back(static_cast<uint32_t>(coordinate));
    format::ByteWriter bytes;
    bytes.u32_array(coordinates);
    return format::checksum(bytes.take());
}

std::vector<uint32_t> all_numbers(const StoredIndex& stored) {
    std::vector<uint32_t> numbers(stored.positions.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

// Per number, the lowest id of the caller's that has it, which is the one that the others were welded to.
// NONE for an added vertex.
std::vector<uint32_t> lowest_ids(const StoredIndex& stored) {
    std::vector<uint32_t> lowest(stored.positions.size(), NONE);
    for (size_t id = stored.number_of_id.size(); id-- > 0;)
        if (const uint32_t number = stored.number_of_id[id]; number != NONE)
            lowest[number] = static_cast<uint32_t>(id);
    return lowest;
}

std::vector<uint32_t> added_vertices(std::span<const uint32_t> id_of_number) {
    std::vector<uint32_t> added;
    for (uint32_t n = 0; n < id_of_number.size(); ++n)
        if (id_of_number[n] == NONE) added.push_back(n);
    return added;
}

// ---- To the file

std::vector<uint32_t> differences_of(const StoredIndex& stored, std::span<const uint32_t> numbers) {
    std::vector<uint32_t> differences;
    std::array<int32_t, 3> last{};
    for (const uint32_t number : numbers)
        for (size_t k = 0; k < 3; ++k)
            differences.push_back(
                folded(static_cast<uint32_t>(stored.positions[number][k]) -
                       static_cast<uint32_t>(std::exchange(last[k], stored.positions[number][k]))));
    return differences;
}

// ---- From the file

void read_grid(format::ByteReader& reader, StoredIndex& stored) {
    stored.position_step = reader.f32();
    if (!(stored.position_step > 0) || !std::isfinite(stored.position_step))
        refuse_as_corrupt("section POSI: steps of " + number_text(stored.position_step));
    for (double& coordinate : stored.position_origin) {
        coordinate = reader.f64();
        if (!std::isfinite(coordinate))
            refuse_as_corrupt("section POSI: the origin has the coordinate " + number_text(coordinate));
    }
}

void read_differences(format::ByteReader& reader, std::span<const uint32_t> numbers, StoredIndex& stored) {
    std::vector<uint32_t> differences(numbers.size() * 3);
    reader.u32_planes(differences);
    std::array<uint32_t, 3> last{};
    for (size_t i = 0; i < differences.size(); ++i) {
        last[i % 3] += unfolded(differences[i]);
        const auto coordinate = static_cast<int32_t>(last[i % 3]);
        if (coordinate < 0 || coordinate > MOST_STEPS)
            refuse_as_corrupt("section POSI: a coordinate of " + std::to_string(coordinate) + " steps");
        stored.positions[numbers[i / 3]][i % 3] = coordinate;
    }
}

void take_from_mesh(const geoidx_mesh& mesh, std::span<const uint32_t> id_of_number, uint64_t checksum,
                    StoredIndex& stored) {
    const auto positions = positions_of(mesh);
    for (size_t n = 0; n < id_of_number.size(); ++n)
        if (id_of_number[n] != NONE) stored.positions[n] = in_steps(positions[id_of_number[n]], stored);
    if (checksum_of_positions(stored) != checksum)
        throw Error(GEOIDX_ERROR_MESH_MISMATCH,
                    "the file holds no positions, and those of the mesh differ from the index's by less than "
                    "a float can tell: they must be given in the precision that the index was built with");
}

// Reads the positions of the added vertices, and takes all others from the mesh.
void read_without_positions(format::ByteReader& reader, const ReadOptions& options, uint64_t checksum,
                            StoredIndex& stored) {
    stored.description.file_flags = GEOIDX_SAVE_NO_POSITIONS;
    const auto id_of_number = lowest_ids(stored);
    const auto added = added_vertices(id_of_number);
    if (reader.remaining() != added.size() * BYTES_EACH)
        refuse_as_corrupt("section POSI does not hold the positions of " + std::to_string(added.size()) +
                          " added vertices");
    read_differences(reader, added, stored);
    if (options.mesh) return take_from_mesh(*options.mesh, id_of_number, checksum, stored);
    if (!options.may_lack_positions)
        refuse_argument(
            "the file holds no positions, so that it opens only with the mesh that it was built from, "
            "as expected_mesh");
}

}

void write_positions(const StoredIndex& stored, format::ContainerWriter& writer) {
    const bool all = !(stored.description.file_flags & GEOIDX_SAVE_NO_POSITIONS);
    format::ByteWriter bytes;
    bytes.f32(stored.position_step);
    for (const double coordinate : stored.position_origin) bytes.f64(coordinate);
    bytes.u64(checksum_of_positions(stored));
    bytes.u32_planes(differences_of(stored, all ? all_numbers(stored) : added_vertices(lowest_ids(stored))));
    writer.add_bytes(TAG_POSITIONS, bytes.take());
}

void read_positions(const format::Container& container, uint32_t count, const ReadOptions& options,
                    StoredIndex& stored) {
    const uint64_t whole_size = BYTES_BEFORE_COORDINATES + uint64_t{count} * BYTES_EACH;
    const auto bytes = container.read_bytes(TAG_POSITIONS, whole_size);
    format::ByteReader reader(bytes, "section POSI");
    read_grid(reader, stored);
    const uint64_t checksum = reader.u64();
    const uint64_t held = reader.remaining() / BYTES_EACH;
    if (held + stored.number_of_id.size() < count)
        refuse_as_corrupt("section POSI holds " + std::to_string(held) + " positions of " +
                          std::to_string(count) + " vertices, of which no more than " +
                          std::to_string(stored.number_of_id.size()) + " have ids");
    stored.positions.resize(count);
    if (bytes.size() != whole_size) return read_without_positions(reader, options, checksum, stored);
    read_differences(reader, all_numbers(stored), stored);
    if (checksum_of_positions(stored) != checksum)
        refuse_as_corrupt("section POSI: the checksum of the positions does not match");
}

}
