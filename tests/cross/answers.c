/* answers INDEX: opens an index file and prints what many queries answer, bit for bit, as one number a kind:
 * pairs, several sources, single sources, pairs from a prepared source, and several sources within a radius.
 */
#include <geoidx.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SOURCES = 17, PAIRS = 2000 };

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

static int print_prepared(geoidx_query* query, uint32_t source, const uint32_t* targets) {
    float distances[PAIRS];
    if (geoidx_query_prepare(query, source) != GEOIDX_OK) return fail("prepare");
    if (geoidx_query_prepared(query, targets, PAIRS, distances) != GEOIDX_OK) return fail("prepared");
    printf("prepared %016llx\n", (unsigned long long)hash_of(distances, PAIRS));
    return 0;
}

/* From the first 1, 4 and all sources, within several shares of the bounding box's diagonal. */
static int print_within(geoidx_query* query, const geoidx_info* info, const uint32_t* sources, float* field) {
    static const double SHARES[] = {0, 0.01, 0.1, 0.5, 2};
    static const uint32_t COUNTS[] = {1, 4, SOURCES};
    size_t c, r;
    for (c = 0; c < sizeof COUNTS / sizeof COUNTS[0]; ++c)
        for (r = 0; r < sizeof SHARES / sizeof SHARES[0]; ++r) {
            const float radius = (float)(SHARES[r] * info->bounding_box_diagonal);
            if (geoidx_query_msad_within(query, sources, COUNTS[c], radius, field,
                                         (uint32_t)info->vertex_count) != GEOIDX_OK)
                return fail("msad_within");
            printf("within %u %g %016llx\n", (unsigned)COUNTS[c], SHARES[r],
                   (unsigned long long)hash_of(field, info->vertex_count));
        }
    return 0;
}

int main(int argument_count, char** arguments) {
    geoidx* index = NULL;
    geoidx_query* query = NULL;
    geoidx_open_options options;
    geoidx_info info;
    uint32_t sources[SOURCES], pairs[2 * PAIRS], i;
    float *fields, between[PAIRS];
    if (argument_count != 2) return 2;
    geoidx_open_options_init(&options);
    options.threads = 1; /* an emulator may have no threads */
    if (geoidx_open(arguments[1], &options, &index) != GEOIDX_OK) return fail("open");
    if (geoidx_query_create(index, &query) != GEOIDX_OK) return fail("query");
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
    if (print_prepared(query, sources[SOURCES - 1], pairs) != 0) return 1;
    if (print_within(query, &info, sources, fields) != 0) return 1;
    free(fields);
    geoidx_query_close(query);
    geoidx_close(index);
    return 0;
}
