#pragma once

#include "src/metric/event_queue.h"
#include "src/metric/metric.h"

namespace geodesic {

// A solver whose front passes the vertices from the nearest on (Dijkstra): each is left once, when its
// distance is final.
class VertexFront : public FieldSolver {
protected:
    explicit VertexFront(uint32_t vertex_count) : FieldSolver(vertex_count), pending_(vertex_count) {}

    // Reaches what can be reached from a vertex directly, which is no nearer.
    virtual void leave(uint32_t vertex) = 0;

    void reach(uint32_t vertex, double distance, uint32_t nearest) {
        if (improve(vertex, distance, nearest)) queue_.push(distance, vertex);
    }

private:
    void run(const FieldRequest& request) final {
        queue_.clear();
        pending_.begin(request);
        for (uint32_t i = 0; i < request.sources.size(); ++i) reach(request.sources[i], 0, i);
        while (!queue_.empty()) {
            check_cancelled_sometimes();
            const auto event = queue_.pop();
            if (event.distance > request.radius) break;
            if (event.distance != distance(event.item)) continue;
            if (pending_.settle(event.item)) break;
            leave(event.item);
        }
    }

    EventQueue queue_;
    PendingTargets pending_;
};

}
