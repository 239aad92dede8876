#pragma once

#include <cstddef>
#include <memory_resource>
#include <variant>

#include "format/container.h"
#include "src/graph/tables.h"
#include "src/index/description.h"
#include "src/overlay/tables/tables.h"

namespace geodesic {

struct StoredIndex;

// What queries answer from, by the engine that the index was built for.
struct Index {
    explicit Index(std::pmr::memory_resource* memory)
        : memory(memory), number_of_id(memory), mesh_bytes(memory),
          engine(std::in_place_type<GraphIndex>, memory) {}

    std::pmr::memory_resource* memory;
    Description description;
    Array<uint32_t> number_of_id;  // per caller's id; NONE: no triangle uses it
    uint32_t vertices_with_id = 0; // of those that have a number; the others are added vertices
    // The mesh as the section MESH holds it, packed; no bytes if it is not kept. It lies in mesh_bytes, or in
    // a mapped file.
    format::StoredBytes mesh;
    Array<std::byte> mesh_bytes;
    std::variant<GraphIndex, OverlayIndex> engine;

    bool keeps_mesh() const { return !mesh.bytes.empty(); }
    const Numbering& numbering() const {
        return std::visit([](const auto& of_engine) -> const Numbering& { return of_engine.numbering; },
                          engine);
    }
};

// Fills an index from what is stored, in place of what it held. Throws Error where what is stored cannot be
// an index; the index is then neither the old nor the new one, and may only be prepared again or destroyed.
// Hop codes and the mesh of a mapped file stay where they are.
void prepare(const StoredIndex& stored, Index& index);

// Copies a packed mesh into the index's memory.
void keep_mesh(const format::StoredBytes& mesh, Index& index);

// Makes what only pairs need, if it has not been made: samples and labels of the overlay engine. Any thread
// may call it at any time. Without it, the first pair that is asked for makes the samples, and each pair the
// labels that it needs.
void prepare_pairs(const Index& index);

// Frees what prepare_pairs() made. No query may be running.
void release_pairs(const Index& index);

// From now on no labels are made, neither by prepare_pairs() nor by pairs. To be called before any query.
void leave_out_labels(Index& index);

// What is stored of an index: the opposite of prepare().
StoredIndex restore(const Index& index);

// Throws Error CORRUPT unless all that queries read of an index that was opened from a mapped file is what
// prepare() would have made of another form, and another form can hold it. Opening does not ask, since it
// takes longer than everything else that opening does.
void require_hops_follow(const Index& index);

// The largest error of tables, for pairs of a class of distances that are held beside them; at most 1, which
// also stands for more. Answers that measured pairs do not reach may be as wrong.
inline double error_of_measured_pairs(const Index& index, size_t of_class) {
    const auto* const overlay = std::get_if<OverlayIndex>(&index.engine);
    return overlay ? double{overlay->measured.largest_errors[of_class]} : 0;
}

// Distances that are stored in the tables of an index.
uint64_t table_entries(const Index& index);

}
