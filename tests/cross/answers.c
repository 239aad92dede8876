/* answers INDEX: opens an index file and prints what many queries answer, bit for bit, as one number a kind.
 */
#include <geoidx.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t hash_of(const float* distances, uint64_t count) {
    uint64_t hash = 1469598103934665603u, i;
    for (i = 0; i < count; ++i) {
        uint32_t bits;
        memcpy(&bits, &distances[i], sizeof bits);
        hash = (hash ^ bits) * 1099511628211u;
    }
    return hash;
}

static int fail(const char* call) {
    fprintf(stderr, "%s: %s\n", call, geoidx_last_error());
    return 1;
}

int main(int argument_count, char** arguments) {
    enum { SOURCES = 17, PAIRS = 2000 };
    geoidx* index = NULL;
    geoidx_info info;
    uint32_t sources[SOURCES], pairs[2 * PAIRS], i;
    float *fields, between[PAIRS];
    if (argument_count != 2) return 2;
    if (geoidx_open(arguments[1], NULL, &index) != GEOIDX_OK) return fail("open");
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    if (geoidx_get_info(index, &info) != GEOIDX_OK) return fail("info");
    for (i = 0; i < SOURCES; ++i) sources[i] = (uint32_t)(i * 2654435761u % info.vertex_count);
    for (i = 0; i < 2 * PAIRS; ++i) pairs[i] = (uint32_t)((i + 7) * 2246822519u % info.vertex_count);
    fields = malloc(sizeof *fields * SOURCES * info.vertex_count);
    if (!fields) return 3;
    if (geoidx_sssd_batch(index, pairs, PAIRS, between) != GEOIDX_OK) return fail("sssd");
    printf("sssd %016llx\n", (unsigned long long)hash_of(between, PAIRS));
    if (geoidx_msad(index, sources, SOURCES, fields, (uint32_t)info.vertex_count) != GEOIDX_OK)
        return fail("msad");
    printf("msad %016llx\n", (unsigned long long)hash_of(fields, info.vertex_count));
    if (geoidx_ssad_batch(index, sources, SOURCES, fields, SOURCES * info.vertex_count) != GEOIDX_OK)
        return fail("batch");
    printf("batch %016llx\n", (unsigned long long)hash_of(fields, SOURCES * info.vertex_count));
    free(fields);
    geoidx_close(index);
    return 0;
}
