#include "tests/campaign/file_queries.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "geoidx.h"
#include "tests/campaign/file_memory.h"
#include "tests/campaign/file_random.h"
#include "tests/support/handles.h"

namespace geodesic::file_campaign {

namespace {

void require(bool holds, const std::string& what) {
    if (!holds) throw Broken(what);
}

void succeed(geoidx_status status, const std::string& what) {
    require(status == GEOIDX_OK, what + ": " + geoidx_status_string(status) + ", " + geoidx_last_error());
}

bool same_bits(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

std::vector<std::byte> saved(const geoidx& index, const geoidx_save_options* options = nullptr) {
    uint64_t size = 0;
    succeed(geoidx_save_memory(&index, options, nullptr, 0, &size), "the size of the saved file");
    std::vector<std::byte> bytes(size);
    succeed(geoidx_save_memory(&index, options, bytes.data(), size, &size), "saving");
    return bytes;
}

std::vector<std::byte> saved_as(const geoidx& index, uint32_t codec, uint32_t flags) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    options.flags = flags;
    return saved(index, &options);
}

// With the mesh of the content, if it has one.
geoidx_status open_file(const FileContent& content, const std::vector<std::byte>& bytes, geoidx** opened) {
    geoidx_mesh mesh;
    geoidx_mesh_init(&mesh);
    mesh.position_type = GEOIDX_POSITION_DOUBLE;
    mesh.positions = content.mesh_positions.data();
    mesh.vertex_count = content.id_count();
    mesh.triangles = content.triangles.data();
    mesh.triangle_count = content.triangles.size() / 3;
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    if (!content.has_positions) options.expected_mesh = &mesh;
    return geoidx_open_memory(bytes.data(), bytes.size(), &options, opened);
}

class Questions {
public:
    Questions(const FileContent& content, const geoidx& index, uint64_t seed)
        : content_(content), index_(index), random_(seed), ids_(content.id_count()) {
        geoidx_query* query = nullptr;
        succeed(geoidx_query_create(&index, &query), "a query");
        query_.reset(query);
    }

    void ask() {
        ask_pairs();
        ask_fields();
        ask_within();
        ask_batches_of_fields();
        ask_several_sources();
        ask_prepared();
    }

private:
    // An answer that can be: 0 for a vertex and itself, not NaN, not negative, infinite to another component.
    void check(float distance, uint32_t source, uint32_t target, const char* query) const {
        const auto at = [&] {
            return std::string(query) + " from " + std::to_string(source) + " to " + std::to_string(target) +
                   " is " + std::to_string(distance);
        };
        require(distance >= 0, at());
        if (source == target) require(distance == 0, at());
        const uint32_t a = content_.number_of_id[source], b = content_.number_of_id[target];
        const bool is_reachable =
            source == target ||
            (a != NOTHING && b != NOTHING &&
             (content_.component.empty() || content_.component[a] == content_.component[b]));
        if (!is_reachable) require(distance == NO_PATH, at() + ", which no path leads to");
        if (a == b && a != NOTHING) require(distance == 0, at() + ", which is the same vertex");
    }

    // All pairs of a small index, some of a large one.
    std::vector<uint32_t> some_pairs() {
        constexpr uint32_t ALL = 24, SOME = 500;
        std::vector<uint32_t> pairs;
        if (ids_ <= ALL)
            for (uint32_t a = 0; a < ids_; ++a)
                for (uint32_t b = 0; b < ids_; ++b) pairs.insert(pairs.end(), {a, b});
        else
            for (uint32_t i = 0; i < 2 * SOME; ++i) pairs.push_back(random_.below(ids_));
        return pairs;
    }

    void ask_pairs() {
        const auto pairs = some_pairs();
        std::vector<float> batch(pairs.size() / 2);
        for (size_t i = 0; i < batch.size(); ++i) {
            const uint32_t a = pairs[2 * i], b = pairs[2 * i + 1];
            float there = -1, back = -1, by_query = -1;
            succeed(geoidx_sssd(&index_, a, b, &there), "SSSD");
            succeed(geoidx_sssd(&index_, b, a, &back), "SSSD back");
            succeed(geoidx_query_sssd(query_.get(), a, b, &by_query), "SSSD by a query");
            check(there, a, b, "SSSD");
            require(same_bits(there, back), "SSSD is symmetric");
            require(same_bits(there, by_query), "SSSD by a query is SSSD");
            batch[i] = there;
        }
        std::vector<float> at_once(batch.size());
        succeed(geoidx_sssd_batch(&index_, pairs.data(), at_once.size(), at_once.data()), "SSSD of a batch");
        require(same_bits(batch, at_once), "SSSD of a batch is SSSD");
    }

