#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "geoidx.h"

// The C++ namespace of this repository is `geodesic` (`geodesic::format`, `geodesic::tools`): in C++ the C
// type `geoidx` takes the name geoidx at global scope.
namespace geodesic {

// The one exception type of the library; capi turns it into a status and geoidx_last_error().
struct Error : std::runtime_error {
    Error(geoidx_status status, const std::string& detail, std::uint32_t section = 0)
        : std::runtime_error(detail), status(status), section(section) {}

    geoidx_status status;
    std::uint32_t section;       // the tag of the section of a file that is at fault; 0: no single one
    bool is_undecodable = false; // that section's stored bytes are at fault, not what they hold
};

// An argument of a call is not what the header asks for.
[[noreturn]] inline void refuse_argument(const std::string& detail) {
    throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, detail);
}

// Returns what body() returns. An Error of it that names no section names this one.
template <class Body>
decltype(auto) about_section(std::uint32_t tag, const Body& body) {
    try {
        return body();
    } catch (Error& error) {
        if (error.section == 0) error.section = tag;
        throw;
    }
}

}
