#include "tests/campaign/mesh_checks.h"

#include <algorithm>
#include <set>

#include "tests/campaign/query_checks.h"

namespace geodesic::campaign {

namespace {

IndexHandle build(const BuildInput& input) {
    geoidx* made = nullptr;
    const geoidx_status status = geoidx_build(&input.mesh(), &input.options(), &made);
    IndexHandle index(made);
    expect((status == GEOIDX_OK) == (made != nullptr), "an index or an error", "%d", status);
    if (input.surface().has_triangles())
        succeed(status, "geoidx_build");
    else
        expect(status == GEOIDX_ERROR_BAD_MESH, "a mesh without triangles is refused", "%d", status);
    return index;
}

// A source in each part, some anywhere.
std::vector<uint32_t> chosen_sources(const Surface& surface, Dice& dice) {
    constexpr size_t MOST_PARTS = 8, ANYWHERE = 8;
    std::vector<uint32_t> order(surface.vertex_count()), sources;
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    dice.shuffle(order);
    for (uint32_t id : order) {
        const bool is_new =
            std::ranges::none_of(sources, [&](uint32_t s) { return surface.are_joined(s, id); });
        if (is_new && sources.size() < MOST_PARTS) sources.push_back(id);
    }
    const size_t of_parts = sources.size();
    for (uint32_t id : order)
        if (sources.size() < of_parts + ANYWHERE && std::ranges::count(sources, id) == 0)
            sources.push_back(id);
    return sources;
}

std::vector<Truth> find_truths(const BuildInput& input, geoidx_solver* solver, Dice& dice) {
    std::vector<Truth> truths;
    for (uint32_t source : chosen_sources(input.surface(), dice)) {
        truths.push_back(truth_of(input, solver, std::span(&source, 1)));
        check_truth(input, truths.back());
    }
    return truths;
}

// No distance is longer: a way leads over the source that the part was given.
double longest_of(std::span<const Truth> truths) {
    double longest = 0;
    for (const Truth& truth : truths)
        for (double d : truth.exact)
            if (d < FAR) longest = std::max(longest, 2 * d);
    return longest;
}

int32_t tell(void* user, const geoidx_issue* issue) {
    *static_cast<std::string*>(user) += formatted(
        "%u at %llu: %s; ", issue->number, static_cast<unsigned long long>(issue->offset), issue->message);
    return 1;
}

constexpr uint32_t CODECS[]{GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED};

std::vector<std::byte> saved(const geoidx* index, uint32_t codec, uint32_t flags = 0) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    options.flags = flags;
    uint64_t size = 0;
    succeed(geoidx_save_memory(index, &options, nullptr, 0, &size), "geoidx_save_memory, size");
    std::vector<std::byte> bytes(size);
    succeed(geoidx_save_memory(index, &options, bytes.data(), size, &size), "geoidx_save_memory");
    return bytes;
}

IndexHandle opened(const BuildInput& input, std::span<const std::byte> bytes) {
    std::string issues;
    const geoidx_status status = geoidx_verify(bytes.data(), bytes.size(), tell, &issues);
    expect(status == GEOIDX_OK && issues.empty(), "geoidx_verify of a saved index", "%d, %s", status,
           issues.c_str());
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = &input.mesh();
    geoidx* made = nullptr;
    succeed(geoidx_open_memory(bytes.data(), bytes.size(), &options, &made), "geoidx_open_memory");
    return IndexHandle(made);
}

void check_forms(const geoidx* index, const std::vector<std::vector<std::byte>>& files) {
    for (const uint32_t codec : CODECS)
        expect(saved(index, codec) == files[codec], "an opened index is saved as the same bytes", "codec %u",
               codec);
}

// An index of a file without positions is saved as the one that it was saved from, with them and without.
void check_without_positions(const BuildInput& input, const geoidx* index,
                             const std::vector<std::vector<std::byte>>& files) {
    for (const uint32_t codec : CODECS) {
        const auto bytes = saved(index, codec, GEOIDX_SAVE_NO_POSITIONS);
        const IndexHandle again = opened(input, bytes);
        expect(bytes.size() <= files[codec].size(), "no positions take no more", "codec %u", codec);
        expect(saved(again.get(), codec) == files[codec], "positions come back", "codec %u", codec);
        expect(saved(again.get(), codec, GEOIDX_SAVE_NO_POSITIONS) == bytes, "positions are left out again",
               "codec %u", codec);
    }
}

// What a surface says of its vertices and of positions around them, as bits.
std::string bits_of_surface(const BuildInput& input, const geoidx_surface* surface) {
    std::string text;
    const auto add = [&text](const auto& value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (uint32_t id = 0; id < input.surface().vertex_count(); ++id) {
        geoidx_surface_point point{};
        add(geoidx_vertex_point(surface, id, &point));
        add(point);
        Eigen::Vector3d beside = input.position(id) + Eigen::Vector3d(0.3, -0.2, 0.1);
        double distance = 0;
        succeed(geoidx_closest_point(surface, beside.data(), &point, &distance), "geoidx_closest_point");
        add(point);
        add(distance);
    }
    return text;
}

// The surface of the mesh that the files keep is that of the mesh that they were built from.
void check_kept_mesh(const BuildInput& input, const std::vector<std::vector<std::byte>>& files) {
    const std::string own = bits_of_surface(input, input.make_surface().get());
    for (const auto& file : files) {
        geoidx_surface* made = nullptr;
        succeed(geoidx_surface_of_index(opened(input, file).get(), nullptr, &made),
                "geoidx_surface_of_index");
        expect(bits_of_surface(input, SurfaceHandle(made).get()) == own, "the kept mesh is the mesh",
               "%zu bytes", file.size());
    }
}

void check_info(const BuildInput& input, const geoidx_info& info) {
    expect(info.vertex_count == input.mesh().vertex_count, "info: vertex_count", "%llu",
           static_cast<unsigned long long>(info.vertex_count));
    expect(info.triangle_count == input.mesh().triangle_count, "info: triangle_count", "%llu",
           static_cast<unsigned long long>(info.triangle_count));
    expect(info.welded_vertex_count == input.surface().welded_vertex_count(), "info: welded_vertex_count",
           "%llu, counted %u", static_cast<unsigned long long>(info.welded_vertex_count),
           input.surface().welded_vertex_count());
    for (double error :
         {info.error_mean, info.error_p99, info.error_p999, info.error_max, info.error_near_mean,
          info.error_near_max, info.error_middle_mean, info.error_middle_max, info.error_far_mean,
          info.error_far_max, info.error_several_mean, info.error_several_max})
        expect(error >= 0 && error < FAR, "info: errors", "%g", error);
}

}

void check_case(const test::Soup& soup, const CaseOptions& options) {
    const BuildInput input(soup, options);
    IndexHandle built = build(input);
    if (!built) return;
    check_info(input, info_of(built.get()));
    Dice dice(options.query_seed);
    const SolverHandle solver = input.make_solver();
    const auto truths = find_truths(input, solver.get(), dice);
    const double longest = longest_of(truths);
    std::vector<std::vector<std::byte>> files; // by codec
    for (const uint32_t codec : CODECS) files.push_back(saved(built.get(), codec));
    check_without_positions(input, built.get(), files);
    if (options.store_mesh) check_kept_mesh(input, files);
    const Subject subject(input, std::move(built), longest);
    check_queries(subject, solver.get(), truths, dice);
    for (const auto& file : files) check_forms(opened(input, file).get(), files);
    if (!options.opened) return;
    IndexHandle again = opened(input, files[options.query_seed % files.size()]);
    const Subject other(input, std::move(again), longest);
    check_same_answers("an opened index answers the same", subject, other, truths, dice);
}

}
