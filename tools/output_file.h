#pragma once

#include <span>
#include <string>
#include <string_view>

namespace geodesic::tools {

// The name of an output that stands for standard output.
inline constexpr std::string_view STANDARD_OUTPUT = "-";

// All throw Failure("path: why").

// Before minutes of work: can a file be made at `path`, and is it none of the `inputs`?
void require_writable(const std::string& path, std::span<const std::string> inputs);

// A terminal shows bytes that are no text as rubbish, and obeys some of it.
void require_no_terminal(const std::string& path);

// Where a symbolic link leads to, also if nothing is there: a link stays a link, what it points to is
// replaced or made. Any other path is returned as it is.
std::string behind_links(const std::string& path);

// Whether both name one file, which need not exist.
bool is_same_path(const std::string& a, const std::string& b);

// Whether what is at `path` can only be written to, not be replaced.
bool is_device_or_pipe(const std::string& path);

// Replaces the file at `path` in one step (a sibling is written, synced and renamed), so that a failure
// leaves neither a partial file nor a damaged old one. A pipe, a device or standard output is written to as
// it is.
void write_file(const std::string& path, std::span<const unsigned char> bytes);

}
