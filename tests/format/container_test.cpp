#include "format/container.h"

#include <algorithm>
#include <array>

#include <doctest/doctest.h>
#include <zstd.h>

#include "format/matrix_png.h"
#include "tests/format/helpers.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;

namespace {

constexpr std::uint32_t MORE = make_tag("MORE");
constexpr std::array TWO_TAGS = {DATA, MORE};
constexpr std::uint64_t NO_LIMIT = 1 << 20;

// A file with one section whose stored bytes, codec and raw size are as given.
Bytes file_with(const Bytes& stored, Codec codec, std::uint64_t raw_size) {
    ContainerWriter writer(0);
    writer.add_raw(DATA, stored);
    Bytes file = writer.finish();
    put(file, record(0) + CODEC, static_cast<std::uint32_t>(codec), 4);
    return patched(file, record(0) + RAW_SIZE, raw_size, 8);
}

geoidx_status read_status(const Bytes& file, std::uint64_t max_raw_size, std::string* message = nullptr) {
    return status_of([&] { Container::parse(file, TWO_TAGS).read_bytes(DATA, max_raw_size); }, message);
}

geoidx_status read_matrices_status(const Bytes& file, std::span<const std::pair<int, int>> shapes) {
    std::vector<std::vector<float>> values;
    std::vector<MatrixTarget> targets;
    for (const auto& [rows, cols] : shapes) values.emplace_back(static_cast<std::size_t>(rows * cols));
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        targets.push_back({values[i], static_cast<std::uint32_t>(shapes[i].first),
                           static_cast<std::uint32_t>(shapes[i].second)});
    }
    const Container container = Container::parse(file, TWO_TAGS);
    return status_of([&] { container.read_matrices(DATA, targets); });
}

Bytes zstd_frame(const Bytes& raw) {
    Bytes frame(ZSTD_compressBound(raw.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), raw.data(), raw.size(), 3));
    return frame;
}

Bytes zstd_frame_without_content_size(const Bytes& raw) {
    ZSTD_CCtx* context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
    Bytes frame(ZSTD_compressBound(raw.size()));
    frame.resize(ZSTD_compress2(context, frame.data(), frame.size(), raw.data(), raw.size()));
    ZSTD_freeCCtx(context);
    return frame;
}

Bytes png_section(const std::vector<Bytes>& pngs) {
    Bytes stored(4 + 8 * pngs.size());
    put(stored, 0, pngs.size(), 4);
    for (std::size_t i = 0; i < pngs.size(); ++i) put(stored, 4 + 8 * i, pngs[i].size(), 8);
    for (const Bytes& png : pngs) stored.insert(stored.end(), png.begin(), png.end());
    return stored;
}

}

TEST_CASE("a tag reads in the file as it is written") {
    CHECK(DATA == 0x41544144);
    CHECK(tag_text(DATA) == "'DATA'");
    CHECK(tag_text(0x0A544100) == "'\\x00AT\\x0a'");
}

TEST_CASE("a container gives back what was put in, whatever the codec") {
    const Bytes text(5000, std::byte{'x'});
    const Bytes noise = random_bytes(777, 1);
    const auto first = floats_of(awkward_bits());
    const auto second = random_floats(300, 2);
    const std::vector<MatrixView> matrices = {{first, 2, 7}, {second, 20, 15}};
    ContainerWriter writer(0x0123456789ABCDEF);
    writer.add_bytes(make_tag("TEXT"), text);
    writer.add_raw(make_tag("NOIS"), noise);
    writer.add_matrices(make_tag("MATR"), matrices);
    writer.add_bytes(make_tag("NONE"), {});
    writer.add_raw(make_tag("NIL "), {});
    const Bytes file = writer.finish();

    const std::array known = {make_tag("TEXT"), make_tag("NOIS"), make_tag("MATR"), make_tag("NONE"),
                              make_tag("NIL ")};
    const Container container = Container::parse(file, known);
    CHECK(container.version_minor() == 0);
    CHECK(container.mesh_fingerprint() == 0x0123456789ABCDEF);
    CHECK(container.sections().size() == 5);
    CHECK(container.has(make_tag("TEXT")));
    CHECK_FALSE(container.has(DATA));
    CHECK(container.read_bytes(make_tag("TEXT"), 5000) == text);
    CHECK(container.section(make_tag("TEXT")).stored_size < 500);
    CHECK(container.read_bytes(make_tag("NOIS"), 777) == noise);
    CHECK(container.read_bytes(make_tag("NONE"), 0).empty());
    CHECK(container.read_bytes(make_tag("NIL "), 0).empty());
    std::vector<float> first_read(first.size());
    std::vector<float> second_read(second.size());
    const std::vector<MatrixTarget> targets = {{first_read, 2, 7}, {second_read, 20, 15}};
    container.read_matrices(make_tag("MATR"), targets);
    CHECK(bits_of(first_read) == bits_of(first));
    CHECK(bits_of(second_read) == bits_of(second));
    CHECK(inspect(file, known).empty());
}

