#pragma once

#include <functional>

#include "format/container.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"

namespace geodesic::test {

// The file with the raw bytes of one section changed.
inline Bytes with_changed_section(std::span<const std::byte> file, uint32_t changed,
                                  const std::function<void(Bytes&)>& change,
                                  format::Packing packing = format::Packing::Zstd) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    format::ContainerWriter writer(container.mesh_fingerprint(), packing);
    for (const format::Section& section : container.sections()) {
        Bytes raw = container.read_bytes(section.tag, UINT64_MAX);
        if (section.tag == changed) change(raw);
        writer.add_bytes(section.tag, raw);
    }
    return writer.finish();
}

}
