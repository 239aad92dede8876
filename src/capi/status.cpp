#include "src/capi/status.h"

#include <cstring>

namespace geodesic {

namespace {

// A fixed array, so that reporting a lack of memory needs none.
thread_local char last_error[1024] = "";

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// How many bytes of a text have room, without a part of a UTF-8 character at the end. If the last four bytes
// are no such character, the text is cut anywhere.
size_t length_of_beginning(const char* text, size_t room) {
    const size_t length = std::strlen(text);
    if (length <= room) return length;
    for (size_t cut = room; cut + 4 > room; --cut)
        if (!continues_character(text[cut])) return cut;
    return room;
}

}

geoidx_status fail(geoidx_status status, const char* detail) noexcept {
    const size_t length = length_of_beginning(detail, sizeof last_error - 1);
    std::memmove(last_error, detail, length);
    last_error[length] = '\0';
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
