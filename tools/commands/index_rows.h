#pragma once

#include <string>
#include <vector>

#include "geoidx.h"
#include "tools/json.h"

namespace geodesic::tools {

// One thing that is known of an index.
struct IndexRow {
    const char* key;   // in JSON
    const char* label; // in text
    std::string value;
    bool is_text = false; // quoted in JSON
};

// `path` is the index's file.
std::vector<IndexRow> rows_of_index(const geoidx_info& info, const std::string& path, bool json);

// Adds them in order.
void add_rows(const std::vector<IndexRow>& rows, JsonObject& object);

}
