/* The loop over pairs that C# is compared with. */
#include "geoidx.h"

typedef geoidx_status (*sssd_fn)(geoidx_query* query, uint32_t source, uint32_t target, float* distance);

geoidx_status native_loop(sssd_fn sssd, geoidx_query* query, const uint32_t* pairs, uint64_t pair_count,
                          float* distances) {
    for (uint64_t i = 0; i < pair_count; ++i) {
        const geoidx_status status = sssd(query, pairs[2 * i], pairs[2 * i + 1], &distances[i]);
        if (status != GEOIDX_OK) return status;
    }
    return GEOIDX_OK;
}
