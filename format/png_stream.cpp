#include "format/png_stream.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

#include <png.h>
#include <zlib.h>

#include "format/error.h"

// libpng leaves a function by longjmp when it fails. So no frame between setjmp and libpng, ours and the
// callbacks', may hold an object with a destructor: the owners live in the frames of write_png and read_png,
// the functions that call setjmp and what they call see only references.

namespace geodesic::format {
namespace {

struct Failure {
    std::array<char, 160> message{};
    bool out_of_memory = false;
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
    std::snprintf(failure->message.data(), failure->message.size(), "%s", message);
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

// libpng and the zlib below it report a lack of memory as one of many errors, and in words only.
png_voidp on_malloc(png_structp png, png_alloc_size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) static_cast<Failure*>(png_get_mem_ptr(png))->out_of_memory = true;
    return memory;
}

void on_free(png_structp, png_voidp memory) { std::free(memory); }

int color_type(Pixel kind) { return kind == Pixel::Gray8 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB_ALPHA; }

std::string size_text(std::uint32_t rows, std::uint32_t cols) {
    return std::to_string(rows) + " rows x " + std::to_string(cols) + " columns";
}

std::string size_text(const PngImage& image) { return size_text(image.height, image.width); }

void check_arguments(std::size_t size, const PngImage& image) {
    check_sides(image);
    if (size != image.height * image.row_size()) {
        throw Error(GEOIDX_ERROR_INTERNAL,
                    "an image of " + size_text(image) + " with " + std::to_string(size) + " bytes");
    }
}

// ---- Encoding

class Writer {
public:
    explicit Writer(Failure& failure)
        : png_(png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning, &failure,
                                         on_malloc, on_free)),
          info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png_, &info_); }

    bool is_open() const { return info_ != nullptr; }
    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

private:
    png_structp png_;
    png_infop info_;
};

bool append(std::vector<std::byte>& out, std::span<const std::byte> bytes) noexcept {
    try {
        out.insert(out.end(), bytes.begin(), bytes.end());
        return true;
    } catch (...) {
        return false;
    }
}

void on_write(png_structp png, png_bytep data, std::size_t size) {
    auto& out = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    if (append(out, std::as_bytes(std::span(data, size)))) return;
    static_cast<Failure*>(png_get_error_ptr(png))->out_of_memory = true;
    png_error(png, "out of memory");
}

void on_flush(png_structp) {}

void set_compression(png_structp png, const PngImage& image, Compression compression) {
    constexpr std::uint64_t MAX_CHUNK_SIZE = 1 << 20;
    const std::uint64_t size = image.height * (1 + image.row_size());
    png_set_filter(png, PNG_FILTER_TYPE_BASE,
                   compression.filter == Filter::Paeth ? PNG_FILTER_PAETH : PNG_FILTER_NONE);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, compression.seeks_repeats ? Z_FILTERED : Z_HUFFMAN_ONLY);
    png_set_compression_buffer_size(png, static_cast<std::size_t>(std::min(size + 64, MAX_CHUNK_SIZE)));
}

bool write_image(png_structp png, png_infop info, const PngImage& image, Compression compression,
                 const std::byte* pixels) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_user_limits(png, MAX_PNG_SIDE, MAX_PNG_SIDE);
    png_set_IHDR(png, info, image.width, image.height, 8, color_type(image.kind), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    set_compression(png, image, compression);
    png_write_info(png, info);
    for (std::size_t r = 0; r < image.height; ++r)
        png_write_row(png, reinterpret_cast<png_const_bytep>(pixels) + r * image.row_size());
    png_write_end(png, nullptr);
    return true;
}

// ---- Decoding

class Reader {
public:
    explicit Reader(Failure& failure)
        : png_(png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &failure, on_error, on_warning, &failure,
                                        on_malloc, on_free)),
          info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {}
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    bool is_open() const { return info_ != nullptr; }
    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

private:
    png_structp png_;
    png_infop info_;
};

void on_read(png_structp png, png_bytep data, std::size_t size) {
    auto& rest = *static_cast<std::span<const std::byte>*>(png_get_io_ptr(png));
    if (size > rest.size()) png_error(png, "the image ended early");
    std::memcpy(data, rest.data(), size);
    rest = rest.subspan(size);
}

std::uint32_t load_big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4)) value = value << 8 | std::to_integer<std::uint32_t>(byte);
    return value;
}

