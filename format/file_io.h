#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace geodesic::format {

// What a file begins with, and its size, which pipes and devices do not tell.
struct FileStart {
    std::span<const std::byte> bytes;
    std::optional<std::uint64_t> size;
};

// How many bytes of a file are worth reading, by its start. It throws to refuse the file.
using SizeByStart = std::function<std::uint64_t(const FileStart&)>;

// The content of a file, of which `wanted` sees the first bytes before more is read. One byte more than it
// asks for, or a few, shows that the file is longer. Throws GEOIDX_ERROR_IO with the path and the operating
// system's reason, also for a directory, and what `wanted` throws.
std::vector<std::byte> read_file(const std::string& utf8_path, const SizeByStart& wanted);

// Puts `bytes` in place of the file, in one step that other processes see entirely or not at all: a new file
// beside it is written, synced and renamed, then the directory is synced. The permissions of an old file are
// kept, a symbolic link is followed. Only a regular file is ever replaced. Throws GEOIDX_ERROR_IO; then the
// new file is removed and the old one untouched, unless the message says that only syncing the directory
// failed.
void write_file_atomically(const std::string& utf8_path, std::span<const std::byte> bytes);

}
