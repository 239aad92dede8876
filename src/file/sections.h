#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/container.h"
#include "geoidx.h"
#include "src/file/read_options.h"
#include "src/index/section_tags.h"
#include "src/index/stored.h"

namespace geodesic {

// Each pair of functions writes and reads a group of sections. Those in common.cpp and positions.cpp are for
// sections that both engines have, those in graph.cpp and overlay.cpp for sections of one engine. Sections
// must be read in this order, since earlier ones say how large later ones are. Reading throws Error CORRUPT
// for what format/SPEC.md refuses, with the tag of the section.
void write_common(const StoredIndex& stored, format::ContainerWriter& writer);
// Throws Error LIMIT if the caller's vertex array had more than max_vertices, and MESH_MISMATCH if the mesh
// of the options is another one, before anything is taken from it.
void read_common(const format::Container& container, const ReadOptions& options, StoredIndex& stored);

// POSI, which is one of those; `count` is the vertex count of VERT.
void write_positions(const StoredIndex& stored, format::ContainerWriter& writer);
void read_positions(const format::Container& container, uint32_t count, const ReadOptions& options,
                    StoredIndex& stored);

void write_graph(const StoredIndex& stored, format::ContainerWriter& writer);
void read_graph(const format::Container& container, uint32_t threads, StoredIndex& stored);

// The tables of the overlay engine in their three forms.
void write_lossless_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_lossless_tables(const format::Container& container, uint32_t threads, StoredIndex& stored);
void write_packed_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_packed_tables(const format::Container& container, const ReadOptions& options, StoredIndex& stored);

void write_mapped_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_mapped_tables(const format::Container& container, StoredIndex& stored); // They stay in the file.

// MESH, which either engine may have. It stays packed, and no more of it is looked at than its size.
void write_mesh(const StoredIndex& stored, format::ContainerWriter& writer);
void read_mesh(const format::Container& container, StoredIndex& stored);

// PAIR and EDGE, each of which is there if it holds any.
void write_vertex_pairs(const StoredIndex& stored, format::ContainerWriter& writer);
void read_vertex_pairs(const format::Container& container, StoredIndex& stored);

void write_overlay(const StoredIndex& stored, format::ContainerWriter& writer);
void read_overlay(const format::Container& container, const ReadOptions& options, StoredIndex& stored);

[[noreturn]] void refuse_as_corrupt(const std::string& detail);

}
