#pragma once

#include <memory>

#include "geoidx.h"

// The handles of the C API, each closed by its owner.
namespace geodesic::test {

struct Close {
    void operator()(geoidx* index) const { geoidx_close(index); }
    void operator()(geoidx_query* query) const { geoidx_query_close(query); }
    void operator()(geoidx_solver* solver) const { geoidx_solver_close(solver); }
    void operator()(geoidx_surface* surface) const { geoidx_surface_close(surface); }
};
using IndexHandle = std::unique_ptr<geoidx, Close>;
using QueryHandle = std::unique_ptr<geoidx_query, Close>;
using SolverHandle = std::unique_ptr<geoidx_solver, Close>;
using SurfaceHandle = std::unique_ptr<geoidx_surface, Close>;

}
