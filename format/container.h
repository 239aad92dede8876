#pragma once

// The file as a container: a header, a table of sections and the sections' stored bytes. SPEC.md is the norm.
// Nothing here knows what a section means.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "format/error.h"

namespace geodesic::format {

inline constexpr std::uint16_t FORMAT_MAJOR = 2;
inline constexpr std::uint16_t FORMAT_MINOR = 0;
inline constexpr std::uint32_t MAX_SECTIONS = 1024;

// The tag of four characters as it stands in the file, the first character first.
constexpr std::uint32_t make_tag(const char (&name)[5]) {
    std::uint32_t tag = 0;
    for (int i = 3; i >= 0; --i) tag = tag << 8 | static_cast<unsigned char>(name[i]);
    return tag;
}

// A tag for messages: 'HEAD', with bytes that are not printable as \xNN.
std::string tag_text(std::uint32_t tag);

enum class Codec : std::uint32_t {
    Raw = 0,  // the raw bytes themselves
    Zstd = 1, // one zstd frame
    // u32 count, count u64 byte lengths, as many PNG streams back to back:
    Png = 2,       // one matrix of floats each
    ByteImages = 3 // the raw bytes, cut into images (byte_images.h)
};

// Flags of a section. A reader that does not know the tag of an optional section skips it.
inline constexpr std::uint32_t SECTION_OPTIONAL = 1;

struct Section {
    std::uint32_t tag = 0;
    Codec codec = Codec::Raw; // of a section that the reader does not know, perhaps none of the above
    std::uint32_t flags = 0;
    std::uint64_t offset = 0;      // bytes from the start of the file
    std::uint64_t stored_size = 0; // bytes in the file
    std::uint64_t raw_size = 0;    // bytes after decoding; of matrices 4 an entry
    std::uint64_t checksum = 0;    // of the stored bytes
};

// The stored bytes of a section of bytes, which someone else holds.
struct StoredBytes {
    Codec codec = Codec::Raw;
    std::uint64_t raw_size = 0;
    std::span<const std::byte> bytes;
};

struct PackedBytes {
    Codec codec = Codec::Raw;
    std::uint64_t raw_size = 0;
    std::vector<std::byte> bytes;

    StoredBytes view() const { return {codec, raw_size, bytes}; }
};

// As a section that is Zstd stores them, or Raw if they are too small then for a reader to believe.
PackedBytes pack_bytes(std::span<const std::byte> raw);

// The raw bytes of a section that is Raw or Zstd. Throws GEOIDX_ERROR_CORRUPT about the section `tag`.
std::vector<std::byte> unpack_bytes(const StoredBytes& stored, std::uint32_t tag);

// A matrix, row by row; values.size() is rows x cols, neither of them 0.
struct MatrixView {
    std::span<const float> values;
    std::uint32_t rows = 0;
    std::uint32_t cols = 0;
};

struct MatrixTarget {
    std::span<float> values;
    std::uint32_t rows = 0;
    std::uint32_t cols = 0;
};

// What becomes of sections of bytes: they are compressed, or stand in the file as they are, for readers that
// map it.
enum class Packing { Zstd, None };

// Collects sections, in the order in which they shall stand in the file. A tag added twice is
// GEOIDX_ERROR_INTERNAL.
class ContainerWriter {
public:
    explicit ContainerWriter(std::uint64_t mesh_fingerprint, Packing packing = Packing::Zstd)
        : mesh_fingerprint_(mesh_fingerprint), packing_(packing) {}

    // `flags` is 0 or SECTION_OPTIONAL.
    void add_bytes(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags = 0);
    // As they are, whatever the packing.
    void add_raw(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags = 0);
    // As another file holds them, whatever the packing.
    void add_stored(std::uint32_t tag, const StoredBytes& stored, std::uint32_t flags = 0);
    // As gray images, which pack well what has few different bytes next to each other.
    void add_images(std::uint32_t tag, std::span<const std::byte> raw, std::uint32_t flags = 0);
    void add_matrices(std::uint32_t tag, std::span<const MatrixView> matrices, std::uint32_t flags = 0);
    // The streams of a section that is Png or ByteImages, as encode_png and encode_byte_images gave them.
    // `raw_size` is that of what they hold; of matrices the sum of rows x cols x 4.
    void add_encoded_images(std::uint32_t tag, Codec codec, std::span<const std::vector<std::byte>> pngs,
                            std::uint64_t raw_size, std::uint32_t flags = 0);

