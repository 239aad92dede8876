#include "tools/commands/index_rows.h"

#include <cstdio>
#include <filesystem>

#include "tools/commands/index_output.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

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

std::vector<IndexRow> general_rows(const geoidx_info& info, const std::string& path, bool json) {
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
        {"added_vertex_count", "added vertices", std::to_string(info.added_vertex_count)},
        {"table_entries", "table entries", std::to_string(info.table_entries)},
        {"delta", "delta (% of diagonal)", printed(info.delta)},
        {"seed", "seed", std::to_string(info.seed)},
        {"codec", "codec", info.codec < CODEC_NAMES.size() ? CODEC_NAMES[info.codec] : "unknown", true},
        {"has_positions", "positions in the file", info.file_flags & GEOIDX_SAVE_NO_POSITIONS ? "0" : "1"},
        {"has_mesh", "mesh in the file", std::to_string(info.has_mesh)},
        {"smallest_step", "distances are multiples of, in the finest table", printed(info.smallest_step)},
        {"largest_step", "in the coarsest table", printed(info.largest_step)},
        {"file_size", "file size (bytes)", std::to_string(size_of_file(path))},
        {"format_version", "format version",
         std::to_string(info.format_major) + "." + std::to_string(info.format_minor), true},
        {"error_sources", "sources of the errors below", std::to_string(info.error_sources)},
    };
}

std::vector<IndexRow> error_rows(const geoidx_info& info) {
    std::vector<IndexRow> rows{
        {"error_mean", "relative error, mean", printed(info.error_mean)},
        {"error_signed_mean", "relative error, signed mean", printed(info.error_signed_mean)},
        {"error_p99", "relative error, p99", printed(info.error_p99)},
        {"error_p999", "relative error, p99.9", printed(info.error_p999)},
        {"error_max", "relative error, max", printed(info.error_max)},
        {"error_mean_at_vertices", "mean, crossing borders at vertices",
         printed(info.error_mean_at_vertices)},
        {"error_near_mean", "relative error up to 10 average edges, mean", printed(info.error_near_mean)},
        {"error_near_max", "relative error up to 10 average edges, max", printed(info.error_near_max)},
        {"error_middle_mean", "up to 100 average edges, mean", printed(info.error_middle_mean)},
        {"error_middle_max", "up to 100 average edges, max", printed(info.error_middle_max)},
        {"error_far_mean", "beyond, mean", printed(info.error_far_mean)},
        {"error_far_max", "beyond, max", printed(info.error_far_max)},
        {"error_several_mean", "relative error, several sources, mean", printed(info.error_several_mean)},
        {"error_several_max", "relative error, several sources, max", printed(info.error_several_max)}};
    return rows;
}

// JSON has no infinity and no NaN.
std::string json_value(const IndexRow& row) {
    if (row.is_text) return json_text(row.value);
    return row.value.find("inf") != std::string::npos || row.value.find("nan") != std::string::npos
               ? "null"
               : row.value;
}

}

std::vector<IndexRow> rows_of_index(const geoidx_info& info, const std::string& path, bool json) {
    std::vector<IndexRow> rows = general_rows(info, path, json);
    if (info.error_sources > 0)
        for (IndexRow& row : error_rows(info)) rows.push_back(std::move(row));
    return rows;
}

void add_rows(const std::vector<IndexRow>& rows, JsonObject& object) {
    for (const IndexRow& row : rows) object.json(row.key, json_value(row));
}

}
