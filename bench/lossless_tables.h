#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geoidx.h"

namespace geodesic::bench {

// An index file in memory.
struct IndexFile {
    std::string name; // for messages
    std::vector<unsigned char> bytes;
    std::vector<geoidx_section> sections;
};

// A matrix of codes as format/SPEC.md has it, row by row. A code is a whole number up to 32766, or infinity.
// A code times the quantum is a distance.
struct CodeTable {
    uint32_t rows = 0, columns = 0;
    std::vector<float> codes;
    float quantum = 0;
};

// The matrices of the section OVOV, BVIV or IVIV, in their order. The file is a lossless one that the library
// has saved; its bytes are not checked again. Throws tools::Failure where it is of another kind.
std::vector<CodeTable> tables_of(const IndexFile& lossless, const std::string& tag);

}
