// The tables of the overlay engine as they lie in memory, so that queries read them in the file.
#include <bit>
#include <string>

#include "src/file/sections.h"

namespace geodesic {

namespace {

void require_little_endian() {
    if constexpr (std::endian::native != std::endian::little)
        throw Error(GEOIDX_ERROR_UNSUPPORTED_VERSION, "mapped files are for little-endian processors");
}

void read_hop_codes(const format::Container& container, StoredIndex& stored) {
    const auto bytes = container.view_bytes(TAG_HOP_CODES);
    if (bytes.size() % sizeof(uint16_t) != 0) refuse_as_corrupt("section HOPS ends within a code");
    stored.hop_codes = {reinterpret_cast<const uint16_t*>(bytes.data()), bytes.size() / sizeof(uint16_t)};
}

}

void write_mapped_tables(const StoredIndex& stored, format::ContainerWriter& writer) {
    require_little_endian();
    writer.add_raw(TAG_HOP_CODES, std::as_bytes(stored.hop_codes));
}

void read_mapped_tables(const format::Container& container, StoredIndex& stored) {
    require_little_endian();
    about_section(TAG_HOP_CODES, [&] { read_hop_codes(container, stored); });
}

}
