#include "src/path/least_excess.h"

#include <algorithm>
#include <queue>
#include <unordered_map>
#include <utility>

#include "src/surface/nearby.h"

namespace geodesic {

namespace {

// Dijkstra's algorithm over faces.
class ExcessSearch {
public:
    ExcessSearch(const Surface& surface, const std::function<double(uint32_t, uint32_t)>& excess)
        : surface_(surface), excess_(excess) {}

    std::optional<Strip> run(const SurfacePoint& source, const SurfacePoint& target);

private:
    // A face that was reached, over an edge of the face before it.
    struct Reached {
        double excess;
        uint32_t before; // NONE: the source lies in it
        Portal portal;
        bool is_final = false;
    };

    void reach(uint32_t face, double excess, uint32_t before, const Portal& portal);
    void leave(uint32_t face);
    Strip strip_to(uint32_t face) const;

    const Surface& surface_;
    const std::function<double(uint32_t, uint32_t)>& excess_;
    std::unordered_map<uint32_t, Reached> reached_;
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

void ExcessSearch::reach(uint32_t face, double excess, uint32_t before, const Portal& portal) {
    const auto [found, is_new] = reached_.try_emplace(face, Reached{excess, before, portal});
    if (!is_new) {
        if (found->second.is_final || !(excess < found->second.excess)) return;
        found->second = {excess, before, portal};
    }
    open_.push({excess, face});
}

void ExcessSearch::leave(uint32_t face) {
    const auto& corners = surface_.faces[face];
    for (size_t k = 0; k < 3; ++k) {
        const Portal portal{corners[(k + 1) % 3], corners[(k + 2) % 3]};
        const double excess = reached_.at(face).excess + excess_(portal.a, portal.b);
        if (!(excess < UNREACHABLE)) continue;
        for_each_face_beyond(surface_, face, portal.a, portal.b,
                             [&](uint32_t other) { reach(other, excess, face, portal); });
    }
}

Strip ExcessSearch::strip_to(uint32_t face) const {
    Strip strip;
    for (; face != NONE; face = reached_.at(face).before) {
        strip.faces.push_back(face);
        if (reached_.at(face).before != NONE) strip.portals.push_back(reached_.at(face).portal);
    }
    std::ranges::reverse(strip.faces);
    std::ranges::reverse(strip.portals);
    return strip;
}

std::optional<Strip> ExcessSearch::run(const SurfacePoint& source, const SurfacePoint& target) {
    std::unordered_map<uint32_t, SurfacePoint> sources, targets; // by face
    for_each_alias(surface_, source, [&](const SurfacePoint& alias) { sources[alias.face] = alias; });
    for_each_alias(surface_, target, [&](const SurfacePoint& alias) { targets[alias.face] = alias; });
    for (const auto& [face, alias] : sources) reach(face, 0, NONE, {NONE, NONE});
    while (!open_.empty()) {
        const uint32_t face = open_.top().second;
        open_.pop();
        if (const auto found = targets.find(face); found != targets.end()) {
            Strip strip = strip_to(face);
            strip.source = sources.at(strip.faces.front());
            strip.target = found->second;
            return strip;
        }
        if (std::exchange(reached_.at(face).is_final, true)) continue;
        leave(face);
    }
    return std::nullopt;
}

}

std::optional<Strip> strip_of_least_excess(const Surface& surface, const SurfacePoint& source,
                                           const SurfacePoint& target,
                                           const std::function<double(uint32_t, uint32_t)>& excess) {
    return ExcessSearch(surface, excess).run(source, target);
}

}
