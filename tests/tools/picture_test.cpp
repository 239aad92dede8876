#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tools/picture/colour_map.h"
#include "tools/picture/png.h"
#include "tools/picture/render.h"
#include "tools/picture/shading.h"

using namespace geodesic::tools;

namespace {

constexpr float UNREACHABLE = std::numeric_limits<float>::infinity();

// side x side cells over the unit square in the plane z = 0.
TriangleMesh plane(uint32_t side) {
    TriangleMesh mesh;
    for (uint32_t y = 0; y <= side; ++y)
        for (uint32_t x = 0; x <= side; ++x)
            mesh.positions.insert(mesh.positions.end(), {double(x) / side, double(y) / side, 0.0});
    for (uint32_t y = 0; y < side; ++y)
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x;
            const uint32_t c = a + side + 1;
            mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, c + 1, a, c + 1, c});
        }
    return mesh;
}

TriangleMesh sphere(uint32_t rings, uint32_t sectors) {
    TriangleMesh mesh;
    for (uint32_t ring = 0; ring <= rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const double polar = std::numbers::pi * ring / rings;
            const double around = 2 * std::numbers::pi * sector / sectors;
            mesh.positions.insert(mesh.positions.end(), {std::sin(polar) * std::cos(around), std::cos(polar),
                                                         std::sin(polar) * std::sin(around)});
        }
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const uint32_t next = (sector + 1) % sectors;
            const uint32_t a = ring * sectors;
            const uint32_t b = a + sectors;
            mesh.triangles.insert(mesh.triangles.end(),
                                  {a + sector, a + next, b + next, a + sector, b + next, b + sector});
        }
    return mesh;
}

std::vector<float> x_coordinates(const TriangleMesh& mesh) {
    std::vector<float> distances;
    for (size_t v = 0; v < mesh.vertex_count(); ++v)
        distances.push_back(static_cast<float>(mesh.positions[3 * v]));
    return distances;
}

PictureOptions front_view(int side, uint32_t isolines) {
    PictureOptions options;
    options.width = side;
    options.height = side;
    options.isolines = isolines;
    options.view = View{0, 0, UpAxis::y, false};
    return options;
}

bool is_grey(const uint8_t* pixel) { return pixel[0] == pixel[1] && pixel[1] == pixel[2]; }

int brightness(const uint8_t* pixel) { return pixel[0] + pixel[1] + pixel[2]; }

// A place much darker than what is a few pixels to either side.
int dark_lines_in_row(const Image& image, int y) {
    int lines = 0;
    bool in_line = false;
    for (int x = 5; x + 5 < image.width; ++x) {
        const int here = brightness(image.pixel(x, y)) * 11 / 10;
        const bool dark =
            here < brightness(image.pixel(x - 5, y)) && here < brightness(image.pixel(x + 5, y));
        if (dark && !in_line) ++lines;
        in_line = dark;
    }
    return lines;
}

double lightness(Colour c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

}

TEST_CASE("picture: a plane with distance = x shows as many lines as asked for, evenly spaced") {
    const TriangleMesh mesh = plane(40);
    const std::vector<float> distances = x_coordinates(mesh);
    for (const uint32_t count : {0u, 1u, 7u, 24u}) {
        const Image image = render_field(mesh, distances, {}, front_view(500, count));
        for (const int row : {100, 250, 400}) CHECK(dark_lines_in_row(image, row) == static_cast<int>(count));
    }
}

TEST_CASE("picture: a sphere covers the disc that it should") {
    const TriangleMesh mesh = sphere(60, 120);
    const std::vector<float> distances(mesh.vertex_count(), UNREACHABLE);
    const Image image = render_field(mesh, distances, {}, front_view(400, 0));
    int covered = 0;
    for (int y = 0; y < 400; ++y)
        for (int x = 0; x < 400; ++x) covered += is_grey(image.pixel(x, y)) ? 1 : 0;
    const double radius = 400 * 0.44; // a margin of 6 % on either side
    CHECK(covered == doctest::Approx(std::numbers::pi * radius * radius).epsilon(0.03));
    CHECK(is_grey(image.pixel(200, 200)));
    CHECK(is_grey(image.pixel(200 + 170, 200)));
    CHECK_FALSE(is_grey(image.pixel(200 + 180, 200)));
    CHECK_FALSE(is_grey(image.pixel(200 + 135, 200 + 135)));
}

TEST_CASE("picture: unreachable parts are grey, reachable ones are not") {
    const TriangleMesh mesh = plane(10);
    std::vector<float> distances = x_coordinates(mesh);
    for (float& distance : distances)
        if (distance > 0.55f) distance = UNREACHABLE;
    const Image image = render_field(mesh, distances, {}, front_view(200, 5));
    CHECK(is_grey(image.pixel(150, 100)));
    CHECK_FALSE(is_grey(image.pixel(50, 100)));
}

