#include "src/metric/intrinsic_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "src/mesh/angle.h"
#include "src/mesh/components.h"

namespace geodesic {

namespace {

uint32_t corner_at(const Mesh& mesh, uint32_t face, uint32_t vertex) {
    const auto& f = mesh.faces[face];
    return 3 * face + (f[0] == vertex ? 0u : f[1] == vertex ? 1u : 2u);
}

uint32_t other_edge_at(const Mesh& mesh, uint32_t corner, uint32_t edge) {
    const auto& edges = mesh.face_edges[corner / 3];
    const uint32_t first = edges[(corner + 1) % 3], second = edges[(corner + 2) % 3];
    return first == edge ? second : first;
}

uint32_t other_face_at(const Mesh& mesh, uint32_t edge, uint32_t face) {
    const auto faces = mesh.edge_faces[edge];
    if (faces.size() != 2) return NONE;
    return faces[0] == face ? faces[1] : faces[0];
}

// Of a triangle with sides a, b, c: four times its area, and the angle opposite to a; stable for needles
// (Kahan).
double quadruple_area(double a, double b, double c) {
    if (a < b) std::swap(a, b);
    if (b < c) std::swap(b, c);
    if (a < b) std::swap(a, b);
    const double product = (1 + (b + c) / a) * ((c - (a - b)) / a) * ((c + (a - b)) / a) * (1 + (b - c) / a);
    return a * a * std::sqrt(product);
}

double angle_opposite(double a, double b, double c) {
    if (b < c) std::swap(b, c);
    const double mu = c >= a ? a - (b - c) : c - (b - a);
    return 2 * std::atan2(std::sqrt(((b - c) + a) * mu), std::sqrt((b + (c + a)) * ((b - a) + c)));
}

// How far along a side the opposite corner is, at the distances `a` from where it begins and `b` from its
// end: (base^2 + a^2 - b^2) / (2 base). The difference of the squares of two long sides is a product, so that
// it keeps what is left of it beside the short one.
double foot_of_apex(double base, double a, double b) {
    return a < base ? 0.5 * ((base - b) * (base + b) + a * a) / base
                    : 0.5 * (base + (a - b) * ((a + b) / base));
}

// How much the two shorter sides of a face are longer than the longest.
double slack(double a, double b, double c) {
    const double longest = std::max({a, b, c});
    return a == longest ? b - (a - c) : b == longest ? a - (b - c) : a - (c - b);
}

// By how much all edges of a face must be longer, if at all, for it to have an area.
double missing_length(const Mesh& mesh, const std::array<uint32_t, 3>& edges) {
    constexpr double SMALLEST_SLACK = 2e-15;
    const double a = mesh.edge_length(edges[0]), b = mesh.edge_length(edges[1]),
                 c = mesh.edge_length(edges[2]);
    return std::max(0.0, SMALLEST_SLACK * std::max({a, b, c}) - slack(a, b, c));
}

// Paths through a face without area have no direction. Where a component has such a face, all of its edges
// are made longer by one length that gives each of these a height, of some 1e-8 of its longest edge
// (intrinsic mollification, Sharp and Crane 2020): then lengths, and not positions, make the surface. Returns
// an empty list where all faces have an area.
std::vector<double> mollified_lengths(const Mesh& mesh) {
    const auto has_area = [&](const auto& edges) { return missing_length(mesh, edges) == 0; };
    if (std::ranges::all_of(mesh.face_edges, has_area)) return {};
    const Components components = components_of(mesh);
    const auto component_of = [&](uint32_t edge) { return components.of_vertex[mesh.edges[edge][0]]; };
    std::vector<double> addition(components.all.size(), 0);
    for (const auto& edges : mesh.face_edges) {
        double& most = addition[component_of(edges[0])];
        most = std::max(most, missing_length(mesh, edges));
    }
    std::vector<double> lengths;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e)
        lengths.push_back(mesh.edge_length(e) + addition[component_of(e)]);
    return lengths;
}

// The shape of a face as positions or own lengths have it.
class Shapes {
public:
    Shapes(const Mesh& mesh, std::span<const double> own_lengths) : mesh_(mesh), own_lengths_(own_lengths) {}

    double length(uint32_t edge) const {
        return own_lengths_.empty() ? mesh_.edge_length(edge) : own_lengths_[edge];
    }