    std::vector<uint32_t> some_ids(uint32_t count) {
        std::vector<uint32_t> ids;
        for (uint32_t i = 0; i < count; ++i) ids.push_back(random_.below(ids_));
        return ids;
    }

    std::vector<float> field(const std::vector<uint32_t>& sources, float radius = NO_PATH) {
        std::vector<float> distances(ids_);
        succeed(geoidx_query_msad_within(query_.get(), sources.data(), static_cast<uint32_t>(sources.size()),
                                         radius, distances.data(), ids_),
                "MSAD");
        return distances;
    }

    void ask_fields() {
        for (uint32_t source : some_ids(6)) {
            std::vector<float> distances(ids_);
            succeed(geoidx_msad(&index_, &source, 1, distances.data(), ids_), "MSAD");
            for (uint32_t v = 0; v < ids_; ++v) check(distances[v], source, v, "MSAD");
            require(same_bits(distances, field({source})), "MSAD by a query is MSAD");
            succeed(geoidx_query_set_threads(query_.get(), 2), "two threads");
            require(same_bits(distances, field({source})), "MSAD of two threads is MSAD");
            succeed(geoidx_query_set_threads(query_.get(), 1), "one thread");
        }
    }

    float some_radius() {
        switch (random_.below(4)) {
        case 0:
            return 0;
        case 1:
            return random_.unit();
        case 2:
            return 3e38f;
        default:
            return random_.unit() * 1e-3f;
        }
    }

    void ask_within() {
        for (uint32_t i = 0; i < 4; ++i) {
            const float radius = some_radius();
            const auto sources = some_ids(1 + i / 2);
            const auto distances = field(sources, radius);
            for (float d : distances)
                require((d >= 0 && d <= radius) || d == NO_PATH, "within a radius is within it");
            for (uint32_t source : sources) require(distances[source] == 0, "sources are within any radius");
        }
    }

    void ask_batches_of_fields() {
        for (uint32_t count : {3u, 8u, 17u}) {
            const auto sources = some_ids(count);
            std::vector<float> fields(size_t{ids_} * count), by_query(fields.size()), one_by_one;
            succeed(geoidx_ssad_batch(&index_, sources.data(), count, fields.data(), fields.size()), "SSAD");
            succeed(geoidx_query_ssad_batch(query_.get(), sources.data(), count, by_query.data(),
                                            by_query.size()),
                    "SSAD by a query");
            require(same_bits(fields, by_query), "SSAD by a query is SSAD");
            for (uint32_t source : sources) {
                const auto one = field({source});
                one_by_one.insert(one_by_one.end(), one.begin(), one.end());
            }
            require(same_bits(fields, one_by_one), "SSAD of many is MSAD of each");
        }
    }

    // From several sources, in any order and any of them twice, by one thread and by two.
    void ask_several_sources() {
        for (uint32_t count : {2u, 5u, 40u}) {
            auto sources = some_ids(count);
            const auto distances = field(sources);
            for (uint32_t v = 0; v < ids_; ++v) {
                require(distances[v] >= 0, "MSAD of several sources is no distance");
                if (std::isfinite(distances[v])) check_reachable(sources, v);
            }
            for (uint32_t source : sources) require(distances[source] == 0, "MSAD is 0 at sources");
            random_.shuffle(sources);
            sources.push_back(sources.front());
            succeed(geoidx_query_set_threads(query_.get(), 2), "two threads");
            require(same_bits(distances, field(sources)), "MSAD of two threads, in another order, is MSAD");
            succeed(geoidx_query_set_threads(query_.get(), 1), "one thread");
        }
    }

    void check_reachable(const std::vector<uint32_t>& sources, uint32_t target) const {
        if (content_.component.empty()) return;
        const uint32_t b = content_.number_of_id[target];
        require(std::ranges::any_of(sources,
                                    [&](uint32_t source) {
                                        const uint32_t a = content_.number_of_id[source];
                                        return source == target ||
                                               (a != NOTHING && b != NOTHING &&
                                                content_.component[a] == content_.component[b]);
                                    }),
                "MSAD of several sources is finite at " + std::to_string(target) +
                    ", which no path leads to");
    }

