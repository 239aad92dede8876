#include "src/mesh/intake.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

#include <xxhash.h>

#include "format/error.h"
#include "src/mesh/spatial_order.h"
#include "src/mesh/weld.h"

namespace geodesic {

namespace {

constexpr uint64_t MOST_VERTICES = UINT32_MAX - 1;
constexpr uint64_t MOST_TRIANGLES = MOST_VERTICES / 3; // their corners are counted in 32 bits

[[noreturn]] void bad_mesh(const std::string& detail) { throw Error(GEOIDX_ERROR_BAD_MESH, detail); }

void check_count(uint64_t count, uint64_t most, const char* what) {
    if (count == 0) bad_mesh(std::string("the mesh has no ") + what);
    if (count > most)
        throw Error(GEOIDX_ERROR_LIMIT, "the mesh has " + std::to_string(count) + " " + what +
                                            ", more than " + std::to_string(most));
}

void check_arrays(const geoidx_mesh& mesh) {
    if (mesh.position_type != GEOIDX_POSITION_FLOAT && mesh.position_type != GEOIDX_POSITION_DOUBLE)
        refuse_argument("position_type " + std::to_string(mesh.position_type) +
                        " is not a GEOIDX_POSITION_*");
    check_count(mesh.vertex_count, MOST_VERTICES, "vertices");
    check_count(mesh.triangle_count, MOST_TRIANGLES, "triangles");
    if (!mesh.positions) refuse_argument("positions is NULL");
    if (!mesh.triangles) refuse_argument("triangles is NULL");
}

template <class Scalar>
Eigen::Vector3d position_at(const std::byte* address) {
    Scalar xyz[3];
    std::memcpy(xyz, address, sizeof xyz);
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
}

// The file and the fingerprint hold positions as floats.
void check_position(const Eigen::Vector3d& position, size_t vertex) {
    if (!position.allFinite())
        bad_mesh("vertex " + std::to_string(vertex) + " has a position that is NaN or infinite");
    if (position.cwiseAbs().maxCoeff() > double{FLT_MAX})
        bad_mesh("vertex " + std::to_string(vertex) +
                 " has a coordinate that is larger than a 32-bit float holds");
}

std::vector<std::array<uint32_t, 3>> read_triangles(const geoidx_mesh& mesh) {
    std::vector<std::array<uint32_t, 3>> triangles(mesh.triangle_count);
    std::memcpy(triangles.data(), mesh.triangles, triangles.size() * sizeof triangles[0]);
    for (size_t i = 0; i < triangles.size(); ++i)
        for (uint32_t id : triangles[i])
            if (id >= mesh.vertex_count)
                bad_mesh("triangle " + std::to_string(i) + " uses vertex " + std::to_string(id) +
                         ", but the mesh has " + std::to_string(mesh.vertex_count) + " vertices");
    return triangles;
}

bool is_degenerate(const std::array<uint32_t, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

struct CleanTriangles {
    std::vector<std::array<uint32_t, 3>> kept;                                  // in the caller's order
    std::vector<uint32_t> kept_of_triangle;                                     // NONE where it is degenerate
    std::unordered_map<uint32_t, std::array<uint32_t, 3>> corners_of_duplicate; // as in Intake
};

// Which corner of `kept` each corner of a triangle with the same vertices is.
std::array<uint32_t, 3> matching_corners(const std::array<uint32_t, 3>& triangle,
                                         const std::array<uint32_t, 3>& kept) {
    std::array<uint32_t, 3> corners;
    for (size_t k = 0; k < 3; ++k)
        corners[k] = static_cast<uint32_t>(std::ranges::find(kept, triangle[k]) - kept.begin());
    return corners;
}

// Drops triangles that are degenerate after welding, and all but the first of equal ones.
CleanTriangles clean_triangles(std::vector<std::array<uint32_t, 3>> triangles,
                               const std::vector<uint32_t>& representative) {
    struct Sorted {
        std::array<uint32_t, 3> vertices;
        uint32_t index;
        auto operator<=>(const Sorted&) const = default;
    };
    std::vector<Sorted> sorted;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        for (uint32_t& id : triangles[i]) id = representative[id];
        if (is_degenerate(triangles[i])) continue;
        sorted.push_back({triangles[i], i});
        std::ranges::sort(sorted.back().vertices);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<uint32_t> first_equal(triangles.size(), NONE);
    for (size_t i = 0; i < sorted.size(); ++i) {
        const bool again = i > 0 && sorted[i].vertices == sorted[i - 1].vertices;
        first_equal[sorted[i].index] = again ? first_equal[sorted[i - 1].index] : sorted[i].index;
    }
    CleanTriangles clean;
    for (uint32_t i = 0; i < triangles.size(); ++i) {
        const bool is_first = first_equal[i] == i;
        clean.kept_of_triangle.push_back(is_first                 ? static_cast<uint32_t>(clean.kept.size())
                                         : first_equal[i] == NONE ? NONE
                                                                  : clean.kept_of_triangle[first_equal[i]]);
        if (is_first)
            clean.kept.push_back(triangles[i]);
        else if (first_equal[i] != NONE)
            clean.corners_of_duplicate[i] = matching_corners(triangles[i], triangles[first_equal[i]]);
    }
    return clean;
}

// Numbers the vertices that triangles use, neighbours close together, and rewrites the triangles.
void number_used_vertices(Intake& intake, const std::vector<Eigen::Vector3d>& positions,
                          const std::vector<uint32_t>& representative,
                          std::vector<std::array<uint32_t, 3>>& triangles) {
    std::vector<uint32_t> number(positions.size(), NONE);
    for (const auto& triangle : triangles)
        for (uint32_t id : triangle) number[id] = 0;
    std::vector<uint32_t> used;
    for (uint32_t id = 0; id < number.size(); ++id)
        if (number[id] != NONE) used.push_back(id);
    intake.id_of_vertex = spatial_order(positions, std::move(used));
    for (uint32_t id : intake.id_of_vertex) {
        number[id] = intake.mesh.vertex_count();
        intake.mesh.positions.push_back(positions[id]);
    }
    for (auto& triangle : triangles)
        for (uint32_t& id : triangle) id = number[id];
    intake.vertex_of_id.resize(positions.size());
    for (size_t id = 0; id < positions.size(); ++id) intake.vertex_of_id[id] = number[representative[id]];
}

// Orders the faces as their vertices are.
void number_faces(Intake& intake, const CleanTriangles& clean) {
    std::vector<uint32_t> order(clean.kept.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](uint32_t i) { return std::ranges::min(clean.kept[i]); });
    std::vector<uint32_t> face_of_kept(order.size());
    for (uint32_t i : order) {
        face_of_kept[i] = intake.mesh.face_count();
        intake.mesh.faces.push_back(clean.kept[i]);
    }
    for (uint32_t kept : clean.kept_of_triangle)
        intake.face_of_triangle.push_back(kept == NONE ? NONE : face_of_kept[kept]);
}

// Names the first such edge by the caller's ids.
void refuse_edges_of_many(const Intake& intake) {
    const Mesh& mesh = intake.mesh;
    std::pair<uint32_t, uint32_t> first{NONE, NONE};
    size_t faces_of_first = 0;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e) {
        if (mesh.edge_faces[e].size() <= 2) continue;
        const auto [low, high] =
            std::minmax(intake.id_of_vertex[mesh.edges[e][0]], intake.id_of_vertex[mesh.edges[e][1]]);
        if (std::pair(low, high) > first) continue;
        first = {low, high};
        faces_of_first = mesh.edge_faces[e].size();
    }
    if (faces_of_first > 0)
        bad_mesh("the edge between vertices " + std::to_string(first.first) + " and " +
                 std::to_string(first.second) + " has " + std::to_string(faces_of_first) +
                 " triangles, more than two");
}

double bounding_box_diagonal(const Mesh& mesh) {
    Eigen::Vector3d low = mesh.positions[0], high = mesh.positions[0];
    for (const auto& p : mesh.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).stableNorm();
}

// Of floats, so that a mesh is the same one whether its positions are given in single or in double precision.
// Adding 0 makes -0, which texts and programs may lose, the same as +0.
uint64_t fingerprint(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<uint32_t, 3>>& triangles) {
    std::vector<std::array<float, 3>> rounded(positions.size());
    for (size_t i = 0; i < positions.size(); ++i)
        for (size_t k = 0; k < 3; ++k)
            rounded[i][k] = static_cast<float>(positions[i][static_cast<Eigen::Index>(k)]) + 0.0f;
    const uint64_t first = XXH3_64bits(rounded.data(), rounded.size() * sizeof rounded[0]);
    return XXH3_64bits_withSeed(triangles.data(), triangles.size() * sizeof triangles[0], first);
}

// Drops what is degenerate or there twice, and numbers the rest.
Intake clean_mesh(const std::vector<Eigen::Vector3d>& positions,
                  const std::vector<std::array<uint32_t, 3>>& triangles,
                  const std::vector<uint32_t>& representative) {
    Intake intake;
    intake.fingerprint = fingerprint(positions, triangles);
    CleanTriangles clean = clean_triangles(triangles, representative);
    if (clean.kept.empty()) bad_mesh("every triangle of the mesh is degenerate");
    number_used_vertices(intake, positions, representative, clean.kept);
    number_faces(intake, clean);
    intake.corners_of_duplicate = std::move(clean.corners_of_duplicate);
    connect(intake.mesh);
    intake.bounding_box_diagonal = bounding_box_diagonal(intake.mesh);
    if (!std::isfinite(intake.bounding_box_diagonal) || intake.bounding_box_diagonal > FLT_MAX)
        bad_mesh("the bounding box is too large: distances would not fit a 32-bit float");
    if (intake.bounding_box_diagonal < FLT_MIN)
        bad_mesh("the bounding box is too small: distances would not fit a 32-bit float");
    return intake;
}

}