TEST_CASE("a container without sections is its header") {
    const Bytes file = ContainerWriter(7).finish();
    CHECK(file.size() == 48);
    CHECK(Container::parse(file, {}).mesh_fingerprint() == 7);
}

TEST_CASE("the same sections give the same bytes") {
    const auto write = [] {
        ContainerWriter writer(1);
        writer.add_bytes(DATA, Bytes(1000, std::byte{3}));
        const auto values = random_floats(12, 1);
        writer.add_matrices(MORE, std::vector<MatrixView>{{values, 3, 4}});
        return writer.finish();
    };
    CHECK(write() == write());
}

TEST_CASE("matrices encoded beforehand give the same file as matrices encoded by the writer") {
    const auto values = random_floats(12, 1);
    ContainerWriter one(1);
    one.add_matrices(DATA, std::vector<MatrixView>{{values, 3, 4}, {values, 4, 3}});
    ContainerWriter other(1);
    other.add_encoded_images(DATA, Codec::Png,
                             std::vector<Bytes>{encode_png(values, 3, 4), encode_png(values, 4, 3)}, 96);
    CHECK(one.finish() == other.finish());
}

TEST_CASE("fields and sections stand where the specification has them") {
    const Bytes raw = bytes_of({1, 2, 3});
    ContainerWriter writer(0x1122334455667788);
    writer.add_raw(DATA, raw);
    writer.add_raw(MORE, raw, SECTION_OPTIONAL);
    const Bytes file = writer.finish();
    REQUIRE(file.size() == 256 + 3);
    const Bytes start(file.begin(), file.begin() + 12);
    CHECK(start == bytes_of({0x89, 'G', 'I', 'D', 'X', 0x0D, 0x0A, 0x1A, 2, 0, 0, 0}));
    CHECK(get(file, SECTION_COUNT, 4) == 2);
    CHECK(get(file, FILE_SIZE, 8) == file.size());
    CHECK(get(file, 32, 8) == 0x1122334455667788);
    CHECK(get(file, record(0) + OFFSET, 8) == 192);
    CHECK(get(file, record(0) + STORED_SIZE, 8) == 3);
    CHECK(get(file, record(0) + RAW_SIZE, 8) == 3);
    CHECK(get(file, record(0) + CHECKSUM, 8) == XXH3_64bits(raw.data(), raw.size()));
    CHECK(get(file, record(1), 4) == MORE);
    CHECK(get(file, record(1) + FLAGS, 4) == 1);
    CHECK(get(file, record(1) + OFFSET, 8) == 256);
    Bytes resealed = file;
    reseal(resealed);
    CHECK(resealed == file);
}

TEST_CASE("a tag cannot be written twice, nor more sections than allowed") {
    ContainerWriter writer(0);
    writer.add_raw(DATA, {});
    CHECK(status_of([&] { writer.add_raw(DATA, {}); }) == GEOIDX_ERROR_INTERNAL);
    for (std::uint32_t tag = 1; tag < MAX_SECTIONS; ++tag) writer.add_raw(tag, {}, SECTION_OPTIONAL);
    CHECK(status_of([&] { writer.add_raw(MORE, {}); }) == GEOIDX_ERROR_LIMIT);
    const Bytes file = writer.finish();
    CHECK(Container::parse(file, TWO_TAGS).sections().size() == MAX_SECTIONS);
}

