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

// Returns whether there was more of the file.
bool append_block(std::FILE* file, std::string& bytes) {
    const size_t before = bytes.size();
    bytes.resize(before + BLOCK);
    bytes.resize(before + std::fread(bytes.data() + before, 1, BLOCK, file));
    if (std::ferror(file)) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
    return bytes.size() > before;
}

// Read to the end instead of asking for the size, which a pipe does not know.
void append_rest(std::FILE* file, std::string& bytes) {
    while (append_block(file, bytes)) {
    }
}

}

std::string read_file(const std::string& path) {
    return read_file_if(path, [](const std::string&) { return true; });
}

std::string read_file_if(const std::string& path, const std::function<bool(const std::string&)>& goes_on) {
    const OpenedFile file = open_to_read(path);
    std::string bytes;
    if (append_block(file.get(), bytes) && goes_on(bytes)) append_rest(file.get(), bytes);
    return bytes;
}

std::string read_standard_input() {
    std::string bytes;
    append_rest(stdin, bytes);
    return bytes;
}

}
