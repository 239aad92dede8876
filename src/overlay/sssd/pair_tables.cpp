#include "src/overlay/sssd/pair_tables.h"

#include <mutex>

#include "src/overlay/sssd/labels.h"
#include "src/overlay/sssd/samples.h"

namespace geodesic {

void require_pair_tables(const OverlayIndex& index) {
    PairTables& pairs = index.pairs;
    if (pairs.are_made.load(std::memory_order_acquire)) return;
    const std::lock_guard only_one(pairs.making);
    if (pairs.are_made.load(std::memory_order_relaxed)) return;
    std::pmr::memory_resource* memory = pairs.samples.codes.get_allocator().resource();
    pairs.samples = Samples(memory);
    make_samples(index, pairs.samples);
    if (pairs.has_labels)
        pairs.labels.emplace(lay_out_labels(index, memory));
    else
        pairs.labels.emplace(index.numbering.patch_count(), memory);
    pairs.are_made.store(true, std::memory_order_release);
}

void release_pair_tables(const OverlayIndex& index) {
    PairTables& pairs = index.pairs;
    std::pmr::memory_resource* memory = pairs.samples.codes.get_allocator().resource();
    pairs.are_made = false;
    pairs.samples = Samples(memory);
    pairs.labels.reset();
}

}
