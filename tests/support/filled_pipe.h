#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include <sys/ioctl.h>
#include <unistd.h>

#include <doctest/doctest.h>

namespace geodesic::test {

// A pipe that has been filled and that nobody writes to any more.
class FilledPipe {
public:
    explicit FilledPipe(std::span<const std::byte> bytes) {
        std::array<int, 2> ends{};
        REQUIRE(::pipe(ends.data()) == 0);
        end_ = ends[0];
        const ssize_t written = ::write(ends[1], bytes.data(), bytes.size());
        ::close(ends[1]);
        REQUIRE(written == static_cast<ssize_t>(bytes.size()));
    }
    FilledPipe(const FilledPipe&) = delete;
    FilledPipe& operator=(const FilledPipe&) = delete;
    ~FilledPipe() { ::close(end_); }

    std::string path() const { return "/dev/fd/" + std::to_string(end_); }
    // How many bytes nobody has read yet.
    std::size_t left() const {
        int count = 0;
        REQUIRE(::ioctl(end_, FIONREAD, &count) == 0);
        return static_cast<std::size_t>(count);
    }

private:
    int end_ = -1;
};

}
