#pragma once

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "geoidx.h"
#include "tools/mesh_io/triangle_mesh.h"

namespace geodesic::tools {

struct IndexCloser {
    void operator()(geoidx* index) const { geoidx_close(index); }
};
struct SolverCloser {
    void operator()(geoidx_solver* solver) const { geoidx_solver_close(solver); }
};
struct SurfaceCloser {
    void operator()(geoidx_surface* surface) const { geoidx_surface_close(surface); }
};
struct QueryCloser {
    void operator()(geoidx_query* query) const { geoidx_query_close(query); }
};
using Index = std::unique_ptr<geoidx, IndexCloser>;
using Query = std::unique_ptr<geoidx_query, QueryCloser>;
using Surface = std::unique_ptr<geoidx_surface, SurfaceCloser>;
using Solver = std::unique_ptr<geoidx_solver, SolverCloser>;

// Throws Failure("what: why") with the library's own words where the status is an error.
void require_ok(geoidx_status status, const std::string& what);

// The arrays of `mesh` as the library takes them; `mesh` must outlive the result.
geoidx_mesh view_of(const TriangleMesh& mesh);

// `expected` may be null, unless the file holds no positions; an index of another mesh is refused.
// `mesh_word` is how a command line names the mesh.
Index open_index(const std::string& path, const TriangleMesh* expected,
                 const std::string& mesh_word = "--mesh");
// The same with a mesh file, or none where its name is empty.
Index open_index_with(const std::string& mesh_path, const std::string& path);
geoidx_info info_of(const geoidx& index, const std::string& path);
std::vector<geoidx_section> sections_of(const geoidx& index, const std::string& path);

// The bytes of the file that the index is saved as.
std::vector<unsigned char> saved_bytes(const geoidx& index, const geoidx_save_options& options,
                                       const std::string& path);

Query make_query(const geoidx& index, const std::string& path);

Surface make_surface(const TriangleMesh& mesh, const std::string& path, double weld_tolerance = 0);
// Of the mesh that the index keeps.
Surface surface_of(const geoidx& index, const std::string& path);

Solver make_solver(const TriangleMesh& mesh, const std::string& path, const geoidx_build_options& options);

const char* metric_name(uint32_t metric);
uint32_t metric_of_name(const std::string& name);

inline constexpr std::array<const char*, 2> ENGINE_NAMES{"graph", "overlay"}; // by GEOIDX_ENGINE_*
uint32_t engine_of_name(const std::string& name);

extern const std::vector<std::string> CODEC_NAMES; // by GEOIDX_CODEC_*

}
