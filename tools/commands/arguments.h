#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "geoidx.h"

namespace geodesic::tools {

// Where an argument is wrong, these throw CLI::ValidationError.

// The ids are words so that "-1" and "4294967296" are told apart from ids instead of being converted somehow.
uint32_t vertex_id(std::string_view word);
std::vector<uint32_t> vertex_ids(std::span<const std::string> words);

// A pair a line; empty lines and what follows a # are passed over. Throws Failure, which names the line.
std::vector<uint32_t> vertex_pairs_of_text(std::string_view text);

// Accepts 0 .. 2^64 - 1; CLI11 alone takes a sign and an overflow for some other number.
CLI::Validator whole_number();

// --mesh, for a command that needs it where the index has no positions.
CLI::Option* add_mesh_option(CLI::App& command, std::string& mesh);

// What decides the distances that a mesh has, with or without an index.
struct MetricArguments {
    std::string metric = "exact";
    double weld_tolerance = 0;
    bool refuse_edges_of_many = false;
};
void add_metric_options(CLI::App& command, MetricArguments& arguments);
void apply(const MetricArguments& arguments, geoidx_build_options& options);

}