size_t position_stride(const geoidx_mesh& mesh) {
    const size_t scalar = mesh.position_type == GEOIDX_POSITION_DOUBLE ? sizeof(double) : sizeof(float);
    if (mesh.position_stride == 0) return 3 * scalar;
    if (mesh.position_stride < 3 * scalar)
        refuse_argument("position_stride " + std::to_string(mesh.position_stride) +
                        " is less than three coordinates");
    return mesh.position_stride;
}

std::vector<Eigen::Vector3d> positions_of(const geoidx_mesh& mesh) {
    const size_t stride = position_stride(mesh);
    const auto* bytes = static_cast<const std::byte*>(mesh.positions);
    const auto read = mesh.position_type == GEOIDX_POSITION_DOUBLE ? position_at<double> : position_at<float>;
    std::vector<Eigen::Vector3d> positions(mesh.vertex_count);
    for (size_t i = 0; i < positions.size(); ++i) {
        positions[i] = read(bytes + i * stride);
        check_position(positions[i], i);
    }
    return positions;
}

uint64_t mesh_fingerprint(const geoidx_mesh& mesh) {
    check_arrays(mesh);
    return fingerprint(positions_of(mesh), read_triangles(mesh));
}

Intake take_in(const geoidx_mesh& mesh, const IntakeOptions& options) {
    if (!(options.weld_tolerance >= 0) || !std::isfinite(options.weld_tolerance))
        refuse_argument("weld_tolerance must be finite and not negative");
    check_arrays(mesh);
    const auto positions = positions_of(mesh);
    Intake intake = clean_mesh(positions, read_triangles(mesh), weld(positions, options.weld_tolerance));
    if (options.refuse_edges_of_many) refuse_edges_of_many(intake);
    return intake;
}

Intake take_in_welded(const geoidx_mesh& mesh, const std::vector<uint32_t>& representative) {
    check_arrays(mesh);
    return clean_mesh(positions_of(mesh), read_triangles(mesh), representative);
}

}
