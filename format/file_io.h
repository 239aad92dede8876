#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace geodesic::format {

// The whole content of a file; a pipe is read to its end. Throws GEOIDX_ERROR_IO with the path and the
// operating system's reason, also for a directory.
std::vector<std::byte> read_file(const std::string& utf8_path);

// Puts `bytes` in place of the file, in one step that other processes see entirely or not at all: a new file
// beside it is written, synced and renamed, then the directory is synced. The permissions of an old file are
// kept, a symbolic link is followed. Only a regular file is ever replaced. Throws GEOIDX_ERROR_IO; then the
// new file is removed and the old one untouched, unless the message says that only syncing the directory
// failed.
void write_file_atomically(const std::string& utf8_path, std::span<const std::byte> bytes);

}
