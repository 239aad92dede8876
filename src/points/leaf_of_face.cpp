#include "src/points/leaf_of_face.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "src/overlay/fields/point_ways.h"
#include "src/points/face_points.h"

namespace geodesic {

namespace {

using Numbers = std::array<uint32_t, 3>;

// The faces around one, by what a leaf has of them.
class Surroundings {
public:
    static constexpr size_t MOST = 64; // faces that are looked at

    Surroundings(const Index& index, const Surface& surface, const AnyFace& face)
        : index_(index), overlay_(std::get<OverlayIndex>(index.engine)), surface_(surface), first_(face) {}

    // From the face on, all faces that are reached without crossing the border of a leaf lie in that leaf if
    // the face does. Returns how many of them it has before one that it does not have, MOST if there is no
    // such face.
    size_t count_in(uint32_t leaf) {
        faces_[0] = first_.face;
        count_ = 1;
        for (size_t i = 0; i < count_; ++i) {
            const AnyFace face{first_.is_of_index, faces_[i]};
            const auto corners = corners_of(surface_, face);
            const Numbers numbers = numbers_of(corners);
            if (std::ranges::find(numbers, NONE) != numbers.end() ||
                !are_in_leaf(overlay_.numbering, leaf, numbers))
                return i;
            const auto lengths = edge_lengths(surface_, corners);
            for (size_t k = 0; k < 3; ++k) {
                const size_t a = (k + 1) % 3, b = (k + 2) % 3;
                if (!is_on_border(overlay_, leaf, numbers[a], numbers[b], lengths[k]))
                    for_each_beyond(surface_, face, corners[a], corners[b],
                                    [&](const AnyFace& other) { add(other.face); });
            }
        }
        return MOST;
    }

    Numbers numbers_of(const std::array<uint32_t, 3>& corners) const {
        return {number_of(index_, surface_, corners[0]), number_of(index_, surface_, corners[1]),
                number_of(index_, surface_, corners[2])};
    }

private:
    void add(uint32_t face) {
        const auto known = std::span(faces_).first(count_);
        if (count_ < MOST && std::ranges::find(known, face) == known.end()) faces_[count_++] = face;
    }

    const Index& index_;
    const OverlayIndex& overlay_;
    const Surface& surface_;
    const AnyFace first_;
    size_t count_ = 0;
    std::array<uint32_t, MOST> faces_;
};

// All of them, if all corners are on borders.
std::vector<uint32_t> leaves_with(const Numbering& numbering, const Numbers& corners) {
    std::vector<uint32_t> leaves;
    for (const PatchPosition& at : numbering.borders_of(corners[0]))
        if (at.patch >= numbering.first_leaf() && are_in_leaf(numbering, at.patch, corners))
            leaves.push_back(at.patch);
    return leaves;
}

// The first of those that have the most faces around.
uint32_t best_of(std::span<const uint32_t> leaves, Surroundings& around) {
    uint32_t best = NONE;
    size_t most = 0;
    for (const uint32_t leaf : leaves)
        if (const size_t count = around.count_in(leaf); best == NONE || count > most) {
            best = leaf;
            most = count;
        }
    return best;
}

}

// All corners of a face that touches no vertex inside of its leaf are on borders, perhaps all on that of a
// leaf beside it, too: then the leaf counts that more of the faces around can lie in.
uint32_t leaf_of_face(const Index& index, const Surface& surface, const AnyFace& face) {
    const Numbering& numbering = index.numbering();
    Surroundings around(index, surface, face);
    const Numbers corners = around.numbers_of(corners_of(surface, face));
    for (const uint32_t corner : corners)
        if (!numbering.is_border(corner)) {
            const uint32_t leaf = numbering.leaf_of(corner);
            return are_in_leaf(numbering, leaf, corners) ? leaf : NONE;
        }
    const std::vector<uint32_t> leaves = leaves_with(numbering, corners);
    return leaves.size() < 2 ? (leaves.empty() ? NONE : leaves.front()) : best_of(leaves, around);
}

}
