#pragma once

#include <memory>

#include "geoidx.h"

namespace geodesic::test {

// The index of a mesh by these options. It is built once for all tests of a process that ask for the same,
// since no answer depends on what was asked before; with callbacks or an allocator of the caller it is built
// anew. A test of first use, of memory or of two builds must build its own. Building must succeed.
std::shared_ptr<const geoidx> shared_index(const geoidx_mesh& mesh, const geoidx_build_options& options);

}
