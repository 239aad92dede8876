#include "bench/rows.h"

namespace geodesic::bench {

namespace {

double per_vertex(double value, const geoidx_info& info) {
    return value / static_cast<double>(info.vertex_count);
}

// Level by level: "8/112".
std::string patch_list(const geoidx_info& info) {
    std::string list;
    for (uint32_t l = 0; l < info.level_count; ++l)
        list += (l ? "/" : "") + std::to_string(info.patch_count[l]);
    return list;
}

}

void add_patches(Row& row, const geoidx_info& info) {
    row.push_back({"patches", "patches", patch_list(info)});
    row.push_back({"border_vertices", "", info.border_vertex_count});
}

void add_query_times(Row& row, const Measurement& measurement) {
    const QueryTimes& times = measurement.times;
    row.push_back({"sssd_us", "SSSD µs", 1e6 * times.sssd.wall});
    row.push_back({"sssd_cpu_us", "", 1e6 * times.sssd.cpu});
    row.push_back({"prepared_us", "prepared µs", 1e6 * times.prepared.wall});
    row.push_back({"msad_ms", "MSAD ms", 1e3 * times.msad.wall});
    row.push_back({"msad_cpu_ms", "", 1e3 * times.msad.cpu});
    row.push_back({"msad_ns_per_vertex", "ns/vertex", per_vertex(1e9 * times.msad.wall, measurement.info)});
    row.push_back({"msad_threads_ns_per_vertex", std::to_string(MSAD_THREADS) + " threads",
                   per_vertex(1e9 * times.msad_threads.wall, measurement.info)});
    row.push_back({"batch_ns_per_vertex_and_source", "ns of 16",
                   per_vertex(1e9 * times.batch.wall, measurement.info) / BATCH});
}

void add_errors(Row& row, const IndexErrors& errors, const geoidx_info& stored) {
    const ErrorSummary msad = errors.msad.relative();
    const ErrorSummary sssd = errors.sssd.relative();
    row.push_back({"msad_error_mean_percent", "MSAD mean %", 100 * msad.mean});
    row.push_back({"msad_error_signed_mean_percent", "", 100 * msad.signed_mean});
    row.push_back({"msad_error_p99_percent", "", 100 * msad.p99});
    row.push_back({"msad_error_p999_percent", "p99.9 %", 100 * msad.p999});
    row.push_back({"msad_error_max_percent", "max %", 100 * msad.max});
    row.push_back({"stored_error_mean_percent", "stored %", 100 * stored.error_mean});
    row.push_back({"sssd_error_mean_percent", "SSSD mean %", 100 * sssd.mean});
    row.push_back({"sssd_error_p999_percent", "", 100 * sssd.p999});
    row.push_back({"sssd_error_max_percent", "", 100 * sssd.max});
    const ErrorSummary difference = errors.difference.relative();
    row.push_back({"sssd_msad_difference_mean_percent", "SSSD-MSAD %", 100 * difference.mean});
    row.push_back({"sssd_msad_difference_p999_percent", "", 100 * difference.p999});
    row.push_back({"reachability_mismatches", "", errors.msad.mismatches() + errors.sssd.mismatches()});
}

void add_build_time(Row& row, const Duration& build, const geoidx_info& info) {
    row.push_back({"build_s", "build s", build.wall});
    row.push_back({"build_cpu_s", "", build.cpu});
    row.push_back({"build_cpu_s_per_10000_vertices", "CPU s/10k", per_vertex(1e4 * build.cpu, info)});
}

void add_size(Row& row, const Measurement& measurement) {
    const auto bytes = static_cast<double>(measurement.file_bytes);
    const auto entries = static_cast<double>(measurement.info.table_entries);
    row.push_back({"file_bytes", "file bytes", measurement.file_bytes});
    row.push_back({"bytes_per_vertex", "bytes/vertex", per_vertex(bytes, measurement.info)});
    row.push_back({"entries_per_vertex", "entries/vertex", per_vertex(entries, measurement.info)});
}

Row error_parameters(uint32_t error_source_count) {
    return {{"seed", "seed", SEED},
            {"error_sources", "sources of errors", uint64_t{error_source_count}},
            {"error_pairs", "pairs of SSSD errors", uint64_t{error_source_count} * PAIRS_PER_FIELD}};
}

Row workload_parameters(uint32_t error_source_count) {
    Row row = error_parameters(error_source_count);
    row.push_back({"timed_queries", "timed queries", uint64_t{TIMED_QUERIES}});
    return row;
}

std::string mismatch_note(const std::string& name, const IndexErrors& errors) {
    const uint64_t count = errors.msad.mismatches() + errors.sssd.mismatches();
    if (count == 0) return "";
    return name + ": " + std::to_string(count) + " distances are finite on one side only, and in no error.";
}

}
