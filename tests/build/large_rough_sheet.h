#pragma once

#include "tests/index/changed_section.h"

namespace geodesic::test {

// So rough that its index has measured pairs and steep edges, and so large that most vertices are not near
// each other.
inline const TestMesh& large_rough_sheet() {
    static const TestMesh mesh = rough_sheet(40, 16);
    return mesh;
}

// The file of its index with default options, built once for all tests.
inline const Bytes& file_of_large_rough_sheet() {
    static const Bytes file = save(build(large_rough_sheet(), default_options(4)).get());
    return file;
}

}
