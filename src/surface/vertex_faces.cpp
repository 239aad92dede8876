#include "src/surface/vertex_faces.h"

#include <algorithm>

#include "format/error.h"

namespace geodesic {

namespace {

// Faces are numbered in the order of their least vertices, so that those around the next vertices have
// numbers a little above that of the last face here, or below it: 16 bits hold 2^15 on either side.
uint32_t base_at(std::span<const uint32_t> faces) {
    const uint32_t last = std::ranges::max(faces);
    return last - std::min(last, uint32_t{1} << 15);
}

}

VertexFaces::VertexFaces(const ListOfLists<uint32_t>& lists) {
    begin_.reserve(lists.size() + 1);
    bases_.reserve(lists.size() / VERTICES_PER_BASE + 1);
    words_.reserve(lists.items.size());
    for (size_t vertex = 0; vertex < lists.size(); ++vertex) {
        if (vertex % VERTICES_PER_BASE == 0) bases_.push_back(base_at(lists[vertex]));
        begin_.push_back(static_cast<uint32_t>(words_.size()));
        for (const uint32_t face : lists[vertex]) add(face, bases_.back());
    }
    begin_.push_back(static_cast<uint32_t>(words_.size()));
    if (words_.size() > UINT32_MAX)
        throw Error(GEOIDX_ERROR_LIMIT, "the mesh has too many triangles for a surface");
    words_.shrink_to_fit();
}

void VertexFaces::add(uint32_t face, uint32_t base) {
    constexpr uint16_t FAR = VertexFaceIterator::FAR;
    if (face >= base && face - base < FAR) {
        words_.push_back(static_cast<uint16_t>(face - base));
        return;
    }
    words_.push_back(FAR);
    words_.push_back(static_cast<uint16_t>(face));
    words_.push_back(static_cast<uint16_t>(face >> 16));
}

}
