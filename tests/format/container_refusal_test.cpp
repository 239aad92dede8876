#include <algorithm>
#include <array>

#include <doctest/doctest.h>

#include "format/container.h"
#include "tests/format/helpers.h"

using namespace geodesic;
using namespace geodesic::format;
using namespace geodesic::format::test;

namespace {

constexpr std::uint32_t HEAD = make_tag("HEAD");
constexpr std::uint32_t TABL = make_tag("TABL");
constexpr std::uint32_t NOTE = make_tag("NOTE");
constexpr std::array KNOWN = {HEAD, TABL};
constexpr std::size_t FIRST = 0, SECOND = 1, UNKNOWN_OPTIONAL = 2;

// A section of each codec; the raw one is optional and unknown to the reader.
Bytes sample() {
    const auto values = random_floats(12, 1);
    ContainerWriter writer(42);
    writer.add_bytes(HEAD, random_bytes(50, 1));
    writer.add_matrices(TABL, std::vector<MatrixView>{{values, 3, 4}, {values, 2, 6}});
    writer.add_raw(NOTE, random_bytes(30, 2), SECTION_OPTIONAL);
    return writer.finish();
}

geoidx_status parse_status(const Bytes& file, std::string* message = nullptr) {
    return status_of([&] { Container::parse(file, KNOWN); }, message);
}

Bytes cut(const Bytes& file, std::size_t length) {
    return {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)};
}

Bytes text(const std::string& characters) {
    Bytes bytes;
    for (const char character : characters) bytes.push_back(static_cast<std::byte>(character));
    return bytes;
}

}

TEST_CASE("an index cut at any length is refused as truncated") {
    const Bytes file = sample();
    REQUIRE(parse_status(file) == GEOIDX_OK);
    for (std::size_t length = 0; length < file.size(); ++length) {
        CAPTURE(length);
        CHECK(parse_status(cut(file, length)) == GEOIDX_ERROR_TRUNCATED);
        CHECK_FALSE(inspect(cut(file, length), KNOWN).empty());
    }
}

TEST_CASE("an index with any single byte changed is refused") {
    const Bytes file = sample();
    for (std::size_t at = 0; at < file.size(); ++at) {
        for (const int change : {0x01, 0x02, 0x04, 0x08, 0x10, 0x20, 0x40, 0x80, 0x7F, 0xFF}) {
            CAPTURE(at);
            CAPTURE(change);
            Bytes changed = file;
            changed[at] ^= static_cast<std::byte>(change);
            const geoidx_status status = parse_status(changed);
            CHECK(status != GEOIDX_OK);
            const auto issues = inspect(changed, KNOWN);
            REQUIRE_FALSE(issues.empty());
            CHECK(issues.front().status == status);
        }
    }
}

TEST_CASE("an index with any single byte removed or added is refused") {
    const Bytes file = sample();
    for (std::size_t at = 0; at < file.size(); ++at) {
        CAPTURE(at);
        Bytes shorter = file;
        shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(at));
        CHECK(parse_status(shorter) != GEOIDX_OK);
        Bytes longer = file;
        longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), std::byte{0});
        CHECK(parse_status(longer) != GEOIDX_OK);
    }
}

TEST_CASE("what does not begin like an index is told from an index that is cut short") {
    CHECK(parse_status(text("")) == GEOIDX_ERROR_TRUNCATED);
    CHECK(parse_status(text("\x89GID")) == GEOIDX_ERROR_TRUNCATED);
    CHECK(parse_status(text("#")) == GEOIDX_ERROR_NOT_AN_INDEX);
    CHECK(parse_status(text("v 0 0 0\nv 1 0 0\nf 1 2 3\n")) == GEOIDX_ERROR_NOT_AN_INDEX);
    CHECK(parse_status(Bytes(1000)) == GEOIDX_ERROR_NOT_AN_INDEX);
}

TEST_CASE("an index transferred as text says so") {
    Bytes file = sample();
    file.erase(file.begin() + 5);
    std::string message;
    CHECK(parse_status(file, &message) == GEOIDX_ERROR_NOT_AN_INDEX);
    CHECK(message.find("as text") != std::string::npos);
}

