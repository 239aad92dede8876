#include "src/tables/layout.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "src/tables/borders.h"
#include "src/tables/positions.h"

namespace geodesic {

namespace {

// The owner of each border vertex, and NONE for an internal vertex.
std::vector<uint32_t> owners(const Hierarchy& hierarchy, const ListOfLists<uint32_t>& leaves_at_vertex,
                             const std::vector<uint8_t>& is_border) {
    std::vector<uint32_t> owner(leaves_at_vertex.size(), NONE);
    for (uint32_t v = 0; v < owner.size(); ++v)
        if (leaves_at_vertex[v].size() > 1 && is_border[v])
            owner[v] = common_ancestor(hierarchy, leaves_at_vertex[v]);
    return owner;
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
    BorderFinder(const Mesh& mesh, const Hierarchy& hierarchy, const std::vector<uint32_t>& owner)
        : mesh_(mesh), hierarchy_(hierarchy), owner_(owner), inside_(mesh.face_count(), 0) {}

    // The border of a patch, given by its faces, in the order along the patch's boundary. Vertices at which
    // the patch only touches another patch come last.
    std::vector<uint32_t> find(uint32_t patch, std::span<const uint32_t> faces) {
        for (uint32_t f : faces) inside_[f] = 1;
        auto walks = walk_border(mesh_, faces, inside_);
        for (uint32_t f : faces) inside_[f] = 0;
        const auto on_border = [&](uint32_t v) { return is_on_border(v, patch); };
        std::vector<uint32_t> border;
        for (auto& walk : walks) {
            // If some vertices of a walk are not on the border, the walk begins at one of them, so that the
            // end of the walk and its beginning do not cut a chain in two.
            if (const auto other = std::ranges::find_if_not(walk, on_border); other != walk.end())
                std::rotate(walk.begin(), other, walk.end());
            std::ranges::copy_if(walk, std::back_inserter(border), on_border);
        }
        add_touching(patch, faces, border);
        return border;
    }

private:
    // A vertex lies on the border of a patch unless all leaves around it lie inside.
    bool is_on_border(uint32_t vertex, uint32_t patch) const {
        return owner_[vertex] != NONE && !is_within(hierarchy_, owner_[vertex], patch);
    }

    void add_touching(uint32_t patch, std::span<const uint32_t> faces, std::vector<uint32_t>& border) const {
        std::vector<uint32_t> touching, known(border);
        for (uint32_t f : faces)
            for (uint32_t v : mesh_.faces[f])
                if (is_on_border(v, patch)) touching.push_back(v);
        std::sort(touching.begin(), touching.end());
        touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
        std::sort(known.begin(), known.end());
        std::set_difference(touching.begin(), touching.end(), known.begin(), known.end(),
                            std::back_inserter(border));
    }

    const Mesh& mesh_;
    const Hierarchy& hierarchy_;
    const std::vector<uint32_t>& owner_; // per vertex; NONE: it is internal
    std::vector<uint8_t> inside_;        // per face
};

// The border of each patch; that of the whole mesh is empty. The finder serves one patch at a time, so that a
// level is one task, of which the calling thread tells and which it may cancel.
std::vector<std::vector<uint32_t>> find_borders(BorderFinder& finder, const Hierarchy& hierarchy,
                                                Workers& workers) {
    const auto faces = faces_by_level(hierarchy);
    std::vector<std::vector<uint32_t>> borders(1);
    for (uint32_t l = 1; l <= hierarchy.level_count(); ++l)
        workers.run(1, [&](FieldSolver&, size_t) {
            for (uint32_t i = 0; i < faces[l].size(); ++i)
                borders.push_back(finder.find(hierarchy.level_begin[l] + i, faces[l][i]));
        });
    return borders;
}

// Gives vertices their numbers, one after the other.
class NumberGiver {
public:
    explicit NumberGiver(size_t vertex_count) : number_(vertex_count, NONE) {}

