#include "src/mesh/intake.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <string>

#include <xxhash.h>

#include "format/error.h"
#include "src/mesh/weld.h"

namespace geodesic {

namespace {

constexpr uint64_t MAX_COUNT = UINT32_MAX - 1;

[[noreturn]] void bad_mesh(const std::string& detail) { throw Error(GEOIDX_ERROR_BAD_MESH, detail); }

void check_count(uint64_t count, const char* what) {
    if (count == 0) bad_mesh(std::string("the mesh has no ") + what);
    if (count > MAX_COUNT)
        throw Error(GEOIDX_ERROR_LIMIT,
                    "the mesh has " + std::to_string(count) + " " + what + ", more than 2^32 - 2");
}

size_t position_stride(const geoidx_mesh& mesh) {
    const size_t scalar = mesh.position_type == GEOIDX_POSITION_DOUBLE ? sizeof(double) : sizeof(float);
    if (mesh.position_stride == 0) return 3 * scalar;
    if (mesh.position_stride < 3 * scalar)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "position_stride " + std::to_string(mesh.position_stride) +
                                                       " is less than three coordinates");
    return mesh.position_stride;
}

void check_arrays(const geoidx_mesh& mesh) {
    if (mesh.position_type != GEOIDX_POSITION_FLOAT && mesh.position_type != GEOIDX_POSITION_DOUBLE)
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT,
                    "position_type " + std::to_string(mesh.position_type) + " is not a GEOIDX_POSITION_*");
    check_count(mesh.vertex_count, "vertices");
    check_count(mesh.triangle_count, "triangles");
    if (!mesh.positions) throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "positions is NULL");
    if (!mesh.triangles) throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "triangles is NULL");
}

template <class Scalar>
Eigen::Vector3d position_at(const std::byte* address) {
    Scalar xyz[3];
    std::memcpy(xyz, address, sizeof xyz);
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
}

std::vector<Eigen::Vector3d> read_positions(const geoidx_mesh& mesh) {
    const size_t stride = position_stride(mesh);
    const auto* bytes = static_cast<const std::byte*>(mesh.positions);
    const auto read = mesh.position_type == GEOIDX_POSITION_DOUBLE ? position_at<double> : position_at<float>;
    std::vector<Eigen::Vector3d> positions(mesh.vertex_count);
    for (size_t i = 0; i < positions.size(); ++i) {
        positions[i] = read(bytes + i * stride);
        if (!positions[i].allFinite())
            bad_mesh("vertex " + std::to_string(i) + " has a position that is NaN or infinite");
    }
    return positions;
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

// The triangles that remain, in the caller's order: not degenerate after welding, each once.
std::vector<std::array<uint32_t, 3>> clean_triangles(const std::vector<std::array<uint32_t, 3>>& triangles,
                                                     const std::vector<uint32_t>& representative) {
    struct Sorted {
        std::array<uint32_t, 3> vertices;
        size_t index;
        auto operator<=>(const Sorted&) const = default;
    };
    std::vector<Sorted> sorted;
    for (size_t i = 0; i < triangles.size(); ++i) {
        std::array<uint32_t, 3> t = triangles[i];
        for (uint32_t& id : t) id = representative[id];
        if (is_degenerate(t)) continue;
        std::sort(t.begin(), t.end());
        sorted.push_back({t, i});
    }
    std::sort(sorted.begin(), sorted.end());
    const auto same = [](const Sorted& a, const Sorted& b) { return a.vertices == b.vertices; };
    sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
    std::sort(sorted.begin(), sorted.end(), [](auto& a, auto& b) { return a.index < b.index; });

    std::vector<std::array<uint32_t, 3>> clean;
    for (const Sorted& s : sorted) {
        std::array<uint32_t, 3> t = triangles[s.index];
        for (uint32_t& id : t) id = representative[id];
        clean.push_back(t);
    }
    return clean;
}

// Numbers the vertices that faces use, in the order of their ids, and rewrites the faces.
void number_used_vertices(Intake& intake, const std::vector<Eigen::Vector3d>& positions,
                          const std::vector<uint32_t>& representative) {
    std::vector<uint32_t> number(positions.size(), NONE);
    for (const auto& face : intake.mesh.faces)
        for (uint32_t id : face) number[id] = 0;
    for (uint32_t id = 0; id < number.size(); ++id) {
        if (number[id] == NONE) continue;
        number[id] = intake.mesh.vertex_count();
        intake.mesh.positions.push_back(positions[id]);
        intake.id_of_vertex.push_back(id);
    }
    for (auto& face : intake.mesh.faces)
        for (uint32_t& id : face) id = number[id];
    intake.vertex_of_id.resize(positions.size());
    for (size_t id = 0; id < positions.size(); ++id) intake.vertex_of_id[id] = number[representative[id]];
}

void refuse_edges_of_many(const Intake& intake) {
    const Mesh& mesh = intake.mesh;
    for (uint32_t e = 0; e < mesh.edge_count(); ++e)
        if (const size_t faces = mesh.edge_faces[e].size(); faces > 2)
            bad_mesh("the edge between vertices " + std::to_string(intake.id_of_vertex[mesh.edges[e][0]]) +
                     " and " + std::to_string(intake.id_of_vertex[mesh.edges[e][1]]) + " has " +
                     std::to_string(faces) + " triangles, more than two");
}

double bounding_box_diagonal(const Mesh& mesh) {
    Eigen::Vector3d low = mesh.positions[0], high = mesh.positions[0];
    for (const auto& p : mesh.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).stableNorm();
}

uint64_t fingerprint(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<uint32_t, 3>>& triangles) {
    const uint64_t first = XXH3_64bits(positions.data(), positions.size() * sizeof positions[0]);
    return XXH3_64bits_withSeed(triangles.data(), triangles.size() * sizeof triangles[0], first);
}

}

uint64_t mesh_fingerprint(const geoidx_mesh& mesh) {
    check_arrays(mesh);
    return fingerprint(read_positions(mesh), read_triangles(mesh));
}

Intake take_in(const geoidx_mesh& mesh, double weld_tolerance) {
    if (!(weld_tolerance >= 0) || !std::isfinite(weld_tolerance))
        throw Error(GEOIDX_ERROR_INVALID_ARGUMENT, "weld_tolerance must be finite and not negative");
    check_arrays(mesh);
    const auto positions = read_positions(mesh);
    const auto triangles = read_triangles(mesh);

    Intake intake;
    intake.triangle_count = mesh.triangle_count;
    intake.fingerprint = fingerprint(positions, triangles);
    const auto representative = weld(positions, weld_tolerance);
    intake.mesh.faces = clean_triangles(triangles, representative);
    if (intake.mesh.faces.empty()) bad_mesh("every triangle of the mesh is degenerate");
    number_used_vertices(intake, positions, representative);
    connect(intake.mesh);
    refuse_edges_of_many(intake);
    intake.bounding_box_diagonal = bounding_box_diagonal(intake.mesh);
    if (!std::isfinite(intake.bounding_box_diagonal) || intake.bounding_box_diagonal > FLT_MAX)
        bad_mesh("the bounding box is too large: distances would not fit a 32-bit float");
    return intake;
}

}
