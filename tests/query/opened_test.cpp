// An index that was built and the same one from its file.
#include <cstring>
#include <random>

#include "tests/query/query_cases.h"
#include "tests/support/sanitized.h"

using namespace geodesic::test;

TEST_CASE("opened: every answer is that of the index as built, bit for bit" * doctest::skip(SANITIZED)) {
    for (const QueryCase& test : overlays_of_some_size()) {
        CAPTURE(test.name);
        const geoidx* built = index_of(test);
        const auto opened = open(save(built));
        const uint32_t count = test.mesh.vertex_count();
        uint64_t different = 0;
        for (uint32_t source = 0; source < count; source += 7) {
            const auto a = msad(built, source, count), b = msad(opened.get(), source, count);
            different += std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) != 0;
        }
        std::mt19937 random(3);
        for (uint32_t pair = 0; pair < 30000; ++pair) {
            const uint32_t a = static_cast<uint32_t>(random() % count),
                           b = static_cast<uint32_t>(random() % count);
            different += sssd(built, a, b) != sssd(opened.get(), a, b);
        }
        CHECK(different == 0);
    }
}

TEST_CASE("opened: small meshes of every kind answer bit for bit as built, and save the same bytes" *
          doctest::skip(SANITIZED)) {
    for (const QueryCase& test : query_cases()) {
        CAPTURE(test.name);
        const geoidx* built = index_of(test);
        const Bytes bytes = save(built);
        const auto opened = open(bytes);
        CHECK(save(opened.get()) == bytes);
        const geoidx_info before = info_of(built), after = info_of(opened.get());
        CHECK(std::memcmp(&before, &after, sizeof before) == 0);
        const uint32_t count = test.mesh.vertex_count();
        for (uint32_t source : {0u, count / 2, count - 1}) {
            const auto expected = msad(built, source, count), found = msad(opened.get(), source, count);
            CHECK(std::memcmp(expected.data(), found.data(), count * sizeof(float)) == 0);
            for (uint32_t target = 0; target < count; target += 7)
                CHECK(sssd(built, source, target) == sssd(opened.get(), source, target));
        }
        CHECK(geoidx_verify(bytes.data(), bytes.size(), nullptr, nullptr) == GEOIDX_OK);
    }
}

// Each fits into a leaf: there is no border at all.
TEST_CASE("opened: a thousand separate triangles") {
    constexpr uint32_t TRIANGLES = 1000;
    TestMesh mesh;
    for (uint32_t t = 0; t < TRIANGLES; ++t)
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const auto x = static_cast<double>(3 * t + (corner == 1)), y = static_cast<double>(corner == 2);
            mesh.positions.insert(mesh.positions.end(), {x, y, 0});
            mesh.triangles.push_back(3 * t + corner);
        }
    geoidx_build_options options = build_options();
    options.engine = GEOIDX_ENGINE_OVERLAY;
    const auto index = open(save(build(mesh, options).get()));
    CHECK(double{sssd(index.get(), 3, 4)} == doctest::Approx(1));
    CHECK(double{sssd(index.get(), 2998, 2999)} == doctest::Approx(std::sqrt(2.0)));
    CHECK(std::isinf(sssd(index.get(), 0, 3)));
}
