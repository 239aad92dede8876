// The tables of the overlay engine as what their prediction leaves: a byte an entry, and two more bytes for
// the few entries that are too far from it.
#include <algorithm>
#include <atomic>
#include <string>

#include "format/bytes.h"
#include "src/base/shared_tasks.h"
#include "src/file/code_tables.h"
#include "src/file/prediction.h"
#include "src/file/sections.h"
#include "src/overlay/tables/codes.h"

namespace geodesic {

namespace {

constexpr auto FAR_OFF = std::byte{0x80};
constexpr int32_t MOST_OFF = 127;
constexpr uint16_t NO_PATH_STORED = 0xffff;

// ---- To the file

class Residuals {
public:
    void add(const StoredIndex& stored, const CodeTable& table, const uint16_t* codes) {
        TablePrediction prediction(stored, table);
        const int shift = stored.shift[table.patch];
        prediction.walk([&](int32_t predicted) {
            const uint16_t code = *codes++;
            const bool has_path = code != TableCode::UNREACHED;
            const int32_t steps = has_path ? code >> shift : TablePrediction::NO_PATH;
            add(steps, predicted);
            return steps;
        });
    }

    std::vector<std::byte> take() {
        near_.bytes(far_.take());
        return near_.take();
    }

private:
    void add(int32_t steps, int32_t predicted) {
        if (steps != TablePrediction::NO_PATH && std::abs(steps - predicted) <= MOST_OFF)
            return near_.u8(static_cast<uint8_t>(steps - predicted));
        near_.u8(std::to_integer<uint8_t>(FAR_OFF));
        far_.u16(steps == TablePrediction::NO_PATH ? NO_PATH_STORED : static_cast<uint16_t>(steps));
    }

    format::ByteWriter near_, far_;
};

void write_tables(uint32_t tag, const StoredIndex& stored, std::span<const CodeTable> tables,
                  std::span<const uint16_t> codes, format::ContainerWriter& writer) {
    Residuals residuals;
    for (const CodeTable& table : tables) residuals.add(stored, table, codes.data() + table.begin);
    writer.add_images(tag, residuals.take());
}

// ---- From the file

// Reads one table. Returns whether all of its entries are codes.
bool read_table(const StoredIndex& stored, const CodeTable& table, const std::byte* near,
                const std::byte* far, uint16_t* codes) {
    TablePrediction prediction(stored, table);
    const int shift = stored.shift[table.patch];
    const int32_t most = prediction.most_steps();
    bool all_right = true;
    prediction.walk([&](int32_t predicted) {
        const std::byte residual = *near++;
        int32_t steps = predicted + static_cast<int8_t>(residual);
        if (residual == FAR_OFF) {
            const auto stated = format::load_little_endian<uint16_t>(far);
            far += sizeof(uint16_t);
            steps = stated == NO_PATH_STORED ? TablePrediction::NO_PATH : stated;
            if (stated == NO_PATH_STORED) {
                *codes++ = TableCode::UNREACHED;
                return steps;
            }
        }
        if (steps < 0 || steps > most) {
            all_right = false;
            steps = 0;
        }
        *codes++ = static_cast<uint16_t>(steps << shift);
        return steps;
    });
    return all_right;
}

// Reads what can be read of a table without predicting it. Returns whether the entries that are far off are
// codes.
bool are_codes(std::span<const std::byte> far, int32_t most) {
    for (size_t i = 0; i < far.size(); i += sizeof(uint16_t)) {
        const auto stated = format::load_little_endian<uint16_t>(far.data() + i);
        if (stated != NO_PATH_STORED && stated > most) return false;
    }
    return true;
}

// Where the two bytes of the entries that are far off begin, for each table.
std::vector<uint64_t> begin_of_far(std::span<const CodeTable> tables, std::span<const std::byte> raw) {
    uint64_t at = entry_count(tables);
    std::vector<uint64_t> begin;
    for (const CodeTable& table : tables) {
        begin.push_back(at);
        const auto near = raw.subspan(static_cast<size_t>(table.begin), static_cast<size_t>(table.size));
        at += sizeof(uint16_t) * static_cast<uint64_t>(std::ranges::count(near, FAR_OFF));
    }
    begin.push_back(at);
    return begin;
}

// Of a file that leaves positions out and is read without the mesh, entries are not predicted and codes stay
// 0.
bool can_predict(const StoredIndex& stored, const ReadOptions& options) {
    return !(stored.description.file_flags & GEOIDX_SAVE_NO_POSITIONS) || options.mesh;
}

std::vector<std::byte> decoded(uint32_t tag, const format::Container& container, uint32_t threads) {
    return container.read_bytes(
        tag, container.section(tag).raw_size,
        [&](size_t count, const std::function<void(size_t)>& decode) { share_out(threads, count, decode); });
}

void read_tables(uint32_t tag, const format::Container& container, const ReadOptions& options,
                 const StoredIndex& stored, std::span<const CodeTable> tables, std::vector<uint16_t>& codes) {
    const uint64_t entries = entry_count(tables), size = container.section(tag).raw_size;
    const auto refuse = [&](const std::string& detail) {
        throw Error(GEOIDX_ERROR_CORRUPT, "section " + format::tag_text(tag) + " " + detail, tag);
    };
    if (size < entries || size > entries * (1 + sizeof(uint16_t)))
        refuse("does not hold " + std::to_string(entries) + " table entries");
    constexpr uint64_t WORTH_A_THREAD = 1 << 16; // entries
    const auto threads =
        static_cast<uint32_t>(std::min<uint64_t>(options.threads, 1 + entries / WORTH_A_THREAD));
    const auto raw = decoded(tag, container, threads);
    const auto far = begin_of_far(tables, raw);
    if (far.back() != size) refuse("does not hold what its entries need");
    codes.resize(entries);
    const bool predicted = can_predict(stored, options);
    std::atomic<bool> all_right = true;
    share_out(threads, tables.size(), [&](size_t t) {
        const CodeTable& table = tables[t];
        const auto far_off = std::span(raw).subspan(far[t], far[t + 1] - far[t]);
        if (predicted ? !read_table(stored, table, raw.data() + table.begin, far_off.data(),
                                    codes.data() + table.begin)
                      : !are_codes(far_off, TableCode::LARGEST >> stored.shift[table.patch]))
            all_right = false;
    });
    if (!all_right) refuse("holds an entry that is no code of a distance");
}

}

void write_packed_tables(const StoredIndex& stored, format::ContainerWriter& writer) {
    write_tables(TAG_OVERLAY_TABLES, stored, overlay_tables(stored), stored.overlay_codes, writer);
    write_tables(TAG_BORDER_INTERNAL_TABLES, stored, border_internal_tables(stored),
                 stored.border_internal_codes, writer);
    write_tables(TAG_INTERNAL_TABLES, stored, internal_tables(stored), stored.internal_codes, writer);
}

void read_packed_tables(const format::Container& container, const ReadOptions& options, StoredIndex& stored) {
    read_tables(TAG_OVERLAY_TABLES, container, options, stored, overlay_tables(stored), stored.overlay_codes);
    read_tables(TAG_BORDER_INTERNAL_TABLES, container, options, stored, border_internal_tables(stored),
                stored.border_internal_codes);
    read_tables(TAG_INTERNAL_TABLES, container, options, stored, internal_tables(stored),
                stored.internal_codes);
}

}
