#pragma once

#include <span>
#include <string>
#include <string_view>

namespace geodesic::tools {

// How many letters must be added, taken away, replaced, or swapped with their neighbour.
size_t edit_distance(std::string_view a, std::string_view b);

// The word that was probably meant: the closest one, which at most two edits and at most half of its
// letters tell from `word`, or which `word` is the beginning of; empty where there is none.
std::string probable_word(std::string_view word, std::span<const std::string> words);

}
