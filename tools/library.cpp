#include "tools/library.h"

#include "tools/failure.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::tools {

void require_ok(geoidx_status status, const std::string& what) {
    if (status == GEOIDX_OK) return;
    std::string why = geoidx_last_error();
    if (why.empty()) why = geoidx_status_string(status);
    throw Failure(what + ": " + why);
}

geoidx_mesh view_of(const TriangleMesh& mesh) {
    geoidx_mesh view;
    geoidx_mesh_init(&view);
    view.position_type = GEOIDX_POSITION_DOUBLE;
    view.positions = mesh.positions.data();
    view.vertex_count = mesh.vertex_count();
    view.triangles = mesh.triangles.data();
    view.triangle_count = mesh.triangle_count();
    return view;
}

Index open_index(const std::string& path, const TriangleMesh* expected, const std::string& mesh_word) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    geoidx_mesh view;
    if (expected) {
        view = view_of(*expected);
        options.expected_mesh = &view;
    }
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open(path.c_str(), &options, &index);
    if (status == GEOIDX_ERROR_INVALID_ARGUMENT && !expected)
        throw Failure(path +
                      ": holds no positions, so that it needs the mesh that it was built from: " + mesh_word);
    require_ok(status, path);
    return Index(index);
}

Index open_index_with(const std::string& mesh_path, const std::string& path) {
    if (mesh_path.empty()) return open_index(path, nullptr);
    const TriangleMesh mesh = read_mesh(mesh_path);
    return open_index(path, &mesh);
}

std::vector<geoidx_section> sections_of(const geoidx& index, const std::string& path) {
    uint32_t count = 0;
    require_ok(geoidx_get_sections(&index, nullptr, 0, &count), path);
    std::vector<geoidx_section> sections(count);
    require_ok(geoidx_get_sections(&index, sections.data(), count, &count), path);
    return sections;
}

geoidx_info info_of(const geoidx& index, const std::string& path) {
    geoidx_info info{};
    info.struct_size = sizeof info;
    require_ok(geoidx_get_info(&index, &info), path);
    return info;
}

std::vector<unsigned char> saved_bytes(const geoidx& index, const geoidx_save_options& options,
                                       const std::string& path) {
    uint64_t size = 0;
    require_ok(geoidx_save_memory(&index, &options, nullptr, 0, &size), path);
    std::vector<unsigned char> bytes(size);
    require_ok(geoidx_save_memory(&index, &options, bytes.data(), size, &size), path);
    return bytes;
}

Query make_query(const geoidx& index, const std::string& path) {
    geoidx_query* query = nullptr;
    require_ok(geoidx_query_create(&index, &query), path);
    return Query(query);
}

Surface make_surface(const TriangleMesh& mesh, const std::string& path, double weld_tolerance) {
    geoidx_surface_options options;
    geoidx_surface_options_init(&options);
    options.weld_tolerance = weld_tolerance;
    const geoidx_mesh view = view_of(mesh);
    geoidx_surface* surface = nullptr;
    require_ok(geoidx_surface_create(&view, &options, &surface), path);
    return Surface(surface);
}

Surface surface_of(const geoidx& index, const std::string& path) {
    geoidx_surface* surface = nullptr;
    require_ok(geoidx_surface_of_index(&index, nullptr, &surface), path);
    return Surface(surface);
}

Solver make_solver(const TriangleMesh& mesh, const std::string& path, const geoidx_build_options& options) {
    const geoidx_mesh view = view_of(mesh);
    geoidx_solver* solver = nullptr;
    require_ok(geoidx_solver_create(&view, &options, &solver), path);
    return Solver(solver);
}

const char* metric_name(uint32_t metric) {
    switch (metric) {
    case GEOIDX_METRIC_EXACT:
        return "exact";
    case GEOIDX_METRIC_EDGES:
        return "edges";
    case GEOIDX_METRIC_CALLBACK:
        return "callback";
    case GEOIDX_METRIC_WEIGHTED:
        return "weighted";
    default:
        return "unknown";
    }
}

uint32_t metric_of_name(const std::string& name) {
    return name == "edges" ? GEOIDX_METRIC_EDGES : GEOIDX_METRIC_EXACT;
}

uint32_t engine_of_name(const std::string& name) {
    return name == ENGINE_NAMES[GEOIDX_ENGINE_OVERLAY] ? GEOIDX_ENGINE_OVERLAY : GEOIDX_ENGINE_GRAPH;
}

const std::vector<std::string> CODEC_NAMES{"packed", "lossless", "mapped"};

}