TEST_CASE("picture: the source is marked and turned to the viewer") {
    const TriangleMesh mesh = sphere(30, 60);
    const DrawnSurface surface = drawn_surface(mesh);
    for (const uint32_t source : {15u * 60 + 7, 15u * 60 + 37, 8u * 60 + 20}) {
        const View view = view_of_source(surface, source, UpAxis::y);
        CHECK(VisibilityTest(surface, view)(surface.positions[source]));
        const Camera camera = fitted_camera(surface, view, 300, 300, 0.06);
        CHECK(dot(camera.back, surface.positions[source]) > 0.3);
        PictureOptions options;
        options.width = options.height = 300;
        const std::vector<float> distances(mesh.vertex_count(), 1.0f);
        const Image image = render_field(mesh, distances, {&source, 1}, options);
        const ScreenPoint at = camera.project(surface.positions[source]);
        CHECK(brightness(image.pixel(static_cast<int>(at.x), static_cast<int>(at.y))) > 600);
    }
}

TEST_CASE("picture: a path is a bright line with a dark rim, and what hides it hides it") {
    TriangleMesh mesh = plane(4);
    const std::vector<float> distances(mesh.vertex_count(), 0.5f);
    // Over the triangle (0, 0), (1/4, 0), (1/4, 1/4) and its neighbours along y = 1/8: straight to the right.
    std::vector<WayPoint> way;
    for (uint32_t x = 0; x < 4; ++x) {
        const std::array corners{x, x + 1, x + 6};
        way.push_back({corners, {0.5, 0, 0.5}});
        way.push_back({corners, {0, 0.5, 0.5}});
    }
    const PictureOptions options = front_view(800, 0);
    const Image bare = render_field(mesh, distances, {}, options);
    const Image image = render_field(mesh, distances, {}, options, way);
    const DrawnSurface surface = drawn_surface(mesh);
    const Camera camera = fitted_camera(surface, *options.view, 800, 800, 0.06);
    const ScreenPoint left = camera.project(mix(surface.positions[0], surface.positions[6], 0.5)),
                      right = camera.project(mix(surface.positions[4], surface.positions[9], 0.5));
    const int y = static_cast<int>(left.y);
    for (int x = static_cast<int>(left.x) + 6; x < static_cast<int>(right.x) - 6; ++x) {
        CHECK(brightness(image.pixel(x, y)) > 600);
        CHECK(brightness(image.pixel(x, y)) > brightness(bare.pixel(x, y)));
        int rim = brightness(bare.pixel(x, y));
        for (int beside = 2; beside <= 6; ++beside)
            rim = std::min(rim, brightness(image.pixel(x, y - beside)));
        CHECK(rim < brightness(bare.pixel(x, y)) * 3 / 4);
        CHECK(brightness(image.pixel(x, y - 20)) == brightness(bare.pixel(x, y - 20)));
    }
    // A wall in front of all of it.
    const auto first = static_cast<uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), {-1, -1, 1, 3, -1, 1, -1, 3, 1});
    mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2});
    const std::vector<float> all(mesh.vertex_count(), 0.5f);
    CHECK(render_field(mesh, all, {}, options, way).pixels == render_field(mesh, all, {}, options).pixels);
}

TEST_CASE("picture: no distance, no size and no shape makes it fail") {
    TriangleMesh mesh;
    mesh.positions = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    mesh.triangles = {0, 1, 2};
    const std::vector<float> distances{0, UNREACHABLE, 0};
    const uint32_t source = 0;
    PictureOptions options;
    options.width = 33;
    options.height = 17;
    const Image image = render_field(mesh, distances, {&source, 1}, options);
    CHECK(image.pixels.size() == 3 * 33 * 17);
    mesh.positions[4] = std::nan("");
    CHECK_THROWS_WITH(render_field(mesh, distances, {&source, 1}, options),
                      "vertex 1 has no finite position");
}

TEST_CASE("picture: normals are smooth over a seam and sharp at a cube's edge") {
    TriangleMesh seam;
    seam.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 0, 0, 0, 1, 0.1, -1, 0, 0};
    seam.triangles = {0, 1, 2, 3, 4, 5};
    const DrawnSurface surface = drawn_surface(seam);
    CHECK(surface.normals[0][0].x == doctest::Approx(surface.normals[1][0].x));
    TriangleMesh edge;
    edge.positions = {0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1};
    edge.triangles = {0, 2, 1, 0, 1, 3};
    CHECK(drawn_surface(edge).normals[0][0].z == doctest::Approx(1));
}

TEST_CASE("picture: the colour map darkens evenly") {
    const ColourMap map;
    for (int i = 1; i <= 64; ++i) CHECK(lightness(map(i / 64.0)) < lightness(map((i - 1) / 64.0)));
    CHECK(lightness(map(-1)) == lightness(map(0)));
    CHECK(lightness(map(2)) == lightness(map(1)));
}

TEST_CASE("picture: lines are as wide as asked for, whatever the slope") {
    const Isolines lines{9, 1.0, 4.0};
    for (const double slope : {0.001, 0.01, 0.05}) {
        double width = 0;
        for (int i = -200; i < 200; ++i) width += line_coverage(lines, 3 + slope * i * 0.05, slope) * 0.05;
        CHECK(width == doctest::Approx(4.0).epsilon(0.02));
    }
    CHECK(line_coverage(lines, 0.0, 0.01) == 0);
    CHECK(line_coverage(lines, 10.0, 0.01) == 0);
}

TEST_CASE("picture: png begins like one") {
    const std::vector<unsigned char> bytes = encode_png({2, 1, {255, 0, 0, 0, 0, 255}});
    REQUIRE(bytes.size() > 8);
    CHECK(bytes[0] == 0x89);
    CHECK(bytes[1] == 'P');
}
