#pragma once

#include <functional>

#include "format/container.h"
#include "src/file/sections.h"
#include "tests/capi/calls.h"

namespace geodesic::test {

// A writer that has the sections of a file: change(tag, raw) may change the raw bytes of each, and returns
// whether it stays.
inline format::ContainerWriter with_changes(std::span<const std::byte> file,
                                            const std::function<bool(uint32_t tag, Bytes& raw)>& change,
                                            format::Packing packing = format::Packing::Zstd) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    format::ContainerWriter writer(container.mesh_fingerprint(), packing);
    for (const format::Section& section : container.sections()) {
        Bytes raw = container.read_bytes(section.tag, UINT64_MAX);
        if (change(section.tag, raw)) writer.add_bytes(section.tag, raw);
    }
    return writer;
}

// The file with the raw bytes of one section changed.
inline Bytes with_changed_section(std::span<const std::byte> file, uint32_t changed,
                                  const std::function<void(Bytes&)>& change,
                                  format::Packing packing = format::Packing::Zstd) {
    const auto change_it = [&](uint32_t tag, Bytes& raw) {
        if (tag == changed) change(raw);
        return true;
    };
    return with_changes(file, change_it, packing).finish();
}

inline Bytes without_section(std::span<const std::byte> file, uint32_t left_out) {
    return with_changes(file, [&](uint32_t tag, Bytes&) { return tag != left_out; }).finish();
}

// The file with this section instead of the one that it may have.
inline Bytes with_section(std::span<const std::byte> file, uint32_t tag, const Bytes& section) {
    auto writer = with_changes(file, [&](uint32_t other, Bytes&) { return other != tag; });
    writer.add_bytes(tag, section);
    return writer.finish();
}

}
