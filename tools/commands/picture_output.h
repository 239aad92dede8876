#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "tools/picture/render.h"

namespace geodesic::tools {

// A picture that a command draws, and how; an empty name: none.
struct PictureOutput {
    std::string file;
    std::string size = "1200x1000";
    uint32_t isolines = 24;
    std::string up = "y";
};

// Returns the --png option.
CLI::Option* add_picture_options(CLI::App& command, PictureOutput& output);

// Throws CLI::ValidationError where the size is none.
PictureOptions picture_options(const PictureOutput& output);

// The bytes of the file. Throws Failure.
std::vector<unsigned char> encode_picture(const PictureOutput& output, const Image& image);

}
