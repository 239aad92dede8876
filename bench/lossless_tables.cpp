#include "bench/lossless_tables.h"

#include <algorithm>
#include <bit>
#include <span>

#include <png.h>
#include <zstd.h>

#include "tools/failure.h"

namespace geodesic::bench {

namespace {

using Bytes = std::span<const unsigned char>;

void require(bool condition, const IndexFile& file, const char* why) {
    if (!condition) throw tools::Failure(file.name + ": " + why);
}

const geoidx_section& section_of(const IndexFile& file, const std::string& tag) {
    const auto found = std::ranges::find(file.sections, tag, &geoidx_section::tag);
    require(found != file.sections.end(), file, "no lossless index of the overlay engine");
    return *found;
}

Bytes stored_bytes(const IndexFile& file, const geoidx_section& section) {
    return Bytes(file.bytes).subspan(section.offset, section.stored_size);
}

std::vector<unsigned char> raw_bytes(const IndexFile& file, const std::string& tag) {
    const geoidx_section& section = section_of(file, tag);
    const Bytes stored = stored_bytes(file, section);
    if (section.coding == 0) return {stored.begin(), stored.end()};
    std::vector<unsigned char> raw(section.raw_size);
    const size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    require(size == raw.size(), file, "a section is not what zstd makes");
    return raw;
}

uint64_t little_endian(Bytes bytes, size_t offset, size_t size) {
    uint64_t value = 0;
    for (size_t i = size; i-- > 0;) value = value << 8 | bytes[offset + i];
    return value;
}

uint32_t u32_at(Bytes bytes, size_t index) {
    return static_cast<uint32_t>(little_endian(bytes, 4 * index, 4));
}

// The patch of each matrix of a section. BORD begins with the number of vertices inside of each patch; then
// comes the size of the border of each patch but the root.
std::vector<uint32_t> patches_of(const std::string& tag, Bytes bord, uint32_t inner_count,
                                 uint32_t patch_count) {
    std::vector<uint32_t> patches;
    const bool inner = tag == "OVOV";
    for (uint32_t p = inner ? 0 : inner_count; p < (inner ? inner_count : patch_count); ++p) {
        const uint32_t inside = u32_at(bord, p);
        const uint32_t border = p ? u32_at(bord, patch_count + p - 1) : 0;
        if (tag != "IVIV" && inside > 0 && border > 0) patches.push_back(p);
        if (tag != "BVIV" && inside > 1) patches.push_back(p);
    }
    return patches;
}

float float_of_pixel(const unsigned char* pixel) {
    const uint32_t bits =
        uint32_t{pixel[0]} << 24 | uint32_t{pixel[1]} << 16 | uint32_t{pixel[2]} << 8 | uint32_t{pixel[3]};
    return std::bit_cast<float>(bits);
}

CodeTable table_of_png(Bytes stream, const IndexFile& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    require(png_image_begin_read_from_memory(&image, stream.data(), stream.size()) != 0, file, image.message);
    image.format = PNG_FORMAT_RGBA;
    std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
    require(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0, file, image.message);
    CodeTable table{image.height, image.width, {}, 0};
    for (size_t i = 0; i < pixels.size(); i += 4) table.codes.push_back(float_of_pixel(&pixels[i]));
    return table;
}

std::vector<CodeTable> tables_of_pngs(Bytes section, const IndexFile& file) {
    std::vector<CodeTable> tables(u32_at(section, 0));
    size_t begin = 4 + 8 * tables.size();
    for (size_t i = 0; i < tables.size(); ++i) {
        const uint64_t size = little_endian(section, 4 + 8 * i, 8);
        tables[i] = table_of_png(section.subspan(begin, size), file);
        begin += size;
    }
    return tables;
}

}

std::vector<CodeTable> tables_of(const IndexFile& lossless, const std::string& tag) {
    const std::vector<unsigned char> quanta = raw_bytes(lossless, "QUAN"), bord = raw_bytes(lossless, "BORD");
    const auto patch_count = static_cast<uint32_t>(quanta.size() / 5);
    const auto inner_count = static_cast<uint32_t>(little_endian(raw_bytes(lossless, "HIER"), 4, 8));
    const std::vector<uint32_t> patches = patches_of(tag, bord, inner_count, patch_count);
    std::vector<CodeTable> tables =
        tables_of_pngs(stored_bytes(lossless, section_of(lossless, tag)), lossless);
    require(tables.size() == patches.size(), lossless, "another number of tables than the borders give");
    for (size_t i = 0; i < tables.size(); ++i)
        tables[i].quantum = std::bit_cast<float>(u32_at(quanta, patches[i]));
    return tables;
}

}
