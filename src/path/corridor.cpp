#include "src/path/corridor.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "src/surface/face_boxes.h"

namespace geodesic {

namespace {

double longest_edge_at(const Surface& surface, uint32_t vertex) {
    double longest = 0;
    for (const uint32_t face : surface.vertex_faces[vertex])
        for (const uint32_t other : surface.faces[face])
            longest = std::max(longest, (surface.positions[other] - surface.positions[vertex]).norm());
    return longest;
}

// Vertices of a surface with numbers of their own.
class Renumbering {
public:
    uint32_t number(uint32_t vertex) {
        const auto [found, is_new] = numbers_.try_emplace(vertex, static_cast<uint32_t>(vertices_.size()));
        if (is_new) vertices_.push_back(vertex);
        return found->second;
    }
    const std::vector<uint32_t>& vertices() const { return vertices_; }

private:
    std::unordered_map<uint32_t, uint32_t> numbers_;
    std::vector<uint32_t> vertices_;
};

// The faces are different ones.
Corridor corridor_of_faces(const Surface& surface, std::vector<uint32_t>&& faces) {
    Corridor corridor{{}, std::move(faces)};
    Renumbering renumbering;
    for (const uint32_t face : corridor.surface_face) {
        auto& local = corridor.mesh.faces.emplace_back();
        for (size_t k = 0; k < 3; ++k) local[k] = renumbering.number(surface.faces[face][k]);
    }
    for (const uint32_t vertex : renumbering.vertices())
        corridor.mesh.positions.push_back(surface.positions[vertex]);
    connect(corridor.mesh);
    return corridor;
}

double distance_in_space(const Surface& surface, uint32_t face, const Eigen::Vector3d& position) {
    return (position_of(surface, closest_on_face(surface, face, position)) - position).norm();
}

}

Corridor corridor_around(const Surface& surface, const Strip& strip,
                         const std::function<bool(uint32_t, double)>& belongs) {
    std::unordered_set<uint32_t> met; // vertices
    std::vector<uint32_t> waiting;
    const auto meet = [&](uint32_t vertex, bool for_sure) {
        if (!met.insert(vertex).second) return;
        if (for_sure || belongs(vertex, longest_edge_at(surface, vertex))) waiting.push_back(vertex);
    };
    for (const uint32_t face : strip.faces)
        for (const uint32_t vertex : surface.faces[face]) meet(vertex, true);
    std::vector<uint32_t> faces;
    while (!waiting.empty()) {
        const uint32_t vertex = waiting.back();
        waiting.pop_back();
        for (const uint32_t face : surface.vertex_faces[vertex]) {
            faces.push_back(face);
            for (const uint32_t other : surface.faces[face]) meet(other, false);
        }
    }
    std::ranges::sort(faces);
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return corridor_of_faces(surface, std::move(faces));
}

std::optional<Corridor> corridor_in_space(const Surface& surface, const Strip& strip, double length,
                                          size_t most_faces) {
    constexpr size_t MOST_KNOWN = 8; // times the faces that belong
    const Eigen::Vector3d source = position_of(surface, strip.source),
                          target = position_of(surface, strip.target);
    std::vector<uint32_t> faces{strip.source.face};
    if (strip.target.face != strip.source.face) faces.push_back(strip.target.face);
    std::unordered_set<uint32_t> known(faces.begin(), faces.end()); // whether they belong or not
    std::unordered_set<uint32_t> passed;                            // vertices
    for (size_t i = 0; i < faces.size(); ++i)
        for (const uint32_t vertex : surface.faces[faces[i]]) {
            if (!passed.insert(vertex).second) continue;
            for (const uint32_t face : surface.vertex_faces[vertex]) {
                if (!known.insert(face).second) continue;
                if (known.size() > MOST_KNOWN * most_faces) return std::nullopt;
                if (distance_in_space(surface, face, source) + distance_in_space(surface, face, target) >
                    length)
                    continue;
                if (faces.size() == most_faces) return std::nullopt;
                faces.push_back(face);
            }
        }
    return corridor_of_faces(surface, std::move(faces));
}

}
