#pragma once

// How a file is read, whatever the operating system.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "format/file_io.h"

namespace geodesic::format {

// Appends up to `count` bytes, fewer only at the end of the file. read_some(span) returns how many bytes it
// has put there, 0 at the end.
template <class ReadSome>
void append_from(const ReadSome& read_some, std::uint64_t count, std::vector<std::byte>& content) {
    std::size_t filled = content.size();
    if (count > content.max_size() - filled) throw std::bad_alloc();
    content.resize(filled + static_cast<std::size_t>(count));
    while (filled < content.size()) {
        const std::size_t step = read_some(std::span(content).subspan(filled));
        if (step == 0) break;
        filled += step;
    }
    content.resize(filled);
}

// A file of known size is read in one step. Of another one, memory is taken as it brings bytes, since what
// its start says may not be so.
template <class ReadSome>
std::vector<std::byte> read_content(const ReadSome& read_some, std::optional<std::uint64_t> size,
                                    const SizeByStart& wanted) {
    constexpr std::uint64_t MIN_STEP = 4096;
    std::vector<std::byte> content;
    append_from(read_some, MIN_STEP, content);
    const std::uint64_t end = wanted({content, size});
    for (std::uint64_t filled = 0; filled < content.size() && content.size() <= end;) {
        filled = content.size();
        const std::uint64_t missing = size.value_or(0) > filled ? *size - filled : filled + MIN_STEP;
        append_from(read_some, std::min(missing, end - filled) + 1, content);
    }
    return content;
}

}
