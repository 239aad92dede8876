#include "tests/campaign/query_checks.h"

#include <algorithm>
#include <thread>

#include "tests/campaign/near_checks.h"
#include "tests/campaign/path_checks.h"
#include "tests/campaign/point_checks.h"

namespace geodesic::campaign {

namespace {

struct Pair {
    const Truth* from;
    uint32_t target;
    uint32_t source() const { return from->sources[0]; }
};

// In random order: pairs within a part and across parts one after the other.
std::vector<Pair> random_pairs(const Subject& subject, std::span<const Truth> truths, Dice& dice) {
    constexpr uint32_t MOST_OF_SOURCE = 40;
    const uint32_t count = subject.vertex_count();
    std::vector<Pair> pairs;
    for (const Truth& truth : truths)
        for (uint32_t i = 0; i < std::min(count, MOST_OF_SOURCE); ++i)
            pairs.push_back({&truth, count <= MOST_OF_SOURCE ? i : dice.below(count)});
    for (const Truth& truth : truths) pairs.push_back({&truth, truth.sources[0]});
    dice.shuffle(pairs);
    return pairs;
}

void check_pairs(const Subject& subject, std::span<const Truth> truths, Dice& dice) {
    auto pairs = random_pairs(subject, truths, dice);
    std::vector<uint32_t> ids;
    Floats answers;
    for (const Pair& pair : pairs) {
        const float there = subject.sssd(pair.source(), pair.target);
        check_answer("sssd", subject.input(), subject.bounds(), *pair.from, pair.target, there);
        const float back = subject.sssd(pair.target, pair.source());
        expect(same_bits(there, back), "sssd is symmetric", "%u to %u: %.9g, back %.9g", pair.source(),
               pair.target, double{there}, double{back});
        ids.insert(ids.end(), {pair.source(), pair.target});
        answers.push_back(there);
    }
    Floats batch(pairs.size(), -1);
    succeed(geoidx_sssd_batch(subject.index(), ids.data(), pairs.size(), batch.data()), "geoidx_sssd_batch");
    expect_same("sssd_batch is sssd", batch, answers);
    for (size_t i = pairs.size(); i-- > 0;) {
        const float again = subject.sssd(pairs[i].source(), pairs[i].target);
        expect(same_bits(again, answers[i]), "sssd after others", "%u to %u: %.9g, before %.9g",
               pairs[i].source(), pairs[i].target, double{again}, double{answers[i]});
    }
}

// No way is longer than one over a third vertex, but for what answers may be off: over any two sources and
// every vertex.
void check_triangles(const Subject& subject, std::span<const uint32_t> sources, const Floats& fields) {
    const size_t count = subject.vertex_count();
    for (size_t i = 0; i < sources.size(); ++i)
        for (size_t j = 0; j < sources.size(); ++j)
            for (size_t v = 0; v < count; ++v) {
                const double direct{fields[i * count + v]};
                const double over = double{fields[i * count + sources[j]]} + double{fields[j * count + v]};
                expect(direct <= subject.bounds().most_over(over), "msad keeps the triangle inequality",
                       "%u to %zu: %.9g, over %u: %.9g", sources[i], v, direct, sources[j], over);
            }
}

void check_fields(const Subject& subject, std::span<const Truth> truths) {
    std::vector<uint32_t> sources;
    Floats fields;
    for (const Truth& truth : truths) {
        const Floats field = subject.msad(truth.sources);
        for (uint32_t id = 0; id < field.size(); ++id)
            check_answer("msad", subject.input(), subject.bounds(), truth, id, field[id]);
        sources.push_back(truth.sources[0]);
        fields.insert(fields.end(), field.begin(), field.end());
    }
    check_triangles(subject, sources, fields);
    Floats batch(fields.size(), -1);
    const auto count = static_cast<uint32_t>(sources.size());
    succeed(geoidx_ssad_batch(subject.index(), sources.data(), count, batch.data(), batch.size()),
            "geoidx_ssad_batch");
    expect_same("ssad_batch is msad", batch, fields);
    std::ranges::fill(batch, -1.0f);
    succeed(geoidx_query_ssad_batch(subject.query(), sources.data(), count, batch.data(), batch.size()),
            "geoidx_query_ssad_batch");
    expect_same("query_ssad_batch is msad", batch, fields);
}

void check_prepared(const Subject& subject, std::span<const Truth> truths, Dice& dice) {
    for (const Truth& truth : truths) {
        succeed(geoidx_query_prepare(subject.query(), truth.sources[0]), "geoidx_query_prepare");
        std::vector<uint32_t> targets(subject.vertex_count());
        for (uint32_t i = 0; i < targets.size(); ++i) targets[i] = i;
        dice.shuffle(targets);
        targets.resize(std::min<size_t>(targets.size(), 60));
        Floats answers(targets.size(), -1);
        succeed(geoidx_query_prepared(subject.query(), targets.data(), targets.size(), answers.data()),
                "geoidx_query_prepared");
        for (size_t i = 0; i < targets.size(); ++i)
            check_answer("prepared", subject.input(), subject.bounds(), truth, targets[i], answers[i]);
        for (size_t i = targets.size(); i-- > 0;) {
            float again = -1;
            succeed(geoidx_query_prepared(subject.query(), &targets[i], 1, &again), "geoidx_query_prepared");
            expect(same_bits(again, answers[i]), "prepared after others", "%u to %u: %.9g, before %.9g",
                   truth.sources[0], targets[i], double{again}, double{answers[i]});
        }
    }
}

// Anywhere, or next to each other.
std::vector<uint32_t> random_sources(const Subject& subject, std::span<const Truth> truths, Dice& dice) {
    const uint32_t count = subject.vertex_count();
    const uint32_t wanted = std::min(count, dice.pick({2u, 3u, 7u, 16u, 40u, count / 2 + 1}));
    std::vector<uint32_t> sources(count);
    for (uint32_t i = 0; i < count; ++i) sources[i] = i;
    dice.shuffle(sources);
    if (dice.chance(0.5)) {
        const auto& distance = truths[dice.below(truths.size())].exact;
        std::ranges::stable_sort(sources, [&](uint32_t a, uint32_t b) { return distance[a] < distance[b]; });
    }
    sources.resize(wanted);
    return sources;
}

Floats cut_off(Floats field, float radius) {
    for (float& d : field)
        if (d > radius) d = static_cast<float>(FAR);
    return field;
}

void check_radius(const Subject& subject, std::span<const uint32_t> sources, const Floats& field,
                  Dice& dice) {
    const float farthest = *std::ranges::max_element(field, {}, [](float d) { return d < FAR ? d : 0; });
    for (float radius : {0.0f, farthest * static_cast<float>(dice.real(0, 1)),
                         field[dice.below(field.size())], farthest, static_cast<float>(FAR)})
        expect_same("msad_within is msad", subject.msad_within(sources, radius), cut_off(field, radius));
}

void check_threads(const Subject& subject, std::span<const uint32_t> sources, const Floats& field,
                   Dice& dice) {
    for (uint32_t threads = 4; threads > 0; --threads) {
        succeed(geoidx_query_set_threads(subject.query(), threads), "geoidx_query_set_threads");
        expect_same("threads", subject.msad(sources), field);
        const float radius = field[dice.below(field.size())];
        expect_same("msad_within threads", subject.msad_within(sources, radius), cut_off(field, radius));
    }
}

void check_several(const Subject& subject, geoidx_solver* solver, std::span<const Truth> truths, Dice& dice) {
    auto sources = random_sources(subject, truths, dice);
    const Truth truth = truth_of(subject.input(), solver, sources);
    const Floats field = subject.msad(sources);
    for (uint32_t id = 0; id < field.size(); ++id)
        check_answer("msad of several", subject.input(), subject.bounds(), truth, id, field[id]);
    check_radius(subject, sources, field, dice);
    check_threads(subject, sources, field, dice);
    check_near(subject, sources, field, dice);
    sources.insert(sources.end(), {sources.front(), sources.back()});
    dice.shuffle(sources);
    Floats again(field.size(), -1);
    succeed(geoidx_msad(subject.index(), sources.data(), static_cast<uint32_t>(sources.size()), again.data(),
                        subject.vertex_count()),
            "geoidx_msad");
    expect_same("msad whatever the order", again, field);
}

// Several threads ask one index at once, each its own query or none.
void check_at_once(const Subject& subject, std::span<const Truth> truths, uint64_t seed) {
    std::vector<std::string> failures(3);
    std::vector<Floats> expected;
    for (const Truth& truth : truths) expected.push_back(subject.msad(truth.sources));
    const auto ask = [&](size_t thread) {
        Dice dice(seed + thread);
        for (uint32_t round = 0; round < 12; ++round) {
            const size_t i = dice.below(truths.size());
            Floats field(subject.vertex_count(), -1);
            succeed(geoidx_msad(subject.index(), truths[i].sources.data(), 1, field.data(),
                                subject.vertex_count()),
                    "geoidx_msad");
            expect_same("several threads at once", field, expected[i]);
            const uint32_t target = dice.below(subject.vertex_count());
            float distance = -1;
            succeed(geoidx_sssd(subject.index(), truths[i].sources[0], target, &distance), "geoidx_sssd");
            check_answer("sssd at once", subject.input(), subject.bounds(), truths[i], target, distance);
        }
    };
    {
        std::vector<std::jthread> threads;
        for (size_t t = 0; t < failures.size(); ++t)
            threads.emplace_back([&, t] {
                try {
                    ask(t);
                } catch (const Finding& finding) {
                    failures[t] = finding.what();
                }
            });
    }
    for (const auto& failure : failures)
        if (!failure.empty()) throw Finding("several threads at once", failure);
}

}

void check_queries(const Subject& subject, geoidx_solver* solver, std::span<const Truth> truths, Dice& dice) {
    check_pairs(subject, truths, dice);
    check_fields(subject, truths);
    check_prepared(subject, truths, dice);
    for (uint32_t round = 0; round < 3; ++round) check_several(subject, solver, truths, dice);
    const Truth& one = truths[dice.below(truths.size())];
    const Floats field = subject.msad(one.sources);
    check_radius(subject, one.sources, field, dice);
    check_threads(subject, one.sources, field, dice);
    const SurfacePoints points(subject.input());
    check_points(subject, points, solver, dice);
    check_paths(subject, points, solver, dice);
    if (dice.chance(0.2)) check_at_once(subject, truths, dice.bits());
}

void check_same_answers(const char* check, const Subject& one, const Subject& other,
                        std::span<const Truth> truths, Dice& dice) {
    for (const Pair& pair : random_pairs(one, truths, dice)) {
        const float a = one.sssd(pair.source(), pair.target), b = other.sssd(pair.source(), pair.target);
        expect(same_bits(a, b), check, "%u to %u: %.9g and %.9g", pair.source(), pair.target, double{a},
               double{b});
    }
    const auto sources = random_sources(one, truths, dice);
    expect_same(check, other.msad(sources), one.msad(sources));
    for (const Truth& truth : truths) expect_same(check, other.msad(truth.sources), one.msad(truth.sources));
}

}
