#pragma once

#include <functional>
#include <string>

namespace geodesic::tools {

// These throw std::runtime_error with the reason alone: the caller names the file.
std::string read_file(const std::string& path);
// No more than the start of a file, which does not go on where goes_on(start) is false.
std::string read_file_if(const std::string& path, const std::function<bool(const std::string&)>& goes_on);
std::string read_standard_input();

}
