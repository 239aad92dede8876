#include "format/file_io.h"

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "format/error.h"
#include "format/file_content.h"
#include "format/file_handle_windows.h"

namespace geodesic::format {
namespace {

std::string narrow(const wchar_t* text, int size) {
    const int needed = WideCharToMultiByte(CP_UTF8, 0, text, size, nullptr, 0, nullptr, nullptr);
    std::string result(static_cast<size_t>(needed), '\0');
    WideCharToMultiByte(CP_UTF8, 0, text, size, result.data(), needed, nullptr, nullptr);
    return result;
}

std::string reason_of(DWORD code) {
    wchar_t text[512];
    const DWORD size = FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, nullptr,
                                      code, 0, text, static_cast<DWORD>(std::size(text)), nullptr);
    std::string reason = narrow(text, static_cast<int>(size));
    while (!reason.empty() && (reason.back() == '\n' || reason.back() == '\r' || reason.back() == '.'))
        reason.pop_back();
    return reason.empty() ? "error " + std::to_string(code) : reason;
}

[[noreturn]] void fail(const std::string& doing, const std::string& path, const std::string& reason) {
    throw Error(GEOIDX_ERROR_IO, "cannot " + doing + " '" + path + "': " + reason);
}

[[noreturn]] void fail_code(const std::string& doing, const std::string& path, DWORD code) {
    if (code == ERROR_NOT_ENOUGH_MEMORY || code == ERROR_OUTOFMEMORY) throw std::bad_alloc();
    fail(doing, path, reason_of(code));
}

bool is_directory(const std::wstring& path) {
    const DWORD attributes = GetFileAttributesW(path.c_str());
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY);
}

constexpr size_t MAX_TRANSFER = size_t{1} << 30;

size_t read_some(const FileHandle& file, std::span<std::byte> into, const std::string& path) {
    DWORD count = 0;
    if (!ReadFile(file.get(), into.data(), static_cast<DWORD>(std::min(into.size(), MAX_TRANSFER)), &count,
                  nullptr) &&
        GetLastError() != ERROR_BROKEN_PIPE)
        fail_code("read", path, GetLastError());
    return count;
}

void write_all(const FileHandle& file, std::span<const std::byte> bytes, const std::string& path) {
    while (!bytes.empty()) {
        DWORD count = 0;
        if (!WriteFile(file.get(), bytes.data(), static_cast<DWORD>(std::min(bytes.size(), MAX_TRANSFER)),
                       &count, nullptr))
            fail_code("write", path, GetLastError());
        bytes = bytes.subspan(count);
    }
}

// Pipes and devices have none.
std::optional<std::uint64_t> known_size(const FileHandle& file) {
    LARGE_INTEGER size{};
    if (!GetFileSizeEx(file.get(), &size) || size.QuadPart <= 0) return {};
    return static_cast<std::uint64_t>(size.QuadPart);
}

// A file that is removed again unless it was renamed to its destination.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::wstring& directory) : file_(create(directory)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        file_.close();
        if (!renamed_) DeleteFileW(path_.c_str());
    }

    FileHandle& file() { return file_; }
    // Of a closed file.
    void rename_to(const std::wstring& destination, const std::string& path) {
        if (!MoveFileExW(path_.c_str(), destination.c_str(),
                         MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
            fail_code("replace", path, GetLastError());
        renamed_ = true;
    }

private:
    HANDLE create(const std::wstring& directory) {
        constexpr int MAX_ATTEMPTS = 1000;
        const std::wstring prefix = directory + L".geoidx-" + std::to_wstring(GetCurrentProcessId()) + L"-";
        for (int attempt = 0; attempt < MAX_ATTEMPTS; ++attempt) {
            path_ = prefix + std::to_wstring(attempt) + L".tmp";
            const HANDLE handle = CreateFileW(path_.c_str(), GENERIC_WRITE, 0, nullptr, CREATE_NEW,
                                              FILE_ATTRIBUTE_NORMAL, nullptr);
            if (handle != INVALID_HANDLE_VALUE) return handle;
            if (GetLastError() != ERROR_FILE_EXISTS) break;
        }
        fail_code("create a file in the directory",
                  directory.empty() ? "." : narrow(directory.data(), static_cast<int>(directory.size())),
                  GetLastError());
    }

    std::wstring path_;
    FileHandle file_;
    bool renamed_ = false;
};

}

std::vector<std::byte> read_file(const std::string& utf8_path, const SizeByStart& wanted) {
    const std::wstring path = wide(utf8_path);
    if (is_directory(path)) fail("read", utf8_path, "it is a directory");
    const FileHandle file(CreateFileW(path.c_str(), GENERIC_READ,
                                      FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                      OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!file.is_open()) fail_code("open", utf8_path, GetLastError());
    const auto read = [&](std::span<std::byte> into) { return read_some(file, into, utf8_path); };
    return read_content(read, known_size(file), wanted);
}

void write_file_atomically(const std::string& utf8_path, std::span<const std::byte> bytes) {
    if (utf8_path.empty()) fail("write", utf8_path, "the path is empty");
    const std::wstring path = wide(utf8_path);
    if (is_directory(path)) fail("write", utf8_path, "it is a directory");
    const size_t separator = path.find_last_of(L"\\/:");
    TemporaryFile temporary(separator == std::wstring::npos ? std::wstring() : path.substr(0, separator + 1));
    write_all(temporary.file(), bytes, utf8_path);
    if (!FlushFileBuffers(temporary.file().get())) fail_code("sync", utf8_path, GetLastError());
    if (!temporary.file().close()) fail_code("close", utf8_path, GetLastError());
    temporary.rename_to(path, utf8_path);
}

}
