#include "format/checksum.h"

#include <xxhash.h>

namespace geodesic::format {

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}
