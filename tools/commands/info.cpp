#include <cstdio>
#include <filesystem>

#include "tools/commands/commands.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

struct InfoArguments {
    std::string index;
    bool json = false;
};

struct Row {
    const char* key;   // of the JSON object
    const char* label; // of the text
    std::string value;
    bool is_text = false; // quoted in JSON
};

std::string printed(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

std::string printed_fingerprint(uint64_t fingerprint) {
    char text[20];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fingerprint));
    return text;
}

std::string printed_patches(const geoidx_info& info, const char* separator) {
    std::string text;
    for (uint32_t level = 0; level < info.level_count && level < GEOIDX_MAX_LEVELS; ++level)
        text += (level ? separator : "") + std::to_string(info.patch_count[level]);
    return text;
}

uint64_t size_of_file(const std::string& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

std::vector<Row> rows_of(const geoidx_info& info, const std::string& path, bool json) {
    const std::string patches = printed_patches(info, json ? ", " : " ");
    return {
        {"metric", "metric", metric_name(info.metric), true},
        {"engine", "engine", info.engine < ENGINE_NAMES.size() ? ENGINE_NAMES[info.engine] : "unknown", true},
        {"metric_fingerprint", "metric fingerprint", printed_fingerprint(info.metric_fingerprint), true},
        {"metric_unfoldable", "metric can be unfolded",
         info.metric_flags & GEOIDX_METRIC_UNFOLDABLE ? "1" : "0"},
        {"vertex_count", "vertices", std::to_string(info.vertex_count)},
        {"triangle_count", "triangles", std::to_string(info.triangle_count)},
        {"welded_vertex_count", "distinct used vertices", std::to_string(info.welded_vertex_count)},
        {"bounding_box_diagonal", "bounding-box diagonal", printed(info.bounding_box_diagonal)},
        {"mesh_fingerprint", "mesh fingerprint", printed_fingerprint(info.mesh_fingerprint), true},
        {"level_count", "levels", std::to_string(info.level_count)},
        {"patch_count", "patches per level", json ? "[" + patches + "]" : patches},
        {"border_vertex_count", "border vertices", std::to_string(info.border_vertex_count)},
        {"table_entries", "table entries", std::to_string(info.table_entries)},
        {"delta", "delta (% of diagonal)", printed(info.delta)},
        {"seed", "seed", std::to_string(info.seed)},
        {"file_size", "file size (bytes)", std::to_string(size_of_file(path))},
        {"format_version", "format version",
         std::to_string(info.format_major) + "." + std::to_string(info.format_minor), true},
        {"error_sources", "sources of the errors below", std::to_string(info.error_sources)},
    };
}

std::vector<Row> error_rows(const geoidx_info& info) {
    std::vector<Row> rows{
        {"error_mean", "relative error, mean", printed(info.error_mean)},
        {"error_signed_mean", "relative error, signed mean", printed(info.error_signed_mean)},
        {"error_p99", "relative error, p99", printed(info.error_p99)},
        {"error_p999", "relative error, p99.9", printed(info.error_p999)},
        {"error_max", "relative error, max", printed(info.error_max)},
        {"error_mean_at_vertices", "mean, crossing borders at vertices",
         printed(info.error_mean_at_vertices)}};
    return rows;
}

// JSON has no infinity and no NaN.
std::string json_value(const Row& row) {
    if (row.is_text) return '"' + row.value + '"';
    return row.value.find("inf") != std::string::npos || row.value.find("nan") != std::string::npos
               ? "null"
               : row.value;
}

void print_json(const std::vector<Row>& rows) {
    std::puts("{");
    for (size_t i = 0; i < rows.size(); ++i)
        std::printf("  \"%s\": %s%s\n", rows[i].key, json_value(rows[i]).c_str(),
                    i + 1 < rows.size() ? "," : "");
    std::puts("}");
}

void print_text(const std::vector<Row>& rows) {
    for (const Row& row : rows) std::printf("%-28s %s\n", row.label, row.value.c_str());
}

void info(const InfoArguments& arguments) {
    const Index index = open_index(arguments.index, nullptr);
    const geoidx_info info = info_of(*index, arguments.index);
    std::vector<Row> rows = rows_of(info, arguments.index, arguments.json);
    if (info.error_sources > 0)
        for (Row& row : error_rows(info)) rows.push_back(std::move(row));
    arguments.json ? print_json(rows) : print_text(rows);
}

}

void add_info(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "show what an index is and how accurate");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { info(*arguments); });
}

}
