#pragma once

#include <string>

namespace geodesic::tools {

// Both return all there is, and throw std::runtime_error with the reason alone: the caller names the file.
std::string read_file(const std::string& path);
std::string read_standard_input();

}
