#pragma once

#include "bench/measurement.h"
#include "bench/table.h"

namespace geodesic::bench {

// Parts of table rows, so that the same figure has the same name in every subcommand.

void add_patches(Row& row, const geoidx_info& info);
void add_query_times(Row& row, const Measurement& measurement);

// MSAD in full, the mean of SSSD, all in %.
void add_errors(Row& row, const IndexErrors& errors, const geoidx_info& stored);

void add_build_time(Row& row, const Duration& build, const geoidx_info& info);
void add_size(Row& row, const Measurement& measurement);

// What the errors rest on; with workload_parameters also the times.
Row error_parameters(uint32_t error_source_count);
Row workload_parameters(uint32_t error_source_count);

// Of infinite distances that an index answers as finite or the other way round: "" where there is none.
std::string mismatch_note(const std::string& name, const IndexErrors& errors);

}
