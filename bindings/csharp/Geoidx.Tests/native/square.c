/* square LIBRARY FILE: saves the index of a unit square. */
#include <dlfcn.h>
#include <stdio.h>

#include "geoidx.h"

int main(int argc, char** argv) {
    const float corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    const geoidx_mesh mesh = {sizeof mesh, GEOIDX_POSITION_FLOAT, corners, 4, triangles, 2, 0, 0};
    void* library = argc == 3 ? dlopen(argv[1], RTLD_NOW) : NULL;
    geoidx* index = NULL;
    if (!library) {
        fprintf(stderr, "%s\n", argc == 3 ? dlerror() : "usage: square LIBRARY FILE");
        return 1;
    }
    geoidx_status (*build)(const geoidx_mesh*, const geoidx_build_options*, geoidx**);
    geoidx_status (*save)(const geoidx*, const char*, const geoidx_save_options*);
    *(void**)&build = dlsym(library, "geoidx_build");
    *(void**)&save = dlsym(library, "geoidx_save");
    return build(&mesh, NULL, &index) != GEOIDX_OK || save(index, argv[2], NULL) != GEOIDX_OK;
}
