#pragma once

#include <stdexcept>

#include "tests/campaign/file_content.h"

namespace geodesic::file_campaign {

// What must hold and does not.
struct Broken : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Opens a file that was written of this content, asks it everything that the API has, and throws Broken where
// an answer cannot be. Returns whether it was opened: it may be refused with GEOIDX_ERROR_LIMIT.
bool ask_everything(const FileContent& content, const WrittenFile& file, uint64_t seed);

}
