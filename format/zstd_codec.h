#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace geodesic::format {

// One zstd frame that states the size of its content. The same bytes give the same frame with the same
// release of zstd.
std::vector<std::byte> compress_zstd(std::span<const std::byte> raw);

// The content of `stored`, which must be exactly one frame stating a content of exactly `raw_size` bytes;
// that is checked before memory is allocated for it. Throws GEOIDX_ERROR_CORRUPT with `name` in the message.
std::vector<std::byte> decompress_zstd(std::span<const std::byte> stored, std::uint64_t raw_size,
                                       const std::string& name);

}
