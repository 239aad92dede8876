#pragma once

#include <CLI/CLI.hpp>

namespace geodesic::tools {

// Each adds its command to the command line; the command runs when the line has been parsed.
void add_build(CLI::App& app);
void add_convert(CLI::App& app);
void add_info(CLI::App& app);
void add_verify(CLI::App& app);
void add_sssd(CLI::App& app);
void add_path(CLI::App& app);
void add_msad(CLI::App& app);
void add_exact(CLI::App& app);
void add_bench(CLI::App& app);

}
