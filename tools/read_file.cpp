#include "tools/read_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace geodesic::tools {

namespace {

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

// Read to the end instead of asking for the size, which a pipe does not know.
std::string read_to_the_end(std::FILE* file) {
    std::string bytes;
    std::array<char, 1 << 16> block;
    while (const size_t count = std::fread(block.data(), 1, block.size(), file))
        bytes.append(block.data(), count);
    if (std::ferror(file)) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
    return bytes;
}

}

std::string read_file(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw std::runtime_error("is a directory");
    const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
    if (!file) throw std::runtime_error(std::strerror(errno));
    return read_to_the_end(file.get());
}

std::string read_standard_input() { return read_to_the_end(stdin); }

}
