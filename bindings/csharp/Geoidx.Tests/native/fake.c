/* Has geoidx's names, but can neither open nor check an index. */
#include "geoidx.h"

uint32_t geoidx_version(void) { return FAKE_VERSION; }

uint32_t geoidx_abi_version(void) { return GEOIDX_ABI_VERSION; }

const char* geoidx_last_error(void) { return "the detail"; }

void geoidx_open_options_init_sized(geoidx_open_options* options, uint32_t struct_size) {
    (void)options;
    (void)struct_size;
}

geoidx_status geoidx_open(const char* utf8_path, const geoidx_open_options* options, geoidx** out) {
    (void)utf8_path;
    (void)options;
    *out = 0;
    return GEOIDX_ERROR_INTERNAL;
}

geoidx_status geoidx_verify(const void* data, uint64_t size, geoidx_issue_fn issue, void* user) {
    (void)data;
    (void)size;
    (void)issue;
    (void)user;
    return GEOIDX_ERROR_OUT_OF_MEMORY;
}
