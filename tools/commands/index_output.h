#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "geoidx.h"

namespace geodesic::tools {

// What decides the form of a file, as words of the command line.
struct FileForm {
    std::string codec;
    bool no_positions = false;
    bool no_mesh = false;
};
// --codec, whose default is the first of the names, and --no-positions.
void add_form_options(CLI::App& command, FileForm& form);

// Refuses a file that keeps the mesh and opens with the mesh only.
void require_mesh_or_no_positions(const FileForm& form, bool keeps_mesh);

// Refuses what an index cannot be written to, before work is done for it.
void require_index_output(const std::string& output, const std::string& input);
// The graph engine has one codec only, so that the one of `form` says nothing to it.
void save_index(const geoidx& index, const FileForm& form, const std::string& path);
// What the index in the file is that save_index() has written.
geoidx_info info_of_saved(const geoidx& index, const FileForm& form, const std::string& path);

// Refuses to print JSON where the index goes.
void require_json_apart(bool json, const std::string& output);

}
