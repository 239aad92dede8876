#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "format/container.h"

namespace geodesic::test {

// Adds a section of PNG images of `file` as it is to another file.
inline void copy_images(const format::Container& container, std::span<const std::byte> file,
                        const format::Section& section, format::ContainerWriter& writer) {
    const auto count = std::to_integer<uint32_t>(file[section.offset]); // less than 256
    std::vector<std::vector<std::byte>> streams;
    for (const auto stream : container.png_streams(section.tag, count))
        streams.emplace_back(stream.begin(), stream.end());
    writer.add_encoded_images(section.tag, section.codec, streams, section.raw_size);
}

}
