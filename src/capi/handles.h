#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <optional>
#include <vector>

#include "format/file_mapping.h"
#include "geoidx.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"
#include "src/path/next_step.h"
#include "src/query/index.h"
#include "src/query/query.h"
#include "src/surface/face_boxes.h"
#include "src/surface/surface.h"

namespace geodesic {

// The caller's allocator, or the global heap.
class CallerMemory final : public std::pmr::memory_resource {
public:
    explicit CallerMemory(const geoidx_allocator& allocator) : allocator_(allocator) {}

    const geoidx_allocator& allocator() const { return allocator_; }
    // Asking for more than so many bytes in all is Error LIMIT from now on.
    void set_limit(uint64_t bytes) { limit_ = bytes; }

private:
    void* do_allocate(size_t size, size_t alignment) override;
    void do_deallocate(void* memory, size_t size, size_t alignment) override;
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    void take_share(uint64_t size); // throws Error LIMIT where that is more than is left

    geoidx_allocator allocator_;
    uint64_t limit_ = std::numeric_limits<uint64_t>::max();
    std::atomic<uint64_t> used_ = 0;
};

// Query scratch that is not in use, so that geoidx_sssd and geoidx_msad need not make it anew.
class QueryPool {
public:
    QueryPool(const Index& index, std::pmr::memory_resource& memory)
        : index_(index), memory_(memory), idle_(&memory) {}
    ~QueryPool();

    Query* take();
    void give_back(Query* query) noexcept;

private:
    const Index& index_;
    std::pmr::memory_resource& memory_;
    std::mutex mutex_;
    Array<Query*> idle_;
};

}

struct geoidx {
    explicit geoidx(const geoidx_allocator& allocator)
        : memory(allocator), file_copy(&memory), index(&memory), sections(&memory), queries(index, memory) {}

    geodesic::CallerMemory memory;
    // Where the tables of a mapped file lie, unless the caller keeps them: the file itself, or a copy of it.
    std::optional<geodesic::format::FileMapping> mapping;
    geodesic::Array<uint64_t> file_copy;
    geodesic::Index index;
    geodesic::Array<geoidx_section> sections; // of the file that it was opened from
    mutable geodesic::QueryPool queries;
};

struct geoidx_query {
    explicit geoidx_query(const geoidx& index, std::pmr::memory_resource& memory)
        : memory(memory), index(index.index), query(index.index, &memory) {}

    std::pmr::memory_resource& memory; // of the index
    const geodesic::Index& index;
    geodesic::Query query;
    std::vector<geoidx_path_point> path; // the latest one

    // What geoidx_query_prepare_target keeps, and the size of its surface.
    std::optional<geodesic::Walk> walk;
    uint32_t walk_vertices = 0, walk_faces = 0;
};

struct geoidx_solver {
    geodesic::Intake intake;
    std::unique_ptr<geodesic::Metric> metric;
    std::unique_ptr<geodesic::FieldSolver> solver;
};

struct geoidx_surface {
    geoidx_surface(geodesic::Intake&& intake, geodesic::SurfaceCosts&& costs, geodesic::FlatFaces&& flat)
        : surface(std::move(intake), std::move(costs), std::move(flat)), boxes(surface) {}

    geodesic::Surface surface;
    geodesic::FaceBoxes boxes;
};
