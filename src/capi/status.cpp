#include "src/capi/status.h"

#include <cstring>

namespace geodesic {

namespace {

// A fixed array, so that reporting a lack of memory needs none.
thread_local char last_error[1024] = "";

}

geoidx_status fail(geoidx_status status, const char* detail) noexcept {
    std::strncpy(last_error, detail, sizeof last_error - 1);
    return status;
}

}

const char* geoidx_last_error(void) { return geodesic::last_error; }

const char* geoidx_status_string(geoidx_status status) {
    switch (status) {
    case GEOIDX_OK:
        return "success";
    case GEOIDX_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case GEOIDX_ERROR_IO:
        return "input or output failed";
    case GEOIDX_ERROR_NOT_AN_INDEX:
        return "not a geoidx file";
    case GEOIDX_ERROR_TRUNCATED:
        return "the index is truncated";
    case GEOIDX_ERROR_CORRUPT:
        return "the index is corrupt";
    case GEOIDX_ERROR_CHECKSUM:
        return "a checksum of the index does not match";
    case GEOIDX_ERROR_UNSUPPORTED_VERSION:
        return "the index has an unsupported version";
    case GEOIDX_ERROR_MESH_MISMATCH:
        return "the index belongs to another mesh";
    case GEOIDX_ERROR_LIMIT:
        return "a limit is exceeded";
    case GEOIDX_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case GEOIDX_ERROR_CANCELLED:
        return "cancelled";
    case GEOIDX_ERROR_BAD_MESH:
        return "the mesh cannot be used";
    case GEOIDX_ERROR_CALLBACK:
        return "the metric callback failed";
    case GEOIDX_ERROR_INTERNAL:
        return "internal error";
    case GEOIDX_ERROR_NO_PATH:
        return "there is no path";
    default:
        return "unknown status";
    }
}
