#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "format/container.h"
#include "src/file/read_options.h"
#include "src/index/stored.h"

namespace geodesic {

// The bytes of an index as format/SPEC.md describes them.
std::vector<std::byte> write_index(const StoredIndex& stored);

// Throws Error if the sections are not those of an index, INDEX_TAGS, or not those of the given mesh.
// prepare() checks what can be checked only with the numbering at hand. The tables of a mapped file stay in
// the file, whose bytes must outlive what is read from it and be aligned as a uint16_t.
StoredIndex read_index(const format::Container& container, const ReadOptions& options);

}
