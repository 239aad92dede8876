#pragma once

#include <string>
#include <utility>

#define NOMINMAX
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include "format/error.h"

namespace geodesic::format {

inline std::wstring wide(const std::string& utf8) {
    const int size = static_cast<int>(utf8.size());
    const int needed = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, utf8.data(), size, nullptr, 0);
    if (needed <= 0 && size > 0) throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "utf8_path is not UTF-8");
    std::wstring result(static_cast<size_t>(needed), L'\0');
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, utf8.data(), size, result.data(), needed);
    return result;
}

// An open file or a mapping of one, or none: systems say NULL or INVALID_HANDLE_VALUE.
class FileHandle {
public:
    explicit FileHandle(HANDLE handle) : handle_(handle) {}
    FileHandle(const FileHandle&) = delete;
    FileHandle& operator=(const FileHandle&) = delete;
    ~FileHandle() { close(); }

    HANDLE get() const { return handle_; }
    bool is_open() const { return handle_ && handle_ != INVALID_HANDLE_VALUE; }
    bool close() { return !is_open() || CloseHandle(std::exchange(handle_, INVALID_HANDLE_VALUE)); }

private:
    HANDLE handle_;
};

}
