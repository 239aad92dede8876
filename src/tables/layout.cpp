#include "src/tables/layout.h"

#include <algorithm>
#include <tuple>

#include "src/tables/borders.h"

namespace geodesic {

namespace {

// Sorting these gives the order of the numbers: first the border vertices by owner, then the internal ones by
// leaf and by distance to the border.
struct VertexInOrder {
    bool internal;
    uint32_t group; // the owner, or the leaf
    double distance_to_border;
    uint32_t vertex;

    auto key() const { return std::tie(internal, group, distance_to_border, vertex); }
};

std::vector<double> distances_to_border(const std::vector<uint32_t>& border, uint32_t vertex_count,
                                        Workers& workers) {
    std::vector<double> result(vertex_count, 0);
    if (border.empty()) return result;
    workers.run(1, [&](FieldSolver& solver, size_t) {
        solver.solve(border, {});
        for (uint32_t v = 0; v < vertex_count; ++v) result[v] = solver.distance(v);
    });
    return result;
}

std::vector<VertexInOrder> vertices_in_order(const Hierarchy& hierarchy,
                                             const ListOfLists<uint32_t>& leaves_at_vertex,
                                             const std::vector<uint8_t>& is_border, Workers& workers) {
    const auto vertex_count = static_cast<uint32_t>(leaves_at_vertex.size());
    std::vector<uint32_t> border;
    for (uint32_t v = 0; v < vertex_count; ++v)
        if (leaves_at_vertex[v].size() > 1 && is_border[v]) border.push_back(v);
    const auto distance = distances_to_border(border, vertex_count, workers);

    std::vector<VertexInOrder> order;
    for (uint32_t v = 0; v < vertex_count; ++v) {
        const auto leaves = leaves_at_vertex[v];
        const bool internal = leaves.size() == 1 || !is_border[v];
        order.push_back({internal, internal ? leaves[0] : common_ancestor(hierarchy, leaves),
                         internal ? distance[v] : 0, v});
    }
    std::sort(order.begin(), order.end(),
              [](const VertexInOrder& a, const VertexInOrder& b) { return a.key() < b.key(); });
    return order;
}

// How many of the vertices `from` .. `to` - 1 belong to each of the `count` groups that begin with `first`.
std::vector<uint32_t> group_sizes(const std::vector<VertexInOrder>& order, size_t from, size_t to,
                                  uint32_t first, uint32_t count) {
    std::vector<uint32_t> sizes(count, 0);
    for (size_t i = from; i < to; ++i) ++sizes[order[i].group - first];
    return sizes;
}

std::vector<ListOfLists<uint32_t>> faces_by_level(const Hierarchy& hierarchy) {
    std::vector<ListOfLists<uint32_t>> levels(hierarchy.level_count() + 1);
    std::vector<uint32_t> patch = hierarchy.leaf_of_face;
    for (uint32_t l = hierarchy.level_count(); l > 0; --l) {
        std::vector<uint32_t> key(patch);
        for (uint32_t& k : key) k -= hierarchy.level_begin[l];
        levels[l] = group_by(key, hierarchy.level_begin[l + 1] - hierarchy.level_begin[l]);
        for (uint32_t& p : patch) p = hierarchy.parent[p];
    }
    return levels;
}

// Finds the vertices on the border of each patch.
class BorderFinder {
public:
    // `number` is by vertex of the mesh, `owner` by number of a border vertex.
    BorderFinder(const Mesh& mesh, const Hierarchy& hierarchy, const std::vector<uint32_t>& number,
                 const std::vector<uint32_t>& owner)
        : mesh_(mesh), hierarchy_(hierarchy), number_(number), owner_(owner), inside_(mesh.face_count(), 0) {}

