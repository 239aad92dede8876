#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "geoidx.h"

namespace geodesic::tools {

uint32_t codec_of_name(const std::string& name);
// --codec, whose default is the first of the names.
void add_codec_option(CLI::App& command, std::string& codec);

// Refuses what an index cannot be written to, before work is done for it.
void require_index_output(const std::string& output, const std::string& input);
// The graph engine has one form only, so that `codec` says nothing to it.
void save_index(const geoidx& index, uint32_t codec, const std::string& path);
// What the index in the file is that save_index() has written.
geoidx_info info_of_saved(const geoidx& index, uint32_t codec, const std::string& path);

// Refuses to print JSON where the index goes.
void require_json_apart(bool json, const std::string& output);

}
