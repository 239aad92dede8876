#include "src/file/tables.h"

#include <algorithm>
#include <functional>
#include <string>

#include "format/matrix_png.h"
#include "src/base/shared_tasks.h"
#include "src/file/folded_triangle.h"
#include "src/file/sections.h"
#include "src/index/numbering.h"

namespace geodesic {

void TableSection::add(uint32_t rows, uint32_t cols) {
    if (rows == 0 || cols == 0) return;
    tables_.push_back({rows, cols, 0});
    entries_ += uint64_t{rows} * cols;
}

void TableSection::add_below_diagonal(uint32_t size) {
    if (size < 2) return;
    const FoldedShape shape = folded_shape(size);
    tables_.push_back({shape.rows, shape.cols, size});
    entries_ += uint64_t{shape.rows} * shape.cols;
}

void TableSection::write(std::span<const float> values, format::ContainerWriter& writer) const {
    std::vector<std::vector<std::byte>> streams;
    std::vector<float> folded;
    for (const auto& [rows, cols, size] : tables_) {
        auto table = values.first(size_t{rows} * cols);
        values = values.subspan(table.size());
        if (size > 0) {
            folded.clear();
            for_each_folded(size,
                            [&](uint32_t i, uint32_t j) { folded.push_back(table[below_diagonal(i, j)]); });
            table = folded;
        }
        streams.push_back(format::encode_png(table, rows, cols));
    }
    writer.add_encoded_images(tag_, format::Codec::Png, streams, entries_ * sizeof(float));
}

std::vector<float> TableSection::read(const format::Container& container, uint32_t threads) const {
    return about_section(tag_, [&] { return read_values(container, threads); });
}

std::vector<float> TableSection::read_values(const format::Container& container, uint32_t threads) const {
    if (container.section(tag_).raw_size != entries_ * sizeof(float))
        refuse_as_corrupt("section " + format::tag_text(tag_) + " does not hold " + std::to_string(entries_) +
                          " table entries");
    std::vector<float> values(entries_);
    std::vector<format::MatrixTarget> targets;
    std::span<float> left(values);
    for (const auto& [rows, cols, size] : tables_) {
        targets.push_back({left.first(size_t{rows} * cols), rows, cols});
        left = left.subspan(size_t{rows} * cols);
    }
    constexpr uint64_t WORTH_A_THREAD = 1 << 16; // entries
    threads = static_cast<uint32_t>(std::min<uint64_t>(threads, 1 + entries_ / WORTH_A_THREAD));
    container.read_matrices(tag_, targets, [&](size_t count, const std::function<void(size_t)>& decode) {
        share_out(threads, count, decode);
    });
    for (float value : values)
        if (!(value >= 0))
            refuse_as_corrupt("section " + format::tag_text(tag_) +
                              " holds a distance that is negative or NaN");
    std::vector<float> folded;
    for (size_t t = 0; t < tables_.size(); ++t) {
        if (tables_[t].size == 0) continue;
        const std::span<float> table = targets[t].values;
        folded.assign(table.begin(), table.end());
        const float* entry = folded.data();
        for_each_folded(tables_[t].size,
                        [&](uint32_t i, uint32_t j) { table[below_diagonal(i, j)] = *entry++; });
    }
    return values;
}

TableSection border_internal_section(const StoredIndex& stored) {
    TableSection section(TAG_BORDER_INTERNAL_TABLES);
    const size_t leaves = stored.internal_count.size(), first = stored.border_size.size() - leaves;
    for (size_t i = 0; i < leaves; ++i) section.add(stored.border_size[first + i], stored.internal_count[i]);
    return section;
}

TableSection internal_section(const StoredIndex& stored) {
    TableSection section(TAG_INTERNAL_TABLES);
    for (const uint32_t count : stored.internal_count) section.add_below_diagonal(count);
    return section;
}

}
