#include "src/metric/fast_marching.h"

#include <algorithm>
#include <cmath>

#include "src/base/plane.h"
#include "src/metric/vertex_front.h"

namespace geodesic {

namespace {

// A point beside the line through the first two vertices of a face: how far along the line from the first
// one, and how far off it. `height` is NaN where no point has such distances.
struct PointBeside {
    double foot, height;
};

PointBeside point_beside(double from_first, double from_second, double length) {
    const double foot = foot_of(length, from_first, from_second);
    return {foot, std::sqrt(from_first * from_first - foot * foot)};
}

// The third vertex of a face is `to_first` and `to_second` from the two others, which are `length` from each
// other and have these distances. Returns its distance straight over the edge between them, or infinity where
// the way does not cross this edge.
double distance_across(double first, double second, double length, double to_first, double to_second) {
    const PointBeside source = point_beside(first, second, length),
                      target = point_beside(to_first, to_second, length);
    const double heights = source.height + target.height;
    const double crossing = source.foot * target.height + target.foot * source.height;
    if (!(crossing > 0 && crossing < length * heights)) return UNREACHABLE;
    return hypotenuse(source.foot - target.foot, heights);
}

class FastMarching final : public VertexFront {
public:
    explicit FastMarching(std::shared_ptr<const ListOfLists<FastMarchingMetric::Corner>> corners)
        : VertexFront(static_cast<uint32_t>(corners->size())), corners_(std::move(corners)) {}

private:
    void leave(uint32_t vertex) override {
        for (const auto& corner : (*corners_)[vertex]) pass(vertex, corner);
    }

    void pass(uint32_t vertex, const FastMarchingMetric::Corner& corner) {
        const auto& [first, second, to_first, to_second, between] = corner;
        reach_over(vertex, to_first, second, to_second, first, between);
        reach_over(vertex, to_second, first, to_first, second, between);
    }

    // Reaches the third vertex of a face from `vertex`, whose distance is final, and across the edge to
    // another one if that one's is, too. What is reached is no nearer than what is final.
    void reach_over(uint32_t vertex, double to_third, uint32_t other, double to_other, uint32_t third,
                    double other_to_third) {
        const double own = distance(vertex), along = own + to_third;
        reach(third, along, nearest(vertex));
        if (distance(other) > own) return;
        const double across = distance_across(own, distance(other), to_other, to_third, other_to_third);
        const uint32_t nearer = along < distance(other) + other_to_third ? vertex : other;
        reach(third, std::max(own, across), nearest(nearer));
    }

    std::shared_ptr<const ListOfLists<FastMarchingMetric::Corner>> corners_;
};

}

FastMarchingMetric::FastMarchingMetric(const Mesh& mesh, std::span<const double> lengths) {
    auto corners = std::make_shared<ListOfLists<Corner>>();
    corners->items.reserve(mesh.vertex_faces.items.size());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (const uint32_t f : mesh.vertex_faces[v]) {
            const auto& face = mesh.faces[f];
            const auto k = static_cast<size_t>(std::ranges::find(face, v) - face.begin());
            const size_t i = (k + 1) % 3, j = (k + 2) % 3;
            const auto length = [&](size_t corner) { return lengths[mesh.face_edges[f][corner]]; };
            corners->items.push_back({face[i], face[j], length(j), length(i), length(k)});
        }
        corners->close_list();
    }
    corners_ = std::move(corners);
}

std::unique_ptr<FieldSolver> FastMarchingMetric::make_solver() const {
    return std::make_unique<FastMarching>(corners_);
}

}
