#include <algorithm>
#include <vector>

#include "format/file_handle_windows.h"
#include "format/file_mapping.h"

namespace geodesic::format {
namespace {

std::vector<std::byte> read_start(const FileHandle& file, std::size_t size) {
    std::vector<std::byte> start(size);
    DWORD filled = 0;
    if (!ReadFile(file.get(), start.data(), static_cast<DWORD>(size), &filled, nullptr)) filled = 0;
    start.resize(filled);
    return start;
}

}

void FileMapping::Unmap::operator()(const std::byte* first) const { UnmapViewOfFile(first); }

std::optional<FileMapping> FileMapping::of_file(const std::string& utf8_path,
                                                const std::function<bool(const FileStart&)>& is_wanted) {
    const std::wstring path = wide(utf8_path);
    const DWORD attributes = GetFileAttributesW(path.c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_DIRECTORY)) return {};
    const FileHandle file(CreateFileW(path.c_str(), GENERIC_READ,
                                      FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!file.is_open() || GetFileType(file.get()) != FILE_TYPE_DISK) return {};
    LARGE_INTEGER size{};
    if (!GetFileSizeEx(file.get(), &size) || size.QuadPart <= 0) return {};
    const auto bytes = static_cast<std::size_t>(size.QuadPart);
    if (!is_wanted({read_start(file, std::min(bytes, START)), bytes})) return {};
    const FileHandle mapping(CreateFileMappingW(file.get(), nullptr, PAGE_READONLY, 0, 0, nullptr));
    if (!mapping.is_open()) return {};
    const void* const first = MapViewOfFile(mapping.get(), FILE_MAP_READ, 0, 0, bytes);
    if (!first) return {};
    return FileMapping(static_cast<const std::byte*>(first), bytes);
}

}
