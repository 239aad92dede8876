#pragma once

#include <stdexcept>
#include <string>

namespace geodesic::tools {

// What ends a command with exit status 1. The text is one line: "what: why".
struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}