[[noreturn]] void fail_corrupt(const std::string& what) { throw Error(GEOIDX_ERROR_CORRUPT, "PNG: " + what); }

// Before libpng sees the image, so that nothing is allocated for a size that is not expected.
void check_image_header(std::span<const std::byte> png, const PngImage& image) {
    // Signature, chunk length, "IHDR", width, height, depth, color type, compression, filter, interlace, CRC.
    constexpr std::size_t HEADER_SIZE = 8 + 4 + 4 + 13 + 4;
    if (png.size() < HEADER_SIZE)
        fail_corrupt(std::to_string(png.size()) + " bytes are too few for an image");
    if (png_sig_cmp(reinterpret_cast<png_const_bytep>(png.data()), 0, 8) != 0) fail_corrupt("not a PNG");
    // libpng passes over chunks that it does not know, also in front of the one with the size.
    if (load_big_endian(png.subspan(8)) != 13 || std::memcmp(png.data() + 12, "IHDR", 4) != 0)
        fail_corrupt("the image does not begin with its size");
    const std::uint32_t width = load_big_endian(png.subspan(16));
    const std::uint32_t height = load_big_endian(png.subspan(20));
    if (width != image.width || height != image.height) {
        fail_corrupt("the image has " + size_text(height, width) + ", expected " + size_text(image));
    }
    const auto depth = std::to_integer<int>(png[24]);
    const auto color = std::to_integer<int>(png[25]);
    const auto interlace = std::to_integer<int>(png[28]);
    if (depth != 8 || color != color_type(image.kind) || interlace != PNG_INTERLACE_NONE) {
        fail_corrupt("depth " + std::to_string(depth) + ", color type " + std::to_string(color) +
                     ", interlace " + std::to_string(interlace) +
                     (image.kind == Pixel::Gray8 ? " is not plain 8-bit gray" : " is not plain 8-bit RGBA"));
    }
}

// Whether libpng has found the image that the header promises, so that rows have the size of our own.
bool is_as_expected(png_structp png, png_infop info, const PngImage& image) {
    return png_get_image_width(png, info) == image.width && png_get_image_height(png, info) == image.height &&
           png_get_rowbytes(png, info) == image.row_size() &&
           png_get_interlace_type(png, info) == PNG_INTERLACE_NONE;
}

bool read_image(png_structp png, png_infop info, const PngImage& image, std::byte* pixels) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_user_limits(png, image.width, image.height);
    png_set_chunk_malloc_max(png, 1 << 16);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_benign_errors(png, 0);
    png_read_info(png, info);
    if (!is_as_expected(png, info, image)) png_error(png, "the image is another one than its header says");
    for (std::size_t r = 0; r < image.height; ++r)
        png_read_row(png, reinterpret_cast<png_bytep>(pixels) + r * image.row_size(), nullptr);
    png_read_end(png, nullptr);
    return true;
}

}

void check_sides(const PngImage& image) {
    if (image.height == 0 || image.width == 0 || image.height > MAX_PNG_SIDE || image.width > MAX_PNG_SIDE)
        throw Error(GEOIDX_ERROR_LIMIT, size_text(image) + " cannot be an image");
}

std::vector<std::byte> write_png(std::span<const std::byte> pixels, const PngImage& image,
                                 Compression compression) {
    check_arguments(pixels.size(), image);
    std::vector<std::byte> out;
    Failure failure;
    const Writer writer(failure);
    if (!writer.is_open()) throw std::bad_alloc();
    png_set_write_fn(writer.png(), &out, on_write, on_flush);
    if (write_image(writer.png(), writer.info(), image, compression, pixels.data())) return out;
    if (failure.out_of_memory) throw std::bad_alloc();
    throw Error(GEOIDX_ERROR_INTERNAL, "PNG of " + size_text(image) + ": " + failure.message.data());
}

void read_png(std::span<const std::byte> png, const PngImage& image, std::span<std::byte> pixels) {
    check_arguments(pixels.size(), image);
    check_image_header(png, image);
    Failure failure;
    const Reader reader(failure);
    if (!reader.is_open()) throw std::bad_alloc();
    std::span<const std::byte> rest = png;
    png_set_read_fn(reader.png(), &rest, on_read);
    if (!read_image(reader.png(), reader.info(), image, pixels.data())) {
        if (failure.out_of_memory) throw std::bad_alloc();
        fail_corrupt(failure.message.data());
    }
    if (!rest.empty()) fail_corrupt(std::to_string(rest.size()) + " bytes after the end of the image");
}

}
