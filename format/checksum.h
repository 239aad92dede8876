#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace geodesic::format {

// XXH3 with 64 bits and seed 0, the same number on every host.
std::uint64_t checksum(std::span<const std::byte> bytes);

}
