#pragma once

#include <cstring>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "geoidx.h"
#include "tests/format/helpers.h"

// What geoidx_verify tells of a file.
namespace geodesic::test {

struct ToldIssue {
    uint32_t number;
    geoidx_status status;
    uint64_t offset;
};

inline std::vector<ToldIssue> told_issues(std::span<const std::byte> file) {
    std::vector<ToldIssue> told;
    const auto add = [](void* user, const geoidx_issue* issue) {
        CHECK(std::strlen(issue->message) > 0);
        static_cast<std::vector<ToldIssue>*>(user)->push_back({issue->number, issue->status, issue->offset});
        return int32_t{1};
    };
    const geoidx_status status = geoidx_verify(file.data(), file.size(), add, &told);
    CHECK(status == (told.empty() ? GEOIDX_OK : told[0].status));
    return told;
}

// Where the stored bytes of a section begin, by the section table as SPEC.md has it; 0 if there is none.
inline uint64_t begin_of_section(std::span<const std::byte> file, const char* tag) {
    const format::test::Bytes bytes(file.begin(), file.end());
    const uint64_t count = format::test::get(bytes, format::test::SECTION_COUNT, 4);
    for (uint64_t i = 0; i < count; ++i)
        if (std::memcmp(bytes.data() + format::test::record(i), tag, 4) == 0)
            return format::test::get(bytes, format::test::record(i) + format::test::OFFSET, 8);
    return 0;
}

// The file is corrupt for one reason, which has this number, in this section.
inline void check_told(std::span<const std::byte> file, uint32_t number, const char* tag) {
    CAPTURE(tag);
    const auto told = told_issues(file);
    REQUIRE(told.size() == 1);
    CHECK(told[0].number == number);
    CHECK(told[0].status == GEOIDX_ERROR_CORRUPT);
    CHECK(told[0].offset == begin_of_section(file, tag));
}

}
