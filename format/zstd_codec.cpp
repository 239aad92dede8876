#include "format/zstd_codec.h"

#include <new>

#include <zstd.h>
#include <zstd_errors.h>

#include "format/bytes.h"
#include "format/error.h"

namespace geodesic::format {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
    throw Error(GEOIDX_ERROR_CORRUPT, name + ": " + what);
}

// A lack of memory says nothing about the data.
void check_memory(std::size_t result) {
    if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
}

// zstd reads other things than frames too: frames to be skipped and, when built so, frames of old releases.
void check_is_frame(std::span<const std::byte> stored, const std::string& name) {
    if (stored.size() < 4 || load_little_endian<std::uint32_t>(stored.data()) != ZSTD_MAGICNUMBER) {
        fail(name, "not a zstd frame");
    }
}

void check_content_size(std::span<const std::byte> stored, std::uint64_t raw_size, const std::string& name) {
    const unsigned long long content = ZSTD_getFrameContentSize(stored.data(), stored.size());
    if (content == ZSTD_CONTENTSIZE_ERROR || content == ZSTD_CONTENTSIZE_UNKNOWN) {
        fail(name, "the zstd frame does not state the size of its content");
    }
    if (content != raw_size) {
        fail(name, "the zstd frame holds " + std::to_string(content) + " bytes, expected " +
                       std::to_string(raw_size));
    }
}

void check_frame_size(std::span<const std::byte> stored, const std::string& name) {
    const std::size_t size = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
    if (ZSTD_isError(size) != 0) fail(name, std::string("zstd: ") + ZSTD_getErrorName(size));
    if (size != stored.size()) {
        fail(name, "the zstd frame is " + std::to_string(size) + " bytes long, stored are " +
                       std::to_string(stored.size()));
    }
}

}

std::vector<std::byte> compress_zstd(std::span<const std::byte> raw) {
    constexpr int LEVEL = 12;
    std::vector<std::byte> stored(ZSTD_compressBound(raw.size()));
    const std::size_t size = ZSTD_compress(stored.data(), stored.size(), raw.data(), raw.size(), LEVEL);
    check_memory(size);
    if (ZSTD_isError(size) != 0) {
        throw Error(GEOIDX_ERROR_INTERNAL, "zstd cannot compress " + std::to_string(raw.size()) +
                                               " bytes: " + ZSTD_getErrorName(size));
    }
    stored.resize(size);
    return stored;
}

std::vector<std::byte> decompress_zstd(std::span<const std::byte> stored, std::uint64_t raw_size,
                                       const std::string& name) {
    check_is_frame(stored, name);
    check_content_size(stored, raw_size, name);
    check_frame_size(stored, name);
    std::vector<std::byte> raw(static_cast<std::size_t>(raw_size));
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    check_memory(size);
    if (ZSTD_isError(size) != 0) fail(name, std::string("zstd: ") + ZSTD_getErrorName(size));
    if (size != raw.size()) fail(name, "the zstd frame ended after " + std::to_string(size) + " bytes");
    return raw;
}

}