    double angle(uint32_t corner) const {
        const auto& f = mesh_.faces[corner / 3];
        const uint32_t k = corner % 3;
        if (!own_lengths_.empty()) {
            const auto& edges = mesh_.face_edges[corner / 3];
            return angle_opposite(own_lengths_[edges[k]], own_lengths_[edges[(k + 1) % 3]],
                                  own_lengths_[edges[(k + 2) % 3]]);
        }
        const Eigen::Vector3d a = mesh_.positions[f[(k + 1) % 3]] - mesh_.positions[f[k]];
        const Eigen::Vector3d b = mesh_.positions[f[(k + 2) % 3]] - mesh_.positions[f[k]];
        return angle_between(a, b);
    }

    // Where the apex lies seen from an edge (see Side). `from_first`, `from_second`: the edges to it. What is
    // measured from one end of the edge rounds away how close the apex is to the other.
    void place_apex(uint32_t edge, uint32_t vertex, uint32_t from_first, uint32_t from_second,
                    Side& side) const {
        if (!own_lengths_.empty()) {
            const double base = own_lengths_[edge], a = own_lengths_[from_first],
                         b = own_lengths_[from_second];
            side.apex_x = foot_of_apex(base, a, b);
            side.apex_back = foot_of_apex(base, b, a);
            side.apex_depth = 0.5 * quadruple_area(base, a, b) / base;
            return;
        }
        const auto [first, second] = mesh_.edges[edge];
        const Eigen::Vector3d along = (mesh_.positions[second] - mesh_.positions[first]).normalized();
        const Eigen::Vector3d to_apex = mesh_.positions[vertex] - mesh_.positions[first],
                              back = mesh_.positions[second] - mesh_.positions[vertex];
        side.apex_x = to_apex.dot(along);
        side.apex_back = back.dot(along);
        const bool is_at_first = side.apex_x < side.apex_back;
        side.apex_depth = (is_at_first ? to_apex : back).cross(along).norm();
    }

private:
    const Mesh& mesh_;
    std::span<const double> own_lengths_;
};

Side unfold(const Mesh& mesh, const Shapes& shapes, uint32_t edge, uint32_t face) {
    const auto [first, second] = mesh.edges[edge];
    const auto& f = mesh.faces[face];
    uint32_t k = 0;
    while (f[k] == first || f[k] == second) ++k;
    Side side{0, 0, 0, f[k], face, {}};
    uint32_t edge_from[2];
    for (uint32_t i = 0; i < 2; ++i) {
        const uint32_t from = mesh.edges[edge][i];
        const uint32_t opposite = f[(k + 1) % 3] == from ? (k + 2) % 3 : (k + 1) % 3;
        const uint32_t e = edge_from[i] = mesh.face_edges[face][opposite];
        side.tagged_edge[i] = e << 1 | (mesh.edges[e][0] == f[k] ? 1u : 0u);
    }
    shapes.place_apex(edge, f[k], edge_from[0], edge_from[1], side);
    return side;
}

void add_sides(const Mesh& mesh, const Shapes& shapes, IntrinsicMesh& out) {
    out.edge_vertices = mesh.edges;
    out.side_of_corner.resize(mesh.faces.size() * 3);
    for (const auto& edges : mesh.face_edges)
        out.edge_of_corner.insert(out.edge_of_corner.end(), edges.begin(), edges.end());
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        out.edge_length.push_back(shapes.length(e));
        for (uint32_t face : mesh.edge_faces[e]) {
            const Side side = unfold(mesh, shapes, e, face);
            const uint32_t corner = corner_at(mesh, face, side.apex);
            out.side_of_corner[corner] = static_cast<uint32_t>(out.sides.items.size());
            out.corner_of_side.push_back(corner);
            out.sides.items.push_back(side);
        }
        out.sides.close_list();
    }
}

void add_spokes(const Mesh& mesh, IntrinsicMesh& out) {
    const auto by_vertex = edge_ends_at_vertices(mesh);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (uint32_t end : by_vertex[v])
            out.spokes.items.push_back({out.edge_length[end / 2], end / 2, mesh.edges[end / 2][1 - end % 2]});
        out.spokes.close_list();
    }
}

// Where to begin going around a vertex: at a boundary edge if there is one, else anywhere.
std::pair<uint32_t, uint32_t> fan_start(const Mesh& mesh, uint32_t vertex) {
    for (uint32_t face : mesh.vertex_faces[vertex]) {
        const uint32_t corner = corner_at(mesh, face, vertex);
        for (uint32_t k = 1; k < 3; ++k) {
            const uint32_t edge = mesh.face_edges[face][(corner % 3 + k) % 3];
            if (mesh.edge_faces[edge].size() != 2) return {corner, edge};
        }
    }
    const uint32_t corner = corner_at(mesh, mesh.vertex_faces[vertex][0], vertex);
    return {corner, mesh.face_edges[corner / 3][(corner % 3 + 1) % 3]};
}

