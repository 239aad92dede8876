#pragma once

#include "tests/campaign/subject.h"

namespace geodesic::campaign {

// Every query of the API against the metric, and against the others that must give the same bits. `truths`
// are of single sources, in all parts of the mesh.
void check_queries(const Subject& subject, geoidx_solver* solver, std::span<const Truth> truths, Dice& dice);

// Two indices that must give the same bits.
void check_same_answers(const char* check, const Subject& one, const Subject& other,
                        std::span<const Truth> truths, Dice& dice);

}
