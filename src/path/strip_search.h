#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "src/base/number_map.h"
#include "src/path/open_nodes.h"
#include "src/path/strip.h"

namespace geodesic {

// What a search knows of the distances to its target.
struct TargetDistances {
    std::function<double(uint32_t)> at_vertex; // infinite where unknown
    // As a share, how far they may be off: ways that lead on are followed unless others seem shorter by more.
    double error = 0;
    size_t most_steps = SIZE_MAX; // faces and vertices to leave before a search is given up
};

// Finds strips from one point to another: A* over faces, each entered at a point of an edge, and over
// vertices. A step crosses an edge where the way on, straight to where the distances of the edge's ends
// place the target, is shortest. Every face and every vertex is left at most once, so that distances that are
// not quite right change the way but never make it endless. It keeps its arrays from one strip to the next.
class StripSearch {
public:
    explicit StripSearch(const Surface& surface) : surface_(surface) {}

    // Nothing if there is no way, or if it is given up.
    std::optional<Strip> run(const SurfacePoint& source, const SurfacePoint& target,
                             const TargetDistances& distances);

private:
    // Two vertices, the one with the smaller number first, and how far they are from the target.
    struct Edge {
        Portal ends;
        double rest_a, rest_b;
    };
    static Edge edge_between(uint32_t a, double rest_a, uint32_t b, double rest_b) {
        return a < b ? Edge{{a, b}, rest_a, rest_b} : Edge{{b, a}, rest_b, rest_a};
    }
    enum class Kind : uint32_t { FACE, VERTEX, TARGET };
    struct Node {
        Kind kind;
        uint32_t item;
        uint32_t before;
        Edge entry;    // that a face was entered by: of a vertex it twice, and NONE where the way begins
        double share;  // from the first end of the entry
        double length; // up to there
    };
    // A face that a way is going to leave, from a position on its border.
    struct Leaving {
        uint32_t node, face;
        Eigen::Vector3d at;
        double length;
    };
    // Where it crosses an edge of the face, once that is known.
    struct Crossing {
        bool is_known = false;
        double share = 0, rest = 0, length = 0;
    };

    // The least length in all over nodes that are open at a face or a vertex.
    struct Expected {
        double length = UNREACHABLE;
    };
    struct Vertex {
        Expected expected;
        double rest = UNKNOWN; // how far it is from the target
    };
    static constexpr double UNKNOWN = -1;
    static constexpr double CLOSED = -UNREACHABLE; // expected where no node is opened any more

    void begin(const SurfacePoint& source, const SurfacePoint& target);
    Expected& expected_at(const Node& node) {
        return node.kind == Kind::FACE ? faces_[node.item] : vertices_[node.item].expected;
    }
    Eigen::Vector3d position(const Node& node) const;
    void open(Expected& expected, double rest, const Node& node);
    bool close(const Node& node);
    void reach_target(const Leaving& leaving);
    void leave_face(uint32_t index);
    double rest_from(uint32_t vertex, const Edge& entry);
    void pass_vertex(const Leaving& leaving, uint32_t vertex);
    void pass_edge(const Leaving& leaving, const Edge& edge);
    Crossing cross(const Leaving& leaving, const Edge& edge) const;
    void leave_vertex(uint32_t index);
    Strip strip_to(uint32_t index) const;

    const Surface& surface_;
    const TargetDistances* distances_ = nullptr; // of a run
    Eigen::Vector3d target_position_;
    std::vector<SurfacePoint> sources_, targets_; // as aliases_of()
    OpenNodes<Node> open_;
    NumberMap<Expected> faces_;
    NumberMap<Vertex> vertices_;
};

// One strip.
std::optional<Strip> search_strip(const Surface& surface, const SurfacePoint& source,
                                  const SurfacePoint& target, const TargetDistances& distances);

}
