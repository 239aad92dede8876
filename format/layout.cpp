#include "format/layout.h"

#include <algorithm>

#include "format/checksum.h"

namespace geodesic::format {
namespace {

Header read_header(std::span<const std::byte> file) {
    ByteReader reader(file.first(HEADER_SIZE), "header");
    reader.bytes(MAGIC.size());
    Header header;
    header.version_major = reader.u16();
    header.version_minor = reader.u16();
    header.incompatible_flags = reader.u32();
    header.compatible_flags = reader.u32();
    header.section_count = reader.u32();
    header.file_size = reader.u64();
    header.mesh_fingerprint = reader.u64();
    header.checksum = reader.u64();
    return header;
}

struct Record {
    Section section;
    std::uint32_t reserved = 0;
};

Record read_record(ByteReader& reader) {
    Record record;
    record.section.tag = reader.u32();
    record.section.codec = static_cast<Codec>(reader.u32());
    record.section.flags = reader.u32();
    record.reserved = reader.u32();
    record.section.offset = reader.u64();
    record.section.stored_size = reader.u64();
    record.section.raw_size = reader.u64();
    record.section.checksum = reader.u64();
    return record;
}

bool is_inside(const Section& section, std::uint64_t size) {
    return section.stored_size <= size && section.offset <= size - section.stored_size;
}

std::string section_text(const Section& section) {
    return "section " + tag_text(section.tag) + " at offset " + std::to_string(section.offset);
}

// The checks of the header alone.
class HeaderExamination {
public:
    HeaderExamination(std::span<const std::byte> start, std::optional<std::uint64_t> file_size,
                      const Report& report)
        : start_(start), file_size_(file_size), report_(report) {}

    std::optional<Header> run() {
        if (!check_magic()) return {};
        header_ = read_header(start_);
        if (!check_version() || !check_sizes()) return {};
        return header_;
    }

private:
    bool fail(std::uint32_t number, geoidx_status status, std::uint64_t offset, std::string message) const {
        report_({number, status, offset, std::move(message)});
        return false;
    }

    bool check_magic() const {
        const auto magic = std::as_bytes(std::span(MAGIC));
        const std::size_t length = std::min(start_.size(), magic.size());
        if (!std::ranges::equal(start_.first(length), magic.first(length))) {
            const bool is_text =
                length == magic.size() && std::ranges::equal(start_.first(5), magic.first(5));
            return fail(GEOIDX_ISSUE_MAGIC, GEOIDX_ERROR_NOT_AN_INDEX, 0,
                        is_text ? "the line ends in the magic are changed: the file was transferred as text"
                                : "the first " + std::to_string(length) + " bytes are not those of an index");
        }
        if (start_.size() >= HEADER_SIZE) return true;
        return fail(GEOIDX_ISSUE_HEADER_TRUNCATED, GEOIDX_ERROR_TRUNCATED, start_.size(),
                    "the file ends after " + std::to_string(start_.size()) + " bytes, within the header of " +
                        std::to_string(HEADER_SIZE));
    }

    bool check_version() const {
        if (header_.version_major != FORMAT_MAJOR) {
            return fail(GEOIDX_ISSUE_VERSION, GEOIDX_ERROR_UNSUPPORTED_VERSION, MAJOR_OFFSET,
                        "the file has format version " + std::to_string(header_.version_major) + "." +
                            std::to_string(header_.version_minor) + ", known is " +
                            std::to_string(FORMAT_MAJOR));
        }
        if (header_.incompatible_flags == 0) return true;
        return fail(GEOIDX_ISSUE_FEATURE_FLAGS, GEOIDX_ERROR_UNSUPPORTED_VERSION, INCOMPATIBLE_FLAGS_OFFSET,
                    "the file needs features unknown here, flags " +
                        std::to_string(header_.incompatible_flags));
    }

    void check_file_size(std::uint64_t size) const {
        const std::string sizes = "the file has " + std::to_string(size) + " bytes, its header says " +
                                  std::to_string(header_.file_size);
        if (size < header_.file_size) fail(GEOIDX_ISSUE_FILE_TRUNCATED, GEOIDX_ERROR_TRUNCATED, size, sizes);
        if (size > header_.file_size)
            fail(GEOIDX_ISSUE_FILE_TOO_LONG, GEOIDX_ERROR_CORRUPT, FILE_SIZE_OFFSET, sizes);
    }

