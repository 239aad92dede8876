#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "tests/campaign/isolated.h"
#include "tests/campaign/random_options.h"

namespace geodesic::campaign {

struct MeshCase {
    test::Soup soup;
    CaseOptions options;
};

// The seed decides everything.
MeshCase random_case(uint64_t seed);

// Checks it in a process of its own.
std::optional<Failure> failure_of(const MeshCase& mesh_case, bool quiet = false);

// An OBJ file with all digits, the options in its comments, and what failed.
void write_case(std::ostream& out, const MeshCase& mesh_case, const std::string& failure);
// What write_case() wrote.
MeshCase read_case(std::istream& in);

// A smaller mesh, and plainer options, by which the same check fails, after at most some hundred tries.
MeshCase shrunk(MeshCase failing, const std::string& check);

}
