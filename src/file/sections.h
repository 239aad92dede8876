#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "format/container.h"
#include "src/index/stored.h"

namespace geodesic {

// The sections of an index; format/SPEC.md describes their content.
inline constexpr uint32_t TAG_META = format::make_tag("META");
inline constexpr uint32_t TAG_HIERARCHY = format::make_tag("HIER");
inline constexpr uint32_t TAG_VERTICES = format::make_tag("VERT");
inline constexpr uint32_t TAG_POSITIONS = format::make_tag("POSI");
inline constexpr uint32_t TAG_BORDERS = format::make_tag("BORD");
inline constexpr uint32_t TAG_BORDER_TABLES = format::make_tag("BVBV");
inline constexpr uint32_t TAG_BORDER_INTERNAL_TABLES = format::make_tag("BVIV");
inline constexpr uint32_t TAG_INTERNAL_TABLES = format::make_tag("IVIV");

// These are of the overlay engine only.
inline constexpr uint32_t TAG_QUANTA = format::make_tag("QUAN");
inline constexpr uint32_t TAG_SEGMENTS = format::make_tag("SEGM");
inline constexpr uint32_t TAG_OVERLAY_TABLES = format::make_tag("OVOV");
inline constexpr uint32_t TAG_HOP_CODES = format::make_tag("HOPS");

inline constexpr std::array INDEX_TAGS{TAG_META,
                                       TAG_HIERARCHY,
                                       TAG_VERTICES,
                                       TAG_POSITIONS,
                                       TAG_BORDERS,
                                       TAG_BORDER_TABLES,
                                       TAG_BORDER_INTERNAL_TABLES,
                                       TAG_INTERNAL_TABLES,
                                       TAG_QUANTA,
                                       TAG_SEGMENTS,
                                       TAG_OVERLAY_TABLES,
                                       TAG_HOP_CODES};

// Each pair of functions writes and reads a group of sections. Those in common.cpp and positions.cpp are for
// sections that both engines have, those in graph.cpp and overlay.cpp for sections of one engine. Sections
// must be read in this order, since earlier ones say how large later ones are. Reading throws Error CORRUPT
// for what format/SPEC.md refuses.
void write_common(const StoredIndex& stored, format::ContainerWriter& writer);
// Throws Error LIMIT if the caller's vertex array had more than max_vertices, unless these are 0.
void read_common(const format::Container& container, uint64_t max_vertices, StoredIndex& stored);

// POSI, which is one of those.
void write_positions(const StoredIndex& stored, format::ContainerWriter& writer);
void read_positions(const format::Container& container, StoredIndex& stored);

void write_graph(const StoredIndex& stored, format::ContainerWriter& writer);
void read_graph(const format::Container& container, uint32_t threads, StoredIndex& stored);

// The tables of the overlay engine in their three forms.
void write_lossless_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_lossless_tables(const format::Container& container, uint32_t threads, StoredIndex& stored);
void write_packed_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_packed_tables(const format::Container& container, uint32_t threads, StoredIndex& stored);

void write_mapped_tables(const StoredIndex& stored, format::ContainerWriter& writer);
void read_mapped_tables(const format::Container& container, StoredIndex& stored); // They stay in the file.

void write_overlay(const StoredIndex& stored, format::ContainerWriter& writer);
void read_overlay(const format::Container& container, uint32_t threads, StoredIndex& stored);

[[noreturn]] void refuse_as_corrupt(const std::string& detail);

}
