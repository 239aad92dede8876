/* A program of someone who has installed geoidx: from a mesh to a file to an answer. */
#include <geoidx.h>

#include <math.h>
#include <stdio.h>

int main(void) {
    const float corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    geoidx_mesh mesh;
    geoidx* index = NULL;
    float distance = 0;
    geoidx_mesh_init(&mesh);
    mesh.positions = corners;
    mesh.vertex_count = 4;
    mesh.triangles = triangles;
    mesh.triangle_count = 2;
    if (geoidx_abi_version() != GEOIDX_ABI_VERSION) return 1;
    if (geoidx_build(&mesh, NULL, &index) != GEOIDX_OK) return 2;
    if (geoidx_save(index, "square.geoidx", NULL) != GEOIDX_OK) return 3;
    geoidx_close(index);
    if (geoidx_open("square.geoidx", NULL, &index) != GEOIDX_OK) return 4;
    if (geoidx_sssd(index, 0, 2, &distance) != GEOIDX_OK) return 5;
    geoidx_close(index);
    printf("%g\n", distance);
    return fabs(distance - sqrt(2.0)) < 1e-5 ? 0 : 6;
}
