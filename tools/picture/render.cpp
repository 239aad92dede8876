#include "tools/picture/render.h"

#include <atomic>
#include <thread>

#include "tools/picture/occlusion.h"
#include "tools/picture/shading.h"
#include "tools/picture/source_marks.h"

namespace geodesic::tools {

namespace {

// Samples a pixel has in each direction.
constexpr int SUPERSAMPLING = 3;
// Rows drawn at a time, which bounds the memory of large pictures.
constexpr int STRIP_HEIGHT = 32;
constexpr double MARGIN = 0.06;

Colour background(double part_of_height) {
    return linear_from_srgb(
        mix({0.985, 0.987, 0.992}, {0.875, 0.888, 0.910}, smooth_step(0, 1, part_of_height)));
}

Colour mean_of_samples(const VisibilityBuffer& buffer, const Shader& shader, int x, int y, Colour behind) {
    Colour sum;
    for (int sy = SUPERSAMPLING * y; sy < SUPERSAMPLING * (y + 1); ++sy)
        for (int sx = SUPERSAMPLING * x; sx < SUPERSAMPLING * (x + 1); ++sx) {
            const uint32_t triangle = buffer.triangle[buffer.at(sx, sy)];
            sum = sum + (triangle == NO_TRIANGLE ? behind : shader(triangle, sx + 0.5, sy + 0.5));
        }
    return (1.0 / (SUPERSAMPLING * SUPERSAMPLING)) * sum;
}

void store(Colour linear, uint8_t* pixel) {
    const Colour srgb = srgb_from_linear(linear);
    pixel[0] = static_cast<uint8_t>(std::lround(255 * srgb.x));
    pixel[1] = static_cast<uint8_t>(std::lround(255 * srgb.y));
    pixel[2] = static_cast<uint8_t>(std::lround(255 * srgb.z));
}

void draw_strip(const Scene& scene, const Shader& shader, int first_row, Image& image) {
    const int row_count = std::min(STRIP_HEIGHT, image.height - first_row);
    VisibilityBuffer buffer(SUPERSAMPLING * image.width, SUPERSAMPLING * first_row,
                            SUPERSAMPLING * row_count);
    rasterize(scene.surface, scene.points, buffer);
    for (int y = first_row; y < first_row + row_count; ++y) {
        const Colour behind = background((y + 0.5) / image.height);
        for (int x = 0; x < image.width; ++x)
            store(mean_of_samples(buffer, shader, x, y, behind), image.pixel(x, y));
    }
}

void draw(const Scene& scene, Image& image) {
    const Shader shader(scene);
    std::atomic<int> next_row = 0;
    const auto draw_strips = [&] {
        for (int row; (row = next_row.fetch_add(STRIP_HEIGHT)) < image.height;)
            draw_strip(scene, shader, row, image);
    };
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) helpers.emplace_back(draw_strips);
    draw_strips();
}

Isolines isolines_of(const PictureOptions& options, double max_distance) {
    const double unit = std::min(options.width, options.height) / 1000.0; // thinner in small pictures
    return {static_cast<int>(options.isolines), max_distance / (options.isolines + 1.0),
            SUPERSAMPLING * std::clamp(1.9 * unit, 1.2, 6.0)};
}

}

Image render_field(const TriangleMesh& mesh, std::span<const float> distances,
                   std::span<const uint32_t> sources, const PictureOptions& options,
                   std::span<const WayPoint> way) {
    const DrawnSurface surface = drawn_surface(mesh);
    const auto first_source = sources.empty() ? std::nullopt : std::optional(sources[0]);
    const View view = options.view ? *options.view : view_of_source(surface, first_source, options.up);
    const Camera camera = fitted_camera(surface, view, options.width, options.height, MARGIN);
    const Camera sample_camera = magnified(camera, SUPERSAMPLING);
    const std::vector<ScreenPoint> points = project_all(surface, sample_camera);
    const std::vector<float> sky = sky_visibility(surface);
    const double max_distance = largest_distance(surface, distances);
    const Scene scene{
        surface, sample_camera, points, distances, sky, max_distance, isolines_of(options, max_distance)};

    Image image{options.width, options.height, {}};
    image.pixels.resize(3 * static_cast<size_t>(options.width) * static_cast<size_t>(options.height));
    draw(scene, image);
    draw_way(surface, view, camera, way, image);
    draw_source_marks(surface, view, camera, sources, image);
    return image;
}

}
