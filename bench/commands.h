#pragma once

#include <CLI/CLI.hpp>

namespace geodesic::bench {

// The subcommands, one file each. What goes wrong while one runs is thrown as std::exception.
void add_paper(CLI::App& app);
void add_queries(CLI::App& app);
void add_metric(CLI::App& app);
void add_error(CLI::App& app);
void add_several(CLI::App& app);
void add_tails(CLI::App& app);
void add_stated(CLI::App& app);
void add_open(CLI::App& app);
void add_pairs(CLI::App& app);
void add_paths(CLI::App& app);
void add_surface(CLI::App& app);
void add_weighted(CLI::App& app);
void add_files(CLI::App& app);
void add_farthest(CLI::App& app);
void add_nearest(CLI::App& app);
void add_matrix(CLI::App& app);

}