    // False when the section table cannot be read.
    bool check_sizes() const {
        if (file_size_) check_file_size(*file_size_);
        const std::string count = std::to_string(header_.section_count) + " sections";
        if (header_.section_count > MAX_SECTIONS) {
            return fail(GEOIDX_ISSUE_SECTION_COUNT, GEOIDX_ERROR_LIMIT, SECTION_COUNT_OFFSET,
                        count + ", the limit is " + std::to_string(MAX_SECTIONS));
        }
        if (table_end(header_.section_count) > header_.file_size) {
            return fail(GEOIDX_ISSUE_SECTION_TABLE, GEOIDX_ERROR_CORRUPT, SECTION_COUNT_OFFSET,
                        count + " do not fit into " + std::to_string(header_.file_size) + " bytes");
        }
        return table_end(header_.section_count) <= file_size_.value_or(header_.file_size);
    }

    std::span<const std::byte> start_;
    std::optional<std::uint64_t> file_size_;
    const Report& report_;
    Header header_;
};

class Examination {
public:
    Examination(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags,
                const Report& report)
        : file_(file), known_tags_(known_tags), report_(report) {}

    Layout run() {
        const auto header = examine_header(file_, file_.size(), report_);
        if (!header) return {};
        layout_.header = *header;
        check_table();
        check_header_checksum();
        check_contents();
        return std::move(layout_);
    }

private:
    void fail(std::uint32_t number, geoidx_status status, std::uint64_t offset, std::string message) const {
        report_({number, status, offset, std::move(message)});
    }

    void check_table() {
        std::uint64_t end = table_end(layout_.header.section_count);
        ByteReader reader(file_.first(end).subspan(HEADER_SIZE), "section table");
        for (std::uint32_t i = 0; i < layout_.header.section_count; ++i) {
            const std::uint64_t at = HEADER_SIZE + reader.position();
            const Record record = read_record(reader);
            check_place(record.section, end, at);
            check_kind(record, at);
            check_raw_size(record.section, at);
            end = record.section.offset + record.section.stored_size;
            layout_.sections.push_back(record.section);
        }
        if (end != layout_.header.file_size) {
            fail(GEOIDX_ISSUE_FILE_END, GEOIDX_ERROR_CORRUPT, std::min<std::uint64_t>(end, file_.size()),
                 "the last section ends at offset " + std::to_string(end) + ", the file at " +
                     std::to_string(layout_.header.file_size));
        }
    }

    void check_place(const Section& section, std::uint64_t previous_end, std::uint64_t at) const {
        if (!is_inside(section, layout_.header.file_size)) {
            fail(GEOIDX_ISSUE_SECTION_OUTSIDE, GEOIDX_ERROR_CORRUPT, at,
                 section_text(section) + " with " + std::to_string(section.stored_size) +
                     " bytes is not inside the file of " + std::to_string(layout_.header.file_size));
        }
        if (section.offset != align_section(previous_end)) {
            fail(GEOIDX_ISSUE_SECTION_PLACE, GEOIDX_ERROR_CORRUPT, at,
                 section_text(section) + " must stand at offset " +
                     std::to_string(align_section(previous_end)));
        }
    }

    void check_kind(const Record& record, std::uint64_t at) const {
        const Section& section = record.section;
        const auto same_tag = [&](const Section& other) { return other.tag == section.tag; };
        if (std::ranges::any_of(layout_.sections, same_tag)) {
            fail(GEOIDX_ISSUE_SECTION_TWICE, GEOIDX_ERROR_CORRUPT, at,
                 section_text(section) + " is there twice");
        }
        if ((section.flags & ~SECTION_OPTIONAL) != 0) {
            fail(GEOIDX_ISSUE_SECTION_FLAGS, GEOIDX_ERROR_CORRUPT, at,
                 section_text(section) + " has undefined flags " + std::to_string(section.flags));
        }
        if (record.reserved != 0) {
            fail(GEOIDX_ISSUE_SECTION_FLAGS, GEOIDX_ERROR_CORRUPT, at,
                 section_text(section) + " has " + std::to_string(record.reserved) +
                     " in the reserved field, not 0");
        }
        if (!is_known(section) && (section.flags & SECTION_OPTIONAL) == 0) {
            fail(GEOIDX_ISSUE_SECTION_UNKNOWN, GEOIDX_ERROR_UNSUPPORTED_VERSION, at,
                 section_text(section) + " is needed and unknown here");
        }
        if (is_known(section) && section.codec > Codec::ByteImages) {
            fail(GEOIDX_ISSUE_SECTION_CODEC, GEOIDX_ERROR_UNSUPPORTED_VERSION, at,
                 section_text(section) + " has codec " +
                     std::to_string(static_cast<std::uint32_t>(section.codec)) + ", unknown here");
        }
    }

