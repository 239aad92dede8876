// MESH: the mesh bit for bit, as differences of numbers that follow each other in the caller's arrays, which
// are small where neighbours have been numbered one after the other.
#include "src/file/kept_mesh.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "format/bytes.h"
#include "src/base/numbers.h"
#include "src/file/differences.h"
#include "src/file/sections.h"

namespace geodesic {

namespace {

// Each number is stored as its difference from one that is so many before it: ids from the last one, and
// coordinates from the same coordinate of the last position.
constexpr size_t ONE_BACK = 1, THREE_BACK = 3;

template <class T>
void take_differences(std::vector<T>& numbers, size_t back) {
    for (size_t i = numbers.size(); i-- > 0;)
        numbers[i] = folded<T>(i < back ? numbers[i] : numbers[i] - numbers[i - back]);
}

template <class T>
void add_differences(std::vector<T>& numbers, size_t back) {
    for (size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = unfolded(numbers[i]) + (i < back ? T{0} : numbers[i - back]);
}

uint64_t mesh_raw_size(const Description& about, uint32_t position_type) {
    const uint64_t scalar = position_type == GEOIDX_POSITION_DOUBLE ? sizeof(double) : sizeof(float);
    return sizeof(uint32_t) + 3 * sizeof(uint32_t) * about.triangle_count + 3 * scalar * about.id_count;
}

// The bits of each coordinate.
template <class Bits>
std::vector<Bits> coordinates_of(const geoidx_mesh& mesh) {
    const size_t stride = position_stride(mesh);
    const auto* const bytes = static_cast<const std::byte*>(mesh.positions);
    std::vector<Bits> coordinates(3 * mesh.vertex_count);
    for (size_t i = 0; i < mesh.vertex_count; ++i)
        std::memcpy(coordinates.data() + 3 * i, bytes + i * stride, 3 * sizeof(Bits));
    return coordinates;
}

// The arrays of a mesh. Of the coordinates' bits, those of its precision are there.
struct MeshArrays {
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> floats;
    std::vector<uint64_t> doubles;

    geoidx_mesh view() const {
        geoidx_mesh mesh;
        geoidx_mesh_init(&mesh);
        const bool is_double = floats.empty();
        mesh.position_type = is_double ? GEOIDX_POSITION_DOUBLE : GEOIDX_POSITION_FLOAT;
        mesh.positions = is_double ? static_cast<const void*>(doubles.data()) : floats.data();
        mesh.vertex_count = (is_double ? doubles.size() : floats.size()) / 3;
        mesh.triangles = triangles.data();
        mesh.triangle_count = triangles.size() / 3;
        return mesh;
    }
};

MeshArrays read_arrays(const format::StoredBytes& packed, const Description& about) {
    const auto bytes = format::unpack_bytes(packed, TAG_MESH);
    format::ByteReader reader(bytes, "section MESH");
    const uint32_t position_type = reader.u32();
    if (position_type > GEOIDX_POSITION_DOUBLE || bytes.size() != mesh_raw_size(about, position_type))
        refuse_as_corrupt("section MESH: positions of type " + std::to_string(position_type) + " in " +
                          std::to_string(bytes.size()) + " bytes");
    MeshArrays arrays;
    arrays.triangles.resize(3 * about.triangle_count);
    reader.u32_planes(arrays.triangles);
    add_differences(arrays.triangles, ONE_BACK);
    if (position_type == GEOIDX_POSITION_DOUBLE) {
        arrays.doubles.resize(3 * about.id_count);
        reader.u64_planes(arrays.doubles);
        add_differences(arrays.doubles, THREE_BACK);
    } else {
        arrays.floats.resize(3 * about.id_count);
        reader.u32_planes(arrays.floats);
        add_differences(arrays.floats, THREE_BACK);
    }
    return arrays;
}

// As take_in_welded() needs it: the first id with the same number, and for those without a number, which no
// triangle uses, the first of these.
std::vector<uint32_t> representatives(std::span<const uint32_t> number_of_id) {
    uint32_t numbers = 0, first_unused = NONE;
    for (const uint32_t number : number_of_id)
        if (number != NONE) numbers = std::max(numbers, number + 1);
    std::vector<uint32_t> first_of_number(numbers, NONE), result(number_of_id.size());
    for (uint32_t id = 0; id < result.size(); ++id) {
        const uint32_t number = number_of_id[id];
        uint32_t& first = number == NONE ? first_unused : first_of_number[number];
        if (first == NONE) first = id;
        result[id] = first;
    }
    return result;
}

void require_described(const Description& about, std::span<const uint32_t> number_of_id,
                       const Intake& intake) {
    if (intake.fingerprint != about.mesh_fingerprint)
        refuse_as_corrupt("section MESH: the mesh has another fingerprint than the header states");
    for (size_t id = 0; id < number_of_id.size(); ++id)
        if ((intake.vertex_of_id[id] == NONE) != (number_of_id[id] == NONE))
            refuse_as_corrupt("section MESH: vertex " + std::to_string(id) +
                              (number_of_id[id] == NONE ? " is used by a triangle, but has no number in VERT"
                                                        : " is used by no triangle that is not degenerate"));
}

// A mesh that cannot be used is one that no index was built from.
Intake take_in_kept(const MeshArrays& arrays, const std::vector<uint32_t>& representative) {
    try {
        return take_in_welded(arrays.view(), representative);
    } catch (const Error& error) {
        refuse_as_corrupt(std::string("section MESH: ") + error.what());
    }
}

}

format::PackedBytes pack_mesh(const geoidx_mesh& mesh) {
    format::ByteWriter writer;
    writer.u32(mesh.position_type);
    std::vector<uint32_t> ids(mesh.triangles, mesh.triangles + 3 * mesh.triangle_count);
    take_differences(ids, ONE_BACK);
    writer.u32_planes(ids);
    if (mesh.position_type == GEOIDX_POSITION_DOUBLE) {
        auto coordinates = coordinates_of<uint64_t>(mesh);
        take_differences(coordinates, THREE_BACK);
        writer.u64_planes(coordinates);
    } else {
        auto coordinates = coordinates_of<uint32_t>(mesh);
        take_differences(coordinates, THREE_BACK);
        writer.u32_planes(coordinates);
    }
    return format::pack_bytes(writer.take());
}

Intake unpack_mesh(const format::StoredBytes& packed, const Description& about,
                   std::span<const uint32_t> number_of_id) {
    return about_section(TAG_MESH, [&] {
        const MeshArrays arrays = read_arrays(packed, about);
        Intake intake = take_in_kept(arrays, representatives(number_of_id));
        require_described(about, number_of_id, intake);
        return intake;
    });
}

void write_mesh(const StoredIndex& stored, format::ContainerWriter& writer) {
    if (!stored.mesh.bytes.empty()) writer.add_stored(TAG_MESH, stored.mesh, format::SECTION_OPTIONAL);
}

void read_mesh(const format::Container& container, StoredIndex& stored) {
    if (!container.has(TAG_MESH)) return;
    const Description& about = stored.description;
    stored.mesh = container.view_stored(TAG_MESH);
    if (about.triangle_count > UINT32_MAX ||
        (stored.mesh.raw_size != mesh_raw_size(about, GEOIDX_POSITION_FLOAT) &&
         stored.mesh.raw_size != mesh_raw_size(about, GEOIDX_POSITION_DOUBLE)))
        refuse_as_corrupt("section MESH: " + std::to_string(stored.mesh.raw_size) + " bytes are no mesh of " +
                          std::to_string(about.id_count) + " vertices and " +
                          std::to_string(about.triangle_count) + " triangles");
}

}