// Below this share of the extent of a component, rounding hides on which side of an edge's ends paths
// pass. The root of the sum of all squares of lengths is some times the extent.
class ShortLengths {
public:
    ShortLengths(const Mesh& mesh, std::span<const double> edge_length) {
        double squares = 0;
        for (const double length : edge_length) squares += length * length;
        of_whole_ = below(squares);
        // Of a component it is no longer than that.
        if (std::ranges::all_of(edge_length, [&](double length) { return length >= of_whole_; })) return;
        Components components = components_of(mesh);
        of_component_.resize(components.all.size(), 0);
        for (uint32_t e = 0; e < mesh.edge_count(); ++e)
            of_component_[components.of_vertex[mesh.edges[e][0]]] += edge_length[e] * edge_length[e];
        for (double& of_component : of_component_) of_component = below(of_component);
        component_of_vertex_ = std::move(components.of_vertex);
    }

    // On the component of a vertex.
    double at(uint32_t vertex) const {
        return of_component_.empty() ? of_whole_ : of_component_[component_of_vertex_[vertex]];
    }

private:
    static double below(double squares) { return 1e-7 * std::sqrt(squares); }

    double of_whole_ = 0;
    std::vector<double> of_component_; // none where no edge is short
    std::vector<uint32_t> component_of_vertex_;
};

bool has_short_edge(const IntrinsicMesh& mesh, uint32_t vertex, double shortest) {
    return std::ranges::any_of(mesh.spokes[vertex],
                               [&](const Spoke& spoke) { return spoke.length < shortest; });
}

// Walks the faces around a vertex and lays their angles side by side.
void add_fan(const Mesh& mesh, uint32_t vertex, double shortest, IntrinsicMesh& out) {
    const auto faces = mesh.vertex_faces[vertex];
    for (uint32_t face : faces) out.corners.items.push_back(corner_at(mesh, face, vertex));
    out.corners.close_list();

    auto [corner, edge] = fan_start(mesh, vertex);
    const uint32_t first_edge = edge;
    const bool open = mesh.edge_faces[edge].size() == 1;
    bool simple = mesh.edge_faces[edge].size() <= 2;
    double angle = 0;
    size_t visited = 0;
    while (corner != NONE && visited < faces.size()) {
        out.corner_begin[corner] = angle;
        out.corner_first_edge[corner] = edge;
        angle += out.corner_angle[corner];
        ++visited;
        edge = other_edge_at(mesh, corner, edge);
        simple = simple && mesh.edge_faces[edge].size() <= 2;
        if (edge == first_edge) break;
        const uint32_t face = other_face_at(mesh, edge, corner / 3);
        corner = face == NONE ? NONE : corner_at(mesh, face, vertex);
    }
    out.total_angle[vertex] = angle;
    if (!simple || visited < faces.size() || has_short_edge(out, vertex, shortest))
        out.fan[vertex] = Fan::Irregular;
    else
        out.fan[vertex] = open ? Fan::Open : Fan::Closed;
}

bool can_bend(const IntrinsicMesh& mesh, uint32_t vertex) {
    constexpr double ROUNDING = 1e-12;
    switch (mesh.fan[vertex]) {
    case Fan::Closed:
        return mesh.total_angle[vertex] > 2 * std::numbers::pi + ROUNDING;
    case Fan::Open:
        return mesh.total_angle[vertex] > std::numbers::pi + ROUNDING;
    case Fan::Irregular:
        break;
    }
    return true;
}

}

IntrinsicMesh::IntrinsicMesh(const Mesh& mesh, std::span<const double> own_lengths) {
    const std::vector<double> mollified =
        own_lengths.empty() ? mollified_lengths(mesh) : std::vector<double>();
    if (own_lengths.empty() && mollified.empty()) positions = mesh.positions;
    const Shapes shapes(mesh, own_lengths.empty() ? std::span<const double>(mollified) : own_lengths);
    add_sides(mesh, shapes, *this);
    add_spokes(mesh, *this);
    const size_t corner_count = mesh.faces.size() * 3;
    corner_begin.resize(corner_count);
    corner_angle.resize(corner_count);
    corner_first_edge.resize(corner_count);
    for (uint32_t c = 0; c < corner_count; ++c) corner_angle[c] = shapes.angle(c);
    total_angle.resize(mesh.vertex_count());
    fan.resize(mesh.vertex_count());
    can_bend.resize(mesh.vertex_count());
    const ShortLengths shortest(mesh, edge_length);
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        add_fan(mesh, v, shortest.at(v), *this);
        can_bend[v] = geodesic::can_bend(*this, v);
    }
}

}
