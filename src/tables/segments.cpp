#include "src/tables/segments.h"

#include <algorithm>

namespace geodesic {

namespace {

class SegmentFinder {
public:
    SegmentFinder(const Mesh& mesh, std::span<const uint32_t> vertex_of_number, const DistanceTables& tables,
                  const Index& index, BorderSegments& segments)
        : neighbours_(edges_among_borders(mesh, vertex_of_number, index)), tables_(tables), index_(index),
          segments_(segments) {}

    // Rings follow each other in a border; the last vertex of each may be joined to its first.
    void find(uint32_t patch) {
        const uint32_t size = index_.border_size(patch);
        uint32_t ring = 0;
        for (uint32_t i = 0; i < size; ++i) {
            if (i + 1 < size && join(patch, i, i + 1)) continue;
            if (i - ring >= 2) join(patch, i, ring);
            ring = i + 1;
        }
    }

private:
    static ListOfLists<uint32_t>
    edges_among_borders(const Mesh& mesh, std::span<const uint32_t> vertex_of_number, const Index& index) {
        std::vector<uint32_t> number(mesh.vertex_count());
        for (uint32_t n = 0; n < vertex_of_number.size(); ++n) number[vertex_of_number[n]] = n;
        std::vector<uint32_t> from, to;
        for (const auto& edge : mesh.edges) {
            const uint32_t a = number[edge[0]], b = number[edge[1]];
            if (!index.is_border(a) || !index.is_border(b)) continue;
            from.insert(from.end(), {a, b});
            to.insert(to.end(), {b, a});
        }
        ListOfLists<uint32_t> lists = group_by(from, index.border_vertex_count());
        for (uint32_t& item : lists.items) item = to[item];
        return lists;
    }

    bool join(uint32_t patch, uint32_t i, uint32_t j) {
        const uint32_t first = index_.border_begin[patch];
        const auto neighbours = neighbours_[index_.border[first + i]];
        if (std::ranges::find(neighbours, index_.border[first + j]) == neighbours.end()) return false;
        const float length = length_of(index_.border[first + i], index_.border[first + j]);
        if (!(length > 0)) return false;
        segments_.next[first + i] = j;
        segments_.length[first + i] = length;
        return true;
    }

    // Both ends lie on the border of a leaf on one side of the edge.
    float length_of(uint32_t a, uint32_t b) const {
        for (const BorderPlace& at : index_.places_of(a))
            for (const BorderPlace& bt : index_.places_of(b)) {
                if (at.patch != bt.patch || at.patch < index_.first_leaf()) continue;
                const uint32_t parent = index_.parent[at.patch], first = index_.border_begin[at.patch];
                const size_t row = index_.overlay_position[first + at.position];
                return tables_.overlay[parent][row * index_.overlay_size(parent) +
                                               index_.overlay_position[first + bt.position]];
            }
        return 0;
    }

    ListOfLists<uint32_t> neighbours_; // of border vertices: border vertices at the other ends of edges
    const DistanceTables& tables_;
    const Index& index_;
    BorderSegments& segments_;
};

}

BorderSegments find_segments(const Mesh& mesh, std::span<const uint32_t> vertex_of_number,
                             const DistanceTables& tables, const Index& index) {
    BorderSegments segments(index.border.size());
    SegmentFinder finder(mesh, vertex_of_number, tables, index, segments);
    for (uint32_t p = 1; p < index.patch_count(); ++p) finder.find(p);
    return segments;
}

}
