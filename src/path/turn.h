#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "src/base/array.h"
#include "src/mesh/angle.h"
#include "src/surface/surface.h"

namespace geodesic {

// Finds the shortest way around a vertex from a direction in one of its faces to a direction in another one.
// The way crosses edges at the vertex; any number of faces may share each of these.
class Turn {
public:
    Turn(const Surface& surface, uint32_t vertex);

    // No way passes the edge to this vertex, which there must be.
    void forbid(uint32_t other_end) { spokes_[spoke_of(other_end)].is_forbidden = true; }

    // The faces between the two, without them, and the other ends of the edges passed.
    struct Fan {
        std::vector<uint32_t> faces, spokes;
    };
    // Nothing if the angle is not below the limit. To be called once: it leaves its angles in the spokes.
    std::optional<Fan> below(double limit, uint32_t from_face, const Eigen::Vector3d& from, uint32_t to_face,
                             const Eigen::Vector3d& to);

private:
    struct Spoke {
        uint32_t vertex;
        Eigen::Vector3d direction;  // to its other end
        double angle = UNREACHABLE; // from the first direction
        uint32_t before = NONE, face = NONE;
        uint32_t first_side = 0; // where its sectors begin in `sides_`
        bool is_done = false, is_forbidden = false;
    };
    struct Sector {
        uint32_t face;
        std::array<uint32_t, 2> spokes;
    };
    // A spoke that has been reached at an angle.
    struct Reached {
        double angle;
        uint32_t spoke;
        auto operator<=>(const Reached&) const = default;
    };

    void list_sides();
    uint32_t spoke_of(uint32_t other_end) const;
    const Sector& sector_of(uint32_t face) const { return *std::ranges::find(sectors_, face, &Sector::face); }
    double angle_of(const Sector& sector) const {
        const auto [a, b] = sector.spokes;
        return angle_between(spokes_[a].direction, spokes_[b].direction);
    }
    void reach(uint32_t spoke, double angle);
    uint32_t take_nearest(double limit);
    void spread(uint32_t spoke, uint32_t from_face, uint32_t to_face);
    Fan fan_to(uint32_t spoke) const;

    std::array<std::byte, 1024> room_; // for the faces of most vertices
    std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
    Array<Spoke> spokes_{&memory_};    // ascending by vertex
    Array<Sector> sectors_{&memory_};  // ascending by face
    Array<uint32_t> sides_{&memory_};  // sectors, of one spoke after the other
    Array<Reached> reached_{&memory_}; // a heap; a spoke may be in it at larger angles, too
};

// The faces around a vertex in their order from a first one on, where they form a closed fan: each edge at
// the vertex joins two of them, as nearly everywhere on scans. A way from the first face to another one then
// leads around one side of the vertex or around the other, and need not be searched for.
class ClosedFan {
public:
    ClosedFan(const Surface& surface, uint32_t vertex, uint32_t first_face);

    // Whether the faces form a closed fan, of at most MOST_FACES.
    bool is_closed() const { return is_closed_; }

    // As Turn::below(), from the first face to another, for a limit of at most pi. The fan must be closed.
    std::optional<Turn::Fan> below(double limit, const Eigen::Vector3d& from, uint32_t to_face,
                                   const Eigen::Vector3d& to) const;

private:
    static constexpr size_t MOST_FACES = 16;
    struct Sector {
        uint32_t face;
        std::array<uint32_t, 2> ends; // of its edges at the vertex: to the sector before, and to the next one
    };
    // Of a way from the first face to another: so many edges are passed, in the order of the sectors or
    // against it.
    struct Side {
        bool is_forward;
        size_t edges;
    };

    bool read_sectors(uint32_t first_face);
    bool put_in_order();
    // The end of the edge that the way passes after so many others, and the face behind it.
    uint32_t end(const Side& side, size_t edge) const {
        return sectors_[side.is_forward ? edge : count_ - 1 - edge].ends[1];
    }
    uint32_t face(const Side& side, size_t edge) const {
        return sectors_[side.is_forward ? edge + 1 : count_ - 1 - edge].face;
    }
    double angle_below_half_turn(const Side& side, const Eigen::Vector3d& from,
                                 const Eigen::Vector3d& to) const;
    Turn::Fan fan_over(const Side& side) const;
    Eigen::Vector3d direction_to(uint32_t end) const {
        return surface_.positions[end] - surface_.positions[vertex_];
    }

    const Surface& surface_;
    const uint32_t vertex_;
    size_t count_ = 0;
    std::array<Sector, MOST_FACES> sectors_;
    const bool
        is_closed_; // declared last: read_sectors() and put_in_order(), which it is made of, fill these
};

}