    // The border of a patch, given by its faces, as numbers in their order along the patch's boundary.
    // Vertices at which the patch only touches another patch come last.
    std::vector<uint32_t> find(uint32_t patch, std::span<const uint32_t> faces) {
        for (uint32_t f : faces) inside_[f] = 1;
        auto walks = walk_border(mesh_, faces, inside_);
        for (uint32_t f : faces) inside_[f] = 0;
        const auto on_border = [&](uint32_t v) { return is_on_border(v, patch); };
        std::vector<uint32_t> border;
        for (auto& walk : walks) {
            // If some vertices of a ring are not on the border, the walk begins at one of them, so that the
            // end of the walk and its beginning do not cut a chain in two.
            if (const auto other = std::ranges::find_if_not(walk, on_border); other != walk.end())
                std::rotate(walk.begin(), other, walk.end());
            for (uint32_t v : walk)
                if (on_border(v)) border.push_back(number_[v]);
        }
        add_touching(patch, faces, border);
        return border;
    }

private:
    // A vertex lies on the border of a patch unless all leaves around it lie inside.
    bool is_on_border(uint32_t vertex, uint32_t patch) const {
        const uint32_t number = number_[vertex];
        return number < owner_.size() && !is_within(hierarchy_, owner_[number], patch);
    }

    void add_touching(uint32_t patch, std::span<const uint32_t> faces, std::vector<uint32_t>& border) const {
        std::vector<uint32_t> touching, known(border);
        for (uint32_t f : faces)
            for (uint32_t v : mesh_.faces[f])
                if (is_on_border(v, patch)) touching.push_back(number_[v]);
        std::sort(touching.begin(), touching.end());
        touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
        std::sort(known.begin(), known.end());
        std::set_difference(touching.begin(), touching.end(), known.begin(), known.end(),
                            std::back_inserter(border));
    }

    const Mesh& mesh_;
    const Hierarchy& hierarchy_;
    const std::vector<uint32_t>&number_, &owner_;
    std::vector<uint8_t> inside_; // per face
};

void lay_out_borders(BorderFinder& finder, const Hierarchy& hierarchy, Workers& workers,
                     StoredIndex& stored) {
    const auto faces = faces_by_level(hierarchy);
    for (uint32_t l = 1; l <= hierarchy.level_count(); ++l)
        workers.run(1, [&](FieldSolver&, size_t) {
            for (uint32_t i = 0; i < faces[l].size(); ++i) {
                const auto border = finder.find(hierarchy.level_begin[l] + i, faces[l][i]);
                stored.border_size.push_back(static_cast<uint32_t>(border.size()));
                stored.border.insert(stored.border.end(), border.begin(), border.end());
            }
        });
}

std::array<float, 3> rounded(const Eigen::Vector3d& p) {
    return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

}

std::vector<uint32_t> lay_out(const Intake& intake, const Hierarchy& hierarchy,
                              const ListOfLists<uint32_t>& leaves_at_vertex,
                              const std::vector<uint8_t>& is_border, Workers& workers, StoredIndex& stored) {
    const uint32_t inner_count = hierarchy.first_leaf(), leaf_count = hierarchy.patch_count() - inner_count;
    stored.level_count = hierarchy.level_count();
    for (uint32_t p = 0; p < inner_count; ++p)
        stored.child_count.push_back(hierarchy.child_begin[p + 1] - hierarchy.child_begin[p]);

    const auto order = vertices_in_order(hierarchy, leaves_at_vertex, is_border, workers);
    const auto border_count = static_cast<size_t>(
        std::count_if(order.begin(), order.end(), [](const VertexInOrder& at) { return !at.internal; }));
    stored.owned_count = group_sizes(order, 0, border_count, 0, inner_count);
    stored.internal_count = group_sizes(order, border_count, order.size(), inner_count, leaf_count);

    std::vector<uint32_t> vertex_of_number, owner, number(order.size());
    for (const VertexInOrder& at : order) {
        number[at.vertex] = static_cast<uint32_t>(vertex_of_number.size());
        vertex_of_number.push_back(at.vertex);
        if (!at.internal) owner.push_back(at.group);
        stored.positions.push_back(rounded(intake.mesh.positions[at.vertex]));
    }
    for (uint32_t vertex : intake.vertex_of_id)
        stored.number_of_id.push_back(vertex == NONE ? NONE : number[vertex]);
    BorderFinder finder(intake.mesh, hierarchy, number, owner);
    lay_out_borders(finder, hierarchy, workers, stored);
    return vertex_of_number;
}

}
