#include <algorithm>

#include "tests/campaign/mesh_case.h"

namespace geodesic::campaign {

namespace {

// Tries smaller cases, only so many: a large mesh need not become the smallest one.
class SameFailure {
public:
    explicit SameFailure(const std::string& check) : check_(check) {}

    bool operator()(const MeshCase& smaller) {
        if (tries_left_ == 0) return false;
        --tries_left_;
        const auto failure = failure_of(smaller, true);
        return failure && failure->check == check_;
    }

private:
    const std::string& check_;
    uint32_t tries_left_ = 500;
};

// Without `count` triangles from `first` on; vertices keep their ids.
MeshCase without(const MeshCase& whole, size_t first, size_t count) {
    MeshCase rest = whole;
    const auto begin = rest.soup.triangles.begin() + static_cast<ptrdiff_t>(first);
    rest.soup.triangles.erase(begin, begin + static_cast<ptrdiff_t>(count));
    return rest;
}

bool remove_triangles(MeshCase& failing, SameFailure& still_fails, size_t at_once) {
    bool removed = false;
    for (size_t first = 0; first < failing.soup.triangles.size();) {
        const size_t count = std::min(at_once, failing.soup.triangles.size() - first);
        MeshCase smaller = without(failing, first, count);
        if (!smaller.soup.triangles.empty() && still_fails(smaller)) {
            failing = std::move(smaller);
            removed = true;
        } else {
            first += count;
        }
    }
    return removed;
}

void make_plainer(MeshCase& failing, SameFailure& still_fails) {
    const auto attempt = [&](auto&& change) {
        MeshCase plainer = failing;
        change(plainer.options);
        if (still_fails(plainer)) failing = std::move(plainer);
    };
    attempt([](CaseOptions& o) { o.threads = 1; });
    attempt([](CaseOptions& o) { o.opened = false; });
    attempt([](CaseOptions& o) { o.store_mesh = false; });
    attempt([](CaseOptions& o) { o.floats = false; });
    attempt([](CaseOptions& o) { o.own_lengths = false; });
    attempt([](CaseOptions& o) { o.cost_seed = 0; });
    attempt([](CaseOptions& o) { o.weld_tolerance = 0; });
    attempt([](CaseOptions& o) { o.delta = 0; });
    attempt([](CaseOptions& o) { o.metric = GEOIDX_METRIC_EXACT; });
    attempt([](CaseOptions& o) { o.lloyd_iterations = 0; });
    attempt([](CaseOptions& o) { o.exact_vertices = 400; });
    attempt([](CaseOptions& o) { o.target_error = 0; });
}

MeshCase without_unused_vertices(const MeshCase& whole) {
    MeshCase result{{{}, {}}, whole.options};
    std::vector<uint32_t> new_id(whole.soup.positions.size(), UINT32_MAX);
    for (auto triangle : whole.soup.triangles) {
        for (uint32_t& id : triangle) {
            if (new_id[id] == UINT32_MAX) {
                new_id[id] = result.soup.vertex_count();
                result.soup.positions.push_back(whole.soup.positions[id]);
            }
            id = new_id[id];
        }
        result.soup.triangles.push_back(triangle);
    }
    return result;
}

}

MeshCase shrunk(MeshCase failing, const std::string& check) {
    SameFailure still_fails(check);
    make_plainer(failing, still_fails);
    for (size_t at_once = failing.soup.triangles.size() / 2; at_once > 0;)
        if (!remove_triangles(failing, still_fails, at_once)) at_once /= 2;
    make_plainer(failing, still_fails);
    MeshCase compact = without_unused_vertices(failing);
    return still_fails(compact) ? compact : failing;
}

}
