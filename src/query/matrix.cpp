#include <algorithm>
#include <string>

#include "format/error.h"
#include "src/query/query.h"

namespace geodesic {

// How many pairs take as long as one field, as measured on meshes of 500 to 50,000 vertices: by the graph
// engine about 2; by the overlay engine 10 on the smallest, and one more for each 400 vertices, or for each
// 900 where the field is swept in a batch.
double Query::pairs_worth_a_field(size_t fields) const {
    if (!std::holds_alternative<OverlayQuery>(engine_)) return 2;
    const double vertices_per_pair = fields < OverlayQuery::FEWEST_AT_ONCE ? 400 : 900;
    return 10 + index_.numbering().vertex_count() / vertices_per_pair;
}

bool Query::pairs_are_faster(size_t pairs, size_t fields) const {
    return static_cast<double>(pairs) < static_cast<double>(fields) * pairs_worth_a_field(fields);
}

void Query::matrix(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                   std::span<float> distances) {
    if (distances.size() != uint64_t{source_ids.size()} * target_ids.size())
        refuse_argument("distance_count is " + std::to_string(distances.size()) + ", but there are " +
                        std::to_string(source_ids.size()) + " sources and " +
                        std::to_string(target_ids.size()) + " targets");
    for (const auto ids : {source_ids, target_ids})
        for (const uint32_t id : ids) number_of(id);
    const size_t rows = source_ids.size(), columns = target_ids.size();
    const bool is_symmetric = std::ranges::equal(source_ids, target_ids);
    const size_t pairs = is_symmetric ? rows * (rows + 1) / 2 : rows * columns;
    if (pairs_are_faster(pairs, std::min(rows, columns)))
        matrix_of_pairs(source_ids, target_ids, is_symmetric, distances.data());
    else if (rows <= columns)
        matrix_of_fields(source_ids, target_ids, {distances.data(), columns, 1});
    else
        matrix_of_fields(target_ids, source_ids, {distances.data(), 1, columns});
}

// Where sources and targets are the same, what is above the diagonal is below it, too, bit for bit.
void Query::matrix_of_pairs(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                            bool is_symmetric, float* distances) {
    const size_t columns = target_ids.size();
    for (size_t i = 0; i < source_ids.size(); ++i) {
        const size_t first = is_symmetric ? i : 0;
        pair_ids_.clear();
        for (const uint32_t target : target_ids.subspan(first))
            pair_ids_.insert(pair_ids_.end(), {source_ids[i], target});
        sssd_each(pair_ids_, {distances + i * columns + first, columns - first});
        for (size_t j = 0; j < first; ++j) distances[i * columns + j] = distances[j * columns + i];
    }
}

// Reads the wanted distances where the fields lie, by number.
void Query::matrix_of_fields(std::span<const uint32_t> source_ids, std::span<const uint32_t> target_ids,
                             const MatrixEntries& entries) {
    for (size_t done = 0; done < source_ids.size();) {
        const auto ids = source_ids.subspan(done, fields_at_once(source_ids.size() - done));
        const FieldsByNumber fields = fields_from(ids);
        for (size_t j = 0; j < target_ids.size(); ++j) {
            const uint32_t number = number_of(target_ids[j]); // again: an entry may have overwritten it
            for (size_t i = 0; i < ids.size(); ++i)
                entries.at(done + i, j) = ids[i] == target_ids[j] ? 0 : fields.at(i, number);
        }
        done += ids.size();
    }
}

}
