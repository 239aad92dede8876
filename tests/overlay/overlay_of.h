#pragma once

#include "src/build/build.h"
#include "src/index/stored.h"
#include "tests/capi/calls.h"

namespace geodesic::test {

// An index of the overlay engine, as it is built or opened, and with what pairs need.
struct OverlayOf {
    OverlayOf(const TestMesh& mesh, geoidx_build_options options) : index(std::pmr::get_default_resource()) {
        options.engine = GEOIDX_ENGINE_OVERLAY;
        build_index(mesh.view(), options, index);
        prepare_pairs(index);
    }
    explicit OverlayOf(const StoredIndex& stored) : index(std::pmr::get_default_resource()) {
        prepare(stored, index);
        prepare_pairs(index);
    }
    const OverlayIndex& overlay() const { return std::get<OverlayIndex>(index.engine); }

    Index index;
};

// Vertices close together along x: the borders of its patches have many.
inline TestMesh pressed(TestMesh mesh, double factor) {
    for (size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] *= factor;
    return mesh;
}

// Borders of 300 vertices and more, with short ones beside them, for patches of {2, 2, 3}.
inline const TestMesh& mesh_of_long_borders() {
    static const TestMesh mesh = pressed(grid(330, 14), 0.05);
    return mesh;
}

// An id of each number, NONE of added vertices.
inline std::vector<uint32_t> ids_by_number(const Index& index) {
    std::vector<uint32_t> ids(index.numbering().vertex_count(), NONE);
    for (uint32_t id = 0; id < index.number_of_id.size(); ++id)
        if (index.number_of_id[id] != NONE) ids[index.number_of_id[id]] = id;
    return ids;
}

}
