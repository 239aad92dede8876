#include "src/partition/straighten.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace geodesic {

namespace {

// The neighbours of each of some faces over edges that two faces share. Faces are given by their positions
// among these faces.
class Neighbours {
public:
    Neighbours(const Mesh& mesh, std::span<const uint32_t> faces) {
        std::unordered_map<uint32_t, uint32_t> position;
        for (uint32_t i = 0; i < faces.size(); ++i) position.emplace(faces[i], i);
        for (uint32_t f : faces) {
            for (uint32_t e : mesh.face_edges[f]) {
                if (mesh.edge_faces[e].size() != 2) continue;
                const uint32_t other = mesh.edge_faces[e][mesh.edge_faces[e][0] == f ? 1 : 0];
                if (const auto found = position.find(other); found != position.end())
                    neighbours_.push_back(found->second);
            }
            begin_.push_back(static_cast<uint32_t>(neighbours_.size()));
        }
    }

    std::span<const uint32_t> of(uint32_t i) const {
        return std::span(neighbours_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }

private:
    std::vector<uint32_t> begin_ = {0}, neighbours_;
};

// Returns the cell that most neighbours are in. If it is a tie with the own cell, the own one is returned.
uint32_t best_cell(std::span<const uint32_t> neighbours, std::span<const uint32_t> cell, uint32_t own) {
    const auto count = [&](uint32_t wanted) {
        return std::ranges::count_if(neighbours, [&](uint32_t j) { return cell[j] == wanted; });
    };
    uint32_t best = own;
    auto most = count(own);
    for (uint32_t j : neighbours)
        if (const auto there = count(cell[j]); there > most) {
            most = there;
            best = cell[j];
        }
    return best;
}

}

void straighten_borders(const Mesh& mesh, std::span<const uint32_t> faces, std::span<uint32_t> cell) {
    const Neighbours neighbours(mesh, faces);
    std::unordered_map<uint32_t, uint32_t> faces_of_cell;
    for (uint32_t c : cell) ++faces_of_cell[c];
    std::vector<uint32_t> to_look_at(faces.size());
    for (uint32_t i = 0; i < faces.size(); ++i) to_look_at[i] = i;
    for (size_t done = 0; done < to_look_at.size(); ++done) {
        const uint32_t i = to_look_at[done];
        const uint32_t best = best_cell(neighbours.of(i), cell, cell[i]);
        if (best == cell[i] || faces_of_cell[cell[i]] == 1) continue;
        --faces_of_cell[cell[i]];
        ++faces_of_cell[best];
        cell[i] = best;
        for (uint32_t j : neighbours.of(i)) to_look_at.push_back(j);
    }
}

}
