#include "tools/spelling.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace geodesic::tools {

// Row by row of the table of all beginnings of `a` and `b`; a swap looks two rows up.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> two_up, above, row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        two_up = above;
        above = row;
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], two_up[j - 2] + 1);
        }
    }
    return row.back();
}

std::string probable_word(std::string_view word, std::span<const std::string> words) {
    std::string best;
    size_t least = 3;
    for (const std::string& candidate : words) {
        const bool is_beginning = word.size() > 1 && candidate.starts_with(word);
        const size_t distance = is_beginning ? 1 : edit_distance(word, candidate);
        if (distance >= least || 2 * distance > candidate.size()) continue;
        least = distance;
        best = candidate;
    }
    return best;
}

}
