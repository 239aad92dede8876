#pragma once

#include <array>
#include <cstdint>

#include "format/container.h"

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
inline constexpr uint32_t TAG_MEASURED_PAIRS = format::make_tag("PAIR"); // only if there are any
inline constexpr uint32_t TAG_STEEP_EDGES = format::make_tag("EDGE");    // only if there are any
inline constexpr uint32_t TAG_OVERLAY_TABLES = format::make_tag("OVOV");
inline constexpr uint32_t TAG_HOP_CODES = format::make_tag("HOPS");

// This one is optional.
inline constexpr uint32_t TAG_MESH = format::make_tag("MESH");

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
                                       TAG_MEASURED_PAIRS,
                                       TAG_STEEP_EDGES,
                                       TAG_OVERLAY_TABLES,
                                       TAG_HOP_CODES,
                                       TAG_MESH};

}
