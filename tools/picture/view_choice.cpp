#include "tools/picture/view_choice.h"

#include "tools/picture/rasterizer.h"

namespace geodesic::tools {

namespace {

constexpr int SIDE = 400;

Vec3 normal_at(const DrawnSurface& surface, uint32_t vertex) {
    for (size_t t = 0; t < surface.triangles.size(); ++t)
        for (size_t corner = 0; corner < 3; ++corner)
            if (surface.triangles[t][corner] == vertex) return surface.normals[t][corner];
    return {};
}

struct Candidate {
    View view;
    double penalty; // of views from far above or below, which are less pleasing
};

std::vector<Candidate> candidates(UpAxis up) {
    std::vector<Candidate> list;
    for (const auto& [elevation, penalty] : {std::pair{20.0, 0.0}, {48.0, 0.45}, {-18.0, 0.6}})
        for (int step = 0; step < 8; ++step)
            list.push_back({{30.0 + 45 * step, elevation, up, true}, penalty});
    return list;
}

double score(const DrawnSurface& surface, const Candidate& candidate, Vec3 source, Vec3 normal) {
    const VisibilityTest is_visible(surface, candidate.view);
    const Vec3 back = is_visible.camera().back;
    return (is_visible(source) ? 3.0 : 0.0) + dot(source, back) + std::abs(dot(normal, back)) +
           is_visible.filled_part() - candidate.penalty;
}

}

VisibilityTest::VisibilityTest(const DrawnSurface& surface, const View& view)
    : camera_(fitted_camera(surface, view, SIDE, SIDE, 0.05)) {
    VisibilityBuffer buffer(SIDE, 0, SIDE);
    rasterize(surface, project_all(surface, camera_), buffer);
    nearness_ = std::move(buffer.nearness);
}

bool VisibilityTest::operator()(Vec3 position) const {
    constexpr double SLACK = 0.02; // of the mesh's radius, towards the viewer
    const ScreenPoint point = camera_.project(position + SLACK * camera_.back);
    const int x = std::clamp(static_cast<int>(point.x), 0, SIDE - 1);
    const int y = std::clamp(static_cast<int>(point.y), 0, SIDE - 1);
    return point.nearness > double{nearness_[static_cast<size_t>(y * SIDE + x)]};
}

double VisibilityTest::filled_part() const {
    const auto empty =
        std::count(nearness_.begin(), nearness_.end(), -std::numeric_limits<float>::infinity());
    return 1 - static_cast<double>(empty) / static_cast<double>(nearness_.size());
}

View view_of_source(const DrawnSurface& surface, std::optional<uint32_t> source, UpAxis up) {
    if (!source) return View{.up = up};
    const Vec3 position = surface.positions[*source];
    const Vec3 normal = normal_at(surface, *source);
    View best{.up = up};
    double best_score = -std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates(up)) {
        const double candidate_score = score(surface, candidate, position, normal);
        if (candidate_score <= best_score) continue;
        best_score = candidate_score;
        best = candidate.view;
    }
    return best;
}

}
