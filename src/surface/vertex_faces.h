#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "src/mesh/mesh.h"

namespace geodesic {

// Goes through the faces around one vertex of VertexFaces.
class VertexFaceIterator {
public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = uint32_t;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = uint32_t;

    static constexpr uint16_t FAR = UINT16_MAX; // the face follows in two words, the lower one first

    VertexFaceIterator() = default;
    VertexFaceIterator(const uint16_t* at, uint32_t base) : at_(at), base_(base) {}

    uint32_t operator*() const { return *at_ == FAR ? at_[1] | uint32_t{at_[2]} << 16 : base_ + *at_; }
    VertexFaceIterator& operator++() {
        at_ += *at_ == FAR ? 3 : 1;
        return *this;
    }
    VertexFaceIterator operator++(int) {
        const VertexFaceIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const VertexFaceIterator& other) const { return at_ == other.at_; }

private:
    const uint16_t* at_ = nullptr; // face - base, or FAR
    uint32_t base_ = 0;
};

class FacesAround {
public:
    FacesAround(VertexFaceIterator begin, VertexFaceIterator end) : begin_(begin), end_(end) {}

    VertexFaceIterator begin() const { return begin_; }
    VertexFaceIterator end() const { return end_; }

private:
    VertexFaceIterator begin_, end_;
};

// The faces around each vertex in 16 bits each: vertices and faces are in spatial order, so that most of
// these have numbers close to those of the faces around vertices with numbers close by. Others take three
// times as much.
class VertexFaces {
public:
    explicit VertexFaces(const ListOfLists<uint32_t>& lists);

    // In the order of the given list.
    FacesAround operator[](uint32_t vertex) const {
        const uint32_t base = bases_[vertex / VERTICES_PER_BASE];
        return {VertexFaceIterator(words_.data() + begin_[vertex], base),
                VertexFaceIterator(words_.data() + begin_[vertex + 1], base)};
    }
    // At least as many as there are around a vertex, and mostly just as many.
    uint32_t room_for(uint32_t vertex) const { return begin_[vertex + 1] - begin_[vertex]; }

private:
    static constexpr uint32_t VERTICES_PER_BASE = 32;

    void add(uint32_t face, uint32_t base);

    std::vector<uint32_t> begin_; // per vertex, and of the end
    std::vector<uint32_t> bases_;
    std::vector<uint16_t> words_;
};

}
