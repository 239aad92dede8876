#include "src/tables/segments.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "src/overlay/tables/rings.h"

namespace geodesic {

namespace {

class SegmentFinder {
public:
    SegmentFinder(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                  std::span<const uint32_t> vertex_of_number, const DistanceTables& tables,
                  const Numbering& numbering, BorderSegments& segments)
        : mesh_(mesh), leaf_of_face_(leaf_of_face), tables_(tables), numbering_(numbering),
          segments_(segments), edges_(numbering.border_vertex_count()) {
        std::vector<uint32_t> number(mesh.vertex_count());
        for (uint32_t n = 0; n < vertex_of_number.size(); ++n) number[vertex_of_number[n]] = n;
        for (uint32_t e = 0; e < mesh.edges.size(); ++e) {
            const uint32_t a = number[mesh.edges[e][0]], b = number[mesh.edges[e][1]];
            if (!numbering.is_border(a) || !numbering.is_border(b)) continue;
            edges_[a].push_back({b, e});
            edges_[b].push_back({a, e});
        }
    }

    // A border consists of several chains, one after the other. The last vertex of each may be joined to its
    // first.
    void find(uint32_t patch) {
        const uint32_t size = numbering_.border_size(patch);
        uint32_t chain_begin = 0;
        for (uint32_t i = 0; i < size; ++i) {
            if (i + 1 < size && join(patch, i, i + 1)) continue;
            if (i - chain_begin >= 2) join(patch, i, chain_begin);
            chain_begin = i + 1;
        }
        find_bridges(patch);
    }

private:
    struct Edge {
        uint32_t other_end, edge;
    };

    bool join(uint32_t patch, uint32_t i, uint32_t j) {
        const uint32_t first = numbering_.border_begin[patch];
        const uint32_t a = numbering_.border[first + i], b = numbering_.border[first + j];
        if (std::ranges::none_of(
                edges_[a], [&](const Edge& edge) { return edge.other_end == b && parts(edge.edge, patch); }))
            return false;
        const float length = length_of(a, b);
        if (!(length > 0)) return false;
        segments_.end[first + i] = j;
        segments_.length[first + i] = length;
        return true;
    }

    // Of more bridges than the border has vertices, or than its ring has room for, the longest ones are kept.
    void find_bridges(uint32_t patch) {
        const uint32_t first = numbering_.border_begin[patch], size = numbering_.border_size(patch);
        std::vector<Bridge> bridges;
        for (uint32_t i = 0; i < size; ++i)
            for (const auto& [other, edge] : edges_[numbering_.border[first + i]]) {
                const uint32_t j = numbering_.border_position(patch, other);
                if (j == NONE || j < i || are_in_chain(first, i, j) || !parts(edge, patch)) continue;
                const float length = length_of(numbering_.border[first + i], other);
                if (length > 0) bridges.push_back({first + i, j, length});
            }
        std::ranges::sort(bridges, {}, [](const Bridge& b) { return std::tuple(-b.length, b.slot, b.end); });
        bridges.resize(std::min<size_t>({bridges.size(), size, room_for_bridges(first, size)}));
        std::ranges::sort(bridges, {}, [](const Bridge& b) { return std::pair(b.slot, b.end); });
        segments_.bridges.insert(segments_.bridges.end(), bridges.begin(), bridges.end());
    }

    // How many bridges fit into the ring of the border that begins at a slot, behind its chains.
    size_t room_for_bridges(uint32_t first, uint32_t size) const {
        size_t places = size;
        for (uint32_t i = 0; i < size; ++i)
            if (segments_.end[first + i] != i + 1) places += size_t{2} * Rings::REACH; // a chain ends here
        return places < Rings::MOST_PLACES ? (Rings::MOST_PLACES - places) / 2 : 0;
    }

    // Whether a segment of a chain joins two positions of the border that begins at a slot.
    bool are_in_chain(uint32_t first, uint32_t i, uint32_t j) const {
        return segments_.end[first + i] == j || segments_.end[first + j] == i;
    }

    // Whether an edge has the patch on some sides and other patches on others.
    bool parts(uint32_t edge, uint32_t patch) const {
        const auto is_inside = [&](uint32_t face) {
            return numbering_.is_within(leaf_of_face_[face], patch);
        };
        const auto faces = mesh_.edge_faces[edge];
        return std::ranges::any_of(faces, is_inside) && !std::ranges::all_of(faces, is_inside);
    }

    // The length of an edge. Both of its ends lie on the border of a leaf beside it, so that the table of
    // that leaf's parent has their distance.
    float length_of(uint32_t a, uint32_t b) const {
        for (const PatchPosition& at : numbering_.borders_of(a))
            for (const PatchPosition& bt : numbering_.borders_of(b)) {
                if (at.patch != bt.patch || at.patch < numbering_.first_leaf()) continue;
                const uint32_t parent = numbering_.parent[at.patch];
                const auto in_parent = numbering_.positions_in_parent(at.patch);
                const size_t row = in_parent[at.position];
                return tables_
                    .overlay[parent][row * numbering_.overlay_size(parent) + in_parent[bt.position]];
            }
        return 0;
    }

    const Mesh& mesh_;
    std::span<const uint32_t> leaf_of_face_;
    const DistanceTables& tables_;
    const Numbering& numbering_;
    BorderSegments& segments_;
    std::vector<std::vector<Edge>> edges_; // per border vertex: to other border vertices
};

}

BorderSegments find_segments(const Mesh& mesh, std::span<const uint32_t> leaf_of_face,
                             std::span<const uint32_t> vertex_of_number, const DistanceTables& tables,
                             const Numbering& numbering) {
    BorderSegments segments(numbering.border.size());
    SegmentFinder finder(mesh, leaf_of_face, vertex_of_number, tables, numbering, segments);
    for (uint32_t p = 1; p < numbering.patch_count(); ++p) finder.find(p);
    return segments;
}

}
