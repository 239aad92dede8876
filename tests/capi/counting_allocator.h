#pragma once

#include <cstdlib>
#include <map>
#include <mutex>

#include "geoidx.h"

namespace geodesic::test {

// An allocator for geoidx that keeps account and can be told to fail: from the first failing call on, all
// fail, or only that one. It also fails beyond BUDGET, so that a defect does not take the machine along.
class CountingAllocator {
public:
    explicit CountingAllocator(uint64_t failing_call = UINT64_MAX, bool recovers = false)
        : failing_call_(failing_call), recovers_(recovers) {}
    CountingAllocator(const CountingAllocator&) = delete;
    CountingAllocator& operator=(const CountingAllocator&) = delete;
    ~CountingAllocator() {
        for (const auto& [memory, block] : blocks_) std::free(memory);
    }

    geoidx_allocator get() { return {allocate, release, this}; }

    // The call_from_now-th allocation from now on fails; 0 is the next one.
    void fail_at(uint64_t call_from_now) {
        const std::lock_guard lock(mutex_);
        failing_call_ = calls_ + call_from_now;
    }
    void never_fail() {
        const std::lock_guard lock(mutex_);
        failing_call_ = UINT64_MAX;
    }

    uint64_t calls() const { return calls_; }
    uint64_t failures() const { return failures_; }
    uint64_t bytes() const { return bytes_; }
    uint64_t largest() const { return largest_; }
    size_t blocks() const { return blocks_.size(); }
    // Releases of what was not allocated, or with another size or alignment.
    uint64_t mistakes() const { return mistakes_; }

private:
    static constexpr uint64_t BUDGET = uint64_t{64} << 20;

    struct Block {
        uint64_t size, alignment;
    };

    static void* allocate(void* user, uint64_t size, uint64_t alignment) {
        auto& self = *static_cast<CountingAllocator*>(user);
        const std::lock_guard lock(self.mutex_);
        const uint64_t call = self.calls_++;
        if (alignment == 0 || alignment > 64 || (alignment & (alignment - 1)) != 0) ++self.mistakes_;
        if (self.recovers_ ? call == self.failing_call_ : call >= self.failing_call_) {
            ++self.failures_;
            return nullptr;
        }
        self.largest_ = size > self.largest_ ? size : self.largest_;
        if (size > BUDGET || self.bytes_ > BUDGET - size) return nullptr;
        void* memory = std::aligned_alloc(64, (size + 63) / 64 * 64);
        if (!memory) return nullptr;
        self.blocks_[memory] = {size, alignment};
        self.bytes_ += size;
        return memory;
    }

    static void release(void* user, void* memory, uint64_t size, uint64_t alignment) {
        auto& self = *static_cast<CountingAllocator*>(user);
        const std::lock_guard lock(self.mutex_);
        const auto found = self.blocks_.find(memory);
        if (found == self.blocks_.end() || found->second.size != size ||
            found->second.alignment != alignment) {
            ++self.mistakes_;
            return;
        }
        self.bytes_ -= size;
        self.blocks_.erase(found);
        std::free(memory);
    }

    std::mutex mutex_;
    std::map<void*, Block> blocks_;
    uint64_t failing_call_, calls_ = 0, failures_ = 0, bytes_ = 0, largest_ = 0, mistakes_ = 0;
    bool recovers_;
};

}
