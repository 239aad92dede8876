#pragma once

#include <stdexcept>
#include <string>

#include "geoidx.h"

// The C++ namespace of this repository is `geodesic` (`geodesic::format`, `geodesic::tools`): in C++ the C
// type `geoidx` takes the name geoidx at global scope.
namespace geodesic {

// The one exception type of the library; capi turns it into a status and geoidx_last_error().
struct Error : std::runtime_error {
    Error(geoidx_status status, const std::string& detail) : std::runtime_error(detail), status(status) {}

    geoidx_status status;
};

}
