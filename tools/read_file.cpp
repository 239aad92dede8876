#include "tools/read_file.h"

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
using OpenedFile = std::unique_ptr<std::FILE, FileCloser>;

constexpr size_t BLOCK = 1 << 16;

OpenedFile open_to_read(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) throw std::runtime_error("is a directory");
    OpenedFile file(std::fopen(path.c_str(), "rb"));
    if (!file) throw std::runtime_error(std::strerror(errno));
    return file;
}

std::string read_block(std::FILE* file) {
    std::string block(BLOCK, '\0');
    block.resize(std::fread(block.data(), 1, block.size(), file));
    if (std::ferror(file)) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
    return block;
}

// Read to the end instead of asking for the size, which a pipe does not know.
std::string read_to_the_end(std::FILE* file) {
    std::string bytes;
    for (std::string block = read_block(file); !block.empty(); block = read_block(file)) bytes += block;
    return bytes;
}

}

std::string read_file(const std::string& path) { return read_to_the_end(open_to_read(path).get()); }

std::string read_file_if(const std::string& path, const std::function<bool(const std::string&)>& goes_on) {
    const OpenedFile file = open_to_read(path);
    const std::string start = read_block(file.get());
    return goes_on(start) ? start + read_to_the_end(file.get()) : start;
}

std::string read_standard_input() { return read_to_the_end(stdin); }

}
