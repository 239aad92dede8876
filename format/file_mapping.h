#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "format/file_io.h"

namespace geodesic::format {

// A file as memory that the operating system shares with all who map it. Whoever changes the file changes the
// bytes, and whoever cuts it short makes reading them crash.
class FileMapping {
public:
    std::span<const std::byte> bytes() const { return {first_.get(), first_.get_deleter().size}; }

    // How many bytes of a file `is_wanted` is shown.
    static constexpr std::size_t START = 65536;

    // Maps a regular file if is_wanted(its start). Returns nothing if it is not wanted or cannot be
    // mapped, whatever the reason is: reading the file will tell.
    static std::optional<FileMapping> of_file(const std::string& utf8_path,
                                              const std::function<bool(const FileStart&)>& is_wanted);

private:
    struct Unmap {
        std::size_t size;
        void operator()(const std::byte* first) const;
    };

    FileMapping(const std::byte* first, std::size_t size) : first_(first, {size}) {}

    std::unique_ptr<const std::byte, Unmap> first_;
};

}