    // Refuses what cannot be true, before someone allocates memory for it.
    void check_raw_size(const Section& section, std::uint64_t at) const {
        const bool is_wrong = section.codec == Codec::Raw
                                  ? section.raw_size != section.stored_size
                                  : section.raw_size / MAX_PACKING > section.stored_size;
        if (!is_wrong || !is_known(section)) return;
        fail(GEOIDX_ISSUE_SECTION_SIZE, GEOIDX_ERROR_CORRUPT, at,
             section_text(section) + " cannot hold " + std::to_string(section.raw_size) + " raw bytes in " +
                 std::to_string(section.stored_size));
    }

    void check_header_checksum() const {
        const auto covered = file_.first(table_end(layout_.header.section_count));
        if (header_checksum(covered) == layout_.header.checksum) return;
        fail(GEOIDX_ISSUE_HEADER_CHECKSUM, GEOIDX_ERROR_CHECKSUM, CHECKSUM_OFFSET,
             "the checksum of the header and the section table does not match");
    }

    void check_contents() const {
        std::uint64_t end = table_end(layout_.header.section_count);
        for (const Section& section : layout_.sections) {
            check_padding(end, section);
            check_section_checksum(section);
            end = section.offset + section.stored_size;
        }
    }

    void check_padding(std::uint64_t begin, const Section& section) const {
        const std::uint64_t end = section.offset;
        if (begin > end || end > file_.size() || end - begin >= SECTION_ALIGNMENT) return;
        const auto padding = file_.subspan(begin, end - begin);
        const auto wrong = std::ranges::find_if(padding, [](std::byte byte) { return byte != std::byte{0}; });
        if (wrong == padding.end()) return;
        fail(GEOIDX_ISSUE_PADDING, GEOIDX_ERROR_CORRUPT,
             begin + static_cast<std::uint64_t>(wrong - padding.begin()),
             "the padding before " + section_text(section) + " is " +
                 std::to_string(std::to_integer<int>(*wrong)) + ", not 0");
    }

    void check_section_checksum(const Section& section) const {
        if (!is_inside(section, file_.size())) return;
        if (checksum(file_.subspan(section.offset, section.stored_size)) == section.checksum) return;
        fail(GEOIDX_ISSUE_SECTION_CHECKSUM, GEOIDX_ERROR_CHECKSUM, section.offset,
             "the checksum of " + section_text(section) + " with " + std::to_string(section.stored_size) +
                 " bytes does not match");
    }

    bool is_known(const Section& section) const {
        return std::ranges::find(known_tags_, section.tag) != known_tags_.end();
    }

    std::span<const std::byte> file_;
    std::span<const std::uint32_t> known_tags_;
    const Report& report_;
    Layout layout_;
};

}

void write_header(ByteWriter& writer, const Header& header) {
    writer.bytes(std::as_bytes(std::span(MAGIC)));
    writer.u16(header.version_major);
    writer.u16(header.version_minor);
    writer.u32(header.incompatible_flags);
    writer.u32(header.compatible_flags);
    writer.u32(header.section_count);
    writer.u64(header.file_size);
    writer.u64(header.mesh_fingerprint);
    writer.u64(header.checksum);
}

void write_section_record(ByteWriter& writer, const Section& section) {
    writer.u32(section.tag);
    writer.u32(static_cast<std::uint32_t>(section.codec));
    writer.u32(section.flags);
    writer.u32(0);
    writer.u64(section.offset);
    writer.u64(section.stored_size);
    writer.u64(section.raw_size);
    writer.u64(section.checksum);
}

std::uint64_t header_checksum(std::span<const std::byte> header_and_table) {
    std::vector<std::byte> covered(header_and_table.begin(), header_and_table.end());
    std::ranges::fill(std::span(covered).subspan(CHECKSUM_OFFSET, sizeof(Header::checksum)), std::byte{0});
    return checksum(covered);
}

std::optional<Header> examine_header(std::span<const std::byte> start, std::optional<std::uint64_t> file_size,
                                     const Report& report) {
    return HeaderExamination(start, file_size, report).run();
}

Layout examine(std::span<const std::byte> file, std::span<const std::uint32_t> known_tags,
               const Report& report) {
    return Examination(file, known_tags, report).run();
}

bool names_section(std::span<const std::byte> start, std::uint32_t tag) {
    for (std::uint64_t at = HEADER_SIZE; at + sizeof tag <= start.size() && at < table_end(MAX_SECTIONS);
         at += SECTION_RECORD_SIZE)
        if (load_little_endian<std::uint32_t>(start.data() + at) == tag) return true;
    return false;
}

}
