#pragma once

#include <string>

namespace geodesic::tools {

// The whole contents of a file. Throws std::runtime_error with the reason alone: the caller names the file.
std::string read_file(const std::string& path);

}