    void ask_prepared() {
        for (uint32_t source : some_ids(4)) {
            succeed(geoidx_query_prepare(query_.get(), source), "preparing");
            const auto targets = some_ids(100);
            std::vector<float> distances(targets.size());
            succeed(geoidx_query_prepared(query_.get(), targets.data(), targets.size(), distances.data()),
                    "prepared SSSD");
            for (size_t i = 0; i < targets.size(); ++i)
                check(distances[i], source, targets[i], "prepared SSSD");
        }
    }

    const FileContent& content_;
    const geoidx& index_;
    Random random_;
    const uint32_t ids_;
    test::QueryHandle query_;
};

void check_saving(const FileContent& content, const WrittenFile& file, const geoidx& index) {
    const auto bytes = saved(index);
    if (content.is_canonical && !content.is_packed)
        require(bytes == file.bytes, "what is saved is what was opened");
    geoidx* again = nullptr;
    succeed(open_file(content, bytes, &again), "opening what was saved");
    require(saved(*test::IndexHandle(again)) == bytes, "what is saved of that is the same again");
}

// The index in each form, opened, verified, and brought back into the form that it had.
void check_forms(const FileContent& content, const geoidx& index, uint32_t flags) {
    const auto own = saved(index);
    for (const uint32_t codec : {GEOIDX_CODEC_PACKED, GEOIDX_CODEC_LOSSLESS, GEOIDX_CODEC_MAPPED}) {
        const auto bytes = saved_as(index, codec, flags);
        geoidx* opened = nullptr;
        succeed(open_file(content, bytes, &opened), "opening another form");
        const test::IndexHandle other(opened);
        require(geoidx_verify(bytes.data(), bytes.size(), nullptr, nullptr) == GEOIDX_OK,
                "another form is verified");
        require(saved(*other) == bytes, "another form is saved as it was opened");
        geoidx_info info{};
        info.struct_size = sizeof info;
        succeed(geoidx_get_info(&index, &info), "what the index is");
        require(saved_as(*other, info.codec, info.file_flags) == own, "another form holds the same");
    }
}

void check_mesh_is_needed(const WrittenFile& file) {
    geoidx* opened = nullptr;
    const geoidx_status status = geoidx_open_memory(file.bytes.data(), file.bytes.size(), nullptr, &opened);
    require(status == GEOIDX_ERROR_INVALID_ARGUMENT && !opened, "no mesh, no index");
}

// Everything that is derived from a file, and all scratch, these questions' own included, is in proportion to
// it. A file may be up to 1032 times smaller than its raw sections.
void check_memory(const WrittenFile& file, uint64_t before) {
    constexpr uint64_t TIMES = 256, ALWAYS = 32 << 20;
    const uint64_t taken = peak_memory() - before;
    require(taken <= TIMES * file.raw_size + ALWAYS, "opening and asking took " + std::to_string(taken) +
                                                         " bytes for sections of " +
                                                         std::to_string(file.raw_size));
}

}

bool ask_everything(const FileContent& content, const WrittenFile& file, uint64_t seed) {
    start_peak();
    const uint64_t before = peak_memory();
    geoidx* opened = nullptr;
    const geoidx_status status = open_file(content, file.bytes, &opened);
    const test::IndexHandle index(opened);
    require((status == GEOIDX_OK) == (index != nullptr), "there is an index or an error");
    require(status == GEOIDX_OK || status == GEOIDX_ERROR_LIMIT,
            std::string("a file that contradicts nothing is refused: ") + geoidx_last_error());
    require(geoidx_verify(file.bytes.data(), file.bytes.size(), nullptr, nullptr) == status,
            "verify says what open says");
    if (index) {
        Questions(content, *index, seed).ask();
        check_saving(content, file, *index);
    }
    check_memory(file, before);
    if (!content.has_positions) check_mesh_is_needed(file);
    if (!index) return false;
    check_forms(content, *index, 0);
    if (!content.has_positions) check_forms(content, *index, GEOIDX_SAVE_NO_POSITIONS);
    return true;
}

}
