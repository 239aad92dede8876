#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "format/container.h"
#include "src/index/index.h"

namespace geodesic {

// The bytes of an index as format/SPEC.md describes them.
std::vector<std::byte> write_index(const Index& index);

// Fills an empty index; throws Error where the bytes are not an index that queries can trust.
void read_index(std::span<const std::byte> file, Index& index);

// All problems that can be told apart: those of the container, then, if it has none, the first one of its
// content.
std::vector<format::Issue> inspect_index(std::span<const std::byte> file);

}
