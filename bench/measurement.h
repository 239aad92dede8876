#pragma once

#include "bench/statistics.h"
#include "bench/workload.h"
#include "tools/library.h"

namespace geodesic::bench {

struct BuiltIndex {
    tools::Index index;
    Duration time; // CPU time of all threads
};
BuiltIndex build_index(const Model& model, const geoidx_build_options& options);

// Options with `threads` and, unless empty, with patches.size() levels.
geoidx_build_options options_for(uint32_t threads, const std::vector<uint32_t>& patches);

uint64_t file_size(const geoidx& index, const std::string& name);

// Medians of TIMED_QUERIES of the workload, one thread.
struct QueryTimes {
    Duration sssd;
    Duration prepared; // SSSD when the source has been prepared
    Duration msad;
    Duration msad_threads; // on MSAD_THREADS threads
    Duration batch;        // of BATCH sources
};
QueryTimes time_queries(const geoidx& index, const Model& model, const Workload& workload);

struct IndexErrors {
    ErrorSample msad;       // all vertices from each error source
    ErrorSample sssd;       // the pairs
    ErrorSample difference; // of SSSD to MSAD on the pairs
};
IndexErrors measure_errors(const geoidx& index, const Model& model, const Workload& workload);

// All there is to say of one index of one mesh.
struct Measurement {
    geoidx_info info;
    uint64_t file_bytes;
    Duration build;
    QueryTimes times;
    IndexErrors errors;
};
Measurement measure(const BuiltIndex& built, const Model& model, const Workload& workload);

}
