#pragma once

#include <memory>
#include <memory_resource>
#include <mutex>
#include <vector>

#include "geoidx.h"
#include "src/mesh/intake.h"
#include "src/metric/metric.h"
#include "src/query/index.h"
#include "src/query/query.h"

namespace geodesic {

// The caller's allocator, or the global heap.
class CallerMemory final : public std::pmr::memory_resource {
public:
    explicit CallerMemory(const geoidx_allocator& allocator) : allocator_(allocator) {}

private:
    void* do_allocate(size_t size, size_t alignment) override;
    void do_deallocate(void* memory, size_t size, size_t alignment) override;
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    geoidx_allocator allocator_;
};

// Query scratch that is not in use, so that geoidx_sssd and geoidx_msad need not make it anew.
class QueryPool {
public:
    QueryPool(const Index& index, std::pmr::memory_resource& memory)
        : index_(index), memory_(memory), idle_(&memory) {}
    ~QueryPool();

    Query* take();
    void give_back(Query* query);

private:
    const Index& index_;
    std::pmr::memory_resource& memory_;
    std::mutex mutex_;
    Array<Query*> idle_;
};

}

struct geoidx {
    explicit geoidx(const geoidx_allocator& allocator)
        : memory(allocator), index(&memory), sections(&memory), queries(index, memory) {}

    geodesic::CallerMemory memory;
    geodesic::Index index;
    geodesic::Array<geoidx_section> sections; // of the file that it was opened from
    mutable geodesic::QueryPool queries;
};

struct geoidx_query {
    explicit geoidx_query(const geoidx& index, std::pmr::memory_resource& memory)
        : memory(memory), query(index.index, &memory) {}

    std::pmr::memory_resource& memory; // of the index
    geodesic::Query query;
};

struct geoidx_solver {
    geodesic::Intake intake;
    std::unique_ptr<geodesic::Metric> metric;
    std::unique_ptr<geodesic::FieldSolver> solver;
};