    // The bytes of the file. Call it once, last.
    std::vector<std::byte> finish();

private:
    void add(std::uint32_t tag, Codec codec, std::uint32_t flags, std::vector<std::byte> stored,
             std::uint64_t raw_size);

    std::uint64_t mesh_fingerprint_;
    Packing packing_;
    std::vector<Section> sections_;
    std::vector<std::vector<std::byte>> stored_;
};

// A problem of a file: which rule it breaks (GEOIDX_ISSUE_*), where (bytes from the start of the file), and
// one line of text.
struct Issue {
    std::uint32_t number;
    geoidx_status status;
    std::uint64_t offset;
    std::string message;
};

// A checked file. Once parse has returned, every byte of the file is covered by a check that it passed; what
// the sections mean is still to be checked by who reads them.
class Container {
public:
    // `file` is not copied and must outlive the container. `known_tags` are the sections that the caller
    // understands: any other is refused unless it is optional. Throws the first problem found.
    static Container parse(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags);

    std::uint16_t version_minor() const { return version_minor_; }
    std::uint64_t mesh_fingerprint() const { return mesh_fingerprint_; }
    // In the order of the file, those that the caller does not know included.
    std::span<const Section> sections() const { return sections_; }
    bool has(std::uint32_t tag) const { return find(tag) != nullptr; }
    // Throws GEOIDX_ERROR_CORRUPT when there is none.
    const Section& section(std::uint32_t tag) const;

    // Runs decode(0) .. decode(count - 1), perhaps on several threads, and throws what these throw.
    using ShareOut = std::function<void(std::size_t count, const std::function<void(std::size_t)>& decode)>;

    // The raw bytes of a section that is Raw, Zstd or ByteImages. Throws GEOIDX_ERROR_CORRUPT, before it
    // allocates, for a missing section and for one that is larger than `max_raw_size`.
    std::vector<std::byte> read_bytes(std::uint32_t tag, std::uint64_t max_raw_size,
                                      const ShareOut& share_out = one_after_the_other) const;
    // The bytes of a section as they stand in the file, which must be Raw.
    std::span<const std::byte> view_bytes(std::uint32_t tag) const;
    // The same of one that is Raw or Zstd, to be unpacked later.
    StoredBytes view_stored(std::uint32_t tag) const;
    // Fills the matrices, which must be those of the section, all of them, in their order, whatever its
    // codec. Throws GEOIDX_ERROR_CORRUPT otherwise, with unspecified values in the matrices.
    void read_matrices(std::uint32_t tag, std::span<const MatrixTarget> matrices,
                       const ShareOut& share_out = one_after_the_other) const;
    static void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& decode);
    // The streams of a section that is Png or ByteImages. They must be `count`.
    std::vector<std::span<const std::byte>> png_streams(std::uint32_t tag, std::uint64_t count) const;

private:
    Container() = default;
    const Section* find(std::uint32_t tag) const;
    std::span<const std::byte> stored_bytes(const Section& section) const;
    std::vector<std::byte> read_images(const Section& section, const ShareOut& share_out) const;

    std::span<const std::byte> file_;
    std::uint16_t version_minor_ = 0;
    std::uint64_t mesh_fingerprint_ = 0;
    std::vector<Section> sections_;
};

// Whether a file that begins with these bytes seems to have a section, by its section table as far as it is
// there. Nothing is checked.
bool names_section(std::span<const std::byte> start, std::uint32_t tag);

// The size of a file as its header states it. `start` has the first 48 bytes of the file or more, or all of a
// shorter one. Throws as Container::parse does if the magic, the version, the flags or the sizes are wrong;
// the size is compared with `file_size` where that is known.
std::uint64_t checked_file_size(std::span<const std::byte> start, std::optional<std::uint64_t> file_size);
// Whether checked_file_size() would not throw.
bool has_valid_header(std::span<const std::byte> start, std::optional<std::uint64_t> file_size);

// Every problem that Container::parse would throw, and those behind it: after a problem that leaves the rest
// readable, the checks go on. Empty when parse would succeed.
std::vector<Issue> inspect(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags);

}
