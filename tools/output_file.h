#pragma once

#include <span>
#include <string>

namespace geodesic::tools {

// Both throw Failure("path: why").

// Before minutes of work: can a file be made at `path`, and is it none of the `inputs`?
void require_writable(const std::string& path, std::span<const std::string> inputs);

// Whether both name one file, which need not exist.
bool is_same_path(const std::string& a, const std::string& b);

// Replaces the file at `path` in one step (a sibling is written, synced and renamed), so that a failure
// leaves neither a partial file nor a damaged old one. A pipe or device is written to as it is.
void write_file(const std::string& path, std::span<const unsigned char> bytes);

}
