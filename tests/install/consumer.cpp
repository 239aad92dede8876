// The same through geoidx.hpp, and what it adds.
#include <geoidx.hpp>

#include <cmath>
#include <iostream>

namespace {

const std::vector<double> CORNERS{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<std::uint32_t> TRIANGLES{0, 1, 2, 0, 2, 3};

bool is_root_of_two(double distance) { return std::abs(distance - std::sqrt(2.0)) < 1e-5; }

bool answers_right(const gdx::index& index) {
    const std::uint32_t source = 0, target = 2;
    float prepared = 0, within = 0;
    std::vector<float> field(4);
    gdx::query query = index.make_query();
    query.prepare(source);
    query.prepared({&target, 1}, {&prepared, 1});
    query.msad_within({&source, 1}, 1.2f, field);
    within = field[target];
    return is_root_of_two(double{index.sssd(source, target)}) && is_root_of_two(double{query.sssd(2, 0)}) &&
           is_root_of_two(double{prepared}) && std::isinf(within) &&
           is_root_of_two(double{index.msad(std::span(&source, 1))[target]});
}

bool finds_what_is_near(const gdx::index& index) {
    gdx::query query = index.make_query();
    const std::vector<std::uint32_t> corners{0, 1, 2, 3};
    std::vector<std::uint32_t> nearest(4), found(4);
    std::vector<float> distances(4), entries(4), same(4);
    query.nearest_sources(std::span(corners).first(1), nearest, distances);
    const bool all_from_the_source = nearest == std::vector<std::uint32_t>(4, 0u);
    const bool is_alone = query.within(std::span(corners).first(1), 0.5f, found, distances) == 1;
    const std::uint32_t near =
        query.nearest_targets(2, std::span(corners).first(2), std::span(found).first(1));
    index.matrix(std::span(corners).first(1), corners, entries);
    query.matrix(corners, std::span(corners).first(1), same);
    index.sssd({}, {}); // of nothing there is nothing to answer
    index.ssad({}, {});
    index.matrix({}, {}, {});
    query.ssad({}, {});
    query.matrix({}, {}, {});
    bool refused = false;
    try {
        query.nearest_sources(corners, nearest, std::span(distances).first(3));
    } catch (const std::invalid_argument&) {
        refused = true;
    }
    return all_from_the_source && is_alone && distances[0] == 0 && near == 1 && found[0] == 1 &&
           is_root_of_two(double{entries[2]}) && entries == same && refused;
}

bool walks_right(const gdx::index& index, const geoidx_mesh& mesh) {
    auto keeping = gdx::build_options();
    keeping.store_mesh = 1;
    const gdx::surface surface = gdx::surface::of(gdx::index::build(mesh, keeping));
    gdx::query query = index.make_query();
    const auto [from, height] = surface.closest_point({0.25, 0.5, 3});
    const geoidx_surface_point corner = surface.vertex_point(1);
    const double straight = std::hypot(0.75, 0.5);
    const auto path = query.find_path(surface, from, corner, GEOIDX_PATH_EXACT);
    std::vector<float> field(4);
    const float offset = 2;
    query.msad(surface, {&from, 1}, field, {&offset, 1});
    return height == 3 && path && std::abs(path->length - straight) < 1e-9 && path->points.size() >= 2 &&
           std::abs(path->points.front().position[1] - 0.5) < 1e-12 &&
           std::abs(double{query.sssd(surface, from, corner)} - straight) < 1e-5 &&
           std::abs(double{field[1]} - straight - 2) < 1e-5;
}

template <class Function>
geoidx_status status_of(const Function& function) {
    try {
        function();
    } catch (const gdx::error& error) {
        return std::string(error.what()).empty() ? GEOIDX_OK : error.status();
    }
    return GEOIDX_OK;
}

bool throws_what_progress_throws(const geoidx_mesh& mesh) {
    try {
        gdx::index::build(mesh, gdx::build_options(), [](float, const char*) -> bool { throw 7; });
    } catch (int thrown) {
        return thrown == 7;
    }
    return false;
}

bool comes_back_without_positions(const gdx::index& index, const geoidx_mesh& mesh) {
    auto how = gdx::save_options();
    how.flags = GEOIDX_SAVE_NO_POSITIONS;
    const auto bare = index.bytes(&how);
    const auto any_mesh = gdx::open_options(), with_mesh = gdx::open_options(&mesh);
    return status_of([&] { gdx::index::open(bare, &any_mesh); }) == GEOIDX_ERROR_INVALID_ARGUMENT &&
           gdx::index::open(bare, &with_mesh).info().file_flags == GEOIDX_SAVE_NO_POSITIONS &&
           answers_right(gdx::index::open(bare, &with_mesh));
}

}

int main() {
    const geoidx_mesh mesh = gdx::mesh_of<double>(CORNERS, TRIANGLES);
    gdx::index built = gdx::index::build(mesh);
    const gdx::index moved = std::move(built);
    if (!answers_right(moved)) return 1;
    if (!answers_right(gdx::index::open(moved.bytes()))) return 2;
    moved.save("square++.geoidx");
    if (!answers_right(gdx::index::open("square++.geoidx"))) return 3;
    if (status_of([] { gdx::index::open("no such file"); }) != GEOIDX_ERROR_IO) return 4;
    if (status_of([&] { moved.sssd(0, 4); }) != GEOIDX_ERROR_INVALID_ARGUMENT) return 5;
    if (status_of([&] {
            gdx::index::build(mesh, gdx::build_options(), [](float, const char*) { return false; });
        }) != GEOIDX_ERROR_CANCELLED)
        return 6;
    if (!throws_what_progress_throws(mesh)) return 7;

    if (!walks_right(moved, mesh)) return 10;
    if (!finds_what_is_near(moved)) return 11;
    if (!comes_back_without_positions(moved, mesh)) return 9;

    std::vector<double> distances(4);
    const std::uint32_t source = 0;
    gdx::solver(mesh).distances(std::span(&source, 1), distances);
    if (!is_root_of_two(distances[2])) return 8;
    std::cout << moved.sssd(0, 2) << '\n';
}