TEST_CASE("another major version and unknown incompatible features are unsupported") {
    CHECK(parse_status(patched(sample(), MAJOR, 1, 2)) == GEOIDX_ERROR_UNSUPPORTED_VERSION);
    CHECK(parse_status(patched(sample(), MAJOR, 3, 2)) == GEOIDX_ERROR_UNSUPPORTED_VERSION);
    CHECK(parse_status(patched(sample(), INCOMPATIBLE, 1, 4)) == GEOIDX_ERROR_UNSUPPORTED_VERSION);
    CHECK(parse_status(patched(sample(), INCOMPATIBLE, 0x80000000, 4)) == GEOIDX_ERROR_UNSUPPORTED_VERSION);
}

TEST_CASE("a newer minor version and unknown compatible features are accepted") {
    const Bytes newer = patched(sample(), MINOR, 7, 2);
    CHECK(Container::parse(newer, KNOWN).version_minor() == 7);
    CHECK(parse_status(patched(sample(), COMPATIBLE, 0xFFFFFFFF, 4)) == GEOIDX_OK);
}

TEST_CASE("a file that is not as long as its header says is refused") {
    const Bytes file = sample();
    CHECK(parse_status(patched(file, FILE_SIZE, file.size() + 1, 8)) == GEOIDX_ERROR_TRUNCATED);
    CHECK(parse_status(patched(file, FILE_SIZE, ~std::uint64_t{0}, 8)) == GEOIDX_ERROR_TRUNCATED);
    CHECK(parse_status(patched(file, FILE_SIZE, file.size() - 1, 8)) == GEOIDX_ERROR_CORRUPT);
    CHECK(parse_status(patched(file, FILE_SIZE, 0, 8)) == GEOIDX_ERROR_CORRUPT);
    Bytes longer = file;
    longer.push_back(std::byte{0});
    CHECK(parse_status(longer) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("bytes after the last section are refused even when the header counts them") {
    Bytes longer = sample();
    longer.push_back(std::byte{0});
    CHECK(parse_status(patched(longer, FILE_SIZE, longer.size(), 8)) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a count of sections that does not fit is refused before memory is allocated for it") {
    CHECK(parse_status(patched(sample(), SECTION_COUNT, 1000, 4)) == GEOIDX_ERROR_CORRUPT);
    Bytes file = sample();
    put(file, SECTION_COUNT, 0xFFFFFFFF, 4);
    CHECK(parse_status(file) == GEOIDX_ERROR_LIMIT);
    Bytes large = sample();
    large.resize(48 * 2000);
    put(large, FILE_SIZE, large.size(), 8);
    CHECK(parse_status(patched(large, SECTION_COUNT, 1025, 4)) == GEOIDX_ERROR_LIMIT);
}

TEST_CASE("a section outside the file is refused") {
    const Bytes file = sample();
    const std::size_t last = record(UNKNOWN_OPTIONAL);
    for (const std::uint64_t value :
         {std::uint64_t{file.size()}, std::uint64_t{1} << 63, ~std::uint64_t{0}, ~std::uint64_t{0} - 63}) {
        CAPTURE(value);
        CHECK(parse_status(patched(file, last + OFFSET, value, 8)) == GEOIDX_ERROR_CORRUPT);
        CHECK(parse_status(patched(file, last + STORED_SIZE, value, 8)) == GEOIDX_ERROR_CORRUPT);
    }
    // Offset and size whose sum is the end of the section again, in 64-bit arithmetic.
    Bytes wrapped = file;
    const std::uint64_t end = get(file, last + OFFSET, 8) + get(file, last + STORED_SIZE, 8);
    put(wrapped, last + OFFSET, 0 - std::uint64_t{64}, 8);
    CHECK(parse_status(patched(wrapped, last + STORED_SIZE, end + 64, 8)) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a section so long that its end wraps around to where the next one may begin is refused") {
    ContainerWriter writer(0);
    writer.add_raw(HEAD, Bytes(10));
    writer.add_raw(TABL, Bytes(10));
    Bytes file = writer.finish();
    const std::uint64_t wrapping = 0 - std::uint64_t{42};
    put(file, record(FIRST) + STORED_SIZE, wrapping, 8);
    put(file, record(FIRST) + RAW_SIZE, wrapping, 8);
    const std::uint64_t begin = get(file, record(FIRST) + OFFSET, 8);
    const std::uint64_t size = file.size() - begin;
    put(file, record(SECOND) + OFFSET, begin, 8);
    put(file, record(SECOND) + STORED_SIZE, size, 8);
    put(file, record(SECOND) + RAW_SIZE, size, 8);
    put(file, record(SECOND) + CHECKSUM, XXH3_64bits(file.data() + begin, size), 8);
    reseal(file);
    CHECK(parse_status(file) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("sections must follow each other at the next multiple of 64, without overlap or gap") {
    const Bytes file = sample();
    const std::uint64_t offset = get(file, record(SECOND) + OFFSET, 8);
    for (const std::uint64_t moved : {offset + 1, offset - 1, offset - 64, offset + 64, std::uint64_t{0}}) {
        CAPTURE(moved);
        CHECK(parse_status(patched(file, record(SECOND) + OFFSET, moved, 8)) == GEOIDX_ERROR_CORRUPT);
    }
    Bytes swapped = file;
    for (std::size_t i = 0; i < RECORD_SIZE; ++i)
        std::swap(swapped[record(FIRST) + i], swapped[record(SECOND) + i]);
    reseal(swapped);
    CHECK(parse_status(swapped) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("padding that is not zero is refused at its offset") {
    Bytes file = sample();
    const std::size_t padding = get(file, record(SECOND) + OFFSET, 8) - 1;
    REQUIRE(padding >= get(file, record(FIRST) + OFFSET, 8) + get(file, record(FIRST) + STORED_SIZE, 8));
    file[padding] = std::byte{9};
    CHECK(parse_status(file) == GEOIDX_ERROR_CORRUPT);
    const auto issues = inspect(file, KNOWN);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].offset == padding);
}

TEST_CASE("a tag that stands twice in the table is refused") {
    CHECK(parse_status(patched(sample(), record(SECOND), HEAD, 4)) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("undefined flags and reserved fields of a section are refused") {
    CHECK(parse_status(patched(sample(), record(FIRST) + FLAGS, 2, 4)) == GEOIDX_ERROR_CORRUPT);
    CHECK(parse_status(patched(sample(), record(UNKNOWN_OPTIONAL) + FLAGS, 3, 4)) == GEOIDX_ERROR_CORRUPT);
    CHECK(parse_status(patched(sample(), record(FIRST) + RESERVED, 1, 4)) == GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("an unknown section is skipped when it is optional and refused when it is not") {
    const Bytes file = sample();
    CHECK(Container::parse(file, KNOWN).sections().size() == 3);
    CHECK(parse_status(patched(file, record(UNKNOWN_OPTIONAL) + FLAGS, 0, 4)) ==
          GEOIDX_ERROR_UNSUPPORTED_VERSION);
    CHECK(parse_status(patched(file, record(FIRST), make_tag("NEW!"), 4)) ==
          GEOIDX_ERROR_UNSUPPORTED_VERSION);
}

TEST_CASE("an unknown codec is refused in a known section only") {
    CHECK(parse_status(patched(sample(), record(FIRST) + CODEC, 4, 4)) == GEOIDX_ERROR_UNSUPPORTED_VERSION);
    CHECK(parse_status(patched(sample(), record(UNKNOWN_OPTIONAL) + CODEC, 4, 4)) == GEOIDX_OK);
}

TEST_CASE("a raw size that the stored bytes cannot hold is refused") {
    CHECK(parse_status(patched(sample(), record(FIRST) + CODEC, 0, 4)) == GEOIDX_ERROR_CORRUPT);
    CHECK(parse_status(patched(sample(), record(SECOND) + RAW_SIZE, std::uint64_t{1} << 40, 8)) ==
          GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a small file cannot ask for much memory: what packs too well is stored raw, and refused packed") {
    const Bytes zeros(std::size_t{1} << 20);
    ContainerWriter writer(0);
    writer.add_bytes(make_tag("ZERO"), zeros);
    const Bytes file = writer.finish();
    CHECK(file.size() > zeros.size());
    const std::uint32_t known[] = {make_tag("ZERO")};
    CHECK(Container::parse(file, known).read_bytes(make_tag("ZERO"), zeros.size()) == zeros);

    CHECK(parse_status(patched(sample(), record(FIRST) + RAW_SIZE, std::uint64_t{1} << 20, 8)) ==
          GEOIDX_ERROR_CORRUPT);
}

TEST_CASE("a wrong checksum is told from other damage") {
    Bytes header = sample();
    put(header, HEADER_CHECKSUM, get(header, HEADER_CHECKSUM, 8) ^ 1, 8);
    CHECK(parse_status(header) == GEOIDX_ERROR_CHECKSUM);
    for (const std::size_t index : {FIRST, SECOND, UNKNOWN_OPTIONAL}) {
        Bytes file = sample();
        file[get(file, record(index) + OFFSET, 8)] ^= std::byte{1};
        CHECK(parse_status(file) == GEOIDX_ERROR_CHECKSUM);
    }
}

TEST_CASE("a message names the section, its offset and the value") {
    std::string message;
    CHECK(parse_status(patched(sample(), record(FIRST) + RESERVED, 77, 4), &message) == GEOIDX_ERROR_CORRUPT);
    CHECK(message.find("'HEAD'") != std::string::npos);
    CHECK(message.find("offset 192") != std::string::npos);
    CHECK(message.find("77") != std::string::npos);
}

TEST_CASE("inspection goes on after a problem and reports every damaged section") {
    Bytes file = sample();
    put(file, MINOR, 5, 2);
    const std::size_t first = get(file, record(FIRST) + OFFSET, 8);
    const std::size_t last = get(file, record(UNKNOWN_OPTIONAL) + OFFSET, 8);
    file[first + 3] ^= std::byte{1};
    file[last] ^= std::byte{1};
    file.push_back(std::byte{0});
    const auto issues = inspect(file, KNOWN);
    REQUIRE(issues.size() == 4);
    CHECK(issues[0].status == GEOIDX_ERROR_CORRUPT);
    CHECK(issues[1].status == GEOIDX_ERROR_CHECKSUM);
    CHECK(issues[1].offset == HEADER_CHECKSUM);
    CHECK(issues[2].status == GEOIDX_ERROR_CHECKSUM);
    CHECK(issues[2].offset == first);
    CHECK(issues[2].message.find("'HEAD'") != std::string::npos);
    CHECK(issues[3].offset == last);
}

// Numbers and statuses are those of the table in SPEC.md.
TEST_CASE("every rule has its number, and what breaks it its place") {
    const Bytes file = sample();
    const auto check = [](const Bytes& damaged, std::uint32_t number, geoidx_status status,
                          std::uint64_t offset) {
        CAPTURE(number);
        const auto issues = inspect(damaged, KNOWN);
        REQUIRE_FALSE(issues.empty());
        CHECK(issues[0].number == number);
        CHECK(issues[0].status == status);
        CHECK(issues[0].offset == offset);
    };
    check(text("v 0 0 0\nv 1 0 0\n"), 1, GEOIDX_ERROR_NOT_AN_INDEX, 0);
    for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{8}, std::size_t{47}})
        check(cut(file, length), 2, GEOIDX_ERROR_TRUNCATED, length);
    check(patched(file, MAJOR, 3, 2), 3, GEOIDX_ERROR_UNSUPPORTED_VERSION, 8);
    check(patched(file, INCOMPATIBLE, 1, 4), 4, GEOIDX_ERROR_UNSUPPORTED_VERSION, 12);
    for (const std::size_t length : {std::size_t{48}, file.size() - 1})
        check(cut(file, length), 5, GEOIDX_ERROR_TRUNCATED, length);
    Bytes longer = file;
    longer.push_back(std::byte{0});
    check(longer, 6, GEOIDX_ERROR_CORRUPT, 24);
    check(patched(file, SECTION_COUNT, 1025, 4), 7, GEOIDX_ERROR_LIMIT, 20);
    check(patched(file, SECTION_COUNT, 1000, 4), 8, GEOIDX_ERROR_CORRUPT, 20);

    const std::size_t first = record(FIRST), second = record(SECOND), last = record(UNKNOWN_OPTIONAL);
    check(patched(file, last + STORED_SIZE, file.size(), 8), 9, GEOIDX_ERROR_CORRUPT, last);
    const std::uint64_t place = get(file, second + OFFSET, 8);
    check(patched(file, second + OFFSET, place + 1, 8), 10, GEOIDX_ERROR_CORRUPT, second);
    check(patched(file, second, HEAD, 4), 11, GEOIDX_ERROR_CORRUPT, second);
    check(patched(file, last + FLAGS, 3, 4), 12, GEOIDX_ERROR_CORRUPT, last);
    check(patched(file, first + RESERVED, 1, 4), 12, GEOIDX_ERROR_CORRUPT, first);
    check(patched(file, last + FLAGS, 0, 4), 13, GEOIDX_ERROR_UNSUPPORTED_VERSION, last);
    check(patched(file, first + CODEC, 4, 4), 14, GEOIDX_ERROR_UNSUPPORTED_VERSION, first);
    check(patched(file, second + RAW_SIZE, std::uint64_t{1} << 40, 8), 15, GEOIDX_ERROR_CORRUPT, second);
    check(patched(longer, FILE_SIZE, longer.size(), 8), 16, GEOIDX_ERROR_CORRUPT, file.size());

    Bytes header = file;
    header[HEADER_CHECKSUM] ^= std::byte{1};
    check(header, 17, GEOIDX_ERROR_CHECKSUM, 40);
    Bytes padded = file;
    padded[place - 1] = std::byte{9};
    check(padded, 18, GEOIDX_ERROR_CORRUPT, place - 1);
    Bytes changed = file;
    changed[place + 2] ^= std::byte{1};
    check(changed, 19, GEOIDX_ERROR_CHECKSUM, place);
}

TEST_CASE("matrices are not stored as images of bytes") {
    const auto values = random_floats(2048, 5);
    ContainerWriter writer(42);
    writer.add_images(TABL, std::as_bytes(std::span(values)));
    const Bytes file = writer.finish();
    std::vector<float> entries(values.size());
    const MatrixTarget target{entries, 32, 64};
    std::string message;
    CHECK(status_of(
              [&] {
                  Container::parse(file, KNOWN).read_matrices(TABL, {&target, 1});
              },
              &message) == GEOIDX_ERROR_CORRUPT);
    CHECK(message.find("images of bytes") != std::string::npos);
}

TEST_CASE("an error of decoding says whether the stored bytes or what they should hold is at fault") {
    const auto error_of = [](const Bytes& file, auto&& read) {
        try {
            read(Container::parse(file, KNOWN));
        } catch (const Error& error) {
            return std::pair(error.section, error.is_undecodable);
        }
        return std::pair(std::uint32_t{0}, false);
    };
    const auto read_head = [](const Container& container) { container.read_bytes(HEAD, 50); };
    const auto read_table = [](const Container& container) {
        std::vector<float> entries(24);
        const MatrixTarget targets[] = {{std::span(entries).first(12), 3, 4},
                                        {std::span(entries).last(12), 2, 6}};
        container.read_matrices(TABL, targets);
    };
    const Bytes file = sample();
    CHECK(error_of(file, read_head) == std::pair(std::uint32_t{0}, false));
    CHECK(error_of(file, read_table) == std::pair(std::uint32_t{0}, false));

    const auto with_stored_byte = [&](std::size_t index, std::uint64_t at) {
        Bytes damaged = file;
        const std::uint64_t begin = get(file, record(index) + OFFSET, 8);
        const std::uint64_t size = get(file, record(index) + STORED_SIZE, 8);
        damaged[begin + at] ^= std::byte{0x01};
        return patched(damaged, record(index) + CHECKSUM, XXH3_64bits(damaged.data() + begin, size), 8);
    };
    constexpr std::uint64_t LENGTH_OF_STREAM = 4, SIGNATURE = 4 + 2 * 8;
    CHECK(error_of(with_stored_byte(FIRST, 0), read_head) == std::pair(HEAD, true)); // zstd's magic
    CHECK(error_of(with_stored_byte(SECOND, LENGTH_OF_STREAM), read_table) == std::pair(TABL, true));
    CHECK(error_of(with_stored_byte(SECOND, SIGNATURE), read_table) == std::pair(TABL, true));
    CHECK(error_of(with_stored_byte(SECOND, 0), read_table) == std::pair(TABL, false)); // the count

    CHECK(error_of(file, [](const Container& container) { container.read_bytes(HEAD, 49); }) ==
          std::pair(HEAD, false));
    CHECK(error_of(file, [](const Container& container) { container.read_bytes(TABL, 1000); }) ==
          std::pair(TABL, false));
    CHECK(error_of(ContainerWriter(0).finish(), read_head) == std::pair(HEAD, false));
}
