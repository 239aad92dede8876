#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "geoidx.h"

namespace geodesic::tools {

// All throw CLI::ValidationError where an argument is wrong.

// The ids are words so that "-1" and "4294967296" are told apart from ids instead of being converted somehow.
std::vector<uint32_t> vertex_ids(std::span<const std::string> words);

// Accepts 0 .. 2^64 - 1; CLI11 alone takes a sign and an overflow for some other number.
CLI::Validator whole_number();

// What decides the distances that a mesh has, with or without an index.
struct MetricArguments {
    std::string metric = "exact";
    double weld_tolerance = 0;
    bool refuse_edges_of_many = false;
};
void add_metric_options(CLI::App& command, MetricArguments& arguments);
void apply(const MetricArguments& arguments, geoidx_build_options& options);

}
