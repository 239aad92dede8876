#pragma once

#include <exception>
#include <new>
#include <string>

#include "format/error.h"

namespace geodesic {

// Keeps the detail of the calling thread's latest failure for geoidx_last_error and returns the status.
geoidx_status fail(geoidx_status status, const char* detail) noexcept;

// Runs the body of a C function: the one place where exceptions become a status.
template <class Body>
geoidx_status guarded(const Body& body) noexcept {
    try {
        body();
        return GEOIDX_OK;
    } catch (const Error& error) {
        return fail(error.status, error.what());
    } catch (const std::bad_alloc&) {
        return fail(GEOIDX_ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return fail(GEOIDX_ERROR_INTERNAL, error.what());
    } catch (...) {
        return fail(GEOIDX_ERROR_INTERNAL, "unknown exception");
    }
}

inline void require(bool condition, const char* detail) {
    if (!condition) refuse_argument(detail);
}

}