    void give(uint32_t vertex) {
        if (number_[vertex] != NONE) return;
        number_[vertex] = static_cast<uint32_t>(vertex_of_number_.size());
        vertex_of_number_.push_back(vertex);
    }
    uint32_t count() const { return static_cast<uint32_t>(vertex_of_number_.size()); }
    const std::vector<uint32_t>& number() const { return number_; }
    std::vector<uint32_t> take_vertices() { return std::move(vertex_of_number_); }

private:
    std::vector<uint32_t> number_, vertex_of_number_;
};

// Numbers what each patch owns in the order in which it lies along the borders of the patch's children, so
// that neighbours on a border have neighbouring rows and columns in the tables.
void number_owned(const Hierarchy& hierarchy, std::span<const std::vector<uint32_t>> borders,
                  const std::vector<uint32_t>& owner, NumberGiver& giver, StoredIndex& stored) {
    for (uint32_t p = 0; p < hierarchy.first_leaf(); ++p) {
        const uint32_t first = giver.count();
        for (uint32_t child = hierarchy.child_begin[p]; child < hierarchy.child_begin[p + 1]; ++child)
            for (uint32_t v : borders[child])
                if (owner[v] == p) giver.give(v);
        stored.owned_count.push_back(giver.count() - first);
    }
}

double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

// Reorders the vertices so that each is the nearest one, in a straight line, to the one before it of all
// those that are left. The first one is the nearest to `start`.
void order_by_nearness(const Mesh& mesh, Eigen::Vector3d start, std::span<uint32_t> vertices) {
    for (size_t i = 0; i < vertices.size(); ++i) {
        const auto nearest = std::ranges::min_element(vertices.subspan(i), {}, [&](uint32_t v) {
            return std::pair(squared_distance(mesh.positions[v], start), v);
        });
        std::swap(vertices[i], *nearest);
        start = mesh.positions[vertices[i]];
    }
}

// Numbers what is internal to each leaf, so that neighbours mostly have neighbouring rows and columns.
void number_internal(const Mesh& mesh, const Hierarchy& hierarchy,
                     std::span<const std::vector<uint32_t>> borders,
                     const ListOfLists<uint32_t>& leaves_at_vertex, const std::vector<uint32_t>& owner,
                     NumberGiver& giver, StoredIndex& stored) {
    std::vector<std::vector<uint32_t>> internal(hierarchy.patch_count());
    for (uint32_t v = 0; v < owner.size(); ++v)
        if (owner[v] == NONE) internal[leaves_at_vertex[v][0]].push_back(v);
    for (uint32_t leaf = hierarchy.first_leaf(); leaf < hierarchy.patch_count(); ++leaf) {
        std::vector<uint32_t>& vertices = internal[leaf];
        if (!vertices.empty()) {
            const uint32_t start = borders[leaf].empty() ? vertices.front() : borders[leaf].front();
            order_by_nearness(mesh, mesh.positions[start], vertices);
        }
        for (uint32_t v : vertices) giver.give(v);
        stored.internal_count.push_back(static_cast<uint32_t>(vertices.size()));
    }
}

}

std::vector<uint32_t> lay_out(const Mesh& mesh, std::span<const uint32_t> vertex_of_id,
                              const Hierarchy& hierarchy, const ListOfLists<uint32_t>& leaves_at_vertex,
                              const std::vector<uint8_t>& is_border, Workers& workers, StoredIndex& stored) {
    stored.level_count = hierarchy.level_count();
    for (uint32_t p = 0; p < hierarchy.first_leaf(); ++p)
        stored.child_count.push_back(hierarchy.child_begin[p + 1] - hierarchy.child_begin[p]);

    const auto owner = owners(hierarchy, leaves_at_vertex, is_border);
    BorderFinder finder(mesh, hierarchy, owner);
    const auto borders = find_borders(finder, hierarchy, workers);
    NumberGiver giver(owner.size());
    number_owned(hierarchy, borders, owner, giver, stored);
    number_internal(mesh, hierarchy, borders, leaves_at_vertex, owner, giver, stored);

    for (uint32_t p = 1; p < hierarchy.patch_count(); ++p) {
        stored.border_size.push_back(static_cast<uint32_t>(borders[p].size()));
        for (uint32_t v : borders[p]) stored.border.push_back(giver.number()[v]);
    }
    for (uint32_t vertex : vertex_of_id)
        stored.number_of_id.push_back(vertex == NONE ? NONE : giver.number()[vertex]);
    std::vector<uint32_t> vertex_of_number = giver.take_vertices();
    round_positions(mesh, vertex_of_number, stored);
    return vertex_of_number;
}

}
