#include <array>
#include <limits>
#include <map>
#include <memory>

#include "bench/commands.h"
#include "bench/lossless_tables.h"
#include "bench/other_codings.h"
#include "bench/report.h"
#include "tools/failure.h"
#include "tools/library.h"

namespace geodesic::bench {

namespace {

struct FilesArguments {
    std::vector<std::string> files;
    ReportArguments report;
};

constexpr std::array COLUMNS{"META", "HIER", "VERT", "POSI", "BORD", "QUAN",   "SEGM", "PAIR",
                             "EDGE", "OVOV", "BVIV", "IVIV", "HOPS", "tables", "file"};
constexpr std::array TABLE_SECTIONS{"OVOV", "BVIV", "IVIV", "HOPS"};

using Sizes = std::map<std::string, uint64_t>; // bytes by column

IndexFile saved_in(const geoidx& index, uint32_t codec, const std::string& path) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    std::vector<unsigned char> bytes = tools::saved_bytes(index, options, path);
    geoidx* opened = nullptr;
    tools::require_ok(geoidx_open_memory(bytes.data(), bytes.size(), nullptr, &opened), path);
    const tools::Index saved(opened);
    return {path, std::move(bytes), tools::sections_of(*saved, path)};
}

void add_tables(Sizes& sizes) {
    uint64_t sum = 0;
    for (const char* tag : TABLE_SECTIONS)
        if (sizes.contains(tag)) sum += sizes[tag];
    sizes["tables"] = sum;
}

Sizes sizes_of(const IndexFile& file) {
    Sizes sizes{{"file", file.bytes.size()}};
    for (const geoidx_section& section : file.sections) sizes[section.tag] = section.stored_size;
    add_tables(sizes);
    return sizes;
}

// The tables of a lossless file, in codings that the library does not write.
struct OtherSizes {
    Sizes float_zstd, gray_png;
};

OtherSizes other_sizes_of(const IndexFile& lossless) {
    OtherSizes sizes;
    for (const char* tag : {"OVOV", "BVIV", "IVIV"}) {
        const std::vector<CodeTable> tables = tables_of(lossless, tag);
        sizes.float_zstd[tag] = bytes_as_float_zstd(tables);
        sizes.gray_png[tag] = bytes_as_gray_png(tables);
    }
    add_tables(sizes.float_zstd);
    add_tables(sizes.gray_png);
    return sizes;
}

Row row_of(const std::string& path, const std::string& form, const Sizes& sizes, uint64_t vertices) {
    Row row{{"index", "index", path}, {"form", "form", form}};
    for (const char* column : COLUMNS) {
        const auto found = sizes.find(column);
        const double bytes = found == sizes.end() ? std::numeric_limits<double>::quiet_NaN()
                                                  : static_cast<double>(found->second);
        row.push_back(
            {std::string(column) + "_bytes_per_vertex", column, bytes / static_cast<double>(vertices)});
    }
    return row;
}

void add_rows(Table& table, const std::string& path) {
    const tools::Index index = tools::open_index(path, nullptr);
    const geoidx_info info = tools::info_of(*index, path);
    if (info.engine != GEOIDX_ENGINE_OVERLAY) throw tools::Failure(path + ": is not of the overlay engine");
    const auto add = [&](const std::string& form, const Sizes& sizes) {
        table.rows.push_back(row_of(path, form, sizes, info.welded_vertex_count));
    };
    OtherSizes others;
    for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
        const IndexFile file = saved_in(*index, codec, path);
        add(tools::CODEC_NAMES[codec], sizes_of(file));
        if (codec == GEOIDX_CODEC_LOSSLESS) others = other_sizes_of(file);
    }
    add("float32 + zstd 19", others.float_zstd);
    add("16-bit PNG", others.gray_png);
}

void files(const FilesArguments& arguments) {
    Report report("files", {}, arguments.report);
    Table table{"files", "Bytes a vertex", {}};
    for (const std::string& file : arguments.files) {
        progress(file);
        add_rows(table, file);
    }
    report.add(std::move(table));
    report.note("Vertices are those that a triangle uses, after welding. The column 'tables' is the sum of "
                "OVOV, BVIV, IVIV and HOPS. For comparison, the last two rows of each index have the tables "
                "of its first two in codings that the library does not write: the distances as float32, "
                "and the codes as an image for each table.");
}

}

void add_files(CLI::App& app) {
    auto arguments = std::make_shared<FilesArguments>();
    CLI::App* command =
        app.add_subcommand("files", "sizes of index files of the overlay engine, section by section");
    command->add_option("INDEX", arguments->files, "index files")->required();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { files(*arguments); });
}

}