TEST_CASE("a missing section is refused by name") {
    const Bytes file = ContainerWriter(0).finish();
    const Container container = Container::parse(file, {});
    std::string message;
    CHECK(status_of([&] { container.read_bytes(DATA, 1); }, &message) == GEOIDX_ERROR_CORRUPT);
    CHECK(message.find("'DATA'") != std::string::npos);
    CHECK(status_of([&] { container.read_matrices(DATA, {}); }) == GEOIDX_ERROR_CORRUPT);
    CHECK(status_of([&] { container.section(DATA); }) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a section larger than the reader allows is refused before it is decoded") {
    Bytes zeros(100000);
    for (std::size_t i = 0; i < zeros.size(); i += 500)
        zeros[i] = static_cast<std::byte>(i / 500); // packs less well
    const Bytes bomb = file_with(zstd_frame(zeros), Codec::Zstd, zeros.size());
    CHECK(read_status(bomb, zeros.size()) == GEOIDX_OK);
    CHECK(read_status(bomb, zeros.size() - 1) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with(zeros, Codec::Raw, zeros.size()), zeros.size() - 1) == GEOIDX_ERROR_CORRUPT);
    const std::uint64_t huge = std::uint64_t{1} << 60;
    CHECK(read_status(file_with(zstd_frame(zeros), Codec::Zstd, huge), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with(zstd_frame(zeros), Codec::Zstd, huge), huge) == GEOIDX_ERROR_CORRUPT);
    // Allowed by the caller and possible for a frame of this size, but not what the frame says.
    const std::uint64_t possible = zstd_frame(zeros).size() / 4 * 128 * 1024;
    CHECK(read_status(file_with(zstd_frame(zeros), Codec::Zstd, possible), possible) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a zstd section must be one frame that states its raw size and holds it") {
    const Bytes raw = random_bytes(100, 3);
    const Bytes frame = zstd_frame(raw);
    REQUIRE(read_status(file_with(frame, Codec::Zstd, 100), NO_LIMIT) == GEOIDX_OK);
    CHECK(read_status(file_with(frame, Codec::Zstd, 99), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with(frame, Codec::Zstd, 101), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with(zstd_frame_without_content_size(raw), Codec::Zstd, 100), NO_LIMIT) ==
          GEOIDX_ERROR_CORRUPT);
    Bytes two = frame;
    two.insert(two.end(), frame.begin(), frame.end());
    CHECK(read_status(file_with(two, Codec::Zstd, 100), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    Bytes trailing = frame;
    trailing.push_back(std::byte{0});
    CHECK(read_status(file_with(trailing, Codec::Zstd, 100), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with(raw, Codec::Zstd, 100), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    CHECK(read_status(file_with({}, Codec::Zstd, 0), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    const Bytes skippable = bytes_of({0x50, 0x2A, 0x4D, 0x18, 0, 0, 0, 0});
    CHECK(read_status(file_with(skippable, Codec::Zstd, 0), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    Bytes with_skippable = frame;
    with_skippable.insert(with_skippable.end(), skippable.begin(), skippable.end());
    CHECK(read_status(file_with(with_skippable, Codec::Zstd, 100), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    // zstd's own number for "not stated", as a raw size.
    constexpr std::uint64_t NOT_STATED = ZSTD_CONTENTSIZE_UNKNOWN;
    CHECK(read_status(file_with(zstd_frame_without_content_size(raw), Codec::Zstd, NOT_STATED), NOT_STATED) ==
          GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a zstd frame whose content is not as long as it states is refused") {
    Bytes frame = zstd_frame(random_bytes(100, 3));
    // Up to 255 bytes the size of the content is the sixth byte of a frame (RFC 8878, 3.1.1.1).
    REQUIRE(get(frame, 5, 1) == 100);
    put(frame, 5, 101, 1);
    CHECK(read_status(file_with(frame, Codec::Zstd, 101), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    put(frame, 5, 99, 1);
    CHECK(read_status(file_with(frame, Codec::Zstd, 99), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a zstd section cut at any length is refused") {
    const Bytes frame = zstd_frame(Bytes(300, std::byte{5}));
    for (std::size_t length = 0; length < frame.size(); ++length) {
        CAPTURE(length);
        const Bytes cut(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(length));
        CHECK(read_status(file_with(cut, Codec::Zstd, 300), NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    }
}

TEST_CASE("matrices are read from raw and zstd sections too") {
    const auto bits = awkward_bits();
    Bytes raw(4 * bits.size());
    for (std::size_t i = 0; i < bits.size(); ++i) put(raw, 4 * i, bits[i], 4);
    for (const Bytes& file :
         {file_with(raw, Codec::Raw, raw.size()), file_with(zstd_frame(raw), Codec::Zstd, raw.size())}) {
        std::vector<float> values(14);
        const std::vector<MatrixTarget> targets = {{std::span(values).first(8), 2, 4},
                                                   {std::span(values).subspan(8), 1, 6}};
        Container::parse(file, TWO_TAGS).read_matrices(DATA, targets);
        CHECK(bits_of(values) == bits);
    }
}

TEST_CASE("matrices must be those of the section in number, shape and size") {
    const Bytes png = encode_png(random_floats(12, 1), 3, 4);
    const auto status = [](const Bytes& stored, std::uint64_t raw_size,
                           std::vector<std::pair<int, int>> shapes) {
        return read_matrices_status(file_with(stored, Codec::Png, raw_size), shapes);
    };
    REQUIRE(status(png_section({png, png}), 96, {{3, 4}, {3, 4}}) == GEOIDX_OK);
    CHECK(status(png_section({}), 0, {}) == GEOIDX_OK);
    CHECK(status(png_section({png, png}), 96, {{3, 4}}) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(png_section({png, png}), 48, {{3, 4}}) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(png_section({png}), 96, {{3, 4}, {3, 4}}) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(png_section({png}), 48, {{4, 3}}) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(png_section({png}), 52, {{3, 4}}) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(png_section({png}), 44, {{3, 4}}) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("the lengths of the images in a section must add up") {
    const Bytes png = encode_png(random_floats(12, 1), 3, 4);
    const std::vector<std::pair<int, int>> shape = {{3, 4}};
    const auto status = [&](const Bytes& stored) {
        return read_matrices_status(file_with(stored, Codec::Png, 48), shape);
    };
    const Bytes good = png_section({png});
    REQUIRE(status(good) == GEOIDX_OK);
    for (const std::uint64_t length : {std::uint64_t{0}, std::uint64_t{png.size() - 1},
                                       std::uint64_t{png.size() + 1}, ~std::uint64_t{0}}) {
        Bytes stored = good;
        put(stored, 4, length, 8);
        CHECK(status(stored) == GEOIDX_ERROR_CORRUPT);
    }
    Bytes many = good;
    put(many, 0, 0xFFFFFFFF, 4);
    CHECK(status(many) == GEOIDX_ERROR_CORRUPT);
    Bytes trailing = good;
    trailing.push_back(std::byte{0});
    CHECK(status(trailing) == GEOIDX_ERROR_CORRUPT);
    CHECK(status(Bytes(3)) == GEOIDX_ERROR_CORRUPT);
    const Container container = Container::parse(many = file_with(many, Codec::Png, 48), TWO_TAGS);
    CHECK(status_of([&] { container.png_streams(DATA, 0xFFFFFFFF); }) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("images are not bytes, and bytes are not images") {
    const Bytes images = file_with(png_section({}), Codec::Png, 0);
    CHECK(read_status(images, NO_LIMIT) == GEOIDX_ERROR_CORRUPT);
    // The very bytes of a section without images, but stored as raw.
    const Bytes raw = file_with(png_section({}), Codec::Raw, 4);
    const Container container = Container::parse(raw, TWO_TAGS);
    CHECK(status_of([&] { container.png_streams(DATA, 0); }) == GEOIDX_ERROR_CORRUPT);
}
