#include "src/partition/shorten_borders.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/partition/minimum_cut.h"

namespace geodesic {

namespace {

// The band around a border reaches into each cell by this share of the steps, from face to face, to the
// cell's farthest face.
constexpr double BAND = 0.25;

// An edge of average length costs COST_OF_EDGE for being one, and as much for its length. Edges longer than
// the average by more than LONGEST count as that long.
constexpr double COST_OF_EDGE = 64, LONGEST = 1000;

// The faces beside each of some faces, over edges that two faces share, and what each edge costs as one of a
// border. Faces are given by their positions among these faces.
class Neighbours {
public:
    struct Neighbour {
        uint32_t face;
        uint32_t cost;
    };

    Neighbours(const Mesh& mesh, std::span<const double> edge_lengths, std::span<const uint32_t> faces) {
        std::unordered_map<uint32_t, uint32_t> position;
        for (uint32_t i = 0; i < faces.size(); ++i) position.emplace(faces[i], i);
        const double average = average_length(mesh, edge_lengths, faces);
        for (const uint32_t f : faces) {
            for (const uint32_t e : mesh.face_edges[f]) {
                if (mesh.edge_faces[e].size() != 2) continue;
                const uint32_t other = mesh.edge_faces[e][mesh.edge_faces[e][0] == f ? 1 : 0];
                if (const auto found = position.find(other); found != position.end())
                    neighbours_.push_back({found->second, cost(edge_lengths[e], average)});
            }
            begin_.push_back(static_cast<uint32_t>(neighbours_.size()));
        }
    }

    std::span<const Neighbour> of(uint32_t face) const {
        return std::span(neighbours_).subspan(begin_[face], begin_[face + 1] - begin_[face]);
    }

private:
    static double average_length(const Mesh& mesh, std::span<const double> edge_lengths,
                                 std::span<const uint32_t> faces) {
        double sum = 0;
        for (const uint32_t f : faces)
            for (const uint32_t e : mesh.face_edges[f]) sum += edge_lengths[e];
        return sum / (3 * static_cast<double>(faces.size()));
    }

    static uint32_t cost(double length, double average) {
        const double share = length < LONGEST * average ? length / average : LONGEST;
        return static_cast<uint32_t>(COST_OF_EDGE * (1 + share * share));
    }

    std::vector<uint32_t> begin_ = {0};
    std::vector<Neighbour> neighbours_;
};

using Cells = std::pair<uint32_t, uint32_t>; // two different ones

class Borders {
public:
    Borders(const Neighbours& neighbours, std::span<uint32_t> cell)
        : neighbours_(neighbours), cell_(cell), steps_(cell.size(), NONE), node_(cell.size()) {
        for (uint32_t i = 0; i < cell.size(); ++i) {
            if (cell[i] == NONE) continue;
            members_.resize(std::max<size_t>(members_.size(), cell[i] + 1));
            members_[cell[i]].push_back(i);
        }
    }

    // Each two cells that touch, in ascending order.
    std::vector<Cells> touching() const {
        std::vector<Cells> found;
        for (uint32_t i = 0; i < cell_.size(); ++i)
            for (const auto& [j, cost] : neighbours_.of(i))
                if (cell_[i] < cell_[j] && cell_[j] != NONE) found.emplace_back(cell_[i], cell_[j]);
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    uint64_t cost() const {
        uint64_t sum = 0;
        for (uint32_t i = 0; i < cell_.size(); ++i)
            for (const auto& neighbour : neighbours_.of(i))
                if (cell_[i] < cell_[neighbour.face]) sum += neighbour.cost;
        return sum;
    }

    void shorten(const Cells& cells) {
        std::vector<uint32_t> faces;
        std::ranges::merge(members_[cells.first], members_[cells.second], std::back_inserter(faces));
        count_steps(cells, faces);
        if (number_nodes(cells)) {
            link_nodes(cells);
            network_.cut(0, 1);
            take_sides(cells, faces);
        }
        for (const uint32_t i : reached_) steps_[i] = NONE;
    }

private:
    bool is_in(const Cells& cells, uint32_t face) const {
        return cell_[face] == cells.first || cell_[face] == cells.second;
    }
    bool is_on_border(const Cells& cells, uint32_t face) const {
        return std::ranges::any_of(neighbours_.of(face), [&](const auto& neighbour) {
            return cell_[neighbour.face] != cell_[face] && is_in(cells, neighbour.face);
        });
    }

    // Counts the steps of faces from the border between two cells, each in its own cell.
    void count_steps(const Cells& cells, std::span<const uint32_t> faces) {
        reached_.clear();
        for (const uint32_t i : faces)
            if (is_on_border(cells, i)) {
                steps_[i] = 0;
                reached_.push_back(i);
            }
        for (size_t done = 0; done < reached_.size(); ++done) {
            const uint32_t i = reached_[done];
            for (const auto& [j, cost] : neighbours_.of(i)) {
                if (cell_[j] != cell_[i] || steps_[j] != NONE) continue;
                steps_[j] = steps_[i] + 1;
                reached_.push_back(j);
            }
        }
    }

    // Makes a node of each face in the band, and one of all other faces of a cell: 0 and 1. Returns whether
    // there is a band: in a cell that lies on the border with all its faces there is none.
    bool number_nodes(const Cells& cells) {
        uint32_t farthest[2] = {0, 0};
        const auto side = [&](uint32_t face) { return cell_[face] == cells.first ? 0 : 1; };
        for (const uint32_t i : reached_) farthest[side(i)] = std::max(farthest[side(i)], steps_[i]);
        node_count_ = 2;
        for (const uint32_t i : reached_) {
            const uint32_t most = farthest[side(i)];
            const bool is_in_band = steps_[i] < most && (steps_[i] == 0 || steps_[i] < BAND * most);
            node_[i] = is_in_band ? node_count_++ : static_cast<uint32_t>(side(i));
        }
        return node_count_ > 2;
    }

    void link_nodes(const Cells& cells) {
        network_.begin(node_count_);
        for (const uint32_t i : reached_)
            for (const auto& [j, cost] : neighbours_.of(i))
                if (i < j && is_in(cells, j) && node_[i] != node_[j]) network_.link(node_[i], node_[j], cost);
    }

    void take_sides(const Cells& cells, std::span<const uint32_t> faces) {
        for (const uint32_t i : reached_)
            cell_[i] = network_.is_with_source(node_[i]) ? cells.first : cells.second;
        for (const uint32_t c : {cells.first, cells.second}) {
            members_[c].clear();
            std::ranges::copy_if(faces, std::back_inserter(members_[c]),
                                 [&](uint32_t i) { return cell_[i] == c; });
        }
    }

    const Neighbours& neighbours_;
    std::span<uint32_t> cell_;
    std::vector<std::vector<uint32_t>> members_; // of each cell, in ascending order
    MinimumCut network_;
    // Of the two cells whose border is shortened: the faces from which the border can be reached, and of
    // each of these its steps from the border and its node.
    std::vector<uint32_t> reached_;
    std::vector<uint32_t> steps_, node_;
    uint32_t node_count_ = 0;
};

}

uint64_t shorten_borders(const Mesh& mesh, std::span<const double> edge_lengths,
                         std::span<const uint32_t> faces, std::span<uint32_t> cell) {
    const Neighbours neighbours(mesh, edge_lengths, faces);
    Borders borders(neighbours, cell);
    for (const Cells& cells : borders.touching()) borders.shorten(cells);
    return borders.cost();
}

}
